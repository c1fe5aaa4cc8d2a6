#!/usr/bin/env python3
# SPDX-FileCopyrightText: The Edgecase authors
# SPDX-License-Identifier: Apache-2.0
"""Runs the suite under every fault of the breaking layer and writes who catches it.

Every fault is run over a part of the suite first (--part I/N; all of it with 1/1), then, if fewer than two families
have caught it, over the families that are about it. The result goes to two files: the table for people
(docs/breaking-layer.md) and the cases by which the test catches each fault (tests/breaking_layer/catches.json).
"""
import argparse
import collections
import json
import pathlib
import re
import sys
import tempfile

import broken

FOCUS = [  # families that are about the faults whose names match
    ("bare-.*", ["bare/**", "facing/**", "topology/**", "depth-test/**"]),
    ("blend|write-mask", ["blend/**", "store/**", "order/**", "combination/**", "resolve/**"]),
    ("^(clear|load)-", ["clear/**", "load/**"]),
    ("targets", ["color-targets/**", "combination/**"]),
    ("logic-op", ["logic/**", "combination/**"]),
    ("dual-source", ["dual-source/**", "combination/**"]),
    ("sample-location", ["multisample/**", "depth-bias/**", "resolve/**"]),
    ("alpha-to-one", ["alpha-to-one/**", "combination/**"]),
    ("alpha-to-coverage", ["alpha-to-coverage/**", "combination/**"]),
    ("sample|centroid", ["multisample/**", "interpolate-at/**", "derivative/**"]),
    ("query", ["query/**", "combination/**", "large/query*"]),
    ("statistics", ["statistics/**", "combination/**"]),
    ("frag-depth", ["frag-depth/**", "combination/**"]),
    ("fragment-(discard|demote|terminate)|early-tests", ["discard/**", "combination/**"]),
    ("resolve", ["resolve/**"]),
    ("flat|noperspective|provoking|attributes", ["attributes/**", "provoking/**", "combination/**", "order/**"]),
    ("clip-distance", ["clip-distance/**", "complement/**"]),
    ("cull-distance", ["cull-distance/**", "clip-distance/**"]),
    ("depth-bias", ["depth-bias/**", "depth/**"]),
    ("depth-bounds", ["depth-bounds/**", "combination/**"]),
    ("depth-cl", ["depth-clip/**", "depth-clamp/**", "depth/**", "clip/**"]),
    ("depth-c|depth-w|clear-depth", ["depth-test/**", "depth-bias/**", "depth/**", "order/**"]),
    ("depth-range", ["depth/**", "viewport/**", "depth-bias/**", "depth-clamp/**"]),
    ("stencil", ["stencil/**", "resolve/**", "combination/**"]),
    ("blit|upload|clear-image|read-back", ["blit/**", "field/**"]),
    ("viewport", ["viewport/**", "snap/**", "ties/**"]),
    ("discard", ["discard/**", "depth-test/**"]),
    ("scissor", ["scissor/**", "tiled/**", "viewport/**"]),
    ("cull|front-face", ["facing/**", "stencil/**", "topology/**"]),
    ("instance|divisor", ["instances/**", "order/**", "attributes/**"]),
    ("strip|list|fan|restart|index|vertex|draw", ["topology/**", "batch/**", "order/**", "combination/**", "mesh/**"]),
]


def judge_results(results):
    """What the run of one fault has found, as a plain dictionary."""
    caught = [case for case in results["cases"] if broken.is_caught(case)]
    named = [cause["rule"] for cause in results["causes"] if cause["rule"]]
    return {
        "cases": {case["id"]: [case["level"], case["compared_samples"], case["seconds"]] for case in caught},
        "rule": named[0] if named else "(not copied)" if caught else "",
        "run": len(results["cases"]),
    }


def family(case_id):
    return case_id.split("/")[0]


def merge(a, b):
    return {"cases": a["cases"] | b["cases"], "rule": b["rule"] or a["rule"], "run": a["run"] + b["run"],
            "altered": a["altered"] + b["altered"]}


