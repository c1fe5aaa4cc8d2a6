# SPDX-FileCopyrightText: The Edgecase authors
# SPDX-License-Identifier: Apache-2.0
"""What continuous integration sees: annotations, summaries, shards put together, ready workflow files."""
import json
import os
import pathlib
import re
import shutil
import subprocess
import unittest
import xml.etree.ElementTree

import yaml

from support import CASE, PROGRAM, SOURCE, ProgramTest


class CiTest(ProgramTest):
    def in_ci(self, fault="", **variables):
        env = self.environment(fault)
        env.update(variables)
        return env

    def run_in(self, env, *words, check, out=None):
        return self.edgecase("run", "--renderer=reference", "-o", out or self.out, *words, env=env, check=check)


class GitHub(CiTest):
    def test_one_annotation_a_cause_and_a_summary(self):
        summary = self.folder / "summary.md"
        summary.write_text("# before\n")
        env = self.in_ci("flip-pixel@fam/c1,flip-pixel@fam/c2,flip-pixel@fam/c3,flip-pixel@fam/c4,segv@fam/c7", GITHUB_ACTIONS="true", CI="true",
                         GITHUB_STEP_SUMMARY=str(summary), GITHUB_WORKSPACE=str(self.folder))
        lines = [x for x in self.run_in(env, check=1).stdout.splitlines() if x.startswith("::")]
        self.assertEqual(len(lines), 2)
        self.assertRegex(lines[0], r"^::error file=cases/suite/fam/c7\.toml,line=1,"
                                   r"title=crash%3A SIGSEGV during \w+ in fam%2C 1 case::fam/c7")
        self.assertRegex(lines[1], r"^::error file=cases/suite/fam/c1\.toml,line=1,title=fail%3A \S+ \w+ in fam%2C 4 cases::")
        self.assertIn("%0Arerun: ", lines[1])
        text = summary.read_text()
        self.assertTrue(text.startswith("# before\n## Edgecase: exit 1: unexpected results\n"))
        self.assertIn("| crash | 1 |", text)
        self.assertIn("| pass | 5 |", text)
        self.assertRegex(text, r"\n    .*edgecase\S* run fam/c7")

    def test_ten_causes_and_the_number_of_the_others(self):
        for k in range(13):
            self.write_case(f"family{k}/x", (self.suite / "fam/c1.toml").read_text())
        env = self.in_ci("flip-pixel", GITHUB_ACTIONS="true")
        out = self.run_in(env, check=1).stdout
        self.assertEqual(out.count("::error "), 10)
        self.assertIn("+4 more causes of unexpected results: see the summary of the step\n", out)

    def test_nothing_unexpected_is_silent(self):
        env = self.in_ci(GITHUB_ACTIONS="true")
        self.assertNotIn("::", self.run_in(env, check=0).stdout)

    def test_a_run_that_cannot_begin_is_told(self):
        for words, code, told in ((["nosuch/**"], 4, "error: no case matches nosuch/**"), ([], 5, "EDGECASE_FAULT names an unknown fault 'x'")):
            env = self.in_ci("x", GITHUB_ACTIONS="true")
            done = self.run_in(env, *words, check=code)
            self.assertIn("::error title=edgecase::" + told, done.stderr)
            self.assertNotIn("::error", self.run_in(env, *words, "--ci=none", check=code).stderr)

    def test_json_on_standard_output_stays_json(self):
        env = self.in_ci("flip-pixel@fam/c1", GITHUB_ACTIONS="true")
        done = self.run_in(env, "--json", "-", check=1)
        json.loads(done.stdout)
        self.assertIn("::error ", done.stderr)

    def test_not_without_being_asked(self):
        self.assertNotIn("::error", self.run_suite(fault="flip-pixel@fam/c1", check=1).stdout)
        env = self.in_ci("flip-pixel@fam/c1", GITHUB_ACTIONS="true")
        self.assertNotIn("::error", self.run_in(env, "--ci", "none", check=1).stdout)
        self.assertIn("::error", self.run_suite("--ci", "github", fault="flip-pixel@fam/c1", check=1).stdout)

    def test_a_summary_that_cannot_be_written(self):
        env = self.in_ci(GITHUB_ACTIONS="true", GITHUB_STEP_SUMMARY=str(self.folder / "no" / "where.md"))
        done = self.run_in(env, check=7)
        self.assertIn(f"edgecase: error: the step summary '{self.folder}/no/where.md' cannot be written: "
                      "No such file or directory", done.stderr)

    def test_unknown_ci(self):
        done = self.run_suite("--ci", "gitlub", check=2)
        self.assertEqual(done.stderr, "edgecase: --ci: 'gitlub' is none of auto, github, gitlab, none; "
                                      "did you mean 'github'? See 'edgecase run --help'\n")


