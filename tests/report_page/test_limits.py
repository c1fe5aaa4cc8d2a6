# SPDX-FileCopyrightText: The Edgecase authors
# SPDX-License-Identifier: Apache-2.0
"""Scissor, viewport, clip planes and snapping boxes: drawn over the pixels, turned on and off, told in exact numbers."""
import re
import unittest

from page_support import PageTest

HEAD = """format = 1
description = "{what}."
catches = "what lies outside is drawn"
rules = ["cover.inside"]
[target]
size = [16, 16]{target}
[[draw]]
vertices = [[0,0], [16,0], [0,16]]
"""
# z = (x - 4) / 8 is 0 at x = 4 and 1 at x = 12; the clip distance is 0 at y = 5/2.
CASES = {
    "limits/scissor": HEAD.format(what="A scissor", target="") + "scissor = [2, 3, 7, 60000]\n",
    "limits/viewport": HEAD.format(what="A viewport", target="") + "viewport = [1.5, -2, 8, 12]\n",
    "limits/near": HEAD.format(what="Near and far", target="").replace("[[0,0], [16,0], [0,16]]", "[[0,0,-0.5], [16,0,1.5], [0,16,-0.5]]"),
    "limits/distance": HEAD.format(what="A distance", target="") + '[[draw.clip_distance]]\nplane = "y-5/2"\n',
    "limits/boxes": HEAD.format(what="Vertices off the grid", target="").replace("[0,0]", "[1.001953125,2]").replace("[16,0]", "[15,2.001953125]"),
    "limits/layers": HEAD.format(what="A scissor in one layer", target="\nlayers = 2") + "layer = 1\nscissor = [0, 0, 3, 16]\n",
    "limits/all": HEAD.format(what="Nothing in the way", target=""),
}


