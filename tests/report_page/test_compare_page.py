# SPDX-FileCopyrightText: The Edgecase authors
# SPDX-License-Identifier: Apache-2.0
"""The page of "edgecase compare --html"."""
import unittest

from page_support import CASES, SQUARE, PageTest

HOSTILE = SQUARE.format(more="", target="", draw="")


class ComparePage(PageTest):
    cases = CASES | {"family/fixed": HOSTILE, "family/same": HOSTILE, "family/gone": HOSTILE}

    @classmethod
    def make_run(cls):
        cls.a, cls.b = cls.folder / "run of <A> & 1%", cls.folder / "b"
        cls.edgecase("run", "--renderer=reference", "--capture", "all", "-o", cls.a, check=1,
                     fault="flip-pixel@family/fixed,segv@family/gone")
        cls.edgecase("run", "--renderer=reference", "--capture", "all", "-o", cls.b, check=1,
                     fault="flip-pixel@family/wrong,flip-pixel@samples/four,segv@family/gone")
        cls.page = cls.folder / "pages" / "compared.html"
        cls.page.parent.mkdir()
        cls.edgecase("compare", cls.a, cls.b, "--html", cls.page, check=1)

    def sections(self, page):
        return page.run("Object.fromEntries([...document.querySelectorAll('#list section')].map((s) => [s.dataset.kind, "
                        "[...s.querySelectorAll('tr.compared')].map((r) => r.dataset.case)]))")

    def test_kinds_cases_and_runs(self):
        page = self.open(file=self.page)
        self.assertEqual(self.sections(page), {"regression": ["family/wrong", "samples/four"], "fix": ["family/fixed"],
                                               "fails alike": ["family/gone"]})
        self.assertEqual(page.text("[data-kind=regression] .tally"), "2")
        self.assertEqual(page.text("[data-kind=same] .tally"), "3")
        self.assertEqual(page.text(".verdict"), "exit 1: regressions")
        self.assertEqual(page.text("h1"), "2 cases got worse, 1 got better")
        self.assertTrue(page.run("document.title").startswith("edgecase: 2 cases got worse, 1 got better, "))
        tops = page.run("['h1', '#statuses', '#runs', '#causes'].map((s) => document.querySelector(s).getBoundingClientRect().top)")
        self.assertEqual(tops, sorted(tops))
        self.assertIn("run of <A> & 1%", page.text("#runs"))
        row = page.text("tr[data-case='family/wrong']")
        for part in ("pass", "fail", "1 double of 64 samples"):
            self.assertIn(part, row)

    def test_nothing_is_told_twice(self):
        page = self.open(file=self.page)
        self.assertEqual(page.text("[data-kind=regression].tile").split(), ["2", "regressions"])
        self.assertEqual(page.text("[data-kind=fix].tile").split(), ["1", "fix"])
        self.assertEqual(page.text("tr[data-case='family/wrong']").count("1 double of 64 samples"), 1)
        page.click_seen("tr[data-case='family/wrong'] button")
        self.assertEqual(page.run("document.querySelector('.detail td').colSpan"), 3)

    def test_results_stand_beside_the_first_line_of_a_long_id(self):
        page = self.open(file=self.page, width=900)
        page.run("(() => { const row = document.querySelector(\"tr[data-case='family/wrong']\"); row.querySelector('button').textContent = 'long/' + 'id '.repeat(90); })()")
        tops = page.run("[...document.querySelector(\"tr[data-case='family/wrong']\").cells].map((c) => c.firstElementChild.getBoundingClientRect().top)")
        self.assertLess(max(tops) - min(tops), 8)

    def test_causes_stand_by_change(self):
        page = self.open(file=self.page)
        rows = page.run("[...document.querySelectorAll('#causes tr[data-cause]')].map((r) => [...r.cells].map((c) => c.innerText.split('\\n')[0]))")
        self.assertEqual([(row[0], row[2], row[3], row[4]) for row in rows],
                         [("regression", "vulkan", "2 cases", "family/wrong"), ("fix", "vulkan", "1 case", "family/fixed"), ("fails alike", "", "1 case", "family/gone")])
        self.assertIn("A triangle covers no sample strictly outside it", page.text("#causes"))
        page.click_seen("#causes tr:nth-child(2) button")
        self.assertEqual(self.sections(page), {"fix": ["family/fixed"]})
        page.key("Escape")
        self.assertEqual(len(self.sections(page)), 3)

    def test_keys_open_one_case_after_the_other(self):
        page = self.open(file=self.page)
        opened = "[...document.querySelectorAll('tr.compared')].filter((r) => r.querySelector('button').getAttribute('aria-expanded') === 'true').map((r) => r.dataset.case)"
        for key, case in (("n", "family/wrong"), ("n", "samples/four"), ("n", "family/fixed"), ("p", "samples/four")):
            page.key(key)
            self.assertEqual(page.run(opened), [case])
        page.key("?")
        self.assertTrue(page.run("byId('help').open"))
        page.key("Escape")
        self.assertFalse(page.run("byId('help').open"))

    def test_an_address_opens_a_case(self):
        page = self.open("#case=family%2Ffixed", file=self.page)
        self.assertEqual(page.run("document.querySelector('.detail').previousSibling.dataset.case"), "family/fixed")
        page.run("scrollTo(0, 0)")
        page.click_seen("#causes tr:nth-child(1) td:last-child a")
        page.wait_for("document.querySelector(\"tr[data-case='family/wrong']\").nextSibling?.className === 'detail'")

    def test_rows_hold_no_blanks_in_a_narrow_window(self):
        for width in (360, 400, 800, 1400):
            page = self.open(file=self.page, width=width)
            self.assertEqual(page.run("document.documentElement.scrollWidth - innerWidth"), 0, width)
            cut = page.run("[...document.querySelectorAll('.framed')].filter((e) => e.scrollWidth > e.clientWidth + 1).map((e) => e.scrollWidth)")
            self.assertEqual(cut, [], width)
            heights = page.run("[...document.querySelectorAll('tr.compared')].map((r) => r.offsetHeight)")
            self.assertLess(max(heights), 150, width)
            lefts = page.run("[...document.querySelector('tr.compared').cells].map((c) => c.getBoundingClientRect().left)")
            self.assertEqual(len(set(lefts)) == 1, width <= 700, (width, lefts))  # one below the other
            page.run("document.querySelector('tr.compared button').textContent = 'long/' + 'part_of_an_id='.repeat(12)")
            out = page.run("[...document.querySelectorAll('main *')].filter((e) => e.getClientRects().length && e.getBoundingClientRect().right > innerWidth + .5 && !e.closest('thead')).map((e) => e.tagName + e.className)")
            self.assertEqual(out, [], width)

    def test_tiles_and_words_filter(self):
        page = self.open(file=self.page)
        page.click_seen("[data-kind=regression].tile")
        self.assertNotIn("regression", self.sections(page))
        page.key("/")
        page.type("fixed")
        self.assertEqual(self.sections(page), {"fix": ["family/fixed"]})
        self.assertEqual(page.text("#shown"), "1 of 4 cases that are not the same")

    def test_pictures_stand_side_by_side(self):
        page = self.open(file=self.page)
        page.click_seen("tr[data-case='family/wrong'] button")
        self.assertEqual(page.count(".detail .frame canvas"), 3)
        captions = page.run("[...document.querySelectorAll('.detail figcaption')].map((f) => f.innerText)")
        self.assertEqual([caption.split("\n")[0] for caption in captions], [f"A: {self.a}", f"B: {self.b}", "difference of A and B"])
        self.assertEqual(captions[2].split("\n")[1], "0 samples hit by A alone, 0 by B alone, 1 by both, not as often")
        self.assertEqual(page.run("[...document.querySelectorAll('.detail .legend li')].map((e) => e.innerText)"),
                         ["1 hit", "2 hits", "hit alike", "hit by both, not as often", "top or left edge", "other edge", "sample exactly on an edge"])
        # Of 64 pixels one is painted otherwise in B, the one with the cross in the difference.
        other = page.run("(() => { const [a, b, d] = [...document.querySelectorAll('.detail .frame canvas')], zoom = a.width / 10, ok = PALETTES[theme()].ok, one = PALETTES[theme()].hits[1];"
                         "const hex = (d) => '#' + [...d].slice(0, 3).map((v) => v.toString(16).padStart(2, '0')).join('');"
                         "const at = (c, i, j) => hex(c.getContext('2d').getImageData((i + 1.25) * zoom, (j + 1.75) * zoom, 1, 1).data).replace(ok, one);"
                         "const places = []; for (let j = 0; j < 8; ++j) for (let i = 0; i < 8; ++i) {"
                         "if (at(a, i, j) !== at(b, i, j)) places.push([i, j]); if (at(a, i, j) !== at(d, i, j)) places.push([i, j]); } return places; })()")
        self.assertEqual(len(other), 2)
        self.assertEqual(other[0], other[1])
        page.click_seen("tr[data-case='family/wrong'] button")
        self.assertEqual(page.count(".detail canvas"), 0)
        page.click_seen("tr[data-case='family/gone'] button")
        self.assertIn("No pictures of both", page.text(".detail"))

    def test_pictures_have_axes_a_grid_and_the_triangles(self):
        """As those of a case's page, by the same code."""
        page = self.open(file=self.page)
        page.run("(() => { const c = CanvasRenderingContext2D.prototype, {fillText, lineTo} = c; window.told = []; window.ends = 0;"
                 "c.fillText = function (text) { window.told.push(text); return fillText.apply(this, arguments); };"
                 "c.lineTo = function () { ++window.ends; return lineTo.apply(this, arguments); }; })()")
        page.click_seen("tr[data-case='family/wrong'] button")
        told, ends = page.run("[window.told, window.ends]")
        for k in range(8):
            self.assertGreaterEqual(told.count(str(k)), 6, told)  # a column and a row, in three pictures
        self.assertGreaterEqual(ends, 3 * 6)
        grid = page.run("(() => { const c = document.querySelector('.detail canvas'), zoom = c.width / 10, at = (x, y) => [...c.getContext('2d').getImageData(x, y, 1, 1).data].join();"
                        "return [at(zoom * 3, zoom * 1.5), at(zoom * 3.2, zoom * 1.5)]; })()")
        self.assertNotEqual(*grid)

    def test_links_lead_to_the_case_in_each_report(self):
        for column, status in ((2, "pass"), (3, "fail")):
            page = self.open(file=self.page)
            page.click_seen(f"tr[data-case='samples/four'] td:nth-child({column}) a")
            page.wait_for("document.getElementById('case-title') !== null")
            self.assertEqual(page.text("#case-title"), "samples/four")
            self.assertIn(status, page.text(".case-title"))

    def test_dark_light_and_narrow(self):
        page = self.open(file=self.page, width=480)
        paper = "getComputedStyle(document.body).backgroundColor"
        light = page.run(paper)
        page.key("t")
        self.assertNotEqual(page.run(paper), light)
        page.click("tr[data-case='family/wrong'] button")
        self.assertEqual(page.run("document.documentElement.scrollWidth"), 480)


if __name__ == "__main__":
    unittest.main()
