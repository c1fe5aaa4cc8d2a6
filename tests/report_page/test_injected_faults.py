# SPDX-FileCopyrightText: The Edgecase authors
# SPDX-License-Identifier: Apache-2.0
"""Errors put into pictures one at a time: from the page alone a reader finds which sample is wrong, by which rule, by how much.

The pictures are those of a right renderer (edgecase render), altered and judged by edgecase diff. The reader here knows nothing:
it takes links and rows that are to be seen, and reads what is to be seen; results.json then says whether that is so.
"""
import json
import re
import struct
import unittest

from page_support import PageTest

PLAIN = """format = 1
description = "Two triangles share a diagonal through pixel centres."
rules = ["cover.shared-edge", "tie.top-left"]
[target]
size = [8, 8]
[[draw]]
vertices = [[1,1], [7,1], [1,7],  [7,1], [7,7], [1,7]]
[[draw.attribute]]
values = [[1], [7], [1], [7], [7], [1]]
"""
COLOUR = PLAIN.replace("[[draw]]", '[target.color]\nformat = "rgba8-unorm"\n[[draw]]\ncolor = { value = [1, 0, 1, 1] }')
FOUR = PLAIN.replace("size = [8, 8]", "size = [8, 8]\nsamples = 4")
LAYERS = PLAIN.replace("size = [8, 8]", "size = [8, 8]\nlayers = 3").replace("[[draw]]", "[[draw]]\nlayer = 1")
NOTHING = 0xFFFFFFFF


class Planes:
    """What a right renderer delivers of a case, sample by sample: (x, y, sample, layer) to its numbers."""

    def __init__(self, picture):
        self.width, self.height = picture["width"], picture["height"]
        self.samples, self.layers = picture["samples_per_pixel"], picture["layers"]
        self.at = {(s["x"], s["y"], s["sample"], s.get("layer", 0)): self.numbers(s) for s in picture["samples"]}

    @staticmethod
    def numbers(s):
        values = {name: v["value"] for name, v in s["values"].items()}
        return {"hits": [s["front"], s["back"]], "writer": [s["draw"], s["primitive"]], "depth": [values["depth"]],
                "attribute0": [next(v for name, v in values.items() if name.startswith("attribute0"))],
                "fragcoord": [values["frag_coord." + c] for c in "xyzw"]}

    def file(self, plane, form, clear, channels):
        data = b""
        for s in range(self.samples):
            for layer in range(self.layers):
                for y in range(self.height):
                    for x in range(self.width):
                        known = self.at.get((x, y, s, layer))
                        data += struct.pack(f"<{channels}{form}", *(known[plane] if known else [clear] * channels))
        return data

    def write(self, folder):
        folder.mkdir(parents=True)
        (folder / "hits.u32").write_bytes(self.file("hits", "I", 0, 2))
        (folder / "writer.u32").write_bytes(self.file("writer", "I", NOTHING, 2))
        (folder / "depth.f32").write_bytes(self.file("depth", "f", 0.375, 1))
        (folder / "attribute0.f32").write_bytes(self.file("attribute0", "f", 0, 1))
        (folder / "fragcoord.f32").write_bytes(self.file("fragcoord", "f", 0, 4))


def one(x, y, change, sample=0, layer=0):
    def alter(planes):
        change(planes.at[x, y, sample, layer])
    return alter


def drop(x, y, sample=0, layer=0):
    return lambda planes: planes.at.pop((x, y, sample, layer))


def copy(source, to):
    def alter(planes):
        planes.at[to] = {k: list(v) for k, v in planes.at[source].items()}
    return alter


def scaled(planes):
    for numbers in planes.at.values():
        numbers["attribute0"][0] *= 1.001


def moved(planes):
    """The whole picture lies one pixel too far right, as by a viewport that is off."""
    planes.at = {(x + 1, y, s, layer): numbers for (x, y, s, layer), numbers in planes.at.items() if x < 7}


def ties(planes):
    """Samples on the diagonal go to the other triangle, as by a bottom-right rule."""
    for (x, y, _, _), numbers in planes.at.items():
        if x + y == 7:
            numbers["writer"][1] = 0


def other_layer(planes):
    planes.at = {(x, y, s, 2): numbers for (x, y, s, _), numbers in planes.at.items()}


FAULTS = {
    "missing": (PLAIN, drop(3, 2)),
    "extra": (PLAIN, copy((6, 6, 0, 0), (7, 7, 0, 0))),
    "double": (PLAIN, one(3, 4, lambda n: n.update(hits=[0, 2]))),
    "facing": (PLAIN, one(2, 2, lambda n: n.update(hits=[1, 0]))),
    "writer": (PLAIN, one(5, 5, lambda n: n.update(writer=[0, 0]))),
    "ties": (PLAIN, ties),
    "depth": (PLAIN, one(4, 4, lambda n: n.update(depth=[0.5001]))),
    "attribute": (PLAIN, one(2, 5, lambda n: n.update(attribute0=[2.625]))),
    "attribute-nan": (PLAIN, one(2, 5, lambda n: n.update(attribute0=[float("nan")]))),
    "attribute-scaled": (PLAIN, scaled),
    "fragcoord": (PLAIN, one(1, 3, lambda n: n["fragcoord"].__setitem__(0, 1.25))),
    "moved": (PLAIN, moved),
    "black": (PLAIN, lambda planes: planes.at.clear()),
    "sample": (FOUR, drop(1, 1, sample=2)),
    "layer": (LAYERS, other_layer),
}


