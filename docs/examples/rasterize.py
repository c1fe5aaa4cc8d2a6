#!/usr/bin/env python3
# SPDX-FileCopyrightText: The Edgecase authors
# SPDX-License-Identifier: Apache-2.0
"""A rasterizer that draws exported cases, with Python's standard library alone.

    usage: rasterize.py EXPORT CAPTURES [--reverse-ties] [--planes NAME,...]

EXPORT is a folder that 'edgecase export' wrote; the planes go to CAPTURES, for 'edgecase diff'.
Vertices snap to the nearest 1/256 pixel, edge functions are whole numbers, values binary64. What it
cannot draw it says in unsupported.txt. --reverse-ties gives samples on an edge to the bottom and
right edges, so that something is wrong with it.
"""
import array
import fractions
import json
import math
import pathlib
import sys

# What a case may need; everything else is left out (docs/schema/case-1.json).
CAN = {"samples", "sample-locations", "strip", "fan", "indices", "restart", "restart-list", "beyond-viewport",
       "perspective", "viewport", "depth-range", "scissor", "cull", "provoking-last"}
# What changes only planes that are not delivered here.
CAN |= {"color", "blend", "color-write-mask", "stencil", "resolve"}
GRID = 256  # snapped positions are whole numbers of 1/256 pixel
NOTHING = 0xFFFFFFFF  # of writer.u32


def snapped(vertex, viewport):
    """Framebuffer position of a clip-space vertex (w > 0) in 1/256 pixel, exact until it is rounded."""
    x, y, _, w = map(fractions.Fraction, vertex)
    at = ((fractions.Fraction(viewport["width"]) / 2 * (x / w + 1) + fractions.Fraction(viewport["x"])),
          (fractions.Fraction(viewport["height"]) / 2 * (y / w + 1) + fractions.Fraction(viewport["y"])))
    return tuple(math.floor(v * GRID + fractions.Fraction(1, 2)) for v in at)


def edge(a, b, p):
    """Twice the signed area of a, b, p: positive where p is right of a -> b on screen (y goes down)."""
    return (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0])


def owns(a, b, reverse):
    """Whether a sample on the edge a -> b of a clockwise triangle is its own: a top or a left edge."""
    dx, dy = b[0] - a[0], b[1] - a[1]
    return (dy > 0 or (dy == 0 and dx < 0)) if reverse else (dy < 0 or (dy == 0 and dx > 0))


