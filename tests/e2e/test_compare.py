# SPDX-FileCopyrightText: The Edgecase authors
# SPDX-License-Identifier: Apache-2.0
"""Runs side by side, and expectation files brought up to date with what a run has seen."""
import json
import unittest

import jsonschema

from support import SOURCE, ProgramTest

TIES = """format = 1
description = "The lower edge of the first triangle passes through the pixel centres of row 4: without the top-left rule it is free there."
rules = ["cover.inside", "tie.top-left"]
[target]
size = [8, 8]
[[draw]]
vertices = [[-8,4.5], [24,4.5], [8,-20],  [0,0], [0,32], [32,0]]
"""


class CompareTest(ProgramTest):
    def run_as(self, name, *words, fault="", renderer="reference", profile="direct3d"):
        folder = self.folder / name
        self.edgecase("run", f"--renderer={renderer}", "--profile", profile, "-o", folder, *words, fault=fault)
        return folder

    def compare(self, *words, check):
        return self.edgecase("compare", *words, "--json", "c.json", check=check)

    def changes(self):
        comparison = json.loads((self.folder / "c.json").read_text())
        schema = json.loads((SOURCE / "docs/schema/comparison-1.json").read_text())
        jsonschema.Draft7Validator(schema).validate(comparison)
        self.assertEqual(sum(comparison["totals"].values()) - comparison["totals"]["same"], len(comparison["cases"]))
        return {c["id"]: c["change"] for c in comparison["cases"]}


