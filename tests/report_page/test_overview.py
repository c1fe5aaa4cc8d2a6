# SPDX-FileCopyrightText: The Edgecase authors
# SPDX-License-Identifier: Apache-2.0
"""What a reader sees first: the verdict, the causes in order, and a list whose columns have headers at every width."""
import json
import os
import unittest

from page_support import CASES, SQUARE, PageTest

WIDTHS = (360, 800, 1400)


class FirstSight(PageTest):
    cases = CASES | {f"late/{n}": SQUARE.format(more="", target="", draw="") for n in ("one", "two")}
    fault = "flip-pixel@family/wrong,flip-pixel@samples/four,flip-pixel@late/*"

    @classmethod
    def make_run(cls):
        """The two cases of late/ break a direct3d promise alone; what is drawn wrong elsewhere breaks Vulkan."""
        super().make_run()
        file = cls.out / "journal.jsonl"
        records = [json.loads(line) for line in file.read_text(encoding="utf-8").splitlines()]
        for record in records:
            if record["record"] == "end" and record["id"].startswith("late/"):
                record["level"] = "direct3d"
                for part in record["findings"] + record["groups"]:
                    part["level"] = "direct3d"
        file.write_text("".join(json.dumps(record) + "\n" for record in records), encoding="utf-8")
        cls.edgecase("report", cls.out)

    def test_causes_stand_in_the_order_of_results_json(self):
        causes = json.loads((self.out / "results.json").read_text(encoding="utf-8"))["causes"]
        self.assertEqual([(c["level"], len(c["cases"])) for c in causes], [("vulkan", 2), ("direct3d", 2)])
        page = self.open()
        shown = page.run("[...document.querySelectorAll('#causes tr[data-cause]')].map((r) => r.dataset.cause)")
        self.assertEqual(shown, ["|".join((c["status"], c["family"], c["rule"], c["kind"], c["level"], *filter(None, [c["door"]]))) for c in causes])
        levels = page.run("[...document.querySelectorAll('#causes .level')].map((e) => e.innerText)")
        self.assertEqual(levels, [c["level"] for c in causes])
        examples = page.run("[...document.querySelectorAll('#causes td:last-child a')].map((a) => a.innerText)")
        self.assertEqual(examples[1], "late/one")

    def test_the_verdict_is_the_headline(self):
        page = self.open()
        self.assertEqual(page.text("h1"), "4 of 6 cases fail")
        self.assertEqual(page.text(".levels").splitlines(), [
            "vulkan: 2 of 6 cases are wrong (family, samples) not conformant", "practice: nothing",
            "direct3d: 2 cases differ (late) differs from top-left hardware"])
        size = "parseFloat(getComputedStyle(document.querySelector('%s')).fontSize)"
        self.assertGreater(page.run(size % "h1"), 1.5 * page.run(size % ".run dl.key dd"))
        self.assertIn("Edgecase reference", page.text(".run dl.key"))

    def test_the_date_of_the_run_is_told(self):
        started = json.loads((self.out / "results.json").read_text(encoding="utf-8"))["run"]["started"]
        told = self.open().run("[...document.querySelectorAll('.run dl.key div')].find((d) => d.innerText.startsWith('run')).innerText")
        self.assertIn(f"{started[:10]} {started[11:16]} UTC, took ", told)

    def test_the_date_can_be_set(self):
        out = self.folder / "dated"
        os.environ["SOURCE_DATE_EPOCH"] = "86400"
        self.addCleanup(os.environ.pop, "SOURCE_DATE_EPOCH")
        self.edgecase("run", "--renderer=reference", "family/good", "-o", out)
        run = json.loads((out / "results.json").read_text(encoding="utf-8"))["run"]
        self.assertEqual((run["started"], run["ended"]), ("1970-01-02T00:00:00Z", "1970-01-02T00:00:00Z"))
        self.assertIn("1970-01-02 00:00 UTC", self.open(file=out / "report.html").text(".run"))
        self.assertEqual(self.open(file=out / "report.html").text("h1"), "The one case passes")

    def test_no_fact_of_the_run_stands_alone_in_a_line(self):
        page = self.open(width=1400)
        tops = page.run("[...document.querySelectorAll('.run dl.key > div')].map((d) => d.offsetTop)")
        self.assertEqual(len(set(tops)), 1, tops)

    def test_nothing_sticks_out_of_the_window(self):
        for width in WIDTHS:
            page = self.open(width=width)
            self.assertEqual(page.run("document.documentElement.scrollWidth - innerWidth"), 0, width)
            out = page.run("[...document.querySelectorAll('#overview *')].filter((e) => e.getClientRects().length && !e.closest('.hidden-text, thead') && "
                           "e.getBoundingClientRect().right > innerWidth + .5).map((e) => e.tagName + '.' + e.className)")
            self.assertEqual(out, [], width)
            rows = page.run("[...document.querySelectorAll('#causes tbody tr, tr.case-row')].map((r) => r.offsetHeight)")
            self.assertLess(max(rows), 200, width)

    def test_the_bar_does_not_cover_the_columns_headers(self):
        for width in (800, 1400):
            page = self.open(width=width, height=420)
            page.run("window.scrollTo(0, byId('list').getBoundingClientRect().top + scrollY + 60)")
            page.wait_for("byId('bar').getBoundingClientRect().top < 1")
            head, bar = page.run("[document.querySelector('#list thead th').getBoundingClientRect().top, byId('bar').getBoundingClientRect().bottom]")
            self.assertGreaterEqual(head, bar - 1, width)
            seen = page.run("(() => { const r = document.querySelector('#list thead th:nth-child(5)').getBoundingClientRect();"
                            "return document.elementFromPoint(r.x + r.width / 2, r.y + r.height / 2).innerText; })()")
            self.assertEqual(seen, "budgets", width)

    def test_no_error_is_told_where_another_thing_is_wrong(self):
        page = self.open()
        told = page.run("[[null, 0], ['0', 0], ['0', 3], ['1.9', 3], ['2.1', 3], ['inf', 3]].map(([worst, wrong]) =>"
                        "isWorstTold({worst: worst && [worst, worst, ''], finding_total: wrong}))")
        self.assertEqual(told, [False, True, False, False, True, True])

    def test_files_of_ones_own_are_a_family_by_their_folder(self):
        page = self.open()
        self.assertEqual(page.run("[familyOf('ties/a:x=1/2', '/s/ties/a.toml'), familyOf('a:x=1/2', '/h/mine/a.toml'), familyOf('a', 'a.toml')]"),
                         ["ties", "mine/", "a"])

    def test_findings_that_are_not_here_are_told_where_they_are(self):
        page = self.open()
        for total, kept, told in ((1, 1, "Findings 1"), (25, 1, "Findings 25, 1 of them here; the others are counted only"),
                                  (25, 16, "Findings 25, 1 of them here and 16 in results.json")):
            head = page.run("findingsSection({record: {finding_total: %d, finding_kept: %d}, pin() {}, findings: [{x: 0, y: 0, sample: 0, kind: 'value',"
                            "rule: 'cover.inside', level: 'vulkan', expected: '0', got: '1', why: ''}]}).querySelector('h2').textContent" % (total, kept))
            self.assertEqual(head, told)