class GitLab(CiTest):
    def test_code_quality(self):
        env = self.in_ci("flip-pixel@fam/c1,flip-pixel@fam/c2,segv@fam/c7", GITLAB_CI="true", CI_PROJECT_DIR=str(self.folder))
        self.run_in(env, check=1)
        issues = json.loads((self.out / "gl-code-quality.json").read_text())
        self.assertEqual([i["location"] for i in issues],
                         [{"path": f"cases/suite/fam/c{k}.toml", "lines": {"begin": 1}} for k in (1, 2, 7)])
        self.assertEqual([i["severity"] for i in issues], ["critical", "critical", "blocker"])
        self.assertEqual(len({i["fingerprint"] for i in issues}), 3)
        for issue in issues:
            self.assertEqual(set(issue), {"description", "check_name", "fingerprint", "severity", "location"})
        self.run_in(env, check=1, out=self.folder / "again")
        again = json.loads((self.folder / "again" / "gl-code-quality.json").read_text())
        self.assertEqual([i["fingerprint"] for i in issues], [i["fingerprint"] for i in again])

    def test_without_findings_an_empty_list(self):
        self.run_in(self.in_ci(GITLAB_CI="true"), check=0)
        self.assertEqual(json.loads((self.out / "gl-code-quality.json").read_text()), [])


def told(results):
    """What a case says in every run, by id."""
    return {c["id"]: {k: v for k, v in c.items() if k not in ("seconds", "rerun", "attempts")} for c in results["cases"]}


