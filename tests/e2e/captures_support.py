# SPDX-FileCopyrightText: The Edgecase authors
# SPDX-License-Identifier: Apache-2.0
"""What the tests of exported cases and delivered planes share."""
import json
import shutil
import struct
import zlib

from support import SOURCE, ProgramTest

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
