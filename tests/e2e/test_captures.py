# SPDX-FileCopyrightText: The Edgecase authors
# SPDX-License-Identifier: Apache-2.0
"""Planes that renderers elsewhere deliver: what is judged, and wrong input."""
import array
import json
import math
import re
import shutil
import struct
import unittest

import jsonschema
from captures_support import Captures, CASE, INSIDE, png, schema, SIDE, TIES


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

    def test_the_rerun_line_keeps_name_and_expectations(self):
        self.deliver("coverage.u8", bytes(SIDE * SIDE))
        done = self.judge("--name", "mine", "--no-expect", "--subpixel-bits", "4", check=1)
        self.assertIn(f"diff {CASE} --captures {self.captures} --suite {self.suite} --subpixel-bits 4 --name mine --no-expect\n", done.stdout)

    def test_a_folder_that_is_called_like_a_plane(self):
        file = self.deliver("coverage.u8", bytes(INSIDE))
        (file.parent / "depth.f32").mkdir()
        (file.parent / "other.case").mkdir()
        self.rejects(f"'{file.parent / 'depth.f32'}' is a folder; a plane is a file")

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

    def test_support_is_required(self):
        self.deliver("unsupported.txt", b"no triangles yet\n", "fam/c2")
        done = self.judge("--require-support", case="fam/c2", check=1)
        self.assertIn("FAIL fam/c2   unsupported\n", done.stdout)
        self.assertIn(" --require-support", done.stdout.partition("rerun: ")[2].partition("\n")[0])
        case = self.record("fam/c2")
        self.assertEqual((case["status"], case["actual"]), ("fail", "unsupported"))
        skip = self.folder / "skip.txt"
        skip.write_text("# edgecase-expectations 2\n# device: captures\nfam/c2 skip - # Not yet.\n")
        self.judge("--require-support", "--expect", skip, case="fam/c2", check=6)

    def test_few_judged_cases_are_told(self):
        for case in ("fam/c2", "fam/c3"):
            self.deliver("unsupported.txt", b"no triangles yet\n", case)
        self.deliver("coverage.u8", bytes(INSIDE))
        done = self.edgecase("diff", "--captures", self.captures, "-o", self.out, check=0)
        self.assertIn("\nonly 1 of 3 cases was judged\n", done.stdout)

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
        known.write_text('# edgecase-expectations 2\n# device: mine*\nfam/c1 fail bug#1 missing:cover.inside@vulkan<=30 missing:cover.shared-edge@vulkan<=30 # It draws nothing yet.\n')
        done = self.judge("--name", "mine", "--expect", known)
        self.assertEqual((done.returncode, self.record()["status"]), (0, "xfail"), done.stdout)
        for status in ("fail", "skip"):
            cause = "missing:cover.inside@vulkan<=30" if status == "fail" else ""
            known.write_text(f'# edgecase-expectations 2\n# device: mine*\nfam/c1 {status} bug#1 {cause} until=2020-01-01 # It draws nothing yet.\n')
            done = self.judge("--name", "mine", "--expect", known, check=1)
            self.assertEqual((done.returncode, self.record()["status"]), (1, "fail"), done.stderr)


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

    def test_a_link_that_leads_nowhere(self):
        file = self.deliver("coverage.u8", bytes(INSIDE))
        file.with_name("depth.f32").symlink_to("nowhere")
        self.judge(check=7)
        self.assertIn("depth.f32", self.record()["reason"])

    def test_without_selectors_what_was_drawn_is_judged(self):
        self.deliver("coverage.u8", bytes(INSIDE))
        words = ("diff", "--captures", self.captures, "-o", self.out)
        done = self.edgecase(*words, check=0)
        self.assertEqual(self.statuses(), {"fam/c1": "pass"})
        self.assertIn("\n9 cases without a folder in the captures left out; --exported DIR judges all that was exported\n", done.stdout)
        # What was exported and not drawn is no pass.
        self.edgecase("export", "fam/c1", "fam/c2", "-o", "exported", check=0)
        done = self.edgecase(*words, "--exported", "exported", check=7)
        self.assertEqual(self.statuses(), {"fam/c1": "pass", "fam/c2": "not_run"})
        self.assertNotIn("left out", done.stdout)
        self.edgecase(*words, "fam/c1", "--exported", "exported", check=0)
        index = self.folder / "exported/index.json"
        whole = index.read_text()
        index.write_text(whole.replace('"id": "fam/c2"', '"id": "fam/gone"'))
        done = self.edgecase(*words, "--exported", "exported", check=3)
        self.assertEqual(done.stderr, "edgecase: 'exported' has the case 'fam/gone', which is not in the suite; "
                         "export the cases of this suite again\n")
        index.write_text(whole.replace("edgecase-export-1", "edgecase-export-9"))
        self.assertIn("is no list of exported cases", self.edgecase(*words, "--exported", "exported", check=3).stderr)
        done = self.edgecase(*words, "--exported", "nowhere", check=3)
        self.assertEqual(done.stderr, "edgecase: 'nowhere/index.json' is no list of exported cases; name the folder that "
                         "'edgecase export' wrote\n")
        # That comes first: only the list knows cases of one's own, of which there are captures.
        (self.captures / "mine").mkdir()
        (self.captures / "mine/hits.u8").write_bytes(bytes(64))
        self.assertEqual(self.edgecase(*words, "--exported", "nowhere", check=3).stderr, done.stderr)
        shutil.rmtree(self.captures / "mine")
        (self.captures / "fam/c1").rename(self.folder / "away")
        self.assertEqual(self.edgecase(*words, check=4).stderr,
                         f"edgecase: no case is selected: '{self.captures}' holds a folder of none\n")

    def test_an_export_carries_cases_of_ones_own(self):
        text = (self.suite / CASE).with_suffix(".toml").read_text()
        own = self.folder / "mine" / "sub" / "own.toml"
        own.parent.mkdir(parents=True)
        own.write_text(text.replace("[target]", "[matrix]\nfirst = [0, 1]\n[target]").replace("[[draw]]", '[[draw]]\nfirst = "first"'))
        self.edgecase("export", CASE, own.parent.parent, "-o", "exported", check=0)
        ids = [c["id"] for c in json.loads((self.folder / "exported/index.json").read_text())["cases"]]
        leaves = ["sub/own:first=0", "sub/own:first=1"]
        self.assertEqual(ids, [CASE, *leaves])
        shutil.rmtree(own.parent.parent)  # the export has all that is needed
        folders = {c["id"]: c["folder"] for c in json.loads((self.folder / "exported/index.json").read_text())["cases"]}
        for case in ids:
            self.deliver("coverage.u8", bytes(INSIDE), folders[case])
        words = ("diff", "--captures", self.captures, "--exported", "exported", "-o", self.out)
        self.edgecase(*words, check=None)
        self.assertEqual(set(self.statuses()), set(ids))
        # A selector judges the suite's case alone, and the carried ones are no mistake.
        self.edgecase(*words, CASE, check=0)
        self.assertEqual(self.statuses(), {CASE: "pass"})
        # The printed commands name carried cases so that they are found.
        self.deliver("coverage.u8", bytes(SIDE * SIDE), folders[leaves[1]])
        done = self.edgecase(*words, leaves[1], check=1)
        rerun = re.search(r"rerun: \S+ (.*)", done.stdout)[1].split()
        self.assertIn(leaves[1], rerun)
        shutil.rmtree(self.out)
        self.edgecase(*rerun, "-o", self.out, check=1)
        self.assertEqual(list(self.statuses().values()), ["fail"])
        explain = re.search(r"explain: \S+ (.*)", done.stdout)[1].split()
        self.assertIn("exported/own-cases/sub/own.toml:first=1", explain)
        self.edgecase(*explain, check=0)
        # Drawn into the folder of the export, it needs no option.
        shutil.copytree(self.folder / "exported", self.captures, dirs_exist_ok=True)
        self.edgecase("diff", "--captures", self.captures, "-o", self.out, check=1)
        self.assertEqual(set(self.statuses()), set(ids))

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

    def test_an_image_that_claims_gigabytes_is_not_decoded(self):
        bomb = png(16384, 16384, [0] * 64)  # decoding it would find that rows are missing
        file = self.deliver("coverage.png", bomb)
        self.rejects(f"'{file}' has 16384 x 16384 pixels; 8 x 8 pixels take an image of 8 x 8")

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
        self.rejects(f"'{file}' holds NaN at pixel (2, 1); a mask holds 0 and the largest number of its format only")
        file = self.deliver("coverage.png", png(SIDE, SIDE, [128] * 64))
        self.rejects(f"'{file}' holds 128 at pixel (0, 0); a mask holds 0 and the largest number of its format only")
        file = self.deliver("hits.f32", struct.pack("<f", 0.5) * 64)
        self.rejects(f"'{file}' holds 0.5 at pixel (0, 0); hits are whole numbers from 0 to 2^22")
        file = self.deliver("writer.f32", struct.pack("<f", -2) * 128)
        self.rejects(f"'{file}' holds -2 at pixel (0, 0); writers are whole numbers from 0 on, or -1 where nothing was drawn")

    def test_files_that_do_not_belong(self):
        file = self.deliver("covrage.u8", bytes(INSIDE))
        self.rejects(f"'{file}' is no plane of this case, which has coverage, hits, writer, fragcoord, depth; did you "
                     "mean 'coverage'?")
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


if __name__ == "__main__":
    unittest.main()