class Merge(CiTest):
    FAULT = "flip-pixel@fam/c1,flip-pixel@fam/c4,segv@fam/c7"

    def shards(self, count=3, fault=FAULT, **words):
        folders = []
        for k in range(1, count + 1):
            folders.append(self.folder / f"shard-{k}")
            self.run_suite("--shard", f"{k}/{count}", *words.get(f"words{k}", ()), out=folders[-1], fault=fault)
        return [f for f in folders if f.exists()]

    def test_the_parts_are_the_whole(self):
        folders = self.shards()
        self.assertEqual(len(folders), 3)
        merged = self.folder / "merged"
        done = self.edgecase("report", "--merge", *folders, "-o", merged, check=1)
        self.assertIn("10 cases  7 pass  2 fail  1 crash", done.stdout)
        self.run_suite(fault=self.FAULT, check=1)
        self.assertEqual(told(self.results(merged)), told(self.results()))
        # The merged folder is a run like any other.
        self.edgecase("report", merged, check=0)
        self.assertEqual(told(self.results(merged)), told(self.results()))
        self.run_suite("--failed-in", merged, out=self.folder / "again", check=0)
        self.assertEqual(set(self.statuses(self.folder / "again")), {"fam/c1", "fam/c4", "fam/c7"})

    def test_all_as_expected(self):
        self.edgecase("report", "--merge", *self.shards(fault=""), "-o", "merged", check=0)

    def test_a_shard_is_missing(self):
        folders = self.shards(fault="")
        done = self.edgecase("report", "--merge", folders[0], folders[2], "-o", "merged", check=7)
        self.assertEqual(done.stderr, "edgecase: shard 2 is not among the folders, so not every case of the run is "
                                      "here; name the folders of all shards\n")
        self.assertTrue((self.folder / "merged" / "report.html").exists())

    def test_the_reports_of_a_merge_say_that_a_shard_is_missing(self):
        """A job that died looks like success in no report, now or later."""
        folders = self.shards(fault="")
        env = self.in_ci(GITHUB_ACTIONS="true", GITHUB_STEP_SUMMARY=str(self.folder / "summary.md"))
        words = ("report", "--merge", folders[0], folders[2], "-o", "merged")
        done = self.edgecase(*words, env=env, check=7)
        self.assertIn("exit 7: shard 2 is missing\n", done.stdout)
        self.assertEqual(done.stdout.count("::error title=edgecase::shard 2 is not among the folders"), 1)
        self.assertIn("## Edgecase: exit 7: shard 2 is missing\n", (self.folder / "summary.md").read_text())
        self.edgecase(*words, "--ci", "gitlab", check=7)
        [issue] = json.loads((self.folder / "merged/gl-code-quality.json").read_text())
        self.assertEqual(issue["severity"], "blocker")
        later = self.edgecase("report", "merged", "-o", "later", check=0)
        self.assertIn("the run ended with exit 7: shard 2 is missing\n", later.stdout)
        for out in ("merged", "later"):
            results = self.results(self.folder / out)
            self.assertEqual((results["run"]["exit_code"], results["run"]["missing_shards"]), (7, [2]))
            junit = xml.etree.ElementTree.parse(self.folder / out / "junit.xml").getroot()
            self.assertEqual((junit.get("errors"), junit.get("tests")), ("1", str(len(results["cases"]) + 1)))
            page = (self.folder / out / "report.html").read_text()
            self.assertIn("<h1>Not the whole run: shard 2 is missing</h1>", page)

    def test_a_merge_that_fails_leaves_no_report_of_an_earlier_one(self):
        folders = self.shards(fault="")
        self.edgecase("report", "--merge", *folders, "-o", "merged", check=0)
        self.edgecase("report", "--merge", folders[0], folders[0], "-o", "merged", check=3)
        self.assertEqual([f.name for f in (self.folder / "merged").iterdir()], ["journal.jsonl.old"])

    def refused(self, sentence, *words, code=3):
        done = self.edgecase("report", *words, check=code)
        self.assertEqual(done.stderr, f"edgecase: {sentence}\n")
        self.assertFalse((self.folder / "merged").exists())

    def test_twice_the_same(self):
        a = self.shards(1, fault="")[0]
        b = self.folder / "b"
        self.run_suite(out=b, check=0)
        self.refused(f"the case 'fam/c0' is in {a} and in {b}; give each job its own --shard",
                     "--merge", a, b, "-o", "merged")

    def different(self, what, a, b, *, words=(), change=None):
        one, two = self.folder / "one", self.folder / "two"
        self.run_suite("--shard", "1/2", out=one, check=0)
        if change:
            change()
        self.run_suite("--shard", "2/2", *words, out=two, check=0)
        if b is None:
            hashes = [self.results(x)["run"]["suite_hash"] for x in (one, two)]
            a, b = hashes
        self.refused(f"{what} is '{a}' in {one} and '{b}' in {two}; only parts of one run can be merged, "
                     "use 'edgecase compare' for different ones", "--merge", one, two, "-o", "merged")

    def test_two_profiles(self):
        self.different("the profile", "direct3d", "vulkan", words=["--profile", "vulkan"])

    def test_two_suites(self):
        self.different("the suite (a hash of its files)", None, None,
                       change=lambda: self.write_case("fam/c9", (self.suite / "fam/c9.toml").read_text() + "\n"))

    def test_two_devices(self):
        one, two = self.folder / "one", self.folder / "two"
        self.run_suite("--shard", "1/2", out=one, check=0)
        self.edgecase("run", "--renderer=tiles", "--shard", "2/2", "-o", two)
        done = self.edgecase("report", "--merge", one, two, "-o", "merged", check=3)
        self.assertIn("edgecase: the device is '", done.stderr)

    def test_two_numbers_of_shards(self):
        self.run_suite("--shard", "1/2", out=self.folder / "one", check=0)
        self.run_suite("--shard", "2/3", out=self.folder / "two", check=0)
        self.refused("the number of shards is '2' in one and '3' in two; only parts of one run can be merged, "
                     "use 'edgecase compare' for different ones", "--merge", "one", "two", "-o", "merged")

    def test_two_selections(self):
        """Whatever chose the cases: each part is whole in itself, and together they are no run."""
        for n in (1, 2):
            self.write_case(f"other/c{n}", CASE.format(n=20 + n))
        one = self.folder / "one"
        failed = self.folder / "failed"
        self.run_suite("fam/c1", "fam/c2", "fam/c3", fault="flip-pixel@*/*", out=failed, check=1)
        self.run_suite("fam/**", "--shard", "1/2", out=one, check=0)
        for number, words in enumerate((["other/**"], ["fam/*", "!fam/c1"], [], ["fam/**", "--failed-in", failed])):
            two = self.folder / f"two-{number}"
            self.run_suite(*words, "--shard", "2/2", out=two)
            done = self.edgecase("report", "--merge", one, two, "-o", "merged", check=3)
            self.assertRegex(done.stderr, r"\Aedgecase: the selection before --shard \(a hash of the ids\) is "
                                          r"'10 cases, [0-9a-f]{16}' in .*one and '\d+ cases?, [0-9a-f]{16}' in ")
        # The same cases by other words are the same selection.
        two = self.folder / "two"
        self.run_suite("@rule:cover.inside", "!other/*", "--shard", "2/2", "--shuffle", out=two, check=0)
        self.edgecase("report", "--merge", one, two, "-o", "merged", check=0)

    def test_quick_beside_the_whole(self):
        self.write_case("fam/leaves", CASE.format(n=30).replace("[target]", "[matrix]\nk = [1, 2, 3, 4]\n[target]")
                        .replace("[1,1]", "[\"k\",1]"))
        for n, words in enumerate(([], ["--quick"])):
            self.run_suite("fam/leaves", *words, "--shard", f"{n + 1}/2", out=self.folder / f"part-{n}")
        self.assertIn("the selection before --shard",
                      self.edgecase("report", "--merge", "part-0", "part-1", "-o", "merged", check=3).stderr)

    def test_two_judgements(self):
        known = self.folder / "known.txt"
        known.write_text("# edgecase-expectations 2\n# device: Edgecase*\nfam/c1 fail b#1 double:cover.outside@vulkan<=1  # Known.\n")
        for what, one, two in (("what the expectation files hold (a hash)", ["--expect", known], ["--no-expect"]),
                               ("what else decides (options)", [], ["--require-support"]),
                               ("what else decides (options)", ["--repeat", "2"], []),
                               ("what else decides (options)", [], ["--retries", "0"])):
            self.run_suite(*one, "--shard", "1/2", out=self.folder / "one")
            self.run_suite(*two, "--shard", "2/2", out=self.folder / "two")
            self.assertIn(f"edgecase: {what} is '",
                          self.edgecase("report", "--merge", "one", "two", "-o", "merged", check=3).stderr)
        self.assertIn("is '' in one and '--retries 0' in two", self.edgecase("report", "--merge", "one", "two", check=3).stderr)

    def test_a_changed_case_of_ones_own(self):
        own = self.folder / "mine" / "own.toml"
        own.parent.mkdir()
        own.write_text(CASE.format(n=40))
        self.run_suite("fam/**", own, "--shard", "1/2", out=self.folder / "one", check=0)
        own.write_text(CASE.format(n=41))
        self.run_suite("fam/**", own, "--shard", "2/2", out=self.folder / "two", check=0)
        self.assertIn("edgecase: what case files outside the suite hold (a hash) is '",
                      self.edgecase("report", "--merge", "one", "two", "-o", "merged", check=3).stderr)

    def test_several_folders_without_merge(self):
        self.refused("several folders need --merge; 'edgecase compare' sets runs side by side", *self.shards(2), code=2)

    def test_not_over_a_part(self):
        a, b = self.shards(2)
        self.refused(f"the merged run would overwrite '{a}', which is one of its parts; choose another folder with -o",
                     "--merge", a, b, "-o", a, code=2)

    def test_no_run(self):
        done = self.edgecase("report", "--merge", "nowhere", check=3)
        self.assertIn("nowhere/journal.jsonl: No such file or directory; name the directory of a run", done.stderr)


