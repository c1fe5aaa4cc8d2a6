# SPDX-FileCopyrightText: The Edgecase authors
# SPDX-License-Identifier: Apache-2.0
"""What a run says of each level, and which level makes it fail. lavapipe 22.3 draws a case that is wrong at direct3d
alone (docs/drivers.md); an expectation that knows a part of another one's findings leaves news at direct3d."""
import pathlib
import re
import unittest
import xml.etree.ElementTree

from support import SOURCE, ProgramTest

AT_DIRECT3D = "interpolate-at/centroid-4x"  # one case that fails at direct3d alone
FINE = "ties/apex-up"
CONFORMANT = "vulkan: nothing wrong in 2 cases - practice: nothing - direct3d: 1 case differs (interpolate-at)"


class Levels(ProgramTest):
    def environment(self, fault=""):
        return {**super().environment(fault), "EDGECASE_SUITE": str(SOURCE / "cases" / "suite")}

    def draw(self, *words, check, out=None, selectors=(AT_DIRECT3D, FINE)):
        return self.edgecase("run", *selectors, "--no-expect", "-o", out or self.out, *words, check=check)

    def properties(self, out=None):
        root = xml.etree.ElementTree.parse(pathlib.Path(out or self.out) / "junit.xml").getroot()
        return {p.get("name"): p.get("value") for p in root.iter("property")}

    def test_a_conformant_device_is_told_that_it_is(self):
        done = self.draw(check=1)
        self.assertEqual(done.stdout.splitlines()[-4], CONFORMANT)
        self.assertTrue(done.stdout.splitlines()[-3].startswith("diagnosis: "), done.stdout)
        self.assertTrue(done.stdout.splitlines()[-2].startswith(f"smallest case: {AT_DIRECT3D}   rerun: "), done.stdout)
        levels = self.results()["levels"]
        self.assertEqual((levels["judged"], levels["unjudged"]), (2, 0))
        self.assertEqual([(row["level"], row["judged"], row["unexpected_cases"], row["expected_cases"]) for row in levels["rows"]],
                         [("vulkan", True, [], []), ("practice", True, [], []), ("direct3d", True, [AT_DIRECT3D], [])])
        self.assertEqual(self.properties()["level.vulkan"], "nothing wrong in 2 cases")
        self.assertEqual(self.properties()["level.direct3d"], "1 case differs (interpolate-at)")
        self.assertIn("<strong>vulkan: nothing wrong in 2 cases</strong>", (self.out / "report.html").read_text())

    def test_what_the_profile_leaves_out_is_not_judged(self):
        done = self.draw("--profile", "vulkan", check=0)
        self.assertIn("\nvulkan: nothing wrong in 2 cases - practice: not judged - direct3d: not judged\n", done.stdout)

    def test_fail_at(self):
        done = self.draw("--fail-at", "practice", check=0)
        self.assertIn(f"\n{CONFORMANT}\n", done.stdout)
        self.assertIn("exit 0: all as expected at practice; 1 case fails only beyond it", done.stdout)
        self.assertRegex(done.stdout, r"FAIL .*centroid-4x")  # it is told all the same, and repeated alike
        self.assertRegex(done.stdout, r"rerun: .* --fail-at practice")
        run = self.results()["run"]
        self.assertEqual((run["fail_at"], run["exit_code"]), ("practice", 0))
        root = xml.etree.ElementTree.parse(self.out / "junit.xml").getroot()
        self.assertEqual((root.get("failures"), root.get("skipped")), ("0", "1"))
        # Rebuilt from the journal, it is the same.
        first = (self.out / "junit.xml").read_text()
        self.assertIn("the run ended with exit 0", self.edgecase("report", self.out, check=0).stdout)
        self.assertEqual((self.out / "junit.xml").read_text(), first)
        self.draw("--fail-at", "direct3d", check=1)

    def test_fail_fast_ends_at_what_counts(self):
        self.draw("--fail-fast", "--jobs", "1", "--fail-at", "vulkan", check=0)
        self.assertEqual(self.statuses()[FINE], "pass")

    def test_a_resumed_run_fails_at_the_same_level(self):
        self.draw("--fail-at", "practice", check=0)
        journal = self.out / "journal.jsonl"
        lines = journal.read_text().splitlines(keepends=True)
        cut = next(k for k, line in enumerate(lines) if '"end"' in line[:60] and f'"{AT_DIRECT3D}"' in line[:200])
        journal.write_text("".join(lines[:cut]))
        self.assertIn("exit 0: all as expected at practice", self.edgecase("run", "--resume", self.out, check=0).stdout)

    def test_a_merged_run_fails_at_the_level_of_its_parts(self):
        parts = [self.folder / f"part{k}" for k in (1, 2)]
        for k, part in enumerate(parts, 1):
            done = self.draw("--shard", f"{k}/2", "--fail-at", "practice", out=part, check=None,
                             selectors=("interpolate-at/centroid-4x", "ties/**"))
            self.assertIn(done.returncode, (0,), done.stdout + done.stderr)
        merged = self.folder / "merged"
        done = self.edgecase("report", "--merge", *parts, "-o", merged, check=0)
        self.assertIn("exit 0: all as expected at practice; 1 case fails only beyond it", done.stdout)
        self.assertEqual(self.results(merged)["run"]["fail_at"], "practice")
        self.draw("--shard", "2/2", out=parts[1], check=None, selectors=("interpolate-at/centroid-4x", "ties/**"))
        done = self.edgecase("report", "--merge", *parts, "-o", merged, check=3)
        self.assertIn("--fail-at practice", done.stderr)

    def test_gtest(self):
        words = ("gtest", "--gtest_filter", "edgecase." + AT_DIRECT3D)
        self.assertIn("[  FAILED  ] edgecase." + AT_DIRECT3D, self.edgecase(*words, check=1).stdout)
        done = self.edgecase(*words, "--fail-at", "vulkan", check=0)
        self.assertIn("[       OK ] edgecase." + AT_DIRECT3D, done.stdout)
        self.assertIn("interp.at-centroid [direct3d: ", done.stdout)

    def test_the_level_of_a_cause_is_that_of_what_is_new(self):
        expectations = self.folder / "known.txt"
        known = (SOURCE / "cases" / "expectations" / "llvmpipe-interpolate-at.txt").read_text()
        expectations.write_text(re.sub(r",direct3d<=\d+", "", known))
        done = self.edgecase("run", "interpolate-at/**", "--expect", expectations, "-o", self.out, check=1)
        at_offset = next(c for c in self.results()["causes"] if c["rule"] == "interp.at-offset")
        self.assertEqual(at_offset["level"], "direct3d")
        self.assertRegex(done.stdout, r"fail: interp.at-offset value in interpolate-at, \d+ cases \[direct3d\]")
        self.assertRegex(done.stdout, r"vulkan: nothing new in \d+ cases, \d+ are wrong as expected")

    def test_an_unfinished_judgement_has_no_level(self):
        done = self.edgecase("run", FINE, "--no-expect", "-o", self.out, fault="segv", check=1)
        self.assertIn("\nvulkan: not judged - practice: not judged - direct3d: not judged - without a level: 1 case\n", done.stdout)

    def test_bad_values(self):
        for command in (["run"], ["gtest"], ["diff", "--captures", "."]):
            done = self.edgecase(*command, "--fail-at", "direct3", check=2)
            self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)
            self.assertIn("did you mean 'direct3d'?", done.stderr)
            done = self.edgecase(*command, "--fail-at", "practice", "--profile", "vulkan", check=2)
            self.assertIn("--fail-at practice is stricter than the profile vulkan, at which nothing of that level is "
                          "judged; write --fail-at vulkan or --profile practice", done.stderr)
        self.assertIn("--resume goes on with the cases and options", self.edgecase(
            "run", "--resume", "x", "--fail-at", "vulkan", check=2).stderr)


if __name__ == "__main__":
    unittest.main()
