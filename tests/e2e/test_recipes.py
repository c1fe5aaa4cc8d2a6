# SPDX-FileCopyrightText: The Edgecase authors
# SPDX-License-Identifier: Apache-2.0
"""The recipes of docs/ci for CTest, lit and git bisect, carried out."""
import glob
import os
import pathlib
import re
import shutil
import subprocess
import sys
import unittest

from support import PROGRAM, SOURCE, ProgramTest

LEAVES = """format = 1
description = "A square of two triangles, moved."
rules = ["cover.inside", "cover.shared-edge"]
[matrix]
x = ["1/2", "3/2"]
[target]
size = [8, 8]
[[draw]]
vertices = [["x",1], [7,1], ["x",7],  [7,1], [7,7], ["x",7]]
"""


class RecipeTest(ProgramTest):
    def setUp(self):
        super().setUp()
        self.write_case("sub.d/e/m", LEAVES)
        self.ids += ["sub.d/e/m:x=1/2", "sub.d/e/m:x=3/2"]

    def call(self, *words, fault="", check=0, **variables):
        done = subprocess.run([str(w) for w in words], env=self.environment(fault) | variables, cwd=self.folder,
                              capture_output=True, text=True, timeout=200, check=False)
        if check is not None:
            self.assertEqual(done.returncode, check, done.stdout + done.stderr)
        return done.stdout


class CTest(RecipeTest):
    def configure(self, *lines):
        (self.folder / "CMakeLists.txt").write_text("\n".join((
            "cmake_minimum_required(VERSION 3.25)", "project(mine NONE)", "enable_testing()",
            f"include({SOURCE}/docs/ci/edgecase.cmake)", *lines)) + "\n")
        self.call("cmake", "-S", ".", "-B", "build", f"-DEDGECASE_PROGRAM={PROGRAM}")

    def run_tests(self, fault, check):
        told = self.call("ctest", "--test-dir", "build", fault=fault, check=check)
        return dict(re.findall(r"Test +#\d+: (\S+) \.*\**[ ]*(\w+)", told))

    def test_a_test_a_folder(self):
        self.configure("edgecase_add_tests(OPTIONS --renderer reference)")
        self.assertEqual(self.run_tests("", 0), {"edgecase.fam": "Passed", "edgecase.sub.d/e": "Passed"})
        self.assertEqual(self.run_tests("flip-pixel@fam/c3,unsupported@sub.d/**", 8),
                         {"edgecase.fam": "Failed", "edgecase.sub.d/e": "Skipped"})
        self.assertEqual(set(self.statuses(self.folder / "build/edgecase/fam")), {x for x in self.ids if x[:3] == "fam"})
        self.assertEqual(set(self.statuses(self.folder / "build/edgecase/sub.d_e")), set(self.ids[-2:]))

    def test_a_test_a_case(self):
        self.configure("edgecase_add_tests(EACH_CASE PREFIX one: SELECTORS fam/c1 fam/c2 sub.d/** OPTIONS --renderer reference)")
        self.assertEqual(self.run_tests("flip-pixel@fam/c2,unsupported@**3/2", 8),
                         {"one:fam/c1": "Passed", "one:fam/c2": "Failed", "one:sub.d/e/m:x=1/2": "Passed",
                          "one:sub.d/e/m:x=3/2": "Skipped"})

    def own_cases(self):
        """A folder of one's own in which a file has the name of one of the suite's."""
        mine = self.folder / "my-cases"
        for name, text in (("fam/c1", (self.suite / "fam/c1.toml").read_text()), ("tie", LEAVES)):
            (mine / name).parent.mkdir(parents=True, exist_ok=True)
            (mine / f"{name}.toml").write_text(text)

    def test_cases_of_ones_own(self):
        self.own_cases()
        self.configure("edgecase_add_tests(OPTIONS --renderer reference SELECTORS fam/c1)",
                       "edgecase_add_tests(SUITE my-cases PREFIX mine. EACH_CASE OPTIONS --renderer reference)")
        self.assertEqual(self.run_tests("flip-pixel@tie:x=3/2", 8), {"edgecase.fam": "Passed", "mine.fam/c1": "Passed",
                                                                     "mine.tie:x=1/2": "Passed", "mine.tie:x=3/2": "Failed"})
        self.configure("edgecase_add_tests(SUITE my-cases SELECTORS fam/* OPTIONS --renderer reference)")
        self.assertEqual(self.run_tests("", 0), {"edgecase.fam": "Passed"})
        self.assertEqual(set(self.statuses(self.folder / "build/edgecase/fam")), {"fam/c1"})

    def test_cases_outside_the_suite_are_one_sentence(self):
        self.own_cases()
        for name in ("my-cases/tie.toml", "my-cases"):
            shutil.rmtree(self.folder / "my-cases/fam", ignore_errors=True)
            with self.assertRaisesRegex(AssertionError, r"SELECTORS choose cases outside\s+the\s+suite;\s+make\s+a\s+call\s+of\s+its\s+own"):
                self.configure(f"edgecase_add_tests(EACH_CASE SELECTORS {self.folder}/{name})")

    def test_a_selector_that_matches_nothing(self):
        with self.assertRaisesRegex(AssertionError, "no case matches nowhere"):
            self.configure("edgecase_add_tests(SELECTORS nowhere/**)")