class InjectedFaults(PageTest):
    cases = {f"faults/{name}": text for name, (text, _) in FAULTS.items()} | {"faults/none": PLAIN, "faults/colour": COLOUR}

    @classmethod
    def make_run(cls):
        captures = cls.folder / "captures"
        for name, text in cls.cases.items():
            picture = cls.folder / "picture.json"
            cls.edgecase("render", name, "--renderer", "reference", "-o", picture)
            planes = Planes(json.loads(picture.read_text(encoding="utf-8")))
            FAULTS.get(name.split("/")[1], (text, lambda planes: None))[1](planes)
            planes.write(captures / name)
            if text is COLOUR:
                codes = [255, 0, 255, 255]
                rows = [codes if (x, y, 0, 0) in planes.at else [0] * 4 for y in range(8) for x in range(8)]
                rows[3 * 8 + 2] = [250, 0, 255, 255]
                (captures / name / "color.u32").write_bytes(b"".join(struct.pack("<4I", *row) for row in rows))
        cls.edgecase("diff", "--captures", captures, "-o", cls.out, check=1)
        cls.results = {c["id"]: c for c in json.loads((cls.out / "results.json").read_text(encoding="utf-8"))["cases"]}

    def test_each_fault_fails_and_nothing_else(self):
        self.assertEqual([i for i, c in self.results.items() if c["status"] != "fail"], ["faults/none"])

    def test_the_sample_the_rule_and_the_amount_are_found_by_clicks(self):
        for case, result in self.results.items():
            if result["status"] == "pass":
                continue
            with self.subTest(case):
                page = self.open()
                self.assertIn(case, page.text("#list"))
                page.click_seen(f"tr[data-case='{case}'] a")
                page.wait_for("document.getElementById('case-title') !== null")
                self.assertEqual(page.text("#case-title"), case)
                # The sample that is shown first, without a further click.
                self.is_told(page, result)
                rows = page.count(".findings tbody tr")
                self.assertGreaterEqual(rows, 1)
                for k in sorted({0, rows // 2, rows - 1}):
                    page.click_seen(f".findings tbody tr:nth-child({k + 1}) td")
                    self.is_told(page, result)

    def is_told(self, page, result):
        """What the inspector shows is a finding of results.json, with all its parts."""
        title = page.text("#sample-summary")
        place = re.fullmatch(r"Pixel \((\d+), (\d+)\)(?: of layer (\d+))?(?: sample (\d+))? at \([\d.]+, [\d.]+\)", title)
        self.assertIsNotNone(place, title)
        x, y, layer, sample = (int(n or 0) for n in place.groups())
        here = [f for f in result["findings"] if (f["sample"]["x"], f["sample"]["y"], f["sample"]["index"], f["sample"].get("layer", 0))
                == (x, y, sample, layer)]
        self.assertTrue(here, f"{title} is not wrong")
        told, seen = page.text(".inspector .told"), " ".join(page.text(".inspector .mark-line").split())
        for f in here:
            self.assertIn(f["rule"], told)
            self.assertIn(f["why"], told)
            self.assertIn(f["level"], told)
            amount = (f["quantity"] + ": " if f["quantity"] else "") + f"expected {f['expected']}, got {f['got']}"
            self.assertIn(amount, told)
            if f["kind"] == "value" and f["ratio"] not in (0, "inf", "nan", None):
                self.assertRegex(told, r"[\d.e+\u00d7]+ budgets off")
        self.assertIn({"missing": "missing", "extra": "extra", "double": "double", "value": "value", "order": "order"}[here[0]["kind"]], seen)
        link = page.run("(document.querySelector('.inspector .told a') || {}).href")
        self.assertRegex(str(link), r"^https://registry\.khronos\.org/vulkan/specs/")


class Ends(PageTest):
    """Cases that end without a picture: the page says how."""
    cases = {f"ends/{name}": PLAIN for name in ("segv", "device-lost", "unsupported", "good")}
    fault = "segv@ends/segv,device-lost@ends/device-lost,unsupported@ends/unsupported"

    def test_status_and_reason_are_found_by_clicks(self):
        results = {c["id"]: c for c in json.loads((self.out / "results.json").read_text(encoding="utf-8"))["cases"]}
        self.assertEqual({i.split("/")[1]: c["status"] for i, c in results.items()},
                         {"segv": "crash", "device-lost": "device_lost", "unsupported": "unsupported", "good": "pass"})
        for case, result in results.items():
            with self.subTest(case):
                page = self.open()
                page.click_seen(f"tr[data-case='{case}'] a")
                page.wait_for("document.getElementById('case-title') !== null")
                shown = page.text(".case-page")
                self.assertIn(result["status"].replace("_", " "), shown)
                if result.get("reason"):
                    self.assertIn(result["reason"], shown)
                if result.get("signal"):
                    self.assertIn(result["signal"], shown)
                if result["status"] != "pass":
                    self.assertIn("edgecase run " + case, shown)


if __name__ == "__main__":
    unittest.main()