class Compare(CompareTest):
    def test_every_kind(self):
        a = self.run_as("a", fault="flip-pixel@fam/c1,flip-pixel@fam/c2,segv@fam/c3,segv@fam/c6,flip-pixel@fam/c7")
        b = self.run_as("b", "fam/*", "!fam/c9", fault="segv@fam/c1,flip-pixel@fam/c3,segv@fam/c5,segv@fam/c6,"
                                                       "flip-pixel@fam/c7,unsupported@fam/c8")
        done = self.compare(a, b, check=1)
        self.assertEqual(self.changes(), {
            "fam/c1": "regression", "fam/c2": "fix", "fam/c3": "fix", "fam/c5": "regression", "fam/c6": "fails alike",
            "fam/c7": "fails alike", "fam/c8": "vanished", "fam/c9": "vanished"})
        self.assertIn("regressions: 2 cases got worse\n", done.stdout)
        self.assertRegex(done.stdout, r"  A +B +case\n  fail +crash +fam/c1   B: SIGSEGV")
        self.assertIn("fixes: 2 cases got better\n", done.stdout)
        self.assertTrue(done.stdout.endswith("exit 1: regressions, and cases vanished\n"))
        # The other way round the fixes are the regressions.
        self.compare(b, a, check=1)
        self.assertEqual(self.changes()["fam/c2"], "regression")
        self.assertEqual(self.changes()["fam/c1"], "fix")

    def test_cases_that_vanish_are_no_success(self):
        a, b = self.run_as("a"), self.run_as("b", "fam/c1", "fam/c2")
        done = self.compare(a, b, check=1)
        self.assertEqual(set(self.changes().values()), {"vanished"})
        self.assertIn("vanished: 8 cases of the first run not in a later one, or unsupported or skipped there\n", done.stdout)
        self.assertTrue(done.stdout.endswith("exit 1: cases vanished; --common compares those that all runs have\n"))
        done = self.edgecase("compare", a, b, "--common", check=0)
        self.assertIn("the same bit for bit: 2 cases\n", done.stdout)
        self.edgecase("compare", b, a, check=0)  # more cases than before

    def test_what_a_run_did_not_come_to_vanished(self):
        fault = "flip-pixel@fam/c0"
        a, b = self.run_as("a", "-j1", "--batch=1", fault=fault), self.run_as("b", "-j1", "--batch=1", "--fail-fast", fault=fault)
        for words in ((), ("--common",)):  # it has them and would have judged them
            done = self.compare(a, b, *words, check=1)
            self.assertIn("fam/c9   B: the run ended before this case was judged\n", done.stdout)
            self.assertEqual(self.changes()["fam/c9"], "vanished")
        self.edgecase("compare", b, a, check=0)  # more cases than before

    def test_what_somebody_skips_vanished(self):
        skips = self.folder / "skips.txt"
        skips.write_text(HEADER + "fam/c3 skip - # Too slow.\n")
        a, b = self.run_as("a"), self.run_as("b", "--expect", skips)
        done = self.compare(a, b, check=1)
        self.assertEqual(self.changes(), {"fam/c3": "vanished"})
        self.assertTrue(done.stdout.endswith("exit 1: cases vanished; --common compares those that all runs have\n"))
        self.compare(a, b, "--common", check=0)
        self.compare(b, self.run_as("c", "--expect", skips), check=0)

    def test_nothing_compared_is_no_success(self):
        a, b = self.run_as("a", "fam/c1"), self.run_as("b", "fam/c2")
        for words in ((), ("--strict",)):
            done = self.compare(a, b, "--common", *words, check=4)
            self.assertTrue(done.stdout.endswith("exit 4: 0 cases compared: no two runs judged the same\n"), done.stdout)
        self.assertEqual(json.loads((self.folder / "c.json").read_text())["exit_code"], 4)
        self.assertIn("profile direct3d  1 case\n", done.stdout)
        # Cases that no run drew are the same in nothing.
        fault = "unsupported@fam/c1,unsupported@fam/c2"
        c, d = self.run_as("c", "fam/c1", "fam/c2", fault=fault), self.run_as("d", "fam/c1", "fam/c2", fault=fault)
        for words in ((), ("--strict",)):
            done = self.compare(c, d, *words, check=4)
            self.assertIn("judged in none of the runs, so not compared: 2 cases\n", done.stdout)
            self.assertNotIn("bit for bit", done.stdout)
            self.assertEqual(set(self.changes().values()), {"judged in none"})
        self.assertIn("No case was compared", self.edgecase("compare", c, d, "--html", "-", check=4).stdout)
        # Beside a case that was drawn they count for nothing, and do no harm.
        e, f = self.run_as("e", fault=fault), self.run_as("f", fault=fault)
        done = self.compare(e, f, "--strict", check=0)
        self.assertIn("judged in none of the runs, so not compared: 2 cases\nthe same bit for bit: 8 cases\n", done.stdout)
        # A case that one run lacks and the other does not support is judged in none.
        self.compare(self.run_as("g", "fam/c1", fault=fault), self.run_as("h", "fam/c2", fault=fault), check=4)
        self.assertEqual(set(self.changes().values()), {"judged in none"})

    def test_another_kind_of_failure_is_a_regression(self):
        a = self.run_as("a", fault="flip-pixel@fam/c1,segv@fam/c2,flip-pixel@fam/c3")
        b = self.run_as("b", fault="shift-value@fam/c1,abort@fam/c2,flip-pixel+3@fam/c3")
        done = self.compare(a, b, check=1)
        self.assertEqual(self.changes(), {"fam/c1": "regression", "fam/c2": "regression", "fam/c3": "fails otherwise"})
        self.assertIn("fam/c1   B: new: 1 value of fragcoord.xy [vulkan]\n", done.stdout)

    def test_strict(self):
        """Any difference of bits counts, also between runs that fail."""
        a, b = self.run_as("a", fault="flip-pixel@fam/c3"), self.run_as("b", fault="flip-pixel+3@fam/c3")
        self.compare(a, b, check=0)
        done = self.edgecase("compare", a, b, "--strict", check=1)
        self.assertTrue(done.stdout.endswith("exit 1: differences (--strict)\n"))
        self.edgecase("compare", a, a, "--strict", check=0)

    def test_a_page_without_reports_has_no_links(self):
        a, b = self.run_as("a"), self.run_as("b", fault="flip-pixel@fam/c1")
        for folder in (a, b):
            (folder / "report.html").unlink()
        done = self.edgecase("compare", a, b, "--html", "-", check=1)
        self.assertIn('"report":""', done.stdout)
        self.assertNotIn("report.html", done.stdout)
        self.assertIn("regressions: 1 case got worse", done.stderr)
        self.assertIn("--html: there is no folder 'no/such'; make it first", self.edgecase("compare", a, b, "--html", "no/such/folder.html", check=2).stderr)
        self.assertIn("cannot be written", self.edgecase("compare", a, b, "--html", "/dev/full", check=7).stderr)

    def test_nothing(self):
        a, b = self.run_as("a"), self.run_as("b")
        done = self.compare(a, b, check=0)
        self.assertEqual(self.changes(), {})
        self.assertIn("the same bit for bit: 10 cases\nexit 0: no regression\n", done.stdout)

    def test_three_runs(self):
        runs = [self.run_as("a"), self.run_as("b"), self.run_as("c", fault="flip-pixel@fam/c4")]
        done = self.compare(*runs, check=1)
        self.assertRegex(done.stdout, r"  A     B     C     case\n  pass  pass  fail  fam/c4   C: ")
        self.assertEqual(self.changes(), {"fam/c4": "regression"})

    def test_expected_failures_are_failures(self):
        """An expectation file changes what a run says, not what happened."""
        folder = self.suite.parent / "expectations"
        folder.mkdir()
        (folder / "x.txt").write_text("# edgecase-expectations 2\n# device: Edgecase*\nfam/c3 fail b#1 double:cover.outside@vulkan<=1  # Known.\n")
        a = self.run_as("a", fault="flip-pixel@fam/c3")
        self.assertEqual(self.statuses(a)["fam/c3"], "xfail")
        b = self.run_as("b")
        self.assertEqual(self.statuses(b)["fam/c3"], "xpass")
        self.compare(a, b, check=0)
        self.assertEqual(self.changes(), {"fam/c3": "fix"})

    def test_the_reference_allows_both(self):
        """Without the top-left rule ties are free: two devices pass with other samples hit."""
        self.write_case("fam/ties", TIES)
        words = ("fam/ties", "--capture", "all")
        a = self.run_as("a", *words, profile="vulkan")
        b = self.run_as("b", *words, profile="vulkan", fault="flip-pixel@fam/ties")  # one hit more at (0,4)
        for run in (a, b):
            self.assertEqual(self.statuses(run)["fam/ties"], "pass")
        done = self.compare(a, b, check=0)
        self.assertEqual(self.changes(), {"fam/ties": "other coverage"})
        self.assertIn("the reference allows both, other samples are hit: 1 case\n", done.stdout)
        self.assertIn("   1 of 64 samples hit otherwise in A and B, first (0,4)\n", done.stdout)
        drawn = self.edgecase("compare", a, b, "-v", check=0).stdout
        rows = [line.strip() for line in drawn.splitlines() if line.startswith("    ") and len(line) == 12]
        self.assertEqual(rows, ["########"] * 4 + ["2#######"] + ["########"] * 3)
        # Without pictures the checksums still tell.
        c = self.run_as("c", "fam/ties", profile="vulkan", fault="flip-pixel@fam/ties")
        self.assertIn("   8 of 64 samples are free in A, 8 of 64 samples are free in B\n", self.compare(a, c, check=0).stdout)

    def test_unjudged_cases_are_not_success(self):
        a, b = self.run_as("a"), self.run_as("b")
        journal = (b / "journal.jsonl").read_text().splitlines(keepends=True)
        (b / "journal.jsonl").write_text("".join(x for x in journal if not ('"end"' in x[:40] and "fam/c3" in x[:60])))
        done = self.compare(a, b, check=7)
        self.assertTrue(done.stdout.endswith("exit 7: no regression, but cases were not judged\n"))

    def refused(self, sentence, *words, code=2):
        done = self.edgecase("compare", *words, check=code)
        self.assertEqual((done.stdout, done.stderr), ("", f"edgecase: {sentence}\n"))

    def test_wrong_words(self):
        a = self.run_as("a")
        b = self.run_as("b", profile="vulkan")
        self.refused("comparing needs the folders of at least two runs", a)
        self.refused(f"{a} is judged at profile direct3d and {b} at vulkan; compare runs of one profile", a, b)
        self.refused("error: cannot read nowhere/journal.jsonl: No such file or directory; name the directory of a run",
                     a, "nowhere", code=3)
        self.refused("DIR is required; see 'edgecase compare --help'")
        self.refused("unknown option '--jsn'; did you mean '--json'? See 'edgecase compare --help'", a, a, "--jsn", "x")

    def test_other_suites_are_told(self):
        a = self.run_as("a")
        self.write_case("fam/c9", TIES)
        done = self.compare(a, self.run_as("b"), check=1)
        self.assertIn("B: another case under the same id\n", done.stdout)
        self.assertIn("note: the suites of A and B are not the same: a case may ask something else\n", done.stdout)


