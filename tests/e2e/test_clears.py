# SPDX-FileCopyrightText: The Edgecase authors
# SPDX-License-Identifier: Apache-2.0
"""Clears among the draws and load operations on lavapipe: what the commands say of them."""
import json
import unittest

from support import ProgramTest

HEAD = """format = 1
description = "A clear between two draws."
rules = ["clear.attachments"]
[target]
size = [8, 8]
depth_clear = 1
depth_load = "load"
attachments = "color+depth"
[target.color]
format = "rgba8-unorm"
"""
DRAW = """[[draw]]
vertices = [[0,0,"{z}"], [16,0,"{z}"], [0,16,"{z}"]]
depth = {{ compare = "less" }}
color = {{ value = [{red}, 0, 0, 1] }}
"""
CLEAR = """[[draw]]
clear = { rects = [[2,1,3,4]], depth = 0.75, color = [0, 1, 0, 1] }
"""
CASE = HEAD + DRAW.format(z="1/4", red=1) + CLEAR + DRAW.format(z="1/2", red=0)


class Clears(ProgramTest):
    def setUp(self):
        super().setUp()
        (self.folder / "own/a").mkdir(parents=True)
        (self.folder / "own/a/clear.toml").write_text(CASE)

    def run_case(self, *words, check=0):
        done = self.edgecase("run", "--suite", "own", "--device", "llvmpipe", "-o", "out", *words, check=check)
        return done, json.loads((self.folder / "out/results.json").read_text())

    def test_it_is_right(self):
        _, results = self.run_case("--ways", "all", "--doors", "state-static")
        self.assertEqual([(c["id"], c["status"]) for c in results["cases"]], [("a/clear", "pass")])  # no way takes it
        self.assertEqual([d["pictures"] for d in results["doors"] if d["door"] == "state-static"], [1])
        # A door that begins its own renderings does not take the load operations of a case.
        done = self.edgecase("run", "--suite", "own", "--device", "llvmpipe", "--doors", "pass-split", check=4)
        self.assertIn("no selected case can go through the door 'pass-split'", done.stderr)

    def test_explain_tells_of_clears(self):
        inside = self.edgecase("explain", "--suite", "own", "a/clear", "--pixel", "2,1", check=0).stdout
        self.assertIn("    rectangle 0 of draw 1, a clear: clears the sample\n        the pixel lies in the rectangle of a clear, x 2 to 5, y 1 to 5\n", inside)
        self.assertIn("    rectangle 0 of draw 1 writes r 0, g 1, b 0, a 1; that leaves r 0, g 255, b 0, a 255\n", inside)
        self.assertIn("allowed: 2 hits in all", inside)
        beside = self.edgecase("explain", "--suite", "own", "a/clear", "--pixel", "5,1", check=0).stdout
        self.assertIn("    rectangle 0 of draw 1, a clear: leaves the sample\n        the pixel lies outside the rectangle of a clear, x 2 to 5, y 1 to 5\n", beside)
        self.assertIn("allowed: 1 hit in all", beside)

    def test_others_refuse_it(self):
        done = self.edgecase("export", "--reproducer", "a/clear", "--suite", "own", "-o", "p.c", check=2)
        self.assertIn("the case 'a/clear' has a clear among the draws, which a reproducer cannot draw", done.stderr)
        self.edgecase("export", "a/clear", "--suite", "own", "-o", "elsewhere", check=0)
        case = json.loads((self.folder / "elsewhere/a/clear.json").read_text())
        self.assertIn("clear", case["needs"])
        self.assertEqual(case["draws"][1]["clear"]["rects"], [{"x": 2, "y": 1, "width": 3, "height": 4}])


if __name__ == "__main__":
    unittest.main()
