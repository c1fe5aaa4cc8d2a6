#!/usr/bin/env python3
# SPDX-FileCopyrightText: The Edgecase authors
# SPDX-License-Identifier: Apache-2.0
"""Disturbs runs, hunts and reductions (README.md) and ends with 1 if one harms, hangs or loses something.
usage: chaos.py [--seed N] [--minutes M | --rounds N | --round K...] [--keep]"""
import argparse
import collections
import os
import shutil
import sys
import time

import rounds
from place import PROGRAM

COLUMNS = ("rounds", "equal", "named", "resumed", "ended", "not tried", "wrong")


def isolate():
    """Goes on in a mount namespace of its own, so that disks can be small and read-only."""
    if "EDGECASE_CHAOS_ISOLATED" not in os.environ:
        os.environ["EDGECASE_CHAOS_ISOLATED"] = "1"
        if shutil.which("unshare") and os.system("unshare -m true 2>/dev/null") == 0:
            os.execvp("unshare", ["unshare", "-m", sys.executable, *sys.argv])


def table(outcomes):
    """Counts by disturbance, in Markdown."""
    counts = collections.defaultdict(collections.Counter)
    for outcome in outcomes:
        counts[outcome.on.kind]["wrong" if outcome.problems else outcome.word] += 1
        counts[outcome.on.kind]["rounds"] += 1
    lines = ["| disturbance | " + " | ".join(COLUMNS) + " |", "| --- |" + " --- |" * len(COLUMNS)]
    for kind, count in counts.items():
        lines.append(f"| {kind} | " + " | ".join(str(count[column]) for column in COLUMNS) + " |")
    return "\n".join(lines)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--minutes", type=float, default=10)
    parser.add_argument("--rounds", type=int, help="so many instead of a time")
    parser.add_argument("--round", type=int, nargs="+", help="these alone")
    parser.add_argument("--keep", action="store_true", help="keep the folders of rounds that are wrong")
    options = parser.parse_args()
    isolate()
    print(f"chaos: seed {options.seed}, {PROGRAM}", flush=True)
    undisturbed = rounds.Undisturbed()
    outcomes = []
    end = time.monotonic() + options.minutes * 60
    numbers = options.round or (range(options.rounds) if options.rounds else iter(int, 1))
    for k, number in enumerate(numbers):
        if not options.round and not options.rounds:
            number = k
            if time.monotonic() >= end:
                break
        on, work = rounds.choose(options.seed, number)
        outcome = rounds.perform(on, work, undisturbed, options.keep)
        outcomes.append(outcome)
        word = "WRONG" if outcome.problems else outcome.word
        print(f"round {number}: {on.kind} ({on.what}), {outcome.workload}: {word}, {outcome.hits} hits, "
              f"exit {' then '.join(map(str, outcome.exits))}, {outcome.seconds:.1f} s", flush=True)
        for problem in outcome.problems[:5]:
            print(f"    {problem}")
        if outcome.problems:
            print(f"    again: tests/chaos/chaos.py --seed {options.seed} --round {number} --keep"
                  + (f"    folder: {outcome.folder}" if options.keep else ""), flush=True)
    print(f"\n{table(outcomes)}")
    return 1 if any(outcome.problems or outcome.word == "not tried" for outcome in outcomes) else 0


if __name__ == "__main__":
    sys.exit(main())
