# SPDX-FileCopyrightText: The Edgecase authors
# SPDX-License-Identifier: Apache-2.0
"""Cases exported for renderers elsewhere, and what those drew judged: contract, wrong inputs, example programs."""
import array
import json
import math
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
from support import PROGRAM, SOURCE, ProgramTest

EXAMPLES = SOURCE / "docs" / "examples"
RASTER2D = os.environ.get("EDGECASE_RASTER2D", "raster2d")
CASE = "fam/c1"
SIDE = 8  # pixels of the cases of support.py; their square covers 1 .. 7
INSIDE = [x in range(1, 7) and y in range(1, 7) for y in range(SIDE) for x in range(SIDE)]
TIES = """format = 1
description = "Two triangles share a diagonal through pixel centres."
rules = ["cover.shared-edge", "tie.top-left"]
[target]
size = [8, 8]
[[draw]]
vertices = [[0,0], [8,0], [0,8],  [8,0], [8,8], [0,8]]
[[draw.attribute]]
values = [[0], [8], [0], [8], [8], [0]]
"""


def schema(name):
    def refuse(word):
        raise ValueError(f"{word} is not JSON")
    return json.loads((SOURCE / "docs" / "schema" / f"{name}.json").read_text(encoding="utf-8"), parse_constant=refuse)


def png(width, height, rows, channels=1):
    """A PNG file of 8 bits: bytes row by row."""
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    lines = b"".join(b"\0" + bytes(rows[y * width * channels:(y + 1) * width * channels]) for y in range(height))
    colour = {1: 0, 3: 2, 4: 6}[channels]
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, colour, 0, 0, 0)) + \
        chunk(b"IDAT", zlib.compress(lines)) + chunk(b"IEND", b"")


class Captures(ProgramTest):
    def setUp(self):
        super().setUp()
        self.captures = self.folder / "captures"

    def deliver(self, name, data, case=CASE):
        file = self.captures / case / name
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_bytes(data)
        return file

    def judge(self, *words, check=None, case=CASE):
        return self.edgecase("diff", case, "--captures", self.captures, "-o", self.out, *words, check=check)

    def record(self, case=CASE):
        return {c["id"]: c for c in self.results()["cases"]}[case]

    def rejects(self, sentence):
        """The delivered case cannot be judged, for this reason."""
        self.judge(check=7)
        self.assertEqual(self.record()["status"], "error")
        self.assertEqual(self.record()["reason"], sentence)
        shutil.rmtree(self.captures)
        shutil.rmtree(self.out)