class Jobs(CiTest):
    """What the shell lines of the templates are carried out with: a container of which only the network is made up. What
    git and the packages would bring is this checkout, already built."""

    BUILD = pathlib.Path(PROGRAM).resolve().parents[1]
    REPOSITORY = {"EDGECASE_REPOSITORY": "someone/edgecase", "EDGECASE_VERSION": "v1"}

    def setUp(self):
        super().setUp()
        self.log = self.folder / "log"
        self.log.write_text("")
        self.checkout = self.folder / "checkout"
        self.stub(self.checkout / "scripts/install-packages", f'echo "install-packages $*" >> {self.log}')
        self.stub(self.checkout / "scripts/build", f'echo "build $* in $CCACHE_DIR" >> {self.log}')
        (self.checkout / "scripts/packages.txt").write_text("")
        (self.checkout / "build").mkdir()
        (self.checkout / "build/release").symlink_to(self.BUILD)
        self.stub(self.folder / "bin/apt-get", f'echo "apt-get $*" >> {self.log}')
        # The driver of one's own: the system's lavapipe, built to where the template looks for it.
        [manifest] = pathlib.Path("/usr/share/vulkan/icd.d").glob("lvp_icd*.json")
        self.stub(self.folder / "build-my-driver", f"mkdir -p build && cp {manifest} build/my_icd.json")

    def stub(self, path, line):
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(f"#!/bin/sh\n{line}\n")
        path.chmod(0o755)

    def versions(self):
        """Makes a repository of the checkout; its address, and the names of one version: a tag and a commit."""
        def git(*words):
            return subprocess.run(["git", "-C", self.checkout, "-c", "user.name=a", "-c", "user.email=a@b", *words], check=True,
                                  capture_output=True, text=True).stdout.strip()
        git("init", "-q")
        git("add", "-A", "-f")
        git("commit", "-q", "-m", "one")
        git("tag", "v1")
        commit = git("rev-parse", "HEAD")
        git("commit", "-q", "--allow-empty", "-m", "two")  # neither is the tip of a branch
        return f"file://{self.checkout}", ("v1", commit)

    def shell(self, line, variables, fault=""):
        env = {k: v for k, v in self.environment(fault).items() if not k.startswith("VK_")}
        env |= variables | {"PATH": f"{self.folder}/bin:{os.environ['PATH']}"}
        return subprocess.run(["bash", "-eo", "pipefail", "-c", line], env=env, cwd=self.folder, capture_output=True, text=True,
                              timeout=200, check=False)

    def log_lines(self):
        lines = self.log.read_text().splitlines()
        self.log.write_text("")
        return lines

    def flow(self, name):
        return yaml.safe_load((SOURCE / f"docs/ci/{name}.yml").read_text())


