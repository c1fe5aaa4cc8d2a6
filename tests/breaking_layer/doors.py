#!/usr/bin/env python3
# SPDX-FileCopyrightText: The Edgecase authors
# SPDX-License-Identifier: Apache-2.0
"""Finds out through which doors each fault of door_faults.cpp is seen, and writes doors.json: every fault is drawn over a
few cases of the suite, first without any door, where nobody may see it, then through each door alone."""
import json
import pathlib
import shutil
import sys
import tempfile

import broken

FILE = pathlib.Path(__file__).parent / "doors.json"
# Lists and strips, with and without indices and restart, constant attributes, several triangles and draws, scissors,
# faces, depth tests and bias, queries, alpha to coverage, stencils, resolves. None of them has a relation of its own.
SAMPLE = ["attributes/constant:value=1", "topology/restart-*", "coverage/bow-tie:*", "mesh/across-tiles", "topology/strip*",
          "order/draws", "scissor/changes", "depth-test/nearest-wins:*", "depth-bias/decal:*", "facing/*", "query/draws:*",
          "alpha-to-coverage/ends:format=rgba8-unorm,*", "stencil/write-mask:*", "resolve/color:format=rgba8-unorm,*",
          "depth-clamp/bias:*,slope=-8,near=0.25", "provoking/facing:mode=last,*"]
WORDS = ["--retries", "0", "--no-expect", "--html", "/dev/null", "--capture", "none", "--no-diagnosis"]
# What lavapipe does wrong itself tells nothing of a fault (docs/findings).
WRONG_DOORS = ["multi-draw-empty", "indirect-after-count"]
# Doors that lavapipe has since Mesa 25: with an older one their faults are not reached.
NEWER_DOORS = ["shader-objects", "mesh-shader"]
# Doors by which lavapipe is wrong before Mesa 26, whatever the fault (docs/findings).
BROKEN_DOORS = ["query-first"]


def is_known(door, case_id):
    """lavapipe 22.3 forgets where the index buffer of an indirect draw is bound, and into which layers it resolves
    (docs/findings)."""
    return (door == "indirect-count" and case_id.startswith(("mesh/", "topology/restart"))
            or door in ("image-layer", "multiview") and case_id.startswith("resolve/"))


def names():
    return [name for name, _ in broken.faults() if name.startswith("door-")]


def suite_in(folder):
    """The sample's files as a suite of their own, which loads faster than the whole one."""
    suite = pathlib.Path(folder) / "sample"
    for selector in SAMPLE:
        for file in (broken.SOURCE / "cases" / "suite").glob(selector.split(":")[0] + ".toml"):
            (suite / file.parent.name).mkdir(parents=True, exist_ok=True)
            shutil.copy(file, suite / file.parent.name / file.name)
    return suite


def seen(fault, folder, door):
    """The cases that fail under the fault, through this door alone ("none" for none), and how many calls it altered."""
    run = broken.run(fault, SAMPLE, folder, [*WORDS, "--suite", str(suite_in(folder)), "--doors", door])
    if run.results is None:
        sys.exit(run.err)
    caught = [case["id"] for case in run.results["cases"] if broken.is_caught(case)]
    return [i for i in caught if not is_known(door, i)], run


def doors(folder):
    without = ",".join(["all", *(f"-{door}" for door in BROKEN_DOORS)])
    run = broken.run("", SAMPLE, folder, [*WORDS, "--doors", without])
    return [d["door"] for d in run.results["doors"] if d["pictures"] > 0 and d["door"] not in WRONG_DOORS + BROKEN_DOORS]


def main():
    with tempfile.TemporaryDirectory(prefix="edgecase-doors-") as folder:
        every = doors(folder)
        found = {}
        for name in names():
            if seen(name, folder, "none")[0]:
                print(f"{name}: seen without a door", file=sys.stderr)
                continue
            found[name] = [door for door in every if seen(name, folder, door)[0]]
            if not found[name]:
                found[name] = [door for door in json.loads(FILE.read_text()).get(name, []) if door in NEWER_DOORS + BROKEN_DOORS]
            print(f"{name}: {', '.join(found[name]) or 'nobody'}", flush=True)
    FILE.write_text(json.dumps(found, indent=1) + "\n")
    return 0 if len(found) == len(names()) and all(found.values()) else 1


if __name__ == "__main__":
    sys.exit(main())