class Contract(Captures):
    def test_a_mask_alone(self):
        self.deliver("coverage.u8", bytes(INSIDE))
        done = self.judge(check=0)
        self.assertEqual(self.record()["status"], "pass")
        self.assertEqual(self.record()["reason"], "not judged: number of hits, faces, writer, FragCoord, depth")
        self.assertIn("not judged: FragCoord in 1 case, depth in 1 case, faces in 1 case, number of hits in 1 case, "
                      "writer in 1 case", done.stdout)

    def test_every_form_of_a_mask(self):
        for name, data in (("coverage.u32", array.array("I", INSIDE).tobytes()),
                           ("coverage.f32", array.array("f", INSIDE).tobytes()),
                           ("coverage.u8", bytes(255 * v for v in INSIDE)),
                           ("coverage.png", png(SIDE, SIDE, [255 * v for v in INSIDE])),
                           ("coverage.png", png(SIDE, SIDE, [255 * v for v in INSIDE for _ in range(3)], 3)),
                           ("coverage.png", png(SIDE, SIDE, [255 * v for v in INSIDE for _ in range(4)], 4)),
                           ("hits.png", png(SIDE, SIDE, INSIDE)),
                           ("hits.u8", bytes(INSIDE)),
                           ("hits.u8", bytes(n for v in INSIDE for n in (0, v)))):
            with self.subTest(name=name, size=len(data)):
                self.deliver(name, data)
                # Front faces are counter-clockwise here, and the square is clockwise.
                self.judge(check=0)
                shutil.rmtree(self.captures)

    def test_black_pictures_fail(self):
        count = SIDE * SIDE
        for name, data in (("coverage.u8", bytes(count)), ("coverage.png", png(SIDE, SIDE, [0] * count)),
                           ("hits.u8", bytes(2 * count)), ("hits.f32", bytes(4 * count)),
                           ("writer.u32", b"\xff" * (8 * count)),
                           ("writer.f32", struct.pack("<f", -1) * (2 * count)),
                           ("depth.f32", struct.pack("<f", 0.375) * count), ("depth.f32", bytes(4 * count))):
            with self.subTest(name=name):
                self.deliver(name, data)
                self.judge(check=1)
                self.assertEqual(self.record()["status"], "fail")
                shutil.rmtree(self.captures)

    def test_wrong_samples_are_told_with_their_rules(self):
        mask = list(INSIDE)
        mask[3 * SIDE + 3], mask[0] = False, True
        self.deliver("coverage.u8", bytes(mask))
        self.judge(check=1)
        found = {(f["kind"], f["sample"]["x"], f["sample"]["y"]): f["rule"] for f in self.record()["findings"]}
        self.assertEqual(set(found), {("missing", 3, 3), ("extra", 0, 0)})

    def test_double_hits_are_seen_in_counts_only(self):
        twice = [2 if i == 27 else v for i, v in enumerate(INSIDE)]
        self.deliver("hits.u8", bytes(twice))
        self.judge(check=1)
        self.assertEqual([f["kind"] for f in self.record()["findings"]], ["double"])

    def test_writers(self):
        # Sample (x, y) is of the first triangle above the diagonal x + y + 1 = 8; ties go to the second one.
        def writers(swap):
            out = []
            for i, inside in enumerate(INSIDE):
                first = i % SIDE + i // SIDE + 1 < 8
                out += [0, int(first == swap)] if inside else [0xFFFFFFFF] * 2
            return array.array("I", out).tobytes()
        self.deliver("writer.u32", writers(False))
        self.judge(check=0)
        self.deliver("writer.u32", writers(True))
        self.judge(check=1)
        self.assertEqual({f["kind"] for f in self.record()["findings"]}, {"order"})

    def test_contradicting_planes_fail(self):
        self.deliver("coverage.u8", bytes(INSIDE))
        self.deliver("writer.u32", b"\xff" * (8 * SIDE * SIDE))
        self.judge(check=1)
        self.assertEqual({f["rule"] for f in self.record()["findings"]}, {"write.consistent"})

    def test_depth_alone(self):
        values = array.array("f", [0.5 if v else 0.375 for v in INSIDE])
        self.deliver("depth.f32", values.tobytes())
        self.judge(check=0)
        values[3 * SIDE + 3] = 0.5001
        self.deliver("depth.f32", values.tobytes())
        self.judge(check=1)
        self.assertEqual([f["quantity"] for f in self.record()["findings"]], ["depth"])
        values[3 * SIDE + 3] = math.nan
        self.deliver("depth.f32", values.tobytes())
        self.judge(check=1)
        self.assertEqual([(f["sample"]["x"], f["sample"]["y"]) for f in self.record()["findings"]], [(3, 3)])

    def test_special_numbers(self):
        """What docs/other-renderers.md says of each kind of number."""
        # Attribute 0 is 1 at x = 1 and 7 at x = 7, attribute 1 is 0: at pixel (3, 3) they are 3.5 and 0.
        self.write_case(CASE, (self.suite / "fam/c1.toml").read_text() + "[[draw.attribute]]\nvalues = [[1], [7], [1], [7], [7], [1]]\n"
                        "[[draw.attribute]]\nconstant = [0]\n")
        planes = {"attribute0": [i % SIDE + 0.5 if v else 0 for i, v in enumerate(INSIDE)], "attribute1": [0.0] * 64,
                  "fragcoord": [n for i in range(64) for n in (i % SIDE + 0.5, i // SIDE + 0.5, 0.5, 1)]}
        self.deliver("coverage.u8", bytes(INSIDE))
        up = struct.unpack("<f", struct.pack("<I", struct.unpack("<I", struct.pack("<f", 3.5))[0] + 1))[0]
        for plane, number, code in (("attribute0", 3.5, 0), ("attribute0", up, 0), ("attribute0", math.nan, 1),
                                    ("attribute0", math.inf, 1), ("attribute0", -math.inf, 1), ("attribute1", -0.0, 0),
                                    ("attribute1", math.nan, 1), ("attribute1", -math.inf, 1), ("fragcoord", up, 1),
                                    ("fragcoord", math.nan, 1)):
            with self.subTest(plane=plane, number=number):
                values = list(planes[plane])
                values[27 * (4 if plane == "fragcoord" else 1)] = number
                file = self.deliver(plane + ".f32", array.array("f", values).tobytes())
                self.judge(check=code)
                places = {(f["sample"]["x"], f["sample"]["y"]) for f in self.record()["findings"]}
                self.assertEqual(places, {(3, 3)} if code else set())
                file.unlink()

    def test_what_cannot_tell_nothing_from_something_is_not_judged(self):
        text = (self.suite / "fam/c1.toml").read_text()
        self.write_case("fam/c1", text.replace("[[draw]]", "[[draw]]\ndepth = { write = false }"))
        self.deliver("depth.f32", struct.pack("<f", 0.375) * (SIDE * SIDE))
        self.rejects("of the delivered planes (depth) a picture in which nothing is drawn would pass too; deliver "
                     "coverage or hits")

    def test_unsupported_and_undelivered(self):
        self.deliver("unsupported.txt", b"no triangles yet\n", "fam/c2")
        self.judge("fam/c2", check=7)  # with fam/c1, of which there is nothing
        self.assertEqual(self.statuses(), {"fam/c1": "not_run", "fam/c2": "unsupported"})
        self.assertEqual(self.record("fam/c2")["reason"], "the renderer says: no triangles yet")
        self.judge(check=6, case="fam/c2")
        self.captures.mkdir(exist_ok=True)
        self.judge(check=7)

    def test_colours(self):
        self.write_case(CASE, (self.suite / "fam/c1.toml").read_text().replace(
            "[[draw]]", '[target.color]\nformat = "rgba8-unorm"\n[[draw]]\ncolor = { value = [1, 0, 1, 1] }'))
        right = [n for v in INSIDE for n in ((255, 0, 255, 255) if v else (0, 0, 0, 0))]
        self.deliver("color.png", png(SIDE, SIDE, right, 4))
        self.judge(check=0)
        (self.captures / CASE / "color.png").unlink()
        self.deliver("color.u32", array.array("I", right).tobytes())
        self.judge(check=0)
        self.deliver("color.u32", bytes(16 * SIDE * SIDE))
        self.judge(check=1)

    def test_samples_lie_one_below_the_other(self):
        self.write_case(CASE, (self.suite / "fam/c1.toml").read_text().replace("size = [8, 8]", "size = [8, 8]\nsamples = 4")
                        .replace("[[1,1], [7,1], [1,7],  [7,1], [7,7], [1,7]]", '[["1.5",1], [7,1], ["1.5",7],  [7,1], [7,7], ["1.5",7]]'))
        # x = 1.5 covers the samples of pixel 1 whose x is 14/16: 1 (14) and 3 (10) lie right of 8/16.
        planes = [y in range(1, 7) and (x in range(2, 7) or (x == 1 and s in (1, 3)))
                  for s in range(4) for y in range(SIDE) for x in range(SIDE)]
        self.deliver("coverage.u8", bytes(planes))
        self.judge(check=0)
        self.deliver("coverage.u8", bytes(planes[64:] + planes[:64]))
        self.judge(check=1)

    def test_rows_of_layers_lie_one_below_the_other(self):
        text = (self.suite / "fam/c1.toml").read_text()
        self.write_case(CASE, text.replace("size = [8, 8]", "size = [8, 8]\nlayers = 3").replace("[[draw]]", "[[draw]]\nlayer = 1"))
        nothing = bytes(SIDE * SIDE)
        self.deliver("coverage.u8", nothing + bytes(INSIDE) + nothing)
        self.judge(check=0)
        self.deliver("coverage.u8", nothing + nothing + bytes(INSIDE))
        self.judge(check=1)
        self.assertEqual({(f["kind"], f["sample"]["layer"]) for f in self.record()["findings"]}, {("missing", 1), ("extra", 2)})
        (self.captures / CASE / "coverage.u8").unlink()
        self.deliver("coverage.png", png(SIDE, 3 * SIDE, [255 * v for v in nothing + bytes(INSIDE) + nothing]))
        self.judge(check=0)

    def test_profile_and_reports(self):
        self.write_case(CASE, TIES)
        # All ties to the first triangle: allowed by Vulkan, not by Direct3D.
        writers = array.array("I", [n for i in range(64) for n in (0, int(i % 8 + i // 8 + 1 > 8))])
        other = array.array("I", [n for i in range(64) for n in (0, int(i % 8 + i // 8 + 1 >= 8))])
        results = {}
        for name, data in (("first", writers), ("second", other)):
            self.deliver("writer.u32", data.tobytes())
            for profile in ("vulkan", "direct3d"):
                results[name, profile] = self.judge("--profile", profile, "--name", "mine").returncode
        self.assertEqual({results["first", "vulkan"], results["second", "vulkan"]}, {0})
        self.assertEqual(sorted((results["first", "direct3d"], results["second", "direct3d"])), [0, 1])
        self.assertEqual(self.results()["device"]["name"], "mine")
        jsonschema.Draft7Validator(schema("results-1")).validate(self.results())

    def test_expectations(self):
        self.deliver("coverage.u8", bytes(SIDE * SIDE))
        known = self.folder / "known.txt"
        known.write_text('# edgecase-expectations 1\n# device: mine*\nfam/c1 fail bug#1 # It draws nothing yet.\n')
        done = self.judge("--name", "mine", "--expect", known)
        self.assertEqual((done.returncode, self.record()["status"]), (0, "xfail"), done.stderr)


class WrongInput(Captures):
    def test_missing_folder(self):
        done = self.judge(check=3)
        self.assertEqual(done.stderr, f"edgecase: --captures '{self.captures}' is no folder; name the one with the planes "
                         "that were rendered\n")

    def test_unknown_case(self):
        self.deliver("coverage.u8", bytes(INSIDE), "fam/c01")
        done = self.judge(check=3)
        self.assertEqual(done.stderr, f"edgecase: '{self.captures}/fam/c01' belongs to no case of the suite; did you mean "
                         "'fam/c0'?\n")

    def test_unknown_selector(self):
        self.captures.mkdir()
        self.judge(check=4, case="fam/c11")

    def test_sizes_of_raw_files(self):
        file = self.deliver("coverage.u8", bytes(INSIDE)[:-1])
        self.rejects(f"'{file}' has 63 bytes; 8 x 8 pixels take 64 bytes (1 channel of 1 byte)")
        file = self.deliver("hits.f32", bytes(100))
        self.rejects(f"'{file}' has 100 bytes; 8 x 8 pixels take 256 bytes (1 channel of 4 bytes) or 512 bytes (2 channels "
                     "of 4 bytes)")
        file = self.deliver("depth.f32", b"")
        self.rejects(f"'{file}' has 0 bytes; 8 x 8 pixels take 256 bytes (1 channel of 4 bytes)")

    def test_sizes_of_images(self):
        file = self.deliver("coverage.png", png(9, 8, [0] * 72))
        self.rejects(f"'{file}' has 9 x 8 pixels; 8 x 8 pixels take an image of 8 x 8")
        self.deliver("depth.tif", b"no image")
        self.judge(check=7)
        self.assertEqual(self.record()["status"], "error")

    def test_truncated_image(self):
        whole = png(SIDE, SIDE, [255 * v for v in INSIDE])
        for length in (0, 8, 40, len(whole) // 2, len(whole) - 20):
            with self.subTest(length=length):
                self.deliver("coverage.png", whole[:length])
                self.judge(check=7)
                self.assertEqual(self.record()["status"], "error")
                self.assertIn("coverage.png", self.record()["reason"])

    def test_numbers_that_mean_nothing(self):
        mask = array.array("f", INSIDE)
        mask[10] = math.nan
        file = self.deliver("coverage.f32", mask.tobytes())
        self.rejects(f"'{file}' holds nan at pixel (2, 1); a mask holds 0 and the largest number of its format only")
        file = self.deliver("coverage.png", png(SIDE, SIDE, [128] * 64))
        self.rejects(f"'{file}' holds 128 at pixel (0, 0); a mask holds 0 and the largest number of its format only")
        file = self.deliver("hits.f32", struct.pack("<f", 0.5) * 64)
        self.rejects(f"'{file}' holds 0.5 at pixel (0, 0); hits are whole numbers from 0 to 2^22")
        file = self.deliver("writer.f32", struct.pack("<f", -2) * 128)
        self.rejects(f"'{file}' holds -2 at pixel (0, 0); writers are whole numbers from 0 on, or -1 where nothing was drawn")

    def test_files_that_do_not_belong(self):
        file = self.deliver("covrage.u8", bytes(INSIDE))
        self.rejects(f"'{file}' is no plane of this case, did you mean 'coverage'?; it has coverage, hits, writer, "
                     "fragcoord, depth")
        file = self.deliver("coverage.bmp", b"BM")
        self.rejects(f"'{file}' has no ending that the plane coverage may have; use .u8, .u32, .f32, .png, .tif, .exr")
        first, second = self.deliver("coverage.f32", b""), self.deliver("coverage.u8", b"")
        self.rejects(f"'{first}' and '{second}' are both the plane coverage; leave one of them")
        first, second = self.deliver("coverage.u8", bytes(64)), self.deliver("hits.u8", bytes(64))
        self.rejects(f"'{first}' and '{second}' say the same twice; leave one of them")
        first, second = self.deliver("unsupported.txt", b"no\n"), self.deliver("hits.u8", bytes(64))
        self.rejects(f"'{first}' says that the case is not supported, and '{second}' is there all the same; remove one of them")
        file = self.deliver("unsupported.txt", b"")
        self.rejects(f"'{file}' is empty; write the reason into its first line")

    def test_values_in_few_bits(self):
        file = self.deliver("depth.png", png(SIDE, SIDE, [0] * 64))
        self.rejects(f"'{file}' has no ending that the plane depth may have; use .f32, .tif, .exr")


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


class Render(Captures):
    def json(self, *words):
        self.edgecase("render", *words, "-o", self.folder / "x.json", check=0)
        return json.loads((self.folder / "x.json").read_text(encoding="utf-8"))

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
            self.assertEqual(struct.unpack(">II", (self.folder / "x.png").read_bytes()[16:24]), (8, 16))
        told = self.edgecase("explain", CASE, "--pixel", "0,0", "--layer", "1", check=0).stdout
        self.assertIn("    [.]. . . . . .\n     . # # # # # #", told)

    def test_what_cannot_be_drawn(self):
        self.write_case("fam/blit", BLIT)
        done = self.edgecase("render", "fam/blit", "--renderer", "tiles", "-o", "x.png", check=2)
        self.assertEqual(done.stderr, "edgecase: 'tiles' draws triangles, and the case is a blit; leave --renderer out\n")
        self.write_case("fam/clipped", TIES.replace("[[draw]]", '[[draw]]\ncull_distance = [{ values = [1, 1, 1, 1, 1, 1] }]'))
        done = self.edgecase("render", "fam/clipped", "--renderer", "tiles", "-o", "x.png", check=2)
        self.assertEqual(done.stderr, "edgecase: 'tiles' cannot draw the case: the algorithms have no depth state, clip distances, "
                         "sample masks, layers and provoking vertices\n")
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
        self.assertEqual([len(b) for b in blocks], [3, 2])
        said = ""
        for block in blocks[0] + blocks[1]:
            script = "".join(line + "\n" for line in block.splitlines() if not line.startswith("c++ "))
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