class Workflows(Jobs):
    """The templates of several jobs: every shell line, the four jobs one after the other. Artefacts are copied by hand."""

    INSTALL = ["apt-get update", "apt-get install -y --no-install-recommends libvulkan1"]

    def carry_out(self, line, variables, fault="", codes=(0,)):
        done = self.shell(line, variables, fault)
        self.assertIn(done.returncode, codes, f"{line}\n{done.stdout}\n{done.stderr}")
        return done

    def keep_output(self):
        shutil.copytree(self.folder / "out", self.folder / "kept", dirs_exist_ok=True)

    def bring_output(self):
        shutil.rmtree(self.folder / "out")
        (self.folder / "kept").rename(self.folder / "out")

    def check_merged(self, done):
        self.assertEqual(done.returncode, 1, done.stderr)
        merged = self.results(self.folder / "out/merged")
        self.assertEqual({c["id"]: c["status"] for c in merged["cases"]}, {x: "fail" if x == "fam/c1" else "pass" for x in self.ids})
        self.assertIn("llvmpipe", merged["device"]["name"])

    def test_github(self):
        flow = self.flow("github-actions-shards")
        variables = flow["env"] | self.REPOSITORY | {"DEVICE": "llvmpipe"}
        jobs = flow["jobs"]
        shutil.copytree(self.checkout, self.folder / "edgecase-source", symlinks=True)
        for step in jobs["build"]["steps"]:
            self.carry_out(step.get("run", ":"), variables)
        self.assertEqual(self.log_lines(), ["install-packages edgecase-source/scripts/packages.txt", "build release in "])
        shutil.rmtree(self.folder / "edgecase-source")
        shards = jobs["suite"]["strategy"]["matrix"]["shard"]
        for shard in shards:
            for step in jobs["suite"]["steps"]:
                words = {name: value.replace("${{ matrix.shard }}", str(shard)) for name, value in step.get("env", {}).items()}
                self.carry_out(step.get("run", ":"), variables | words, "flip-pixel@fam/c1", (0, 1, 4) if "edgecase run" in step.get("run", "") else (0,))
            self.assertEqual(self.log_lines(), self.INSTALL)
            self.keep_output()
        self.assertEqual(sorted(x.name for x in (self.folder / "kept").iterdir()), [f"shard-{k}" for k in shards])
        self.bring_output()
        for step in jobs["report"]["steps"]:
            if "run" in step:
                done = self.carry_out(step["run"], variables | {"GITHUB_STEP_SUMMARY": str(self.folder / "summary.md")}, codes=(0, 1))
        self.check_merged(done)
        self.assertEqual(self.log_lines(), [])  # merging needs no package at all
        self.assertEqual(done.stdout.count("::error "), 1)
        self.assertTrue((self.folder / "summary.md").exists())

    def test_gitlab(self):
        flow = self.flow("gitlab-ci-shards")
        url, versions = self.versions()
        for version in versions:
            variables = flow["variables"] | {"EDGECASE_URL": url, "EDGECASE_VERSION": version, "DEVICE": "llvmpipe"}
            self.carry_out("\n".join(flow["build"]["script"]), variables)
            self.assertEqual(self.log_lines()[-2:], ["install-packages edgecase-source/scripts/packages.txt", "build release in "])
            for path in flow["build"]["artifacts"]["paths"]:
                self.assertTrue((self.folder / path).is_dir(), path)
            shutil.rmtree(self.folder / "edgecase-source")
            count = flow["suite"]["parallel"]
            for k in range(1, count + 1):
                self.carry_out("\n".join(flow["suite"]["script"]), variables | {"CI_NODE_INDEX": str(k), "CI_NODE_TOTAL": str(count)},
                               "flip-pixel@fam/c1", (0, 1, 4))
                self.assertEqual(self.log_lines(), self.INSTALL)
                self.keep_output()
            self.bring_output()
            self.check_merged(self.carry_out("\n".join(flow["report"]["script"]), variables, codes=(1,)))
            self.assertEqual(self.log_lines(), [])
            for file in flow["report"]["artifacts"]["reports"].values():
                self.assertTrue((self.folder / file).exists(), file)
            shutil.rmtree(self.folder / "edgecase")

    def test_another_device_ends_a_shard(self):
        """A driver's fallback must not be judged in the device's place."""
        flow = self.flow("gitlab-ci-shards")
        (self.folder / "edgecase").symlink_to(self.BUILD)
        self.carry_out("./build-my-driver", {})
        done = self.carry_out("\n".join(flow["suite"]["script"]), flow["variables"] | {"DEVICE": "GeForce", "CI_NODE_INDEX": "1", "CI_NODE_TOTAL": "4"}, codes=(5,))
        self.assertIn("GeForce", done.stderr)


