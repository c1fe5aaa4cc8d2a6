# SPDX-FileCopyrightText: The Edgecase authors
# SPDX-License-Identifier: Apache-2.0
"""The ready workflow files, whose shell lines are carried out."""
import json
import os
import pathlib
import re
import shutil
import subprocess
import unittest

import yaml

from support import PROGRAM, SOURCE
from test_ci import CiTest


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
        # A number of cases and not a time, in which a busy machine may draw none.
        self.assertIn('--time "${HUNT_TIME:-30m}"', hunt)
        hunt = hunt.replace('--time "${HUNT_TIME:-30m}"', "--cases 128")
        for number, attempt in ((7, 1), (7, 2), (8, 1)):
            done = self.shell(hunt, flow["env"] | {"SHARD": "1", "GITHUB_RUN_ID": str(number),
                                                   "GITHUB_RUN_ATTEMPT": str(attempt)}, "flip-pixel@*")
            # The same seed finds what is known by then.
            self.assertEqual(done.returncode, 0 if attempt == 2 else 1, done.stdout + done.stderr)
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



class Nightly(CiTest):
    """.ci/nightly and the workflow of this project that runs its parts; what they call is made up."""

    RUNS = {
        "parsers": ["install-packages scripts/packages.txt scripts/packages-tests.txt scripts/packages-fuzz.txt", "fuzz 300"],
        "doors": ["install-packages scripts/packages.txt", "build release edgecase", "edgecase run --doors all -o out/doors"],
        "tests": ["run-tests --all of 1/1"],
        "hunt": ["install-packages scripts/packages.txt", "build release edgecase",
                 "edgecase fuzz --time 20m --seed DAY -o out/hunt"],
        "chaos": ["install-packages scripts/packages.txt scripts/packages-tests.txt",
                  "build release --tests edgecase hostile_layer chaos_preload", "chaos.py --seed DAY --minutes 10"],
        "clang": ["install-packages scripts/packages.txt scripts/packages-tests.txt scripts/packages-fuzz.txt",
                  "build clang --tests",
                  f"ctest --test-dir build/clang -j {len(os.sched_getaffinity(0)) + 1} --no-tests=error --output-on-failure"],
        "aarch64": ["test-aarch64 "],
        "webgpu": ["install-packages scripts/packages.txt scripts/packages-webgpu.txt", "setup-drivers lvp26",
                   "judge-webgpu --driver=lvp26"]}

    def part(self, *words):
        log = self.folder / "log"
        log.write_text("")
        checkout = self.folder / "checkout"
        shutil.rmtree(checkout, ignore_errors=True)
        (checkout / ".ci").mkdir(parents=True)
        shutil.copy(SOURCE / ".ci/nightly", checkout / ".ci/nightly")
        for name in ("scripts/install-packages", "scripts/build", "scripts/fuzz", "scripts/run-tests",
                     "scripts/test-aarch64", "scripts/setup-drivers", "scripts/judge-webgpu", "path/ctest",
                     "build/release/bin/edgecase", "tests/chaos/chaos.py"):
            path = checkout / name
            path.parent.mkdir(parents=True, exist_ok=True)
            shares = "SHARES=\"${EDGECASE_SUITE_SHARE:+ of $EDGECASE_SUITE_SHARE}\""
            path.write_text(f'#!/bin/sh\n{shares}\necho "{path.name} $*$SHARES" >> {log}\n[ "$FAILS" != {path.name} ]\n')
            path.chmod(0o755)
        env = {k: v for k, v in os.environ.items() if k != "FUZZ_SECONDS"}
        env["PATH"] = f"{checkout}/path:{env['PATH']}"
        done = [subprocess.run([checkout / ".ci/nightly", *words], env=env | {"FAILS": name}, capture_output=True, text=True)
                for name in ("", *{line.split()[0] for line in self.RUNS.get("".join(words), [])})]
        return done, log.read_text().splitlines()

    def test_each_part(self):
        flow = yaml.safe_load((SOURCE / ".github/workflows/nightly.yml").read_text())
        self.assertEqual(flow["jobs"]["part"]["strategy"]["matrix"]["part"], list(self.RUNS))
        runs = [step["run"] for step in flow["jobs"]["part"]["steps"] if ".ci/nightly" in step.get("run", "")]
        self.assertEqual(runs, [".ci/nightly ${{ matrix.part }}"])
        for name, lines in self.RUNS.items():
            with self.subTest(part=name):
                done, log = self.part(name)
                self.assertEqual([re.sub(r"--seed 20\d{6} ", "--seed DAY ", line) for line in log[:len(lines)]], lines)
                # Whatever fails fails the part.
                self.assertEqual([one.returncode == 0 for one in done], [True] + [False] * len(lines))
                for line in lines:
                    for file in re.findall(r"scripts/\S+", line):
                        self.assertTrue((SOURCE / file).is_file(), file)

    def test_a_part_that_is_none(self):
        for words in ((), ("door",)):
            done, log = self.part(*words)
            self.assertEqual((done[0].returncode, log), (2, []))
            self.assertRegex(done[0].stderr, r"^\.ci/nightly: '.*' is no part; there are parsers, doors, tests, hunt, chaos, clang, aarch64 and webgpu\n$")

if __name__ == "__main__":
    unittest.main()
