# SPDX-FileCopyrightText: The Edgecase authors
# SPDX-License-Identifier: Apache-2.0
"""Expectation files: known problems do not fail a run, news of any kind does."""
import re
import unittest

from support import ProgramTest

HEADER = "# edgecase-expectations 1\n# device: Edgecase*   driver: reference >=1.0 <2\n"


class ExpectationTest(ProgramTest):
    def expectations(self, text, header=HEADER):
        folder = self.suite.parent / "expectations"
        folder.mkdir(exist_ok=True)
        (folder / "reference.txt").write_text(header + text)
        return folder / "reference.txt"


class Statuses(ExpectationTest):
    def outcome(self, expected, fault, status, exit_code):
        self.expectations(f"fam/c3  {expected}  bug#1  # It is known.\n")
        self.run_suite(fault=f"{fault}@fam/c3" if fault else "", check=exit_code)
        self.assertEqual(self.statuses()["fam/c3"], status)

    def test_expected_fail(self):
        self.outcome("fail", "flip-pixel", "xfail", 0)

    def test_expected_crash(self):
        self.outcome("crash", "segv", "xfail", 0)

    def test_crash_is_no_expected_fail(self):
        self.outcome("fail", "segv", "crash", 1)

    def test_improvement(self):
        self.outcome("crash", "flip-pixel", "improved", 1)

    def test_unexpected_pass(self):
        self.outcome("fail", "", "xpass", 1)

    def test_flake_is_no_expected_fail_when_asked_twice(self):
        self.outcome("flake", "flake", "xfail", 0)

    def test_skip(self):
        self.expectations("fam/c3  skip  -  # Too slow here.\n")
        self.run_suite(fault="segv@fam/c3", check=0)
        self.assertEqual(self.statuses()["fam/c3"], "skip")

    def test_no_expect(self):
        self.expectations("fam/c3  fail  bug#1  # It is known.\n")
        self.run_suite("--no-expect", fault="flip-pixel@fam/c3", check=1)


    def rerun(self, done):
        return re.search(r"rerun: (?:\w+=\S+ )*\S+ (.*)\n", done.stdout)[1]

    def test_the_rerun_line_repeats_how_it_was_judged(self):
        path = self.expectations("fam/c3  fail  bug#1  # It is known.\n")
        done = self.run_suite("--no-expect", fault="flip-pixel@fam/c3", check=1)
        self.assertEqual(self.rerun(done), "run fam/c3 --renderer reference --no-expect")
        done = self.run_suite("--expect", path, "--timeout", "7.5", "fam/c1", fault="flip-pixel@fam/c1", check=1)
        self.assertEqual(self.rerun(done), f"run fam/c1 --renderer reference --timeout 7.5 --expect {path}")

    def test_an_unexpected_pass_names_the_command(self):
        path = self.expectations("fam/c3  fail  bug#1  # It is known.\n")
        line = f"      update: edgecase expect --update {self.out} {path}\n"
        self.assertIn(line, self.run_suite(check=1).stdout)
        self.assertIn(line, self.edgecase("report", self.out, check=0).stdout)
        self.edgecase("expect", "--update", self.out, path, check=0)
        self.run_suite(check=0)


