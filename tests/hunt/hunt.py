#!/usr/bin/env python3
# SPDX-FileCopyrightText: The Edgecase authors
# SPDX-License-Identifier: Apache-2.0
"""Measures with which of its cases `edgecase fuzz` finds each planted fault: those that tests/breaking_layer gives to
lavapipe, and those of rasterizers/software.

Each fault is hunted with the first seed, without any case of the suite, and with the next one if no earlier one found it.
A find is the first case that fails with the fault as it does not without it. Time is counted in cases: which case finds a
fault does not hang on how busy the machine is. Writes found.json, and the table of docs/fuzzing.md.
"""
import argparse
import json
import os
import pathlib
import statistics
import subprocess
import textwrap

HERE = pathlib.Path(__file__).resolve().parent
SOURCE = HERE.parents[1]
PROGRAM = os.environ.get("EDGECASE_RECORD_HUNT", str(SOURCE / "build" / "release" / "bin" / "record_hunt"))
FOUND, UNFOUND, PAGE = HERE / "found.json", HERE / "unfound.json", SOURCE / "docs" / "fuzzing.md"
BEGIN, END = "<!-- hunts -->\n", "<!-- end of hunts -->\n"
KINDS = {"layer": "lavapipe 22.3 through the breaking layer", "software": "the software rasterizer"}


def all_faults(kind):
    names = subprocess.run([PROGRAM, kind, "--cases", "0"], stdout=subprocess.PIPE, text=True, check=True).stdout
    return [line.split("\t")[0] for line in names.splitlines()]


def hunt(kind, names, seed, cases, jobs, log):
    """Name: [number of the first case that shows it or None, what is wrong with it]. What the log holds is not hunted
    again, so that a measurement that was interrupted goes on."""
    def read():
        rows = [line.split("\t") for line in log.read_text().splitlines()] if log.exists() else []
        return {name: [None if number == "-" else int(number), symptom] for name, number, symptom, _ in rows}
    left = [name for name in names if name not in read()]
    if left:
        command = [PROGRAM, kind, "--seed", str(seed), "--cases", str(cases), "--jobs", str(jobs), *left]
        with log.open("a") as out:
            subprocess.run(command, stdout=out, check=True)
    return read()


def unfound(rows):
    return [name for name, (number, _) in rows.items() if number is None]


def summary(record, reasons, kind):
    """What one kind of device says, as numbers."""
    first, *others = record[kind].values()
    never = unfound((others or [first])[-1])  # each seed hunts what no earlier one found
    reachable = [n for n in first if not reasons[kind].get(n, "").startswith("cannot")]
    numbers = [first[n][0] for n in reachable]
    return {
        "faults": len(first), "reachable": len(reachable),
        "first": sum(number is not None for number in numbers),
        "found": sum(n not in never for n in reachable),
        "median": statistics.median([record["cases"][kind] if number is None else number + 1 for number in numbers]),
        "never": never,
    }


def table(record, reasons):
    heads = ["what draws", "seeds", "cases a seed", "faults", "that cases can show", "found with the first seed",
             "found with one of the seeds", "median time to find with the first seed"]
    lines = [f"| {' | '.join(heads)} |", "| --- " * len(heads) + "|"]
    for kind, title in KINDS.items():
        if kind not in record:
            continue
        s = summary(record, reasons, kind)
        share = f"{100 * s['found'] / s['reachable']:.1f}".removesuffix(".0")
        cells = [title, ", ".join(record[kind]), record["cases"][kind], s["faults"], s["reachable"], s["first"],
                 f"{s['found']} ({share} %)", f"{s['median']:.0f} cases"]
        lines.append(f"| {' | '.join(map(str, cells))} |")
    later = [name for kind in KINDS for name in record.get("later", {}).get(kind, [])]
    if later:
        told = "Faults that came after this measurement and have not been hunted: " + ", ".join(f"`{n}`" for n in later) + "."
        lines += ["", *textwrap.wrap(told, 120, break_long_words=False, break_on_hyphens=False)]
    never = [(kind, name) for kind in KINDS if kind in record for name in summary(record, reasons, kind)["never"]]
    lines += ["", "Never found:", ""] if never else []
    for kind, name in never:
        text = f"* `{name}`: {reasons[kind].get(name, 'not known why')}"
        lines += textwrap.wrap(text, 120, subsequent_indent="  ", break_long_words=False, break_on_hyphens=False)
    return "\n".join(lines) + "\n"


def write_page(record, reasons):
    before, rest = PAGE.read_text().split(BEGIN)
    PAGE.write_text(before + BEGIN + table(record, reasons) + END + rest.split(END)[1])


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--kind", choices=KINDS, action="append", help="what draws (default: both)")
    parser.add_argument("--seeds", default="1,2,3")
    parser.add_argument("--cases", type=int, default=32768, help="of a hunt: about what a minute takes")
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--logs", default=str(SOURCE / "build" / "hunts"),
                        help="folder of what has been hunted; of another generator it is worth nothing")
    parser.add_argument("--page", action="store_true", help="only write the page's table from found.json")
    arguments = parser.parse_args()
    record = json.loads(FOUND.read_text()) if FOUND.exists() else {}
    reasons = json.loads(UNFOUND.read_text())
    if not arguments.page:
        logs = pathlib.Path(arguments.logs)
        logs.mkdir(parents=True, exist_ok=True)
        for kind in arguments.kind or KINDS:
            record.setdefault("cases", {})[kind] = arguments.cases
            record[kind] = {}
            record.get("later", {}).pop(kind, None)
            names = all_faults(kind)
            for seed in arguments.seeds.split(","):
                record[kind][seed] = hunt(kind, names, seed, arguments.cases, arguments.jobs, logs / f"{kind}-{seed}.tsv")
                names = unfound(record[kind][seed])
        FOUND.write_text(json.dumps(record, indent=0) + "\n")
    for kind in (k for k in KINDS if k in record):
        print(kind, summary(record, reasons, kind))
    write_page(record, reasons)


if __name__ == "__main__":
    main()
