# SPDX-FileCopyrightText: The Edgecase authors
# SPDX-License-Identifier: Apache-2.0
"""The picture that a case's page begins with, marks in both themes, and the units of the list."""
import json
import unittest

from page_support import SQUARE, PageTest


class Shown(PageTest):
    """The picture that a case's page begins with, and how it is drawn."""
    DEPTHS = SQUARE.replace("[[1,1], [7,1], [1,7],  [7,1], [7,7], [1,7]]", "[[1,1,0.25], [7,1,0.5], [1,7,0.25],  [7,1,0.5], [7,7,0.5], [1,7,0.25]]")
    cases = {"a/depth": DEPTHS.format(more="", target="\ndepth = \"d32-float\"", draw=""),
             "a/hits": DEPTHS.format(more="", target="\ndepth = \"d32-float\"", draw=""),
             "a/color": SQUARE.format(more="", target="\ncolor = { format = \"rgba8-unorm\" }", draw="color = { value = [1, 0.5, 0, 1] }")}
    fault = "flip-pixel"

    @classmethod
    def make_run(cls):
        """Findings about values, as a device has them that draws the right samples."""
        super().make_run()
        file = cls.out / "journal.jsonl"
        records = [json.loads(line) for line in file.read_text(encoding="utf-8").splitlines()]
        for record in records:
            if record["record"] == "end" and record["id"] in ("a/depth", "a/color"):
                for finding in record["findings"]:
                    finding |= {"kind": "value", "quantity": record["id"][2:]}
                if record["id"] == "a/depth":
                    record["pictures"]["expected_depths"] = record["pictures"]["device_depths"]
                record["groups"] = [group | {"kind": "value"} for group in record["groups"]]
        file.write_text("".join(json.dumps(record) + "\n" for record in records), encoding="utf-8")
        cls.edgecase("report", cls.out)

    def test_what_the_leading_finding_is_about_is_shown_first(self):
        for case, plane in (("depth", "depth"), ("hits", "hits"), ("color", "colour")):
            page = self.open(f"#case=a%2F{case}&view=side")
            self.assertEqual(page.run("document.querySelector('.toolbar select').value"), plane)
        # What a reader chooses stays, from case to case; a case that has no such plane shows its own.
        page = self.open("#case=a%2Fhits&view=device")
        page.run("(() => { const s = document.querySelector('.toolbar select'); s.value = 'depth'; s.dispatchEvent(new Event('change')); })()")
        for case, plane in (("depth", "depth"), ("color", "colour"), ("hits", "depth")):
            page.run(f"openCase('a/{case}')")
            self.assertEqual(page.run("document.querySelector('.toolbar select').value"), plane)

    def test_titles_say_what_a_picture_shows(self):
        page = self.open("#case=a%2Fdepth&view=side")
        self.assertEqual(page.run("[...document.querySelectorAll('figcaption')].map((e) => e.innerText)"), ["reference, depth", "device, depth", "difference"])

    def test_samples_are_seen_on_marks_in_both_themes(self):
        for dark in (False, True):
            page = self.open("#case=a%2Fhits&view=difference&zoom=64&px=0,0", dark=dark)
            middle = page.run("(() => { const p = page.viewer.scene.pictures, k = p.marks.findIndex((m) => m > 1), zoom = page.viewer.zoomNow();"
                              "page.viewer.setView('difference'); const frame = document.querySelector('.frame'), c = frame.querySelector('canvas');"
                              "const x = (k % p.width + 1.5) * zoom - frame.scrollLeft, y = (Math.floor(k / p.width) + 1.5) * zoom - frame.scrollTop, r = devicePixelRatio;"
                              "return [...c.getContext('2d').getImageData(x * r, y * r, 1, 1).data]; })()")
            self.assertLess(max(middle[:3]), 0x60, (dark, middle))

    def test_the_letter_of_a_mark_keeps_off_the_grid(self):
        page = self.open("#case=a%2Fhits")
        places = page.run("(() => { const c = document.createElement('canvas').getContext('2d'), old = drawLetter, seen = [];"
                          "drawLetter = (context, text, x, y) => { seen.push([x, y]); };"
                          "for (const size of [34, 48, 77, 128]) { drawMark(c, 5, 0, 0, size, size); } drawLetter = old; return seen; })()")
        for (x, y), least in zip(places, (9, 12, 16, 16)):
            self.assertGreaterEqual(min(x, y), least)
        self.assertLess(places[0][0] + 6, 34 / 2 - 1)  # nor does it lie on the sample


class Units(PageTest):
    def test_one_unit_a_column(self):
        for width in (360, 800, 1400):
            page = self.open("#group=status", width=width)
            times = page.run("[...document.querySelectorAll('tr.case-row td:last-child')].map((e) => e.textContent)")
            self.assertEqual(len(times), len(self.cases))
            for time in times:
                self.assertRegex(time, r"^\d+\.\d\d$")
        self.assertEqual(page.text("#list thead th:last-child"), "time, ms")

    def test_what_happened_has_room(self):
        page = self.open(width=800)
        widths = page.run("[...document.querySelectorAll('#list thead th')].map((e) => e.offsetWidth)")
        self.assertGreater(widths[2], widths[1])
        self.assertGreater(widths[2], 220)


if __name__ == "__main__":
    unittest.main()
