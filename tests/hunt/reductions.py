#!/usr/bin/env python3
# SPDX-FileCopyrightText: The Edgecase authors
# SPDX-License-Identifier: Apache-2.0
"""Measures what `edgecase reduce` makes of cases that hunts drew: for faults of tests/breaking_layer that found.json
has, one of each symptom before a second one of any, the case that found the fault is reduced, and the reduced case is
run in three fresh processes.

Sizes are those of the file: draws, triangles, pixels of the target, and keys besides those that every case has. Prints a
line for each fault, and the medians with the table of docs/fuzzing.md behind them (--page writes it there).
"""
import argparse
import json
import os
import pathlib
import statistics
import subprocess
import tempfile
import time
import tomllib

HERE = pathlib.Path(__file__).resolve().parent
SOURCE = HERE.parents[1]
PAGE = SOURCE / "docs" / "fuzzing.md"
PROGRAM = os.environ.get("EDGECASE_PROGRAM", str(SOURCE / "build" / "release" / "bin" / "edgecase"))
LAYER = os.environ.get("EDGECASE_LAYER_PATH", str(SOURCE / "build" / "release" / "breaking_layer"))
BEGIN, END = "<!-- reductions -->\n", "<!-- end of reductions -->\n"
SEED = "1"
EVERY_CASE_HAS = {"format", "description", "rules", "target", "size", "draw", "vertices"}


def chosen(count):
    """The faults and the numbers of their cases."""
    found = json.loads((HERE / "found.json").read_text())["layer"][SEED]
    by_symptom = {}
    for fault, (number, symptom) in found.items():
        if number is not None:
            by_symptom.setdefault(symptom, []).append((fault, number))
    lists = list(by_symptom.values())
    turns = [one for turn in range(max(map(len, lists))) for group in lists for one in group[turn:turn + 1]]
    return turns[:count]


def triangles_of(draw):
    count = len(draw.get("indices", draw.get("vertices", [])))
    return count // 3 if draw.get("topology", "triangle-list") == "triangle-list" else max(count - 2, 0)


def keys_of(value):
    if isinstance(value, list):
        return sum(map(keys_of, value))
    if not isinstance(value, dict):
        return 0
    return sum((key not in EVERY_CASE_HAS) + keys_of(inner) for key, inner in value.items())


def sizes(text):
    case = tomllib.loads(text)
    width, height = case["target"]["size"] if "size" in case["target"] else (16, 16)
    draws = case.get("draw", [])
    return {"draws": len(draws), "triangles": sum(map(triangles_of, draws)),
            "pixels": width * height * case["target"].get("layers", 1), "other keys": keys_of(case)}


def edgecase(*arguments, fault=None):
    env = dict(os.environ)
    if fault:
        env |= {"VK_LAYER_PATH": LAYER, "VK_INSTANCE_LAYERS": "VK_LAYER_EDGECASE_breaking", "EDGECASE_BREAK": fault}
    return subprocess.run([PROGRAM, *arguments], env=env, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)


def reduce(fault, number, folder):
    """Sizes before and after, seconds, and how many of three runs fail; nothing where no failure is reduced."""
    drawn, small = folder / "drawn.toml", folder / "small.toml"
    before = edgecase("fuzz", "--seed", SEED, "--print", str(number)).stdout
    drawn.write_text(before)
    begin = time.monotonic()
    run = edgecase("reduce", str(drawn), "-q", "-o", str(small), fault=fault)
    seconds = time.monotonic() - begin
    if run.returncode != 0:
        return None, run.stderr.strip().splitlines()[-1:] or [f"exit code {run.returncode}"]
    fails = [edgecase("run", str(small), "--no-expect", "--no-diagnosis", "-q", "-o", str(folder / f"run-{k}"),
                      fault=fault).returncode == 1 for k in range(3)]
    return {"before": sizes(before), "after": sizes(small.read_text()), "seconds": seconds, "fails": sum(fails)}, []


def table(rows):
    lines = ["| of a case, the median | as drawn | reduced |", "| --- | --- | --- |"]
    for name in rows[0]["before"]:
        before, after = ([row[when][name] for row in rows] for when in ("before", "after"))
        lines.append(f"| {name} | {statistics.median(before):g} | {statistics.median(after):g} |")
    return "\n".join(lines) + "\n"


def summary(rows):
    seconds = sorted(row["seconds"] for row in rows)
    thrice = sum(row["fails"] == 3 for row in rows)
    return (f"{len(rows)} reductions took {statistics.median(seconds):.1f} s in the median, nine of ten at most "
            f"{seconds[len(seconds) * 9 // 10]:.1f} s; {thrice} of the reduced cases failed in three of three fresh "
            "processes.\n")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--count", type=int, default=100)
    parser.add_argument("--page", action="store_true", help="write the table into docs/fuzzing.md")
    options = parser.parse_args()
    if not pathlib.Path(PROGRAM).is_file() or not pathlib.Path(LAYER).is_dir():
        parser.error(f"{PROGRAM} or {LAYER} is missing; build them with 'scripts/build release --tests breaking_layer'")
    if options.count < 1:
        parser.error("--count: write a whole number from 1 on")
    rows = []
    for fault, number in chosen(2 * options.count):
        with tempfile.TemporaryDirectory() as folder:
            row, why = reduce(fault, number, pathlib.Path(folder))
        if row:
            rows.append(row)
            after, fails = row["after"], row["fails"]
            print(f"{fault}\tcase {number}\t{after['draws']} draws, {after['triangles']} triangles, "
                  f"{after['other keys']} other keys\t{row['seconds']:.1f} s\t{fails} of 3", flush=True)
        else:
            print(f"{fault}\tcase {number}\tnot reduced: {' '.join(why)}", flush=True)
        if len(rows) == options.count:
            break
    print(summary(rows) + "\n" + table(rows))
    if options.page:
        page = PAGE.read_text()
        begin, end = page.index(BEGIN) + len(BEGIN), page.index(END)
        PAGE.write_text(page[:begin] + table(rows) + page[end:])


if __name__ == "__main__":
    main()
