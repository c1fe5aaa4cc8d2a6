# SPDX-FileCopyrightText: The Edgecase authors
# SPDX-License-Identifier: Apache-2.0
"""Pages of targets with several layers, whose pictures are stacked."""
import re
import unittest

from page_support import PageTest

# The triangle of layer 0 reaches far below its layer, over where the others lie in the picture.
STACK = """format = 1
description = "A triangle and a square in different layers."
rules = ["cover.inside", "layer.select"]
[target]
size = [8, 8]
layers = 3
[[draw]]
layer = 0
vertices = [[0,0], [40,0], [0,40]]
[[draw]]
layer = 1
vertices = [[1,1], [7,1], [1,7],  [7,1], [7,7], [1,7]]
"""


class Layers(PageTest):
    cases = {"layers/stack": STACK}
    fault = "flip-pixel"

    def rows(self, page, selector):
        return page.run(f"[...document.querySelectorAll('{selector}')].map((r) => r.textContent)")

    def test_names_and_places_are_those_of_the_layer(self):
        page = self.open("#case=layers%2Fstack&px=2,13")
        self.assertEqual(page.text("#sample-summary"), "Pixel (2, 5) of layer 1 at (2.5, 5.5)")
        self.assertIn(" of layer 1", self.rows(page, ".findings tbody tr")[0])
        for row in self.rows(page, "details.section tbody tr"):
            self.assertRegex(row, r"draw [01], layer [01]")

    def test_triangles_of_other_layers_are_not_told(self):
        page = self.open("#case=layers%2Fstack&px=2,13")
        told = self.rows(page, ".triangle summary")
        self.assertTrue(told)
        self.assertEqual([t for t in told if "of draw 1" not in t], [])
        self.assertIn("exactly on a left edge", page.text(".triangles"))
        for _ in range(8):
            page.key("ArrowUp")
        self.assertEqual(page.text("#sample-summary"), "Pixel (2, 5) of layer 0 at (2.5, 5.5)")
        self.assertEqual([t for t in self.rows(page, ".triangle summary") if "of draw 0" not in t], [])

    def test_edges_are_those_that_explain_tells(self):
        page = self.open("#case=layers%2Fstack&px=3,10")
        told = self.edgecase("explain", "layers/stack", "--pixel", "3,2", "--layer", "1").split("of draw 1")
        told = "".join(part.split("of draw 0")[0] for part in told)
        proved = {f"v{a}\u2192v{b}": value for a, b, value in re.findall(r"E\((\d+),(\d+)\) from .*?: (-?[\d./]+)", told)}
        shown = page.run("[...document.querySelectorAll('table.edges tbody tr')].map((r) => [...r.cells].map((c) => c.textContent))")
        self.assertGreaterEqual(len(shown), 3)
        for edge, _, value, _ in shown:
            self.assertEqual(self.number(value), self.number(proved[edge]))

    @staticmethod
    def number(text):
        top, _, bottom = text.replace("\u2212", "-").partition("/")
        return float(top) / float(bottom or 1)

    def test_ties_are_those_of_the_layer(self):
        page = self.open("#case=layers%2Fstack")
        ties = page.run("[...page.viewer.scene.ties].map((k) => k % 8 + ',' + Math.floor(k / 8)).sort()")
        self.assertEqual(ties, sorted(f"{x},{8 + y}" for x, y in ((1, 6), (2, 5), (3, 4), (4, 3), (5, 2), (6, 1))))

    def test_outlines_end_with_their_layer(self):
        # x = 0 is an edge of draw 0: in layer 0 a line is there, in layers 1 and 2 none.
        page = self.open("#case=layers%2Fstack&view=reference&zoom=16&px=0,0")
        page.run("['samples', 'grid'].forEach(toggle)")
        with_outlines = [self.pixel(page, y) for y in (4, 12, 20)]
        page.key("o")
        without = [self.pixel(page, y) for y in (4, 12, 20)]
        self.assertEqual([a != b for a, b in zip(with_outlines, without)], [True, False, False])

    def pixel(self, page, y):
        """The picture's colours across x = 0, in the middle of a row of the stack."""
        return page.run("(() => { const zoom = page.viewer.zoomNow(), f = document.querySelector('.frame'), c = f.querySelector('canvas'); "
                        f"f.scrollTop = 0; page.viewer.draw(); return [...c.getContext('2d').getImageData(zoom - 3, ({y} + 1.5) * zoom, 7, 1).data].join(); }})()")

    def test_a_narrow_window_shows_all(self):
        for width in (480, 360):
            for place in ("#case=layers%2Fstack", ""):
                page = self.open(place, width=width, height=1400)
                self.assertEqual(page.run("document.documentElement.scrollWidth"), width)


if __name__ == "__main__":
    unittest.main()
