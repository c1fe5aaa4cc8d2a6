# SPDX-FileCopyrightText: The Edgecase authors
# SPDX-License-Identifier: Apache-2.0
"""Cases that pass show the reference, and every case shows its file."""
import unittest

from page_support import CASES, SQUARE, PageTest

LEAVES = SQUARE.format(more=" of several leaves", target="", draw='[[draw.attribute]]\nvalues = ["n", 1, 2, 3, 4, 5]').replace("[target]", "[matrix]\nn = [0, 1, 2]\n[target]")


class Reference(PageTest):
    cases = CASES | {"leaves/same": LEAVES}

    def test_a_case_that_passes_shows_what_must_be_covered(self):
        page = self.open("#case=family%2Fgood")
        self.assertIn("What must be covered, as the rules say", page.run("document.querySelector('.frame canvas').getAttribute('aria-label')"))
        self.assertEqual(page.run("[...document.querySelectorAll('[data-view]')].map((b) => b.dataset.view)"), ["reference"])
        # A square from 1 to 7, and the ties that its edges own.
        rows = page.run("(() => { const p = page.viewer.scene.pictures; return Array.from({length: p.height}, (_, y) => [...p.expected.slice(y * p.width, (y + 1) * p.width)].join('')); })()")
        self.assertEqual(rows, ["00000000"] + ["01111110"] * 6 + ["00000000"])
        colour = "(() => {{ const zoom = page.viewer.zoomNow(), c = document.querySelector('.frame canvas'); return [...c.getContext('2d').getImageData(({x} + 1) * zoom + 4, {y} * zoom + 4 + zoom, 1, 1).data].join(); }})()"
        self.assertNotEqual(page.run(colour.format(x=3, y=2)), page.run(colour.format(x=0, y=0)))
        page.key("ArrowRight")
        self.assertNotIn("device", page.text("#announcer") + page.text(".verdict-part"))

    def test_leaves_of_one_picture_share_it(self):
        page = self.open()
        self.assertEqual(page.run("new Set(data.cases.filter((c) => c.id.startsWith('leaves/')).map((c) => c.reference)).size"), 1)
        self.assertEqual(page.run("data.cases.filter((c) => c.id.startsWith('leaves/')).length"), 3)

    def test_none_are_kept_where_none_are_wanted(self):
        out = self.folder / "none"
        self.edgecase("run", "--renderer=reference", "--capture", "none", "family/good", "-o", out)
        page = self.open("#case=family%2Fgood", file=out / "report.html")
        self.assertEqual(page.count(".frame canvas"), 0)
        self.assertIn("--capture=all keeps them", page.text(".note"))

    def test_the_journal_alone_makes_the_same_page(self):
        before = self.report.read_text(encoding="utf-8")
        self.edgecase("report", self.out)
        self.assertEqual(self.report.read_text(encoding="utf-8"), before)

    def test_the_text_of_a_case_is_there(self):
        for case in ("family/good", "family/wrong", "leaves/same:n=1"):
            page = self.open(f"#case={case}")
            page.click(".source summary")
            file = self.folder / "suite" / (case.split(":")[0] + ".toml")
            self.assertEqual(page.text(".source pre").strip(), file.read_text(encoding="utf-8").strip())
            self.assertIn(file.name, page.text(".source"))


if __name__ == "__main__":
    unittest.main()
