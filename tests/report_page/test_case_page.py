# SPDX-FileCopyrightText: The Edgecase authors
# SPDX-License-Identifier: Apache-2.0
"""A case's page at three widths: all that tells a wrong value or sample is to be seen there."""
import unittest

from page_support import SQUARE, PageTest

WIDTHS = (360, 800, 1081, 1400)
# Weights that are no short numbers: every value of a fragment is a long fraction.
LONG = """format = 1
description = "Values that are long fractions."
catches = "a value that is off"
rules = ["interp.perspective"]
links = ["https://example.org/a/path/without/a/break/ffffffffffffffffffffffffffffffffffffffffffffffffffffffffffffffffffffffffff"]
[target]
size = [8, 8]
[[draw]]
vertices = [[1.0625,1,0.5,3.28125], [7,1.9375,0.25,1.71875], [1,6.8125,0.75,0.84375]]
[[draw.attribute]]
values = [1, 2.34375, -5.0625]
"""
CASES = {"told/long": LONG, "told/four": SQUARE.format(more=" of four samples", target="\nsamples = 4", draw="")}


class Widths(PageTest):
    cases = CASES
    fault = "shift-value@told/long,flip-pixel+2@told/four"

    def test_nothing_sticks_out_of_the_window(self):
        for case in ("long", "four"):
            for width in WIDTHS:
                page = self.open(f"#case=told%2F{case}", width=width)
                self.assertEqual(page.run("document.documentElement.scrollWidth - innerWidth"), 0, (case, width))
                out = page.run("[...document.querySelectorAll('#case .scroll, #case .framed, .inspector')].filter((e) => e.getClientRects().length && "
                               "e.scrollWidth > e.clientWidth + 1).map((e) => e.className + ': ' + e.scrollWidth)")
                self.assertEqual(out, [], (case, width))

    def test_the_devices_value_is_seen_at_every_width(self):
        for width in WIDTHS:
            page = self.open("#case=told%2Flong", width=width)
            cut = page.run("[...document.querySelectorAll('.values :is(th, td)')].flatMap((cell) => { const range = document.createRange(); range.selectNodeContents(cell);"
                           "const text = range.getBoundingClientRect(), box = cell.closest('.framed').getBoundingClientRect(), own = cell.getBoundingClientRect();"
                           "return text.right > Math.min(box.right, innerWidth, own.right + 1) || text.left < 0 ? [cell.innerText] : []; })")
            self.assertEqual(cut, [], width)
            wrong = page.text(".values tbody.wrong")
            self.assertRegex(wrong, r"attribute 0\.x[^\n]*\u2717")
            self.assertRegex(wrong, r"0x[0-9a-f]{8}")
            self.assertRegex(wrong, r"ulp")

    def test_squares_of_samples_do_not_overlap(self):
        """In a pixel and across its borders, at every zoom at which samples stand where they are."""
        page = self.open("#case=told%2Ffour")
        for count in (2, 4, 8, 16):
            overlaps = page.run("(() => { const standard = {2: [[12,12],[4,4]], 4: [[6,2],[14,6],[2,10],[10,14]],"
                                "8: [[9,5],[7,11],[13,9],[5,3],[3,13],[1,7],[11,15],[15,1]],"
                                "16: [[9,9],[7,5],[5,10],[12,7],[3,6],[10,13],[13,11],[11,3],[6,14],[8,1],[4,2],[2,12],[0,8],[15,4],[14,15],[1,0]]}[%d];"
                                "const geometry = {locations: standard.map(([x, y]) => ({x: BigInt(x * 4096), y: BigInt(y * 4096)}))};"
                                "const out = []; for (const zoom of [64, 128]) { const cells = [];"
                                "eachCell({p: {samples: %d, columns: 1, width: 3}, zoom, margin: 0, rows: [0, 2], columns: [0, 2]}, {geometry},"
                                "(k, x, y, w, h) => cells.push([x, y, w, h]));"
                                "cells.forEach((a, n) => cells.forEach((b, m) => { if (n < m && Math.min(a[0] + a[2], b[0] + b[2]) - Math.max(a[0], b[0]) > 1e-9 && "
                                "Math.min(a[1] + a[3], b[1] + b[3]) - Math.max(a[1], b[1]) > 1e-9 && a[2] > 4) { out.push([zoom, n, m]); } })); }"
                                "return out.slice(0, 5); })()" % (count, count))
            self.assertEqual(overlaps, [], count)

    def test_long_fractions_are_folded(self):
        page = self.open("#case=told%2Flong")
        fold = page.run("(() => { const b = document.querySelector('.values tbody.wrong .fold'); return [b.innerText, b.getAttribute('aria-expanded'), b.getAttribute('aria-label')]; })()")
        self.assertLessEqual(len(fold[0]), 12, fold)
        self.assertEqual(fold[1], "false")
        page.click_seen(".values tbody.wrong .fold")
        digits = page.text(".values tbody.wrong .fold")
        self.assertRegex(digits, r"^\u2212?\d{6,}/\d{6,}$")
        self.assertIn(digits, fold[2])
        page.click_seen(".values tbody.wrong .fold")
        self.assertEqual(page.text(".values tbody.wrong .fold"), fold[0])
        self.assertEqual(page.run("folded('1/2 = 0.5 or 1234567/7654321').map((part) => part.innerText || part)"),
                         ["1/2 = 0.5 or ", "1234\u2026/7654\u2026", ""])
        self.assertNotRegex(page.text(".findings"), r"\d{7,}/\d{7,}")

    def test_a_cell_without_budgets_has_no_label(self):
        """As a card, each cell is told by a label; missing and extra samples have no budgets."""
        for case, labels in (("long", ["budgets off"]), ("four", [])):
            page = self.open(f"#case=told%2F{case}", width=400)
            told = page.run("[...document.querySelectorAll('.findings tbody tr:first-child td[data-label=\"budgets off\"]')].map((e) => e.dataset.label)")
            self.assertEqual(told, labels, case)

    def test_corners_are_told_in_plain_words(self):
        page = self.open("#case=told%2Flong")
        words = page.run("[['left', 'left'], ['left', 'right'], ['top']].map((kinds) => "
                         "placeText({place: 'edge', owns: true, zero: kinds.map((kind) => ({kind}))}))")
        self.assertEqual([text.partition(":")[0] for text in words],
                         ["exactly on the corner of two left edges", "exactly on the corner of a left edge and a right edge", "exactly on a top edge"])

    def test_links_keep_to_their_column(self):
        page = self.open("#case=told%2Flong", width=1400)
        link, facts = page.run("(() => { const range = document.createRange(); range.selectNodeContents(document.querySelector('.plain a[href*=example]'));"
                               "return [range.getBoundingClientRect().right, document.querySelector('.facts').getBoundingClientRect().left]; })()")
        self.assertLess(link, facts)

    def test_the_picture_fills_its_column(self):
        for case in ("long", "four"):
            page = self.open(f"#case=told%2F{case}", width=1400, height=1000)
            frame, stage = page.run("[document.querySelector('.frame').offsetWidth, document.querySelector('.stage').clientWidth]")
            self.assertGreater(frame, .9 * stage, case)
            self.assertLess(page.box(".frame")[3], 1000)

    def test_no_point_covers_a_letter(self):
        for case, zooms in (("four", (40, 48, 52, 64, 80, 128)), ("long", (16, 20, 24, 28, 64))):
            page = self.open(f"#case=told%2F{case}&view=difference")
            seen = 0
            for zoom in zooms:
                at = page.run("(() => { const texts = [], points = [], c = CanvasRenderingContext2D.prototype, fillText = c.fillText, arc = c.arc;"
                              "c.fillText = function (text, x, y) { if (/^[MXDVO]$/.test(text)) { texts.push([x, y]); } return fillText.apply(this, arguments); };"
                              "c.arc = function (x, y, r) { if (r <= 3) { points.push([x, y]); } return arc.apply(this, arguments); };"
                              # The dots of a pattern are drawn below the letters.
                              "const before = drawMark; drawMark = (...all) => { const kept = points.length, done = before(...all); points.length = kept; return done; };"
                              f"page.viewer.setZoom({zoom}); drawMark = before; c.fillText = fillText; c.arc = arc; return {{texts, points}}; }})()")
                self.assertGreater(len(at["points"]), 4, zoom)
                seen += len(at["texts"])
                near = [(t, p) for t in at["texts"] for p in at["points"] if abs(t[0] - p[0]) < 7 and abs(t[1] - p[1]) < 8]
                self.assertEqual(near, [], (case, zoom))
            self.assertGreaterEqual(seen, len(zooms), case)

    def test_a_pixel_opens_at_the_sample_that_fails(self):
        page = self.open("#case=told%2Ffour")
        pixel = page.run("(() => { const f = page.findings[0]; return [f.x, f.y, f.sample]; })()")
        self.assertGreater(pixel[2], 0, "the fault is to be in another sample than the first")
        page = self.open(f"#case=told%2Ffour&px={pixel[0]},{pixel[1]}")
        self.assertIn(f"Pixel ({pixel[0]}, {pixel[1]}) sample {pixel[2]}", page.text("#sample-summary"))
        page = self.open(f"#case=told%2Ffour&px={pixel[0]},{pixel[1]},0")
        self.assertIn("sample 0", page.text("#sample-summary"))
        # Also where another pixel leads, and the first where none of the samples fails.
        page.run("(() => { const r = entryOf.get('told/four').record; r.lead = null; })()")
        page.run(f"location.hash = '#case=told%2Ffour&px={pixel[0]},{pixel[1]}'")
        page.wait_for(f"document.querySelector('#sample-summary').innerText.includes('sample {pixel[2]}')")
        page.run("location.hash = '#case=told%2Ffour&px=0,0'")
        page.wait_for("document.querySelector('#sample-summary').innerText.includes('Pixel (0, 0) sample 0')")


if __name__ == "__main__":
    unittest.main()
