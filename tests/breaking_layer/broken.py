# SPDX-FileCopyrightText: The Edgecase authors
# SPDX-License-Identifier: Apache-2.0
"""Runs the program on lavapipe through the breaking layer."""
import ctypes
import dataclasses
import json
import os
import pathlib
import subprocess
import sys

sys.path.append(str(pathlib.Path(__file__).parents[1]))  # shares.py

SOURCE = pathlib.Path(__file__).resolve().parents[2]
PROGRAM = os.environ.get("EDGECASE_PROGRAM", str(SOURCE / "build" / "release" / "bin" / "edgecase"))
LAYER = pathlib.Path(os.environ.get("EDGECASE_BREAKING_LAYER", SOURCE / "build" / "release" / "breaking_layer"))
# They end the process or the device: no verdict on a picture is asked of them.
DEADLY = ("lost-", "hang-", "crash-", "pipeline-refused", "refused-")


@dataclasses.dataclass
class Run:
    code: int | None  # nothing if it was stopped at the limit
    altered: int      # calls that the layer altered
    results: dict | None
    out: str
    err: str


def table():
    """Name, sentence and row of the catalogue (cases/fault; "-" for none) of each fault, from the layer itself."""
    library = ctypes.CDLL(str(LAYER / "libbreaking_layer.so"))
    library.edgecase_breaking_faults.restype = ctypes.c_char_p
    text = library.edgecase_breaking_faults().decode()
    return [tuple(line.split("\t")) for line in text.splitlines()]


def faults():
    return [(name, sentence) for name, sentence, _ in table()]


def is_deadly(name):
    return name.startswith(DEADLY)


def is_caught(case):
    """Whether a result says that the picture is wrong, or that there is none. Crashes and the like do not count."""
    return case["status"] in ("fail", "flake") or (case["status"] == "error" and "was not copied from the device" in case["reason"])


def run(fault, selectors, folder, words=(), limit=120):
    """One run of the suite under a fault ("" for none); its folder holds the reports and the count."""
    folder = pathlib.Path(folder)
    count = folder / "altered"
    count.write_bytes(b"")
    results = folder / "out" / "results.json"
    results.unlink(missing_ok=True)
    env = {k: v for k, v in os.environ.items() if not k.startswith(("EDGECASE_", "VK_"))}
    env |= {"VK_LAYER_PATH": str(LAYER), "VK_INSTANCE_LAYERS": "VK_LAYER_EDGECASE_breaking", "EDGECASE_BREAK": fault,
            "EDGECASE_BREAK_COUNT": str(count)}
    command = [PROGRAM, "run", "--suite", str(SOURCE / "cases" / "suite"), "--device", "llvmpipe", "-o", str(folder / "out"),
               *words, *selectors]
    process = subprocess.Popen(command, env=env, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    code = None
    try:
        out, err = process.communicate(timeout=limit)
        code = process.returncode
    except subprocess.TimeoutExpired:
        process.terminate()
        try:
            out, err = process.communicate(timeout=30)
        except subprocess.TimeoutExpired:
            process.kill()
            out, err = process.communicate()
    parsed = json.loads(results.read_text(encoding="utf-8")) if results.exists() else None
    return Run(code, count.stat().st_size, parsed, out, err)
