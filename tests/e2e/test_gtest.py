# SPDX-FileCopyrightText: The Edgecase authors
# SPDX-License-Identifier: Apache-2.0
"""The command "gtest", by itself and driven as deqp-runner drives it."""
import re
import subprocess
import unittest

import deqp_runner
from support import CASE, PROGRAM, ProgramTest

MATRIX = """format = 1
description = "A square of two triangles, moved."
rules = ["cover.inside", "cover.shared-edge"]
[matrix]
x = [1, 1.5]
y = [1, 0.25]
[target]
size = [8, 8]
[[draw]]
vertices = [["x","y"], [7,"y"], ["x",7],  [7,"y"], [7,7], ["x",7]]
"""


# flip-pixel makes of each square the same failure.
EXPECTED_FLIP = ("# edgecase-expectations 2\n# device: Edgecase*   driver: built\n"
                 "fam/{case} fail bug#1 double:cover.outside@vulkan<=1  # Known.\n")


def without_times(text):
    return re.sub(r"\(\d+ ms\)", "(_ ms)", text)


class Gtest(ProgramTest):
    def gtest(self, *words, fault="", check=0):
        return self.edgecase("gtest", "--renderer=reference", *words, fault=fault, check=check)

    def runner(self, fault="", words=(), **options):
        return deqp_runner.Runner(PROGRAM, ["gtest", "--renderer=reference", *words], env=self.environment(fault),
                                  cwd=self.folder, **options)

    def test_names_survive_the_list_the_filter_and_the_baseline(self):
        self.write_case("a.b/m-1", MATRIX)
        self.ids += [f"a.b/m-1:x={x},y={y}" for x in ("1", "1.5") for y in ("1", "0.25")]
        runner = self.runner()
        names = runner.list_tests()
        self.assertEqual(len(names), len(set(names)))
        # The way back is the one that docs/ci/README.md prints.
        back = subprocess.run(["sed", "s/^edgecase[.]//; y/@&~/:,./"], input="\n".join(names), capture_output=True,
                              text=True, check=True).stdout.splitlines()
        self.assertEqual(sorted(back), sorted(self.ids))
        self.assertEqual(runner.run(), {name: "Pass" for name in names})
        self.assertEqual(runner.processes, 1)
        self.assertEqual(deqp_runner.parse_baseline("".join(f"{n},Fail\n" for n in names)), {n: "Fail" for n in names})

    def test_lines(self):
        out = self.gtest("fam/c1", "fam/c2", fault="unsupported@fam/c2").stdout
        self.assertEqual(without_times(out), "[==========] Running 2 tests from 1 test suite.\n"
                         "[ RUN      ] edgecase.fam/c1\n[       OK ] edgecase.fam/c1 (_ ms)\n"
                         "[ RUN      ] edgecase.fam/c2\n[  SKIPPED ] edgecase.fam/c2 (_ ms)\n")
        failed = self.gtest("fam/c1", fault="flip-pixel", check=1).stdout
        self.assertRegex(failed, r"\[  FAILED  \] edgecase.fam/c1 \(\d+ ms\)\n    1 \w+ of 64 samples .*\n    \(\d,\d\): .*\n"
                                 r"    rerun: EDGECASE_FAULT=flip-pixel \S+ run fam/c1 --suite \S+ --renderer reference --timeout 20 --no-expect\n"
                                 r"    explain: \S+ explain fam/c1 --suite \S+ --pixel ")

    def test_filters(self):
        def listed(text):
            return self.gtest("--gtest_list_tests", f"--gtest_filter={text}").stdout.split()[1:]
        self.assertEqual(listed("edgecase.fam/c3:edgecase.fam/c1"), ["fam/c1", "fam/c3"])
        self.assertEqual(listed("*c?:-*c1:*c2"), ["fam/" + c for c in ("c0", "c3", "c4", "c5", "c6", "c7", "c8", "c9")])
        self.assertEqual(listed("-*c1"), [f"fam/c{k}" for k in range(10) if k != 1])
        self.assertEqual(len(self.gtest("--gtest_list_tests", "fam/c1", "fam/c2").stdout.split()), 3)
        # As in GoogleTest, "these without those" without a ':'; a '-' inside of a name is none.
        self.assertEqual(listed("edgecase.fam/*-edgecase.fam/c1:*c2"), ["fam/" + c for c in ("c0", "c3", "c4", "c5", "c6", "c7", "c8", "c9")])
        self.write_case("fam/c1-a", CASE.format(n=10))
        self.assertEqual(listed("edgecase.fam/c1-*:edgecase.fam/c2-edgecase.fam/c3"), ["fam/c1-a", "fam/c2"])
        done = self.gtest("--gtest_filter=nothing", check=4)
        self.assertEqual(done.stdout, "")
        self.assertIn("'edgecase gtest --gtest_list_tests' lists their names", done.stderr)

    def test_names_that_no_test_has_are_told(self):
        done = self.gtest("--gtest_filter=edgecase.nosuch:edgecase.fam/c1:*c2:-edgecase.fam/c2")
        self.assertEqual(done.stderr, "edgecase: warning: --gtest_filter: no selected case is the test 'edgecase.nosuch'\n")
        self.assertIn("Running 1 tests", done.stdout)

    def test_two_runs_tell_the_same(self):
        fault = "flip-pixel@fam/c1,unsupported@fam/c4,segv@fam/c7"
        first, second = (without_times(self.gtest(fault=fault, check=1).stdout) for _ in range(2))
        self.assertEqual(first, second)
        self.assertTrue(first.endswith("[ RUN      ] edgecase.fam/c7\n"), first)

    def test_reports_are_kept_on_demand(self):
        self.gtest("fam/c1")
        self.assertEqual([p.name for p in self.folder.iterdir()], ["cases"])
        self.gtest("fam/c1", "-o", "kept")
        self.gtest("fam/c1", "-o", "kept")
        kept = list((self.folder / "kept").iterdir())
        self.assertEqual(len(kept), 2)
        self.assertEqual(self.statuses(kept[0]), {"fam/c1": "pass"})

    def test_an_expectation_file(self):
        file = self.folder / "mine.txt"
        file.write_text(EXPECTED_FLIP.format(case="c1"))
        self.assertIn("[       OK ] edgecase.fam/c1", self.gtest("fam/c1", "--expect", file, fault="flip-pixel").stdout)
        self.assertIn("[  FAILED  ] edgecase.fam/c1", self.gtest("fam/c1", "--expect", file, check=1).stdout)

    def test_no_device(self):
        done = self.gtest(fault="no-device", check=5)
        self.assertEqual(done.stdout, "")

    FAULT = "flip-pixel@fam/c1,segv@fam/c3,unsupported@fam/c5,abort@fam/c7"
    EXPECTED = {"c0": "Pass", "c1": "Fail", "c2": "Pass", "c3": "Crash", "c4": "Pass", "c5": "Skip", "c6": "Pass",
                "c7": "Crash", "c8": "Pass", "c9": "Pass"}

    def test_driven_by_deqp_runner(self):
        expected = {f"edgecase.fam/{k}": v for k, v in self.EXPECTED.items()}
        for group in (500, 3):
            self.assertEqual(self.runner(self.FAULT, group=group).run(), expected)
        baseline = deqp_runner.failures_csv(expected)
        again = self.runner(self.FAULT, baseline=baseline).run()
        self.assertEqual(again, {k: "ExpectedFail" if v in ("Fail", "Crash") else v for k, v in expected.items()})
        mended = self.runner("", baseline=baseline).run()
        self.assertEqual({k for k, v in mended.items() if v == "UnexpectedImprovement(Pass)"},
                         {k for k, v in expected.items() if v in ("Fail", "Crash")})
        # What failed is drawn by 'run' from the runner's own list.
        ids = subprocess.run(["sed", "s/,.*//; s/^edgecase[.]//; y/@&~/:,./"], input=baseline, capture_output=True,
                             text=True, check=True).stdout
        self.edgecase("run", "--renderer=reference", "-o", self.out, "-", stdin=ids, check=0)
        self.assertEqual(set(self.statuses()), {"fam/c1", "fam/c3", "fam/c7"})

    def test_cases_of_ones_own(self):
        mine = self.folder / "mine"
        (mine / "fam").mkdir(parents=True)
        for name in ("tie", "fam/c1", "fam/good"):
            (mine / f"{name}.toml").write_text(CASE.format(n=0))
        results = self.runner("flip-pixel@tie,flip-pixel@fam/c1", ("--suite", str(mine))).run()
        self.assertEqual(results, {"edgecase.tie": "Fail", "edgecase.fam/c1": "Fail", "edgecase.fam/good": "Pass"})
        ids = subprocess.run(["sed", "s/,.*//; s/^edgecase[.]//; y/@&~/:,./"], input=deqp_runner.failures_csv(results),
                             capture_output=True, text=True, check=True).stdout
        self.edgecase("run", "--renderer=reference", "-o", self.out, "--suite", mine, "-", stdin=ids, check=0)
        self.assertEqual({c["id"]: c["file"] for c in self.results()["cases"]}, {x: str(mine / f"{x}.toml") for x in ("tie", "fam/c1")})

    def test_a_hang(self):
        """Our own limit ends it, long before the runner's."""
        results = self.runner("hang@fam/c8", ("--timeout", "3", "fam/c7", "fam/c8", "fam/c9")).run()
        self.assertEqual(results, {"edgecase.fam/c7": "Pass", "edgecase.fam/c8": "Crash", "edgecase.fam/c9": "Pass"})

    def test_flakes_and_skips(self):
        results = self.runner("segv@fam/c3,flip-pixel@fam/c1", skips=["fam/c3$"], flakes=[r"^edgecase\.fam/c1"]).run()
        self.assertEqual((results["edgecase.fam/c3"], results["edgecase.fam/c1"]), ("Skip", "Flake"))
        self.assertEqual(sum(v == "Pass" for v in results.values()), 8)

    def test_each_of_many_deaths_costs_one_process_twice(self):
        for k in range(10, 20):
            self.write_case(f"fam/c{k}", CASE.format(n=k))
        runner = self.runner("segv")
        self.assertEqual(set(runner.run().values()), {"Crash"})
        self.assertEqual(runner.processes, 2 * 20)


class FailFast(ProgramTest):
    def test_the_rest_is_skipped(self):
        # The last case hangs for the 30 s of a worker's limit, so the failure has to be drawn again before that.
        done = self.run_suite("--fail-fast", "--batch=1", "--jobs=1", fault="flip-pixel@fam/c2,hang@fam/c9", check=1)
        statuses = self.statuses()
        self.assertEqual(statuses["fam/c2"], "fail")
        self.assertEqual(statuses["fam/c9"], "skip")
        self.assertEqual(done.stdout.count("\nFAIL "), 1)
        self.assertEqual(statuses["fam/c1"], "pass")
        [last] = [c for c in self.results()["cases"] if c["id"] == "fam/c9"]
        self.assertEqual(last["reason"], "the run ended before this case was judged")

    def test_an_expected_failure_does_not_end_it(self):
        file = self.folder / "mine.txt"
        file.write_text(EXPECTED_FLIP.format(case="c2"))
        self.run_suite("--fail-fast", "--expect", file, fault="flip-pixel@fam/c2", check=0)
        self.assertEqual(sorted(self.statuses().values()), ["pass"] * 9 + ["xfail"])


if __name__ == "__main__":
    unittest.main()