def run_fault(name, selectors, folder, limit):
    words = ["--retries", "0", "--html", "/dev/null", "--capture", "none"]
    # Faults of pipelines as applications have them are seen by ways alone.
    words += ["--ways", "default"] if name.startswith("bare-") else []
    run = broken.run(name, selectors, folder, words=words, limit=limit)
    if run.results is None:
        return {"cases": {}, "rule": "", "run": 0, "altered": run.altered}
    return judge_results(run.results) | {"altered": run.altered}


def representatives(cases):
    """Up to two cases of different families, small ones first; of one family if there is only one."""
    order = sorted(cases, key=lambda i: (cases[i][1], i))
    out = order[:1]
    other = [i for i in order if family(i) != family(out[0])] if out else []
    return out + (other or order[1:])[:1]


def unseen():
    """The faults that no case can see on this driver, and why."""
    return json.loads((pathlib.Path(__file__).parent / "unseen.json").read_text())


def table(faults, found):
    lines = []
    for name, sentence in faults:
        if name not in found:
            continue
        r = found[name]
        if not r["cases"] and name in unseen():
            lines.append(f"| `{name}` | {sentence} | - | {unseen()[name]} | 0 | - |")
            continue
        levels = collections.Counter(level for level, _, _ in r["cases"].values())
        loosest = next((p for p in ("vulkan", "practice", "direct3d") if levels[p]), "-")
        families = len({family(i) for i in r["cases"]})
        told = f"{len(r['cases'])} of {r['run']}" if r["altered"] else "not reached"
        lines.append(f"| `{name}` | {sentence} | {loosest} | {told} | {families} | {r['rule'] or '-'} |")
    return lines


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--part", default="1/1", help="I/N: the I-th of N parts of the suite (default: all of it)")
    parser.add_argument("--focus-part", default="1/1", help="the same for the families that are about a fault")
    parser.add_argument("--limit", type=float, default=600, help="seconds for one run; what is done by then counts")
    parser.add_argument("--state", default="breaking-matrix.json", help="results so far: a fault in it is not run again")
    parser.add_argument("--page", help="the page whose table is replaced")
    parser.add_argument("--catches", help="the file of catching cases to write")
    parser.add_argument("fault", nargs="*", help="regular expressions of faults to run (default: all)")
    arguments = parser.parse_args()
    state = pathlib.Path(arguments.state)
    found = json.loads(state.read_text()) if state.exists() else {}
    faults = [f for f in broken.faults() if not broken.is_deadly(f[0])]
    for name, _ in faults:
        wanted = not arguments.fault or any(re.fullmatch(p, name) for p in arguments.fault)
        if name in found or not wanted:
            continue
        with tempfile.TemporaryDirectory(prefix="edgecase-breaking-") as folder:
            whole = arguments.part == "1/1"
            found[name] = run_fault(name, [] if whole else ["--shard", arguments.part], folder, arguments.limit)
            if not whole and len({family(i) for i in found[name]["cases"]}) < 2:
                focus = next((f for pattern, f in FOCUS if re.search(pattern, name)), [])
                if focus:
                    focus = [*focus, "--shard", arguments.focus_part]
                    found[name] = merge(found[name], run_fault(name, focus, folder, arguments.limit))
        r = found[name]
        families = len({family(i) for i in r["cases"]})
        print(f"{name}: altered {r['altered']}, caught by {len(r['cases'])} of {r['run']} in {families} families", flush=True)
        state.write_text(json.dumps(found, indent=0))
    if arguments.page:
        page = pathlib.Path(arguments.page)
        begin, end = "<!-- table -->\n", "<!-- end of table -->\n"
        before, rest = page.read_text().split(begin)
        head = ["| fault | the driver's error | profile | cases | families | first rule |", "| --- | --- | --- | --- | --- | --- |"]
        page.write_text(before + begin + "\n".join(head + table(faults, found)) + "\n" + end + rest.split(end)[1])
    if arguments.catches:
        catches = {name: representatives(found[name]["cases"]) for name, _ in faults if found.get(name, {}).get("cases")}
        pathlib.Path(arguments.catches).write_text(json.dumps(catches, indent=1) + "\n")
    survivors = [name for name, r in found.items() if not r["cases"] and name not in unseen()]
    if survivors:
        print(f"not caught: {', '.join(survivors)}", file=sys.stderr)
    return 1 if survivors else 0


if __name__ == "__main__":
    sys.exit(main())