LIT = next(iter(sorted(glob.glob("/usr/lib/llvm-*/build/utils/lit/lit.py"))), None) or shutil.which("lit")


@unittest.skipIf(LIT is None, "there is no lit: install llvm-14-tools")
class Lit(RecipeTest):
    def test_each_case(self):
        done = self.call(sys.executable, LIT, "-v", SOURCE / "docs/ci/lit", fault="flip-pixel@fam/c2,unsupported@**3/2,segv@fam/c4",
                         check=1, EDGECASE_PROGRAM=PROGRAM, EDGECASE_SELECTORS="'fam/c*' !fam/c9 sub.d/**",
                         EDGECASE_OPTIONS="--renderer reference", TMPDIR=str(self.folder))
        told = dict((name, word) for word, name in re.findall(r"^([A-Z]+): edgecase :: (\S+) \(", done, re.M))
        expected = {name: "PASS" for name in self.ids} | {"fam/c2": "FAIL", "fam/c4": "FAIL", self.ids[-1]: "UNSUPPORTED"}
        del expected["fam/c9"]
        self.assertEqual(told, expected)
        self.assertIn("(1,4): expected 0 front, 1 back, got 1 front, 1 back;", done)  # of a failure, what the run says
        report = re.search(r"report\s+(\S+/report\.html)", done)[1]
        self.assertTrue(pathlib.Path(report).is_file(), report)

    def test_cases_of_ones_own(self):
        mine = self.folder / "my-cases"
        mine.mkdir()
        (mine / "tie.toml").write_text(LEAVES)
        done = self.call(sys.executable, LIT, "-v", SOURCE / "docs/ci/lit", fault="flip-pixel@tie:x=3/2", check=1, EDGECASE_PROGRAM=PROGRAM,
                         EDGECASE_SUITE=str(mine), EDGECASE_OPTIONS="--renderer reference", TMPDIR=str(self.folder))
        self.assertEqual(dict((name, word) for word, name in re.findall(r"^([A-Z]+): edgecase :: (\S+) \(", done, re.M)),
                         {"tie:x=1/2": "PASS", "tie:x=3/2": "FAIL"})
        self.refused(str(mine / "tie.toml"), "fatal: EDGECASE_SELECTORS choose cases outside the suite; run them alone, with EDGECASE_SUITE")

    def test_a_misspelt_selector_is_one_sentence(self):
        self.refused("nosuch/**", r"fatal: edgecase: .*nosuch")

    def refused(self, selectors, sentence):
        variables = {"EDGECASE_PROGRAM": PROGRAM, "EDGECASE_SELECTORS": selectors, "TMPDIR": str(self.folder)}
        done = subprocess.run([sys.executable, LIT, "-v", str(SOURCE / "docs/ci/lit")], env=self.environment("") | variables,
                              cwd=self.folder, capture_output=True, text=True, timeout=200, check=False)
        self.assertEqual(done.returncode, 2)
        self.assertRegex(done.stderr, sentence)
        self.assertNotIn("Traceback", done.stderr)