class Files(ExpectationTest):
    def refused(self, text, words, header=HEADER, exit_code=3):
        self.expectations(text, header)
        done = self.run_suite(check=exit_code)
        self.assertIn(words, done.stderr)

    def test_no_reason(self):
        self.refused("fam/c3 fail bug#1\n", "reason")

    def test_no_bug(self):
        self.refused("fam/c3 fail -  # Known.\n", "bug")

    def test_unknown_status(self):
        self.refused("fam/c3 fial bug#1  # Known.\n", "did you mean 'fail'")

    def test_past_date(self):
        """It excuses nothing, is told, and is news whatever happens; lint refuses the file."""
        ended = "ended on 2020-01-01: re-check it, or extend the date"
        path = self.expectations("fam/c3 fail bug#1 until=2020-01-01  # Known.\n")
        done = self.run_suite(fault="flip-pixel@fam/c3", check=1)
        self.assertEqual(self.statuses()["fam/c3"], "fail")
        self.assertIn(f", the expectation of fail (bug#1) {ended}\n", done.stdout)
        done = self.run_suite(check=1)
        self.assertEqual(self.statuses()["fam/c3"], "xpass")
        self.assertIn(f"XPASS fam/c3   passes; the expectation of fail (bug#1) {ended}\n", done.stdout)
        self.assertEqual(self.edgecase("lint", check=3).stderr,
                         f"edgecase: {path}:3:1: error: the expectation of 'fam/c3' ended on 2020-01-01; re-check it, "
                         "or extend the date\n")
        self.expectations("fam/c3 skip - until=2020-01-01  # Too slow.\n")
        self.run_suite(fault="flip-pixel@fam/c3", check=1)
        self.assertEqual(self.statuses()["fam/c3"], "fail")

    def test_no_day_of_the_calendar(self):
        self.refused("fam/c3 fail bug#1 until=2026-02-30  # Known.\n",
                     "'until=2026-02-30' is not understood; only 'until=YYYY-MM-DD' may follow the bug")

    def test_line_that_matches_nothing(self):
        self.refused("fam/cc3 fail bug#1  # Known.\n", "did you mean 'fam/c")

    def test_line_that_matches_nothing_of_a_part(self):
        self.expectations("fam/cc3 fail bug#1  # Known.\n")
        self.run_suite("fam/c1", check=0)

    def test_conflict(self):
        self.refused("fam/c3 fail bug#1  # Known.\nfam/c* crash bug#2  # Known.\n", "disagrees")

    def test_expect_checks_what_a_run_checks(self):
        for text, sentence in (("fam/cc3 fail bug#1  # Known.\n", "did you mean 'fam/c"),
                               ("fam/c3 fail bug#1  # Known.\nfam/c* crash bug#2  # Known.\n", "disagrees about 'fam/c3'")):
            path = self.expectations(text)
            self.assertIn(sentence, self.edgecase("expect", path, check=3).stderr)
        self.edgecase("expect", self.expectations("fam/c3 fail bug#1  # Known.\n"), check=0)

    def test_a_file_that_is_something_else(self):
        path = self.expectations("", header="{\"a\": 1,\n \"b\x01\": 2}\n")
        self.assertEqual(self.edgecase("expect", path, check=3).stderr,
                         f"edgecase: {path}:1:1: error: the first line must be '# edgecase-expectations 1'\n")
        path = self.expectations("fam/c3 f\x1b[31m bug#1  # Known.\n")
        self.assertNotIn("\x1b", self.edgecase("expect", path, check=3).stderr)

    def test_no_header(self):
        self.refused("fam/c3 fail bug#1  # Known.\n", "first line", header="")

    def test_another_device_is_passed_over(self):
        self.expectations("fam/c3 fail bug#1  # Known.\n", HEADER.replace("Edgecase*", "Other*"))
        self.run_suite(check=0)

    def test_another_version_is_passed_over(self):
        self.expectations("fam/c3 fail bug#1  # Known.\n", HEADER.replace("<2", "<1"))
        self.run_suite(check=0)

    def test_a_named_file_must_fit(self):
        path = self.expectations("fam/c3 fail bug#1  # Known.\n", HEADER.replace("Edgecase*", "Other*"))
        done = self.run_suite("--expect", path, check=5)
        self.assertIn("Edgecase reference", done.stderr)

    def test_another_profile_is_passed_over(self):
        self.expectations("fam/c3 fail bug#1  # Known.\n", HEADER + "# profile: vulkan\n")
        self.run_suite(check=0)


if __name__ == "__main__":
    unittest.main()