class Known(PageTest):
    """A run in which every failure was expected."""
    cases = CASES

    @classmethod
    def make_run(cls):
        first, known = cls.folder / "first", cls.folder / "known.txt"
        cls.edgecase("run", "--renderer=reference", "-o", first, check=1, fault=cls.fault)
        cls.edgecase("expect", known, "--update", first, "--bug", "bug#17")
        cls.edgecase("run", "--renderer=reference", "--expect", known, "-o", cls.out, fault=cls.fault)

    def test_causes_of_known_failures_are_folded(self):
        page = self.open()
        self.assertEqual(page.count("#causes"), 0)
        self.assertEqual(page.text("#known summary"), "Known failures by cause 2 causes, 3 cases")
        self.assertFalse(page.run("byId('known').open"))
        page.click_seen("#known summary")
        self.assertTrue(page.run("byId('known').open"))
        self.assertEqual(page.count("#known tr[data-cause]"), 2)
        rows = page.run("[...document.querySelectorAll('#known tr[data-cause]')].map((r) => r.innerText)")
        self.assertTrue(any("family/wrong" in row and "cover.outside" in row for row in rows), rows)
        self.assertTrue(all("known as bug#17" in row for row in rows), rows)
        page.run("[...document.querySelectorAll('#known tr[data-cause]')].find((r) => r.innerText.includes('blit')).querySelector('button').click()")
        self.assertEqual(page.run("[...document.querySelectorAll('tr.case-row')].map((r) => r.dataset.case)"), ["texels/blit"])

    def test_a_run_without_known_failures_has_no_such_list(self):
        out = self.folder / "unknown"
        self.edgecase("run", "--renderer=reference", "-o", out, check=1, fault=self.fault)
        self.assertEqual(self.open(file=out / "report.html").count("#known"), 0)

    def test_the_bars_of_families_begin_at_one_place(self):
        for width in WIDTHS:
            page = self.open(width=width)
            lefts = page.run("[...document.querySelectorAll('.group-line .bar')].map((b) => b.getBoundingClientRect().left)")
            self.assertEqual(len(lefts), 3)
            self.assertEqual(len(set(lefts)), 1, (width, lefts))

    def test_no_status_reads_twice(self):
        glyphs = self.open().run("GLYPHS")
        for status, glyph in glyphs.items():
            self.assertNotEqual(glyph.lower(), status[0], status)


if __name__ == "__main__":
    unittest.main()