DRIVERS = pathlib.Path(os.environ.get("EDGECASE_DRIVERS", pathlib.Path.home() / ".cache/edgecase-drivers"))


class Bisect(RecipeTest):
    """A repository whose commits are versions of a driver; a build makes ./built.json of them."""

    def git(self, *words, check=0):
        return self.call("git", "-C", self.repository, *words, check=check)

    def commits(self, versions):
        """A commit a version; returns their hashes."""
        self.repository = self.folder / "driver"
        self.repository.mkdir()
        self.git("init", "-q", "-b", "main")
        for key, value in (("user.name", "a"), ("user.email", "a@b"), ("commit.gpgsign", "false")):
            self.git("config", key, value)
        (self.repository / ".gitignore").write_text("built.json\n")
        hashes = []
        for k, version in enumerate(versions):
            (self.repository / "version").write_text(version + "\n")
            (self.repository / "number").write_text(f"{k}\n")
            self.git("add", "-A")
            self.git("commit", "-q", "-m", f"number {k}")
            hashes.append(self.git("rev-parse", "HEAD").strip())
        return hashes

    def first_bad(self, hashes, build, words, fault_file=None):
        """What 'git bisect run' blames, between the first and the last commit."""
        program = PROGRAM
        if fault_file:  # a "driver" whose faults are those of the commit
            wrapper = self.folder / "edgecase"
            wrapper.write_text(f'#!/bin/sh\nEDGECASE_FAULT=$(cat {fault_file} 2>/dev/null) exec {PROGRAM} "$@"\n')
            wrapper.chmod(0o755)
            program = wrapper
        self.git("checkout", "-q", hashes[0])
        self.call("sh", "-c", f"cd driver && {build}")
        self.call(program, "run", *words, "-o", self.folder / "good", check=None)
        self.git("bisect", "start", hashes[-1], hashes[0])
        told = self.call("git", "-C", self.repository, "bisect", "run", SOURCE / "docs/ci/bisect-bits", self.folder / "good",
                         build, *words, EDGECASE_PROGRAM=str(program))
        return re.search(r"^([0-9a-f]{40}) is the first bad commit", told, re.M)[1], told

    def test_another_version_by_faults(self):
        # One commit does not build, the driver of another does not start, and a fault in another case is nobody's business.
        hashes = self.commits(["", "broken", "flip-pixel@fam/c2", "no-device", "", "shift-value@fam/c1", "flip-pixel@fam/c1", "segv@fam/c1"])
        bad, told = self.first_bad(hashes, "! grep -q broken version && cp version built.json", ["fam/c1", "--renderer=reference"],
                                   self.folder / "driver/built.json")
        self.assertEqual(bad, hashes[5], told)

    def test_mistakes_end_it(self):
        hashes = self.commits(["", "", ""])
        self.git("bisect", "start", hashes[-1], hashes[0])
        script = SOURCE / "docs/ci/bisect-bits"
        for words in ([], ["nowhere", "true", "no/such/case"], ["nowhere", "true", "fam/c1", "--renderer=reference"]):
            self.call(script, *words, check=128, EDGECASE_PROGRAM=PROGRAM)

    @unittest.skipUnless((DRIVERS / "lvp25.json").exists(), "Mesa 25.0 is not unpacked: scripts/setup-drivers lvp25")
    def test_two_versions_of_mesa(self):
        system = next(iter(glob.glob("/usr/share/vulkan/icd.d/lvp_icd*.json")))
        hashes = self.commits([system] * 4 + [str(DRIVERS / "lvp25.json")] * 3)
        words = ["lod/perspective:w=4", "--suite", SOURCE / "cases/suite", "--icd", self.folder / "driver/built.json"]
        bad, told = self.first_bad(hashes, "cp $(cat version) built.json", words)
        self.assertEqual(bad, hashes[4], told)
        # It is right in both versions, by other values.
        self.assertEqual(self.statuses(self.folder / "good"), {"lod/perspective:w=4": "pass"})
        self.assertIn("pass with the same hits and other values within the budgets: 1 case", told)


if __name__ == "__main__":
    unittest.main()
