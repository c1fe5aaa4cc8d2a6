#!/usr/bin/env python3
# SPDX-FileCopyrightText: The Edgecase authors
# SPDX-License-Identifier: Apache-2.0
"""Asks doctor of every class and writes docs/devices.md: what share of the suite each device runs, and what it lacks."""
import collections
import pathlib
import re
import sys
import tempfile
import textwrap

import device_classes

HEAD = """# What real devices run of the suite

Of real GPUs NVIDIA's have run the suite ([results](results)). What a device can run follows from what it advertises, so
the layer in [tests/device_classes](../tests/device_classes/README.md) makes lavapipe look like a device of each class:
its features, limits, formats and extensions, as drivers' sources and reports publish them; the files beside it say of
each figure where it is from and which are estimates. The layer ends the process when something that the class does not
advertise is used. Nothing fails under a class that does not fail on lavapipe itself. Cases that read single samples
of D24 count as run, but are unsupported where a device's shaders read two of its codes as one number: it can be told
only when one is met (lavapipe's do with the two largest codes).

`cmake --build --preset release --target devices_page` asks `edgecase doctor` of every class and writes this page; a
test compares it. *Unsupported* is the share of the suite's cases, *aim* what it shall be at most, *hits* in which
numbers hits are counted. *By the harness* are those of the unsupported cases that the device could draw, but of which
the harness cannot count the hits or read single samples there; of all others the device lacks something that the case
is about. *Untried* are cases that the class might run and lavapipe cannot: it has 1 and 4 samples a pixel alone. Other
tests hold what `doctor` says to what runs say, and draw a share of the suite under every class.

| class | Vulkan | unsupported | aim | by the harness | untried | hits |
| --- | --- | --- | --- | --- | --- | --- |
"""
# Reasons that say something of how pictures are looked at.
BY_HARNESS = re.compile(r"hits (are counted )?up to|single samples|the harness tells|tell \d+ apart|colour attachments, the device has")


def reasons_of(lacking):
    """How many cases each reason leaves unsupported; numbers that differ from case to case are left out."""
    counts = collections.Counter()
    for reason, cases in lacking:
        counts[re.sub(r"\b\d+ (?=times|vertices|colour attachments, the|samples|viewports)", "N ", reason)] += cases
    return counts


RESOLVES = {"SAMPLE_ZERO": 1, "AVERAGE": 2, "MIN": 4, "MAX": 8}


def lavapipe_alone_lacks(device, reason):
    """Whether the class has what the reason misses: then it is lavapipe that lacks it."""
    if found := re.search(r"does not draw (\d+) samples a pixel|target of format \S+ with (\d+) samples|_S8_UINT at sample count (\d+)",
                          reason):
        return int(next(group for group in found.groups() if group)) in device["samples"] and "at sample count 1" not in reason
    if found := re.search(r"resolve depth by (\w+)", reason):
        return bool(device["limits"].get("supportedDepthResolveModes", 15) & RESOLVES[found[1]])
    if "independentResolveNone" in reason:
        return device["limits"].get("independentResolveNone") == 1
    for text, facts in (("fragmentShaderBarycentric", "features"), ("VK_EXT_sample_locations", "extensions"), ("depthBiasControl", "features"),
                        ("depthBounds", "features"), ("pipelineFragmentShadingRate", "features"), ("VK_EXT_conservative_rasterization", "extensions")):
        if text in reason:
            return text in device[facts]
    return False


def facts(device, told, printed):
    """What the page says of one class: numbers, reasons and nothing of the run. `told`: by doctor; `printed`: by a run
    on a class of which doctor says that no case can run."""
    if told is None or told["suite"] is None:
        lines = [line.strip() for line in printed.splitlines() if "device 0" in line]
        return {"all": 0, "unsupported": None, "alone": 0, "reasons": lines or [printed.strip()], "hits": "-"}
    lacking = [(reason["reason"], reason["cases"]) for reason in told["suite"]["lacking"]]
    alone = [(reason, cases) for reason, cases in lacking if lavapipe_alone_lacks(device, reason)]
    counts = reasons_of(row for row in lacking if row not in alone)
    return {"all": told["suite"]["cases"], "unsupported": sum(counts.values()), "alone": sum(cases for _, cases in alone),
            "hits": told["hit_counting"], "reasons": sorted(counts.items(), key=lambda item: (-item[1], item[0]))}


def section(device, found):
    if found["unsupported"] is None:
        text = f"\n## {device['name']}\nNo case can run:\n\n"
        reasons = [re.sub(r"^.*?device 0 \(.*?\)\): ", "", line) for line in found["reasons"]]
        return text + "".join(textwrap.fill("* " + line, 120, subsequent_indent="  ", break_on_hyphens=False) + "\n" for line in reasons)
    if not found["reasons"]:
        return f"\n## {device['name']}\nEverything runs.\n"
    rows = "".join(f"| {count} | {reason.replace('|', '/')} |\n" for reason, count in found["reasons"])
    return f"\n## {device['name']}\n| cases | why they are unsupported |\n| --- | --- |\n{rows}"


def by_harness(found):
    """How many cases are unsupported by the harness; nothing is told of a device that runs none."""
    return "-" if found["unsupported"] is None else sum(count for reason, count in found["reasons"] if BY_HARNESS.search(reason))


def page(all_found):
    table, sections = "", ""
    for name, found in all_found.items():
        device = device_classes.read(name)
        share = "100 %" if found["unsupported"] is None else f"{100 * found['unsupported'] / found['all']:.1f} %"
        table += (f"| {device['name']} | {device['api']} | {share} | {device['aim']} % | {by_harness(found)} | {found['alone']} "
                  f"| {found['hits']} |\n")
        sections += section(device, found)
    return HEAD + table + sections


def measure(name):
    device = device_classes.read(name)
    with tempfile.TemporaryDirectory(prefix="edgecase-class-") as folder:
        told = device_classes.doctor(device, folder)
        printed = device_classes.run(device, folder, ["coverage/half-square"])[2] if told is None or told["suite"] is None else ""
        return facts(device, told, printed)


def main():
    path = pathlib.Path(sys.argv[1])
    names = sys.argv[2:] or device_classes.names()
    found = {name: measure(name) for name in names}
    text = page(found)
    if sys.argv[2:]:
        print(text)
    else:
        path.write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
