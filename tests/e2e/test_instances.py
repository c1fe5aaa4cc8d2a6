# SPDX-FileCopyrightText: The Edgecase authors
# SPDX-License-Identifier: Apache-2.0
"""Draws of several instances on lavapipe: what the commands say of them."""
import json
import unittest

from support import ProgramTest

CASE = """format = 1
description = "Three instances, each with a colour."
rules = ["instance.input"]
[target]
size = [16, 8]
[[draw]]
topology = "triangle-strip"
vertices = [[0,0], [0,4], [4,0], [4,4]]
instances = 3
first_instance = 2
offsets = [[0,0,0,0], [0.5,0.25,0,0], [1,0.5,0,0]]
[[draw.attribute]]
interpolation = "flat"
divisor = 2
values = [[1, 2], [3, 4]]
"""
# Doors that feed vertices once for all, and those that go with instances as they are.
WITHOUT = ["interleaved", "instance-rate", "divisor", "divisor-zero", "vertices-pulled", "transform-feedback", "mesh-shader"]
WITH = ["index-16", "first-index", "vertex-offset", "separate-buffers", "stride-padded", "indirect", "multi-indirect", "multi-draw",
        "secondary", "pipeline-library", "geometry"]


class Instances(ProgramTest):
    def setUp(self):
        super().setUp()
        (self.folder / "own/a").mkdir(parents=True)
        (self.folder / "own/a/three.toml").write_text(CASE)

    def test_it_is_right_through_doors_and_ways(self):
        self.edgecase("run", "--suite", "own", "--device", "llvmpipe", "-o", "out", "--ways", "all", "--doors", ",".join(WITH), check=0)
        results = json.loads((self.folder / "out/results.json").read_text())
        self.assertEqual({c["status"] for c in results["cases"]}, {"pass"})
        self.assertIn("a/three@bare-color-flat", {c["id"] for c in results["cases"]})
        self.assertEqual({d["door"]: d["pictures"] for d in results["doors"] if d["door"] in WITH}, {door: 1 for door in WITH})

    def test_other_doors_leave_it_out(self):
        for door in WITHOUT:
            done = self.edgecase("run", "--suite", "own", "--device", "llvmpipe", "--doors", door, check=4)
            self.assertIn(f"no selected case can go through the door '{door}', which takes ", done.stderr)

    def test_explain_tells_triangles_of_instances(self):
        text = self.edgecase("explain", "--suite", "own", "a/three", "--pixel", "9,3", check=0).stdout
        self.assertIn("triangle 0 of draw 0, vertices 8 9 10: must be covered", text)

    def test_others_are_told(self):
        done = self.edgecase("export", "--reproducer", "a/three", "--suite", "own", "-o", "p.c", check=2)
        self.assertIn("the case 'a/three' has instances, which a reproducer cannot draw", done.stderr)
        self.edgecase("export", "a/three", "--suite", "own", "-o", "elsewhere", check=0)
        case = json.loads((self.folder / "elsewhere/a/three.json").read_text())
        self.assertIn("instances", case["needs"])
        draw = case["draws"][0]
        self.assertEqual((draw["instances"], len(draw["positions"]), len(draw["triangles"])), (3, 12, 6))
        self.assertEqual([v[0] for v in draw["attributes"][0]["values"]], 8 * [1] + 4 * [3])


if __name__ == "__main__":
    unittest.main()