class Unchanged(Jobs):
    """A template of which nothing was changed says so in one sentence, before it builds anything."""

    def check(self, script, variables, wanted):
        good = dict.fromkeys(wanted, "x")
        for left in [wanted, *([name] for name in wanted)]:
            done = self.shell(script, variables | {name: value for name, value in good.items() if name not in left})
            self.assertEqual(done.returncode, 1, done.stderr)
            self.assertEqual(len(done.stdout.splitlines()), 1, done.stdout)
            self.assertRegex(done.stdout, "yml: change what is marked 'must be changed': " + ".*".join(wanted))
        return good

    def test_github(self):
        for name, wanted in (("github-actions", ["EDGECASE_REPOSITORY", "EDGECASE_VERSION"]),
                             ("github-actions-fuzz", ["EDGECASE_REPOSITORY", "EDGECASE_VERSION"]),
                             ("github-actions-shards", ["EDGECASE_REPOSITORY", "EDGECASE_VERSION", "DEVICE"])):
            flow = self.flow(name)
            first = next(iter(flow["jobs"].values()))["steps"][0]
            good = self.check(first["run"], flow["env"], wanted)
            self.assertEqual(self.shell(first["run"], flow["env"] | good).returncode, 0)
            self.assertEqual((SOURCE / f"docs/ci/{name}.yml").read_text().count("yours, must be changed:"), len(wanted))

    def test_gitlab(self):
        for name, wanted in (("gitlab-ci", ["EDGECASE_URL", "EDGECASE_VERSION"]), ("gitlab-ci-shards", ["EDGECASE_URL", "EDGECASE_VERSION", "DEVICE"])):
            flow = self.flow(name)
            job = flow.get("build") or flow["edgecase"]
            variables = flow.get("variables") or job["variables"]
            self.check("\n".join(job["script"]), variables, wanted)
            self.assertEqual(self.log_lines(), [])
            self.assertEqual((SOURCE / f"docs/ci/{name}.yml").read_text().count("yours, must be changed:"), len(wanted))


