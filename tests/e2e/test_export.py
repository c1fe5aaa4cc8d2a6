# SPDX-FileCopyrightText: The Edgecase authors
# SPDX-License-Identifier: Apache-2.0
"""Cases exported for renderers elsewhere, pictures of them, and the example programs."""
import json
import os
import pathlib
import re
import shutil
import struct
import subprocess
import sys
import unittest
import zlib

import jsonschema
from captures_support import Captures, CASE, INSIDE, png, schema, SIDE, TIES
from support import PROGRAM, SOURCE

EXAMPLES = SOURCE / "docs" / "examples"
RASTER2D = os.environ.get("EDGECASE_RASTER2D", "raster2d")


class Export(Captures):
    def export(self, *words, check=0):
        return self.edgecase("export", *words, "-o", self.folder / "exported", check=check)

    def test_every_family_keeps_to_the_schema(self):
        case, index = (jsonschema.Draft7Validator(schema(name)) for name in ("case-1", "export-1"))
        env = self.environment()
        del env["EDGECASE_SUITE"]
        folder = self.folder / "exported"
        done = self.edgecase("export", "!scale/**", "!limits/**", "-o", folder, env=env)
        if done.returncode == 4:
            done = self.edgecase("export", "-o", folder, env=env)
        self.assertEqual(done.returncode, 0, done.stderr)
        listed = json.loads((folder / "index.json").read_text(encoding="utf-8"))
        index.validate(listed)
        seen = set()
        for entry in listed["cases"]:
            base = entry["id"].split(":")[0]
            needs = frozenset(entry["needs"])
            size = (folder / entry["file"]).stat().st_size
            if (base in seen and needs in seen) or size > 200000:
                continue  # one leaf of each file and of each set of needs
            seen |= {base, needs}
            data = json.loads((folder / entry["file"]).read_text(encoding="utf-8"))
            case.validate(data)
            self.assertEqual((data["id"], data["needs"], data["captures"]["folder"]), (entry["id"], entry["needs"], entry["folder"]))
            for draw in data["draws"]:
                for numbers, bits in zip(draw["positions"], draw["position_bits"]):
                    for number, word in zip(numbers, bits.split()):
                        self.assertIn(struct.pack(">f", float(number)).hex(), (word, word[:2] + "c00000"))
        self.assertGreater(len(seen), 100)
        self.assertEqual(len({e["folder"] for e in listed["cases"]}), len(listed["cases"]))

    def test_the_page_tells_every_need(self):
        page = (SOURCE / "docs/other-renderers.md").read_text(encoding="utf-8")
        table = page.split("| word | the case has |")[1].split("\n\n")[0]
        self.assertEqual(re.findall(r"^\| `([a-z-]+)` \|", table, re.M), schema("case-1")["properties"]["needs"]["items"]["enum"])

    def test_state(self):
        self.write_case(CASE, TIES.replace("[[draw]]", "[[draw]]\ncull = \"front\"\nscissor = [1, 2, 3, 4]"))
        self.export(CASE)
        case = json.loads((self.folder / "exported" / "fam" / "c1.json").read_text(encoding="utf-8"))
        self.assertEqual(case["needs"], ["scissor", "cull"])
        draw = case["draws"][0]
        self.assertEqual(draw["scissor"], {"x": 1, "y": 2, "width": 3, "height": 4})
        self.assertEqual(draw["position_bits"][1], "3f800000 bf800000 3f000000 3f800000")
        self.assertEqual(draw["positions"][1], [1, -1, 0.5, 1])
        self.assertEqual(draw["triangles"], [[0, 1, 2], [3, 4, 5]])
        self.assertEqual(draw["provoking_vertices"], [0, 3])
        self.assertEqual(draw["attributes"][0]["values"][1], [8])
        self.assertEqual(case["target"]["sample_locations"], [[0.5, 0.5]])
        self.assertEqual([p["name"] for p in case["captures"]["planes"]],
                         ["coverage", "hits", "writer", "attribute0", "fragcoord", "depth"])

    def test_folder_that_cannot_be_made(self):
        (self.folder / "exported").write_text("")
        self.assertIn("cannot be made", self.export(CASE, check=2).stderr)


BLIT = """format = 1
description = "One texel to the right, mirrored."
rules = ["blit.nearest", "blit.outside"]
[target]
size = [4, 2]
color = { format = "rgba8-unorm", clear = [0, 0, 0, 1] }
[blit]
size = [4, 4]
from = [0, 0, 2, 1]
to   = [3, 0, 1, 1]
"""