class Limits(PageTest):
    cases = CASES
    fault = "flip-pixel"

    def case(self, name, at="", **window):
        return self.open(f"#case=limits%2F{name}{at}&zoom=20", **window)

    def drawing(self, page):
        return page.run("page.viewer.draw() || document.querySelector('.frame canvas').toDataURL()")

    def test_each_is_told_with_numbers(self):
        for name, kind, told in (("scissor", "scissor", "x 2 to 9, y 3 to 60003"), ("viewport", "viewport", "x 3/2 to 19/2, y \u22122 to 10"),
                                 ("near", "planes", "plane z = 0; plane z = w"), ("distance", "planes", "clip distance 0"),
                                 ("boxes", "boxes", "vertices that may be snapped to several positions"), ("layers", "scissor", "x 0 to 3, y 0 to 16")):
            page = self.case(name)
            entries = page.run("[...document.querySelectorAll('.legend .limit')].map((e) => [e.querySelector('button').dataset.option, e.querySelector('.number').innerText])")
            self.assertIn([kind, told], entries, name)

    def test_what_decides_nothing_is_not_shown(self):
        page = self.case("all")
        self.assertEqual(page.count(".legend .limit"), 0)
        self.assertEqual(page.count(".limits li"), 0)

    def test_keys_and_the_legend_turn_them_on_and_off(self):
        for name, kind, key in (("scissor", "scissor", "c"), ("viewport", "viewport", "v"), ("near", "planes", "l"), ("boxes", "boxes", "x")):
            page = self.case(name)
            button = f".legend button[data-option={kind}]"
            shown = self.drawing(page)
            page.key(key)
            self.assertEqual(page.run(f"document.querySelector('{button}').getAttribute('aria-pressed')"), "false", name)
            hidden = self.drawing(page)
            self.assertNotEqual(hidden, shown, name)
            page.click_seen(button)
            self.assertEqual(self.drawing(page), shown, name)

    def strokes(self, page, kind):
        """Every line end and rectangle that is stroked in the colour of a kind."""
        return page.run("(() => { const c = CanvasRenderingContext2D.prototype, kept = [], made = [], old = {};"
                        "for (const name of ['beginPath', 'moveTo', 'lineTo', 'rect', 'stroke']) { old[name] = c[name]; }"
                        "c.beginPath = function () { made.length = 0; return old.beginPath.apply(this, arguments); };"
                        "for (const name of ['moveTo', 'lineTo', 'rect']) { c[name] = function (...at) { made.push(at); return old[name].apply(this, at); }; }"
                        f"c.stroke = function () {{ if (this.strokeStyle === LIMIT_COLOR[theme()]['{kind}']) {{ kept.push(...made); }} return old.stroke.apply(this, arguments); }};"
                        "page.viewer.draw(); Object.assign(c, old); return kept; })()")

    def test_lines_stand_where_the_limits_are(self):
        place = lambda x: 20 + 20 * x  # zoom and margin of a pixel
        self.assertEqual(self.strokes(self.case("scissor"), "scissor"), [[place(2), place(3), 140, 1200000]])
        self.assertEqual(self.strokes(self.case("viewport"), "viewport"), [[place(1.5), place(-2), 160, 240]])
        ends = self.strokes(self.case("near"), "planes")
        self.assertEqual(sorted(round(x) for x, _ in ends), [place(4)] * 2 + [place(12)] * 2)
        self.assertEqual(sorted(round(y) for _, y in ends), sorted([place(0), place(12), place(0), place(4)]))
        ends = self.strokes(self.case("distance"), "planes")
        self.assertEqual(sorted(ends), [[place(0), place(2.5)], [place(13.5), place(2.5)]])
        middles = [[x + w / 2, y + h / 2] for x, y, w, h in self.strokes(self.case("boxes"), "boxes")]
        self.assertEqual(middles, [[place(1 + .5 / 256), place(2)], [place(15), place(2 + .5 / 256)]])
        # The lower layer alone.
        self.assertEqual(self.strokes(self.case("layers"), "scissor"), [[place(0), place(16), 60, 320]])

    def test_what_clips_a_sample_away_is_named_as_explain_names_it(self):
        for name, x, y, told, why in (("near", 2, 5, "plane z = 0: distance over w is \u22123/16, clipped away", "the plane z = 0 of the view volume"),
                                      ("near", 12, 1, "plane z = w: distance over w is \u22121/16, clipped away", "the plane z = w of the view volume"),
                                      ("distance", 3, 1, "clip distance 0: distance over w is \u22121, clipped away", "clip distance 0 is negative"),
                                      ("near", 6, 5, "plane z = 0: distance over w is 5/16, kept", None),
                                      ("distance", 3, 2, "clip distance 0: distance over w is 0, on it", None)):
            page = self.case(name, f"&px={x},{y}")
            self.assertIn(told, page.run("[...document.querySelectorAll('.limits li')].map((e) => e.innerText)"))
            summary = page.text(".triangle summary")
            explained = self.edgecase("explain", f"limits/{name}", "--pixel", f"{x},{y}")
            self.assertEqual("clips it away" in summary, why is not None, summary)
            if why is not None:
                self.assertIn(why, explained)
                self.assertIn(re.match(r"(plane z = .|clip distance 0)", told)[0] + " clips it away", summary)

    def test_rectangles_are_told_of_a_sample(self):
        self.assertIn("but the scissor rectangle, x 2 to 9, y 3 to 60003, leaves this pixel out", self.case("scissor", "&px=1,4").text(".triangle summary"))
        self.assertNotIn("scissor", self.case("scissor", "&px=2,4").text(".triangle summary"))
        self.assertIn("but it lies outside the viewport, x 3/2 to 19/2, y \u22122 to 10", self.case("viewport", "&px=0,4").text(".triangle summary"))
        # On the border (x = 3/2) nothing is said: rules decide.
        self.assertNotIn("viewport", self.case("viewport", "&px=1,4").text(".triangle summary"))

    def test_boxes_are_told_as_fractions(self):
        page = self.case("boxes", "&px=3,4")
        told = page.run("[...document.querySelectorAll('.limits li')].map((e) => e.innerText)")
        self.assertEqual(told, ["v0 may be snapped to x 1 to 257/256, y 2", "v1 may be snapped to x 15, y 2 to 513/256"])
        self.assertIn("x 1 to 257/256, y 2", page.run("document.querySelector('details.section table').textContent"))


if __name__ == "__main__":
    unittest.main()