HEADER = "# edgecase-expectations 2\n# device: Edgecase*\n"
FLIPPED = "double:cover.outside@vulkan<=1"  # what flip-pixel does to a case of the suite


class Update(CompareTest):
    def setUp(self):
        super().setUp()
        self.file = self.folder / "mine.txt"

    def update(self, *words, check=0, run=None):
        return self.edgecase("expect", "--update", run or self.folder / "a", self.file, *words, check=check)

    def test_a_new_file_makes_the_run_green(self):
        self.run_as("a", fault="flip-pixel@fam/c1,segv@fam/c3")
        self.update("--bug", "mesa#7", "--until", "2999-01-01")
        text = self.file.read_text()
        self.assertRegex(text, r"\A# edgecase-expectations 2\n# device: Edgecase reference   driver: built in   profile: direct3d\n"
                               rf"fam/c1   fail   mesa#7   {FLIPPED}   until=2999-01-01   # 1 \w+ of 64 samples, \S+ \[\w+\]\.\n"
                               r"fam/c3   crash   mesa#7   signal=SIGSEGV   until=2999-01-01   # .*SIGSEGV.*\n\Z")
        self.run_suite("--expect", self.file, fault="flip-pixel@fam/c1,segv@fam/c3", check=0)
        self.edgecase("expect", self.file, check=0)

    def test_what_changed_and_nothing_else(self):
        lines = ["", "# why c1 is here", f"fam/c1    fail   b#1   {FLIPPED}    # The first.", f"fam/c2  fail  b#2  {FLIPPED}  # The second.",
                 "", "  # indented", f"fam/c3 fail b#3 {FLIPPED} # The third.", "fam/c4 skip - # Too slow.",
                 "fam/c5 flake b#5 # Now and then."]
        self.file.write_text(HEADER + "\n".join(lines) + "\n")
        self.run_as("a", "--expect", self.file, fault="flip-pixel@fam/c1,segv@fam/c3,flip-pixel@fam/c7")
        done = self.update("--bug", "b#9", "--reason", "New today.")
        lines[3:4] = []
        lines[5] = "fam/c3 crash b#3   signal=SIGSEGV   # The third."
        lines.append(f"fam/c7   fail   b#9   {FLIPPED}   # New today.")
        self.assertEqual(self.file.read_text(), HEADER + "\n".join(lines) + "\n")
        self.assertEqual(done.stdout, f"- fam/c2  fail  b#2  {FLIPPED}  # The second.\n- fam/c3 fail b#3 {FLIPPED} # The third.\n"
                                      f"+ fam/c3 crash b#3   signal=SIGSEGV   # The third.\n+ fam/c7   fail   b#9   {FLIPPED}   # New today.\n"
                                      f"{self.file}: 1 removed, 1 changed, 1 added, 3 kept\n")
        again = self.update("--bug", "b#9")
        self.assertTrue(again.stdout.endswith("nothing to write\n"), again.stdout)

    def test_a_glob_whose_cases_differ(self):
        for k in range(3):
            self.write_case(f"g/x{k}", (self.suite / "fam/c1.toml").read_text())
        self.file.write_text(HEADER + f"g/*  fail  b#1  {FLIPPED}  # All of them.\n")
        self.run_as("a", "g/x0", "g/x1", "--expect", self.file, fault="flip-pixel@g/x0")
        self.update()
        # g/x2 was not drawn, so the line still holds for it.
        self.assertEqual(self.file.read_text(), HEADER + f"g/x0   fail   b#1   {FLIPPED}   # All of them.\n"
                                                         f"g/x2   fail   b#1   {FLIPPED}   # All of them.\n")

    def matrix(self, name, fault):
        self.write_case(name, (self.suite / "fam/c1.toml").read_text().replace("[[1,1]", '[["1 + 0 * a * b",1]') + "[matrix]\na = [1, 2, 3]\nb = [1, 2]\n")
        self.run_as("a", fault=fault)

    def test_cases_with_one_cause_share_a_line(self):
        """A glob of a new line matches what fails, and nothing else."""
        self.matrix("fam/m", "flip-pixel@fam/m:a=1*,flip-pixel@fam/m:a=3*b=2")
        self.update("--bug", "b#1", "--reason", "R.")
        self.assertEqual(self.file.read_text().splitlines()[2:], [f"fam/m:a=1,*   fail   b#1   {FLIPPED}   # R.",
                                                                  f"fam/m:a=3,b=2   fail   b#1   {FLIPPED}   # R."])
        self.run_suite("--expect", self.file, fault="flip-pixel@fam/m:a=1*,flip-pixel@fam/m:a=3*b=2", check=0)

    def test_other_causes_have_other_lines(self):
        self.matrix("fam/m", "flip-pixel@fam/m:*b=1,segv@fam/m:*b=2,shift-value+1@fam/m:a=1*b=1")
        self.update("--bug", "b#1", "--reason", "R.")
        shifted = "value:fragcoord.xy@vulkan<=1"
        self.assertEqual(self.file.read_text().splitlines()[2:], [
            f"fam/m:a=1,b=1   fail   b#1   {FLIPPED} {shifted}   # R.", "fam/m:*,b=2   crash   b#1   signal=SIGSEGV   # R.",
            f"fam/m:a=2,b=1   fail   b#1   {FLIPPED}   # R.", f"fam/m:a=3,b=1   fail   b#1   {FLIPPED}   # R."])

    def test_a_cause_grows(self):
        """What is new beside a known failure is added to its line, and then known."""
        self.file.write_text(HEADER + f"fam/c1  fail  b#1  {FLIPPED}  # The first.\n")
        self.run_as("a", "--expect", self.file, fault="flip-pixel@fam/c1,shift-value+1@fam/c1")
        self.update()
        self.assertEqual(self.file.read_text(), HEADER + f"fam/c1  fail  b#1   {FLIPPED} value:fragcoord.xy@vulkan<=1   # The first.\n")
        self.run_suite("--expect", self.file, fault="flip-pixel@fam/c1,shift-value+1@fam/c1", check=0)
        self.run_suite("--expect", self.file, fault="flip-pixel@fam/c1", check=0)

    def test_lines_of_cases_that_were_not_drawn_stay(self):
        text = HEADER + f"fam/c1  fail  b#1  {FLIPPED}  # The first.\nfam/gone  fail  b#1  {FLIPPED}  # Its case is gone.\n"
        self.file.write_text(text)
        self.run_as("a", "fam/c2", "--expect", self.file)
        self.assertEqual(self.update().stdout, "note: 'fam/gone' matches no case of the suite\n"
                                               f"{self.file}: 0 removed, 0 changed, 0 added, 2 kept; nothing to write\n")
        self.assertEqual(self.file.read_text(), text)

    def test_a_line_that_ended(self):
        self.file.write_text(HEADER + f"fam/c1  fail  b#1  {FLIPPED}  until=2020-01-01  # The first.\n")
        self.run_as("a", "--expect", self.file, fault="flip-pixel@fam/c1")
        self.assertIn("note: the expectation of 'fam/c1' ended on 2020-01-01 and is still needed; look at it again and "
                      "give --until DATE to extend it\n", self.update().stdout)
        self.update("--until", "2999-12-31")
        self.assertEqual(self.file.read_text(), HEADER + f"fam/c1  fail  b#1   {FLIPPED}   until=2999-12-31   # The first.\n")
        self.assertEqual(self.edgecase("expect", self.file, check=0).stdout,
                         f"{self.file}: 1 expectation, 1 fail; for Edgecase*\n")

    def test_dry_run_writes_nothing(self):
        self.run_as("a", fault="flip-pixel@fam/c1")
        self.assertIn("; not written (--dry-run)\n", self.update("--bug", "x", "--dry-run").stdout)
        self.assertFalse(self.file.exists())

    def test_another_file_speaks_of_it(self):
        other = self.folder / "other.txt"
        other.write_text(HEADER + f"fam/c1  fail  b#1  {FLIPPED}  # The first.\n")
        self.run_as("a", "--expect", other)
        self.assertIn(f"note: 'fam/c1' is spoken of by {other}:3; update that file\n", self.update().stdout)

    def refused(self, sentence, *words, code=2, **more):
        done = self.update(*words, check=code, **more)
        self.assertEqual((done.stdout, done.stderr), ("", f"edgecase: {sentence}\n"))

    def test_wrong_words(self):
        self.run_as("a", fault="flip-pixel@fam/c1,flip-pixel@fam/c2")
        self.refused("2 unexpected results need a line ('fam/c1', 'fam/c2'); give --bug REFERENCE, so that each says "
                     "where it is followed up")
        self.refused("--bug: 'two words' is no reference; give one word that does not begin with '#', like mesa#1234 or a link", "--bug", "two words")
        self.refused("--until: '2026-02-30' is no day to come; write YYYY-MM-DD", "--bug", "x", "--until", "2026-02-30")
        self.refused("--until: '2020-01-01' is no day to come; write YYYY-MM-DD", "--bug", "x", "--until", "2020-01-01")
        self.refused("--update: error: cannot read nowhere/journal.jsonl: No such file or directory; name the directory "
                     "of a run", code=3, run="nowhere")
        self.file.write_text(HEADER.replace("Edgecase*", "Other*"))
        self.refused(f"the expectation file '{self.file}' does not fit the run: it is for the device 'Other*', this is "
                     "'Edgecase reference'", "--bug", "x", code=5)
        self.file.write_text(HEADER + "fam/c1 fial x # y\n")
        self.refused(f"{self.file}:3:1: error: 'fial' is no status that can be expected; did you mean 'fail'?",
                     "--bug", "x", code=3)
        self.assertEqual(self.file.read_text(), HEADER + "fam/c1 fial x # y\n")

    def test_show(self):
        self.file.write_text(HEADER + f"fam/c1  fail  b#1  {FLIPPED}  until=2020-01-01  # The first.\n")
        done = self.edgecase("expect", self.file, check=1)
        self.assertEqual(done.stderr, f"{self.file}:3:1: error: the expectation of 'fam/c1' ended on 2020-01-01; "
                                      "re-check it, or extend the date\n")


if __name__ == "__main__":
    unittest.main()