class Picture:
    """The planes of one case. A sample's index is that of its row in the file: (s * height + y) * width + x."""

    def __init__(self, case, reverse):
        target = case["target"]
        self.case, self.reverse = case, reverse
        self.width, self.height = target["width"], target["height"]
        self.locations = [(int(x * GRID), int(y * GRID)) for x, y in target["sample_locations"]]
        count = self.width * self.height * target["samples"]
        clear = {plane["name"]: plane["clear"] for plane in case["captures"]["planes"]}
        self.planes = {"hits.u8": array.array("B", bytes(2 * count)),
                       "writer.u32": array.array("I", [NOTHING]) * (2 * count)}
        self.channels = {plane["name"]: len(plane["channels"]) for plane in case["captures"]["planes"]}
        for name, channels in self.channels.items():
            if name in ("depth", "fragcoord") or name.startswith("attribute"):
                self.planes[name + ".f32"] = array.array("f", [clear[name]]) * (channels * count)

    def keep(self, name, at, numbers):
        channels = self.channels[name]
        plane = self.planes[name + ".f32"]
        for k, number in enumerate(numbers[:channels]):
            plane[at * channels + k] = number

    def draw(self):
        for number, draw in enumerate(self.case["draws"]):
            corners = [snapped(v, draw["viewport"]) for v in draw["positions"]]
            for primitive, vertices in enumerate(draw["triangles"]):
                self.triangle(draw, number, primitive, vertices, [corners[v] for v in vertices])

    def pixels(self, draw, corners, offset):
        """Pixels whose sample at `offset` lies in target, scissor, viewport and the corners' rectangle."""
        viewport, scissor = draw["viewport"], draw["scissor"]
        ranges = []
        for axis, (start, side, size) in enumerate((("x", "width", self.width), ("y", "height", self.height))):
            first, last = sorted((viewport[start], viewport[start] + viewport[side]))
            inside = [math.ceil(fractions.Fraction(v) - fractions.Fraction(offset[axis], GRID)) for v in (first, last)]
            low = min(c[axis] for c in corners) // GRID - 1
            high = max(c[axis] for c in corners) // GRID + 2
            ranges.append(range(max(0, scissor[start], inside[0], low),
                                min(size, scissor[start] + scissor[side], inside[1], high)))
        return ranges

    def triangle(self, draw, number, primitive, vertices, corners):
        area = edge(*corners)
        if area == 0:
            return
        front = (area > 0) == (draw["front_face"] == "clockwise")
        if draw["cull"] == "front-and-back" or draw["cull"] == ("front" if front else "back"):
            return
        a, b, c = corners if area > 0 else (corners[0], corners[2], corners[1])  # clockwise on screen
        edges = [(p, q, owns(p, q, self.reverse)) for p, q in ((b, c), (c, a), (a, b))]
        for sample, offset in enumerate(self.locations):
            columns, rows = self.pixels(draw, corners, offset)
            for y in rows:
                for x in columns:
                    point = (x * GRID + offset[0], y * GRID + offset[1])
                    if all(e > 0 or (e == 0 and own) for e, own in ((edge(p, q, point), own) for p, q, own in edges)):
                        at = (sample * self.height + y) * self.width + x
                        hits = self.planes["hits.u8"]
                        hits[2 * at + (0 if front else 1)] += 1
                        self.planes["writer.u32"][2 * at:2 * at + 2] = array.array("I", (number, primitive))
                        self.shade(draw, vertices, draw["provoking_vertices"][primitive], corners, at, x, y, point)

    def shade(self, draw, vertices, provoking, corners, at, x, y, sample):
        centre = (x * GRID + GRID // 2, y * GRID + GRID // 2)  # attributes belong to the pixel, depth to the sample
        area = edge(*corners)

        def barycentric(p):
            return [edge(corners[(k + 1) % 3], corners[(k + 2) % 3], p) / area for k in range(3)]

        clip = [draw["positions"][v] for v in vertices]
        near, far = draw["viewport"]["min_depth"], draw["viewport"]["max_depth"]
        depths = [near + (far - near) * (v[2] / v[3]) for v in clip]
        linear = barycentric(centre)
        inverse_w = sum(l / v[3] for l, v in zip(linear, clip))
        self.keep("fragcoord", at, [x + 0.5, y + 0.5, sum(l * z for l, z in zip(linear, depths)), inverse_w])
        if "depth.f32" in self.planes:
            depth = sum(l * z for l, z in zip(barycentric(sample), depths))
            self.keep("depth", at, [min(max(depth, min(near, far)), max(near, far))])
        for k, attribute in enumerate(draw["attributes"]):
            values = [attribute["values"][v] for v in vertices]
            if attribute["interpolation"] == "flat":
                result = attribute["values"][provoking]
            elif attribute["interpolation"] == "noperspective":
                result = [sum(l * f for l, f in zip(linear, fs)) for fs in zip(*values)]
            else:
                result = [sum(l * f / v[3] for l, f, v in zip(linear, fs, clip)) / inverse_w for fs in zip(*values)]
            self.keep(f"attribute{k}", at, result)


def main(words):
    options = [w for w in words if w.startswith("--")]
    folders = [w for w in words if not w.startswith("--")]
    planes = [o[len("--planes="):].split(",") for o in options if o.startswith("--planes=")]
    if len(folders) != 2 or any(o != "--reverse-ties" and not o.startswith("--planes=") for o in options):
        sys.exit(__doc__)
    export, captures = map(pathlib.Path, folders)
    for entry in json.loads((export / "index.json").read_text(encoding="utf-8"))["cases"]:
        folder = captures / entry["folder"]
        folder.mkdir(parents=True, exist_ok=True)
        missing = [need for need in entry["needs"] if need not in CAN]
        if missing:
            (folder / "unsupported.txt").write_text(f"rasterize.py cannot draw: {', '.join(missing)}\n", encoding="utf-8")
            continue
        case = json.loads((export / entry["file"]).read_text(encoding="utf-8"))
        picture = Picture(case, "--reverse-ties" in options)
        picture.draw()
        for name, plane in picture.planes.items():
            if not planes or name.split(".")[0] in planes[0]:
                if sys.byteorder == "big":
                    plane.byteswap()
                (folder / name).write_bytes(plane.tobytes())


if __name__ == "__main__":
    main(sys.argv[1:])
