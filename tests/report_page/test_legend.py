# SPDX-FileCopyrightText: The Edgecase authors
# SPDX-License-Identifier: Apache-2.0
"""The legend names what a view shows, in its colours, and nothing else; names of limits keep off the marks of samples; ids
break at their separators."""
import unittest

from page_support import CASES, SQUARE, PageTest

LONG_ID = "family/several-words-of-an-id:windinggiven=clockwise,culling=nothing,cleanparameter=0"
MORE = {
    "seen/clipped": """format = 1
description = "A triangle that reaches before the near plane."
rules = ["cover.inside"]
[target]
size = [16, 16]
[[draw]]
vertices = [[0,0,-0.5], [16,0,1.5], [0,16,-0.5]]
""",
    "seen/scissor": SQUARE.format(more=" in a scissor", target="", draw="scissor = [3, 3, 3, 3]"),
}
VIEWS = ("reference", "device", "difference", "error", "blink", "side")


class Legend(PageTest):
    cases = CASES | MORE
    fault = "flip-pixel@family/wrong,flip-pixel@samples/four,flip-pixel@texels/blit,flip-pixel@seen/*"

    def entries(self, page):
        """What the legend says, with the middle of each sample's colour."""
        return dict(page.run("[...document.querySelectorAll('.legend li:not(.limit):not(.scale)')].map((e) => [e.innerText,"
                             "[...e.querySelector('canvas').getContext('2d').getImageData(3, 33, 1, 1).data].join()])"))

    def painted(self, page):
        """The colours near the lower left corner of each pixel, of each picture that is shown."""
        page.run("['outlines', 'samples', 'grid'].forEach((name) => { const box = document.querySelector('[data-option=' + name + ']'); if (box && box.checked) { box.click(); } })")
        return page.run("[...document.querySelectorAll('.frame canvas')].map((c) => { const zoom = page.viewer.zoomNow(), p = page.viewer.scene.pictures, found = [];"
                        "for (let j = 0; j < p.height; ++j) { for (let i = 0; i < p.width; ++i) { const k = j * p.width + i;"
                        "found.push([p.marks[k], p.expected[k], p.device[k], [...c.getContext('2d').getImageData((i + 1) * zoom + 2, (j + 2) * zoom - 2, 1, 1).data].join()]); } } return found; })")

    def test_each_view_has_its_own_colours(self):
        for dark in (False, True):
            for view in ("reference", "device", "difference"):
                page = self.open(f"#case=family%2Fwrong&view={view}&zoom=16&px=0,0", dark=dark)
                entries = self.entries(page)
                for mark, expected, device, color in self.painted(page)[0]:
                    if view == "difference" and mark == 0 and expected > 0:
                        self.assertEqual(entries["covered as expected"], color)
                    elif view != "difference" and (hits := expected if view == "reference" else device):
                        self.assertEqual(entries["1 hit" if hits == 1 else f"{hits} hits"], color)

    def test_only_what_is_seen_is_named(self):
        edges = ["top or left edge", "other edge", "sample exactly on an edge"]
        for view, told in (("reference", ["1 hit"]), ("device", ["1 hit", "2 hits"]), ("difference", ["covered as expected", "double"]),
                           ("blink", ["1 hit", "2 hits"]), ("side", ["1 hit", "2 hits", "covered as expected", "double"])):
            page = self.open(f"#case=family%2Fwrong&view={view}")
            self.assertEqual(list(self.entries(page)), told + edges, view)
        self.assertEqual(list(self.entries(self.open("#case=texels%2Fblit&view=difference"))), ["written as expected", "free", "extra"])

    def test_what_clipping_leaves_is_named_where_it_is_drawn(self):
        for case, is_there in (("seen%2Fclipped", True), ("family%2Fwrong", False)):
            page = self.open(f"#case={case}")
            self.assertEqual("what clipping leaves" in self.entries(page), is_there)

    LABELS = ("(() => { const c = CanvasRenderingContext2D.prototype, fillText = c.fillText, found = [];"
              "c.fillText = function (text, x, y) { if (text === 'scissor') { const w = this.measureText(text).width; found.push([x, y - 12, x + w, y]); } return fillText.apply(this, arguments); };"
              "page.viewer.draw(); c.fillText = fillText; return found; })()")

    def test_names_keep_off_marked_samples(self):
        page = self.open("#case=seen%2Fscissor&view=difference&zoom=24&px=0,0")
        before = page.run(self.LABELS)
        self.assertEqual(len(before), 1)
        # Marks where the name stood: it goes elsewhere, and with marks everywhere it is left out.
        left, top, right, bottom = before[0]
        pixels = [(x, y) for y in range(8) for x in range(8)]
        covered = [(x, y) for x, y in pixels if left < 24 * (x + 2) and right > 24 * (x + 1) and top < 24 * (y + 2) and bottom > 24 * (y + 1)]
        self.assertGreater(len(covered), 0)
        for marked, names in ((covered, 1), (pixels, 0)):
            page.run(f"{[list(pixel) for pixel in marked]}.forEach(([x, y]) => {{ page.viewer.scene.pictures.marks[y * 8 + x] = 3; }})")
            after = page.run(self.LABELS)
            self.assertEqual(len(after), names)
            for box in after:
                for x, y in marked:
                    self.assertFalse(box[0] < 24 * (x + 2) and box[2] > 24 * (x + 1) and box[1] < 24 * (y + 2) and box[3] > 24 * (y + 1), (box, x, y))

    def test_ids_break_at_their_separators(self):
        lines = ("[...document.querySelectorAll('.id')].filter((e) => e.innerText.startsWith('family/several') && e.getClientRects().length).map((e) => {"
                 "const walker = document.createTreeWalker(e, NodeFilter.SHOW_TEXT), lines = []; let last = null;"
                 "for (let node = walker.nextNode(); node; node = walker.nextNode()) { for (let k = 0; k < node.length; ++k) {"
                 "const range = document.createRange(); range.setStart(node, k); range.setEnd(node, k + 1); const top = Math.round(range.getBoundingClientRect().top);"
                 "if (top !== last) { lines.push(''); last = top; } lines[lines.length - 1] += node.data[k]; } } return lines; })")
        folder = self.folder / "long"
        folder.mkdir()
        journal = (self.out / "journal.jsonl").read_text(encoding="utf-8")
        (folder / "journal.jsonl").write_text(journal.replace("family/wrong", LONG_ID), encoding="utf-8")
        self.edgecase("report", folder)
        for place, least in (("", 2), ("#case=" + LONG_ID, 1)):
            page = self.open(place, file=folder / "report.html", width=360)
            found = page.run(lines)
            self.assertGreaterEqual(len(found), least)
            for told in found:
                self.assertEqual("".join(told), LONG_ID)
                self.assertGreater(len(told), 1)
                for line in told[:-1]:
                    self.assertIn(line[-1], ":,=/-", told)


if __name__ == "__main__":
    unittest.main()
