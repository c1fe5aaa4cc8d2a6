#!/usr/bin/env python3
# SPDX-FileCopyrightText: The Edgecase authors
# SPDX-License-Identifier: Apache-2.0
"""Measures with which of its cases `edgecase fuzz` finds each planted fault: those that tests/breaking_layer gives to
lavapipe, and those of rasterizers/software.

Each fault is hunted with several seeds, without any case of the suite. A find is the first case that fails with the
fault as it does not without it. Time is counted in cases: which case finds a fault does not hang on how busy the machine
is. Writes found.json, and the table of docs/fuzzing.md.
"""
import argparse
import json
import os
import pathlib
import statistics
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
SOURCE = HERE.parents[1]
PROGRAM = os.environ.get("EDGECASE_RECORD_HUNT", str(SOURCE / "build" / "release" / "bin" / "record_hunt"))
FOUND, UNFOUND, PAGE = HERE / "found.json", HERE / "unfound.json", SOURCE / "docs" / "fuzzing.md"
BEGIN, END = "<!-- hunts -->\n", "<!-- end of hunts -->\n"
KINDS = {"layer": "lavapipe 22.3 through the breaking layer", "software": "the software rasterizer"}


def hunt(kind, seed, cases, jobs, faults):
    """Name: [number of the first case that shows it or None, what is wrong with it]."""
    found = {}
    command = [PROGRAM, kind, "--seed", str(seed), "--cases", str(cases), "--jobs", str(jobs), *faults]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as process:
        for line in process.stdout:
            name, number, symptom, _ = line.rstrip("\n").split("\t")
            found[name] = [None if number == "-" else int(number), symptom]
            print(f"{kind} {seed} {line}", end="", flush=True)
    if process.returncode != 0:
        sys.exit(f"hunt.py: error: {' '.join(command)} ended with {process.returncode}")
    return found


def found_with(record, kind, fault):
    """The numbers of the cases that find a fault, one a seed that found it."""
    rows = [seed[fault] for seed in record[kind].values()]
    return [number for number, _ in rows if number is not None]


def summary(record, reasons, kind):
    """What one kind of device says, as numbers."""
    names = list(next(iter(record[kind].values())))
    unreachable = [n for n in names if reasons[kind].get(n, "").startswith("cannot")]
    reachable = [n for n in names if n not in unreachable]
    found = [n for n in reachable if found_with(record, kind, n)]
    every = [seed[n][0] for seed in record[kind].values() for n in reachable]
    return {
        "faults": len(names), "reachable": len(reachable), "found": len(found),
        "every": sum(len(found_with(record, kind, n)) == len(record[kind]) for n in reachable),
        "median": statistics.median([record["cases"] if number is None else number + 1 for number in every]),
        "never": [n for n in names if not found_with(record, kind, n)],
    }


def table(record, reasons):
    seeds = sorted({seed for kind in KINDS for seed in record[kind]})
    speed = record["cases"] / 60
    lines = [f"| {len(seeds)} seeds, {record['cases']} cases each | faults | that cases can show | found | with every seed |"
             " median time to find |", "| --- | --- | --- | --- | --- | --- |"]
    for kind, title in KINDS.items():
        s = summary(record, reasons, kind)
        lines.append(f"| {title} | {s['faults']} | {s['reachable']} | {s['found']} ({100 * s['found'] / s['reachable']:.0f} %) | "
                     f"{s['every']} | {s['median']:.0f} cases, {s['median'] / speed:.1f} s |")
    lines += ["", "Never found:", ""]
    for kind in KINDS:
        for name in summary(record, reasons, kind)["never"]:
            lines.append(f"* `{name}`: {reasons[kind].get(name, 'not known why')}")
    return "\n".join(lines) + "\n"


def write_page(record, reasons):
    before, rest = PAGE.read_text().split(BEGIN)
    PAGE.write_text(before + BEGIN + table(record, reasons) + END + rest.split(END)[1])


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--kind", choices=KINDS, action="append", help="what draws (default: both)")
    parser.add_argument("--seeds", default="1,2,3")
    parser.add_argument("--cases", type=int, default=32768, help="of a hunt: what 60 s take")
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--page", action="store_true", help="only write the page's table from found.json")
    parser.add_argument("fault", nargs="*", help="hunt these again; the others stay as they are")
    arguments = parser.parse_args()
    record = json.loads(FOUND.read_text()) if FOUND.exists() else {}
    reasons = json.loads(UNFOUND.read_text()) if UNFOUND.exists() else {kind: {} for kind in KINDS}
    if not arguments.page:
        record["cases"] = arguments.cases
        for kind in arguments.kind or KINDS:
            rows = record.setdefault(kind, {})
            for seed in arguments.seeds.split(","):
                rows[seed] = (rows.get(seed, {}) if arguments.fault else {}) | hunt(kind, seed, arguments.cases, arguments.jobs, arguments.fault)
                FOUND.write_text(json.dumps(record, indent=0) + "\n")
    for kind in KINDS:
        if record.get(kind):
            print(kind, summary(record, reasons, kind))
    if all(record.get(kind) for kind in KINDS) and BEGIN in PAGE.read_text():
        write_page(record, reasons)


if __name__ == "__main__":
    main()