def grey(path):
    """The red of each pixel of an 8-bit PNG, row by row."""
    data, at, packed = path.read_bytes(), 8, b""
    width, height, depth, kind = struct.unpack(">IIBB", data[16:26])
    channels = {0: 1, 2: 3, 6: 4}[kind]
    while at < len(data):
        length, name = struct.unpack(">I4s", data[at:at + 8])
        packed += data[at + 8:at + 8 + length] if name == b"IDAT" else b""
        at += length + 12
    raw, size, rows = zlib.decompress(packed), channels * depth // 8, []
    stride = width * size
    before = bytes(stride)
    for y in range(height):
        how, line = raw[y * (stride + 1)], bytearray(raw[y * (stride + 1) + 1:(y + 1) * (stride + 1)])
        for k in range(stride):
            left, up, corner = line[k - size] if k >= size else 0, before[k], before[k - size] if k >= size else 0
            paeth = min((left, up, corner), key=lambda n: abs(left + up - corner - n))
            line[k] = (line[k] + (0, left, up, (left + up) // 2, paeth)[how]) % 256
        rows.append(list(line[::size]))
        before = bytes(line)
    return rows


class Render(Captures):
    def json(self, *words):
        """The picture as JSON, which keeps to its schema."""
        self.edgecase("render", *words, "-o", self.folder / "x.json", check=0)
        picture = json.loads((self.folder / "x.json").read_text(encoding="utf-8"))
        jsonschema.Draft7Validator(schema(picture["schema"].removeprefix("edgecase-"))).validate(picture)
        return picture

    def test_the_reference_tells_values_and_queries(self):
        self.write_case("fam/asked", """format = 1
description = "a"
rules = ["query.occlusion"]
target = { size = [4, 4] }
[[draw]]
query = "occlusion-precise"
vertices = [[0, 0, 0.25], [4, 0, 0.5], [0, 4, 0.75]]
[[draw]]
vertices = [[0, 0], [3, 0], [0, 3]]
""")
        picture = self.json("fam/asked")
        # Of the diagonal's own samples none belongs to the triangle.
        self.assertEqual(picture["queries"], [{"draw": 0, "query": "occlusion-precise", "counted": [6, 6]}])
        self.assertEqual(picture["triangles"][1], {"draw": 1, "primitive": 0, "provoking_vertex": 0})
        writer = next(s for s in picture["samples"] if (s["x"], s["y"]) == (2, 0))["writers"][0]
        self.assertEqual((writer["triangle"], writer["values"]["frag_coord.x"]), (0, [2.5]))
        nearest, low, high = writer["values"]["depth"]  # 1/4 + 5/8 of 1/4 + 1/8 of 1/2
        self.assertEqual(nearest, 0.46875)
        self.assertTrue(low < nearest < high < low + 1e-5)
        self.assertNotIn("exact", writer)
        self.write_case("fam/counted", """format = 1
description = "a"
rules = ["query.statistics"]
target = { size = [4, 4] }
[[draw]]
query = "input-vertices"
topology = "triangle-strip"
vertices = [[0, 0], [4, 0], [0, 4], [4, 4]]
[[draw]]
query = "fragment-invocations"
vertices = [[0, 0], [4, 0], [0, 4]]
""")
        # Six samples lie below the diagonal; four quads of 2 x 2 pixels lie around them.
        self.assertEqual(self.json("fam/counted", "--profile", "direct3d")["queries"],
                         [{"draw": 0, "query": "input-vertices", "counted": [4, 4]},
                          {"draw": 1, "query": "fragment-invocations", "counted": [6, 16]}])
        self.assertEqual(self.json("fam/counted", "--profile", "vulkan")["queries"],
                         [{"draw": 0, "query": "input-vertices", "counted": [4, None]},
                          {"draw": 1, "query": "fragment-invocations", "counted": [6, None]}])
        self.write_case("fam/thirds", """format = 1
description = "a"
rules = ["cover.inside"]
target = { size = [4, 4] }
[[draw]]
vertices = [[0, 0, 0], [3, 0, 1], [0, 3, 0]]
""")
        writer = self.json("fam/thirds")["samples"][0]["writers"][0]
        self.assertEqual(writer["exact"], {"frag_coord.z": "1/6", "depth": "1/6"})
        self.assertEqual(writer["values"]["depth"][0], 1 / 6)

    def test_the_depth_that_is_told_is_the_one_that_is_stored(self):
        """Draw 1 stores 1/4 early and is discarded; draw 3 writes no depth; draw 4 is discarded where nothing was."""
        self.write_case("fam/early", """format = 1
description = "a"
rules = ["discard.early-tests"]
target = { size = [4, 1], depth_clear = 0 }
[[draw]]
vertices = [[0, 0, "1/2"], [24, 0, "1/2"], [0, 8, "1/2"]]
scissor = [0, 0, 3, 1]
[[draw]]
vertices = [[0, 0, "1/4"], [24, 0, "1/4"], [0, 8, "1/4"]]
scissor = [0, 0, 1, 1]
discard = "back"
early_tests = true
[[draw]]
vertices = [[0, 0, "3/4"], [24, 0, "3/4"], [0, 8, "3/4"]]
scissor = [1, 0, 1, 1]
depth = { write = false }
[[draw]]
vertices = [[0, 0, "1/8"], [24, 0, "1/8"], [0, 8, "1/8"]]
scissor = [3, 0, 1, 1]
discard = "back"
early_tests = true
""")
        samples = {s["x"]: s for s in self.json("fam/early")["samples"]}
        depths = {x: [(d["triangle"], d["values"]["depth"][0]) for d in s.get("depths", [])] for x, s in samples.items()}
        self.assertEqual(depths, {0: [(1, 0.25)], 1: [(0, 0.5)], 2: [], 3: [(3, 0.125)]})
        self.assertEqual({x: s["class"] for x, s in samples.items()}, {0: "must", 1: "must", 2: "must", 3: "must_not"})
        for x, writer in ((0, 0), (1, 2)):
            self.assertEqual(samples[x]["writers"][0]["triangle"], writer)
            self.assertNotIn("depth", samples[x]["writers"][0]["values"])
        self.assertEqual(samples[2]["writers"][0]["values"]["depth"][0], 0.5)
        told = self.edgecase("explain", "fam/early", "--pixel", "0,0", check=0).stdout
        self.assertRegex(told, r"(?m)^ +depth +is not the one that is stored$")
        self.assertIn("the depth then is that of triangle 0 of draw 1, 0.25, accepted", told)
        self.assertNotIn("the depth then", self.edgecase("explain", "fam/early", "--pixel", "2,0", check=0).stdout)

    def test_threads_keep_the_order_of_samples(self):
        """More samples than one thread takes at a time; depth tells where each was made."""
        self.write_case("fam/wide", """format = 1
description = "a"
rules = ["cover.inside"]
target = { size = [256, 64] }
[[draw]]
topology = "triangle-strip"
vertices = [[-256, 0, 0], [256, 0, 1], [-256, 128, 0], [256, 128, 1]]
""")
        picture = self.json("fam/wide")
        self.assertEqual([(s["y"], s["x"]) for s in picture["samples"]],
                         [(y, x) for y in range(64) for x in range(256)])
        self.assertEqual([s["writers"][0]["values"]["depth"][0] for s in picture["samples"]],
                         [(x + 256.5) / 512 for _ in range(64) for x in range(256)])

    def test_schemas_know_every_member(self):
        """Of rich cases of the real suite; a schema without a member that is written would be none."""
        self.write_case("fam/blit", BLIT)
        suite = ("--suite", SOURCE / "cases/suite")
        for words, name in ((("clip/noperspective:swap=0,lean=0", *suite), "reference-2"),
                            ((CASE, "--renderer", "tiles"), "drawing-1"), (("fam/blit",), "blit-1")):
            told = schema(name)

            def check(value, rule, where):
                if isinstance(value, dict) and "properties" in rule:
                    self.assertLessEqual(set(value), set(rule["properties"]), where)
                    for key, part in value.items():
                        check(part, rule["properties"][key], f"{where}.{key}")
                if isinstance(value, list):
                    for part in value:
                        check(part, rule.get("items", {}), where)

            picture = self.json(*words)
            self.assertEqual(picture["schema"], f"edgecase-{name}")
            check(picture, told, name)
            for key in told["required"]:
                self.assertFalse(jsonschema.Draft7Validator(told).is_valid({k: v for k, v in picture.items() if k != key}), key)

    def size(self, *words):
        self.edgecase("render", *words, "-o", "x.png", check=0)
        return struct.unpack(">II", (self.folder / "x.png").read_bytes()[16:24])

    def test_pictures_are_large_enough_to_see_a_pixel(self):
        self.assertEqual(self.size(CASE), (512, 512))
        self.assertEqual(self.size(CASE, "--scale", "3"), (24, 24))
        self.assertEqual(self.size(CASE, "--renderer", "tiles", "--scale", "2"), (16, 16))
        self.assertEqual(self.edgecase("render", CASE, "-o", "x.exr", "--scale", "2", check=2).stderr,
                         "edgecase: --scale is for pictures to look at (*.png); values keep the target's size, so leave it out\n")
        self.edgecase("render", CASE, "-o", "x.exr", check=0)
        # 4 samples: each a quarter of its pixel, sample 0 top left. The edge x = 1/2 leaves samples 0 and 2 out.
        self.write_case("fam/four", TIES.split("[target]")[0] + "[target]\nsize = [2, 1]\nsamples = 4\n[[draw]]\n"
                        "vertices = [[0.5,-4], [9,-4], [0.5,9]]\n")
        self.edgecase("render", "fam/four", "-o", "x.png", "--scale", "4", check=0)
        self.assertEqual(grey(self.folder / "x.png"), [[0, 0, 255, 255, 255, 255, 255, 255]] * 4)
        self.edgecase("render", "fam/four", "-o", "x.png", "--scale", "1", check=0)
        self.assertEqual([len(row) for row in grey(self.folder / "x.png")], [2])
        self.assertNotIn(grey(self.folder / "x.png")[0][0], (0, 255))

    def test_a_blit(self):
        self.write_case("fam/blit", BLIT)
        picture = self.json("fam/blit")
        self.assertEqual([(t["x"], t["y"]) for t in picture["texels"]], [(1, 0), (2, 0)])
        self.assertEqual(picture["clear_codes"], [0, 0, 0, 255])
        self.edgecase("export", "fam/blit", "-o", self.folder / "exported", check=0)
        case = json.loads((self.folder / "exported" / "fam" / "blit.json").read_text(encoding="utf-8"))
        jsonschema.Draft7Validator(schema("case-1")).validate(case)
        source = case["blit"]["source"]["codes"]
        # Destination texel 1 is the mirrored second texel of the source.
        self.assertEqual([t["codes"] for t in picture["texels"]], [source[1], source[0]])
        for name in ("x.png", "x.exr"):
            self.edgecase("render", "fam/blit", "-o", name, check=0)
            self.assertGreater((self.folder / name).stat().st_size, 60)
        # The same texels, delivered as a picture, pass; without the blit they do not.
        texels = {(t["x"], t["y"]): t["codes"] for t in picture["texels"]}
        right = [n for y in range(2) for x in range(4) for n in texels.get((x, y), [0, 0, 0, 255])]
        self.deliver("color.png", png(4, 2, right, 4), "fam/blit")
        self.judge(check=0, case="fam/blit")
        self.deliver("color.png", png(4, 2, [0, 0, 0, 255] * 8, 4), "fam/blit")
        self.judge(check=1, case="fam/blit")

    def test_by_an_algorithm(self):
        for name in ("tiles", "brown", "reference"):
            picture = self.json(CASE, "--renderer", name)
            self.assertEqual(picture["renderer"], name)
            self.assertEqual(sorted((s["y"], s["x"]) for s in picture["samples"]),
                             [divmod(i, SIDE) for i, v in enumerate(INSIDE) if v])
            self.assertEqual({s["front"] + s["back"] for s in picture["samples"]}, {1})
            depths = {s["values"]["depth"]["bits"] for s in picture["samples"]}
            self.assertLessEqual(depths, {"3f000000"} if name == "reference" else {"3f000000", "3effffff"})
        for name in ("x.png", "x.exr"):
            self.edgecase("render", CASE, "--renderer", "tiles", "-o", name, check=0)

    def test_layers_are_stacked(self):
        text = (self.suite / "fam/c1.toml").read_text()
        self.write_case(CASE, text.replace("size = [8, 8]", "size = [8, 8]\nlayers = 2").replace("[[draw]]", "[[draw]]\nlayer = 1"))
        for words in ((), ("--renderer", "reference")):
            picture = self.json(CASE, *words)
            self.assertEqual((picture["height"], picture["layers"]), (8, 2))
            self.assertEqual({s["layer"] for s in picture["samples"]}, {1})
            self.assertEqual(sorted((s["y"], s["x"]) for s in picture["samples"]),
                             [divmod(i, SIDE) for i, v in enumerate(INSIDE) if v])
            self.edgecase("render", CASE, *words, "-o", "x.png", check=0)
            self.assertEqual(struct.unpack(">II", (self.folder / "x.png").read_bytes()[16:24]), (256, 512))
        told = self.edgecase("explain", CASE, "--pixel", "0,0", "--layer", "1", check=0).stdout
        self.assertIn("    [.]. . . . . .\n     . # # # # # #", told)

    def test_what_cannot_be_drawn(self):
        self.write_case("fam/blit", BLIT)
        done = self.edgecase("render", "fam/blit", "--renderer", "tiles", "-o", "x.png", check=2)
        self.assertEqual(done.stderr, "edgecase: 'tiles' draws triangles, and the case is a blit; leave --renderer out\n")
        self.write_case("fam/clipped", TIES.replace("[[draw]]", '[[draw]]\ncull_distance = [{ values = [1, 1, 1, 1, 1, 1] }]'))
        done = self.edgecase("render", "fam/clipped", "--renderer", "tiles", "-o", "x.png", check=2)
        self.assertEqual(done.stderr, "edgecase: 'tiles' cannot draw the case: the algorithms have no depth state, clip distances, "
                         "sample masks, layers, provoking vertices and rasterizer discard\n")
        self.assertIn("did you mean 'tiles'?",
                      self.edgecase("render", CASE, "--renderer", "tile", "-o", "x.png", check=2).stderr)


class Examples(Captures):
    """The programs of docs/examples on families of the real suite."""
    SELECTORS = ["ties/**", "coverage/**"]

    def draw(self, program, *options, selectors=None):
        env = self.environment()
        del env["EDGECASE_SUITE"]
        selectors = selectors or self.SELECTORS
        cases = self.folder / "exported"
        self.edgecase("export", *selectors, "-o", cases, env=env, check=0)
        subprocess.run([*program, cases, self.captures, *options], check=True, timeout=240)
        return self.edgecase("diff", *selectors, "--captures", self.captures, "-o", self.out, env=env)

    def check(self, program):
        done = self.draw(program)
        self.assertEqual(done.returncode, 0, done.stdout[-3000:] + done.stderr)
        statuses = list(self.statuses().values())
        self.assertEqual(set(statuses) - {"unsupported"}, {"pass"})
        self.assertGreater(statuses.count("pass"), 20)
        shutil.rmtree(self.captures)
        done = self.draw(program, "--reverse-ties", selectors=["ties/**"])
        self.assertEqual(done.returncode, 1)
        rules = {f["rule"] for c in self.results()["cases"] for f in c["findings"]}
        self.assertIn("tie.top-left", rules)
        self.assertEqual({f["level"] for c in self.results()["cases"]
                          for f in c["findings"] if f["rule"] == "tie.top-left"}, {"direct3d"})

    def test_python(self):
        self.check([sys.executable, EXAMPLES / "rasterize.py"])

    def test_commands_of_the_page(self):
        """docs/other-renderers.md, as it stands; but the C++ program comes from this build."""
        steps, examples = (SOURCE / "docs" / "other-renderers.md").read_text(encoding="utf-8").split("## Complete examples")
        env = self.environment()
        del env["EDGECASE_SUITE"]
        env["PATH"] = str(pathlib.Path(PROGRAM).resolve().parent) + ":" + env.get("PATH", "")
        (self.folder / "docs").symlink_to(SOURCE / "docs")
        shutil.copy(RASTER2D, self.folder / "raster2d")
        blocks = [re.findall(r"```sh\n(.*?)```", text, re.S) for text in (examples, steps)]
        self.assertEqual([len(b) for b in blocks], [3, 3])
        said = ""
        for block in blocks[0] + blocks[1]:
            script = "".join(line + "\n" for line in block.splitlines() if not line.startswith("c++ "))
            # A renderer of one's own, which is wrong.
            script = script.replace("my-renderer %in %out", "./raster2d %in %out --reverse-ties")
            done = subprocess.run(["sh", "-e", "-c", script], cwd=self.folder, env=env, capture_output=True, text=True,
                                  timeout=240, check=False)
            self.assertEqual(done.returncode, 1 if "--reverse-ties" in block else 0, script + done.stdout[-2000:] + done.stderr)
            said += done.stdout
        for line in re.search(r"```text\n(.*?)```", examples, re.S).group(1).splitlines():
            self.assertIn(line, said)

    def test_cpp(self):
        self.check([RASTER2D])
        self.assertLess(len((EXAMPLES / "raster2d.cpp").read_text().splitlines()), 150)


if __name__ == "__main__":
    unittest.main()
