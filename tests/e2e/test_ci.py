# SPDX-FileCopyrightText: The Edgecase authors
# SPDX-License-Identifier: Apache-2.0
"""What continuous integration sees: annotations, summaries, shards put together."""
import json
import unittest
import xml.etree.ElementTree

from support import CASE, ProgramTest


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

    def test_one_cause_of_many_families_is_one_annotation(self):
        """That there are ten at most is tested with records (tests/unit/report/ci_test.cpp)."""
        for k in range(13):
            self.write_case(f"family{k:02}/x", (self.suite / "fam/c1.toml").read_text())
        env = self.in_ci("flip-pixel,segv@family12/x", GITHUB_ACTIONS="true")
        out = self.run_in(env, check=1).stdout
        self.assertEqual(out.count("::error "), 2)
        self.assertRegex(out, r"title=crash%3A SIGSEGV during \w+ in family12%2C 1 case::")
        self.assertRegex(out, r"title=fail%3A \S+ \w+ in fam%2C family00%2C family01 and 10 more%2C \d+ cases::")

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


if __name__ == "__main__":
    unittest.main()
