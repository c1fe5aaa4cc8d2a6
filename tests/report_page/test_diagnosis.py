# SPDX-FileCopyrightText: The Edgecase authors
# SPDX-License-Identifier: Apache-2.0
"""What a diagnosis repeats is folded under it, in the page and on the terminal; a case's page names the diagnosis that
explains it; and a known bug is not named as the cause of what its expectation does not speak of."""
import json
import unittest

from page_support import SQUARE, PageTest

FLIPPED = "double:cover.outside@vulkan<=1"
DIAGNOSIS = {"what": ["The last row is missing"], "names": ["last_row"], "cases": 2, "tried": 3, "examples": ["a/one"],
             "explained": ["a/one", "b/one"], "unexplained": ["c/one"], "samples": 2, "same_samples": 2, "values": 0,
             "same_values": 0, "against": 0, "passed_against": 0, "passed_tried": 1}


class Diagnosis(PageTest):
    """One cause in three families. A diagnosis was tried on one case of each, and repeats those of two."""
    cases = {name: SQUARE.format(more="", target="", draw="") for name in ("a/one", "a/two", "a/three", "a/four", "b/one", "c/one", "d/good")}
    fault = "flip-pixel@a/*,flip-pixel@b/*,flip-pixel@c/*"

    @classmethod
    def make_run(cls):
        (cls.folder / "expectations").mkdir()
        (cls.folder / "expectations" / "known.txt").write_text(
            "# edgecase-expectations 2\n# device: Edgecase*\n"
            "b/one fail bug#1 missing:cover.inside@vulkan<=1 # Another cause.\n"
            f"c/one fail bug#2 {FLIPPED} until=2020-01-01 # This one.\n")
        super().make_run()
        cls.told = cls.diagnosed(cls.out, [DIAGNOSIS])

    @classmethod
    def diagnosed(cls, out, diagnoses, *words):
        file = out / "journal.jsonl"
        records = [json.loads(line) for line in file.read_text(encoding="utf-8").splitlines()]
        [stop] = [record for record in records if record["record"] == "stop"][-1:]
        stop["diagnoses"] = diagnoses
        file.write_text("".join(json.dumps(record) + "\n" for record in records), encoding="utf-8")
        return cls.edgecase("report", out, *words)

    def rows(self, page, where):
        return page.run(f"[...document.querySelectorAll('{where} tr[data-cause]')].map((r) => r.dataset.cause.split('|')[1])")

    def test_causes_are_folded_under_the_diagnosis(self):
        for width in (360, 800, 1400):
            page = self.open(width=width)
            self.assertEqual(self.rows(page, ".diagnosis details"), ["a, b"])
            self.assertEqual(page.text(".diagnosis summary"), "1 cause says the same, in 5 cases")
            self.assertFalse(page.run("document.querySelector('.diagnosis details').open"))
            self.assertEqual((self.rows(page, "#causes"), page.text("#causes h2")), (["c"], "Other causes 1"))
            page.click_seen(".diagnosis summary")
            self.assertEqual(page.run("document.documentElement.scrollWidth - innerWidth"), 0, width)
            page.click_seen(".diagnosis details td button.link")
            self.assertEqual(page.text("#shown"), "5 of 7 cases of one cause")

    def test_the_case_names_the_diagnosis_that_explains_it(self):
        for case, told in (("a/one", "repeats what is wrong here."), ("a/two", "this one was not."), ("c/one", None), ("d/good", None)):
            page = self.open("#case=" + case.replace("/", "%2F"))
            if told is None:
                self.assertEqual(page.run("document.querySelectorAll('.case-head .diagnosis').length"), 0)
            else:
                text = page.text(".case-head .diagnosis")
                self.assertTrue(text.startswith("The last row is missing.") and text.endswith(told), text)

    def test_a_bug_is_named_for_what_its_expectation_speaks_of(self):
        page = self.open()
        line = "(() => { const row = [...document.querySelectorAll('tr[data-cause]')].find((r) => r.dataset.cause.split('|')[1] === '%s'); " \
               "return [...row.querySelectorAll('td:nth-child(2) .small')].map((e) => e.textContent); })()"
        self.assertEqual(page.run(line % "a, b"), ["beside what is known as bug#1"])
        self.assertEqual(page.run(line % "c"), ["known as bug#2"])

    def test_the_terminal_folds_too(self):
        lines = self.told.splitlines()
        self.assertTrue(lines[-3].startswith("diagnosis: The last row is missing; it repeats 2 of 2 wrong samples "), self.told)
        self.assertIn("1 of 2 causes says the same as the diagnosis; -v lists it", lines)
        causes = [line.split(" in ")[1].split(",")[0] for line in lines if line.startswith("  fail: ")]
        self.assertEqual(causes, ["c"])
        all_told = self.edgecase("report", self.out, "-v", "-o", self.folder / "again")
        self.assertEqual(sum(line.startswith("  fail: ") for line in all_told.splitlines()), 2)
        self.assertNotIn("says the same as the diagnosis", all_told)

    def test_without_a_diagnosis_nothing_is_folded(self):
        out = self.folder / "plain"
        self.edgecase("run", "--renderer=reference", "-o", out, check=1, fault=self.fault)
        page = self.open(file=out / "report.html")
        self.assertEqual((page.text("#causes h2"), len(self.rows(page, "#causes"))), ("Causes 1", 1))


if __name__ == "__main__":
    unittest.main()