class OneJob(Jobs):
    """The templates of one job: every shell line of them."""

    INSTALLS = ["apt-get update", "apt-get install -y --no-install-recommends libvulkan1"]
    BUILDS = ["install-packages edgecase-source/scripts/packages.txt", "build release in {}/edgecase-ccache"]

    def test_github(self):
        flow = self.flow("github-actions")
        [job] = flow["jobs"].values()
        variables = flow["env"] | self.REPOSITORY | {"GITHUB_ACTIONS": "true", "GITHUB_WORKSPACE": str(self.folder),
                                   "GITHUB_STEP_SUMMARY": str(self.folder / "summary.md")}
        caches = [s["with"]["path"] for s in job["steps"] if s.get("uses", "").startswith("actions/cache")]
        self.assertEqual(caches, ["edgecase", "edgecase-ccache", "edgecase", "edgecase-ccache"])
        for fault, code, cached in (("", 0, False), ("flip-pixel@fam/c1", 1, True)):
            for step in job["steps"]:
                if cached and "cache-hit" in str(step.get("if")):
                    continue
                if step.get("with", {}).get("path") == "edgecase-source":
                    shutil.copytree(self.checkout, self.folder / "edgecase-source", symlinks=True)
                if "run" in step:
                    done = self.shell(step["run"], variables, fault)
                    self.assertEqual(done.returncode, code if "edgecase run" in step["run"] else 0, done.stdout + done.stderr)
            self.assertEqual(self.log_lines(), ([] if cached else [x.format(self.folder) for x in self.BUILDS]) + self.INSTALLS)
            self.assertEqual(sorted(self.statuses(self.folder / "out/edgecase").values()), ["fail"] * code + ["pass"] * (10 - code))
        self.assertEqual(done.stdout.count("::error file=cases/suite/fam/c1.toml"), 1)
        self.assertIn("exit 1", (self.folder / "summary.md").read_text())

    def test_caches_are_kept_although_the_job_fails(self):
        """actions/cache alone saves after a success only; what a failing step leaves is saved before it or always."""
        for name in ("github-actions", "github-actions-fuzz"):
            flow = yaml.safe_load((SOURCE / f"docs/ci/{name}.yml").read_text())
            [job] = flow["jobs"].values()
            uses = [step.get("uses", "") for step in job["steps"]]
            self.assertFalse([word for word in uses if word.startswith("actions/cache@")], name)
            [fails] = [k for k, step in enumerate(job["steps"]) if re.search(r"bin/edgecase (run|fuzz)", step.get("run", ""))]
            of = {word: [(k, step) for k, step in enumerate(job["steps"]) if step.get("uses", "") == f"actions/cache/{word}@v4"]
                  for word in ("restore", "save")}
            self.assertEqual([(s["with"]["path"], s["with"]["key"]) for _, s in of["restore"]],
                             [(s["with"]["path"], s["with"]["key"]) for _, s in of["save"]], name)
            for k, step in of["save"]:
                self.assertTrue(k < fails or "always()" in step["if"], step)
        [job] = yaml.safe_load((SOURCE / "docs/ci/gitlab-ci.yml").read_text()).values()
        self.assertEqual([c["when"] for c in job["cache"]], ["always", "always"])

    def test_hunts_of_one_day(self):
        """A second hunt on a day has a folder of its own, and knows what the first one found."""
        flow = yaml.safe_load((SOURCE / "docs/ci/github-actions-fuzz.yml").read_text())
        [job] = flow["jobs"].values()
        (self.folder / "edgecase").symlink_to(self.BUILD)
        self.assertEqual(self.shell("./build-my-driver", {}, "").returncode, 0)
        [hunt] = [s["run"] for s in job["steps"] if "edgecase fuzz" in s.get("run", "")]
        for number, attempt in ((7, 1), (7, 2), (8, 1)):
            done = self.shell(hunt, flow["env"] | {"SHARD": "1", "HUNT_TIME": "0.001s", "GITHUB_RUN_ID": str(number),
                                                   "GITHUB_RUN_ATTEMPT": str(attempt)}, "flip-pixel@*")
            self.assertEqual(done.returncode, 1, done.stdout + done.stderr)
            self.assertTrue((self.folder / f"hunts/{number}-{attempt}/fuzz.json").exists())

    def test_gitlab(self):
        [job] = self.flow("gitlab-ci").values()
        self.assertEqual([c["paths"] for c in job["cache"]], [["edgecase"], ["edgecase-ccache"]])
        url, versions = self.versions()
        for version in versions:
            variables = job["variables"] | {"EDGECASE_URL": url, "EDGECASE_VERSION": version, "GITLAB_CI": "true", "CI_PROJECT_DIR": str(self.folder)}
            for fault, code, cached in (("", 0, False), ("flip-pixel@fam/c1", 1, True)):
                done = self.shell("\n".join(job["script"]), variables, fault)
                self.assertEqual(done.returncode, code, done.stdout + done.stderr)
                self.assertEqual(self.log_lines(), self.INSTALLS + ([] if cached else
                                 ["apt-get install -y --no-install-recommends git ca-certificates", *(x.format(self.folder) for x in self.BUILDS)]))
                for file in (*job["artifacts"]["paths"], *job["artifacts"]["reports"].values()):
                    self.assertTrue((self.folder / file).exists(), file)
            shutil.rmtree(self.folder / "edgecase")
        self.assertEqual(len(json.loads((self.folder / "out/edgecase/gl-code-quality.json").read_text())), 1)

    def test_the_vulkan_loader_is_all_that_running_needs(self):
        """Beside what every container has; the loader is opened by name."""
        linked = subprocess.run(["ldd", PROGRAM], capture_output=True, text=True, check=True).stdout
        names = set(re.findall(r"^\t(\S+\.so\S*) =>", linked, re.M))
        self.assertEqual({n for n in names if not re.match("lib[a-z]+san", n)},
                         {"libstdc++.so.6", "libm.so.6", "libgcc_s.so.1", "libc.so.6"})
        self.assertIn("\0libvulkan.so.1\0", pathlib.Path(PROGRAM).read_bytes().decode("latin-1"))


if __name__ == "__main__":
    unittest.main()
