# SPDX-FileCopyrightText: The Edgecase authors
# SPDX-License-Identifier: Apache-2.0
"""Runs the program on lavapipe through the layer that shows a device of another class."""
import json
import os
import pathlib
import subprocess
import sys
import tomllib

sys.path.append(str(pathlib.Path(__file__).parents[1]))  # shares.py

HERE = pathlib.Path(__file__).resolve().parent
SOURCE = HERE.parents[1]
PROGRAM = os.environ.get("EDGECASE_PROGRAM", str(SOURCE / "build" / "release" / "bin" / "edgecase"))
LAYER = pathlib.Path(os.environ.get("EDGECASE_DEVICE_CLASSES", SOURCE / "build" / "release" / "device_classes"))
# Numbers of VkFormat and bits of VkFormatFeatureFlagBits.
FORMATS = {"r16g16-sfloat": 83, "r16g16b16a16-sfloat": 97, "r32-sfloat": 100, "r32g32-sfloat": 103, "r32g32b32a32-sfloat": 109,
           "d16-unorm": 124, "x8-d24-unorm-pack32": 125, "d32-sfloat": 126, "d24-unorm-s8-uint": 129, "d32-sfloat-s8-uint": 130}
FEATURES = {"sampled": 0x1, "color": 0x80, "blend": 0x100, "depth": 0x200, "blit-src": 0x400, "blit-dst": 0x800, "linear": 0x1000,
            "transfer-src": 0x4000, "transfer-dst": 0x8000}


def names():
    return sorted(path.stem for path in (HERE / "classes").glob("*.toml"))


def read(name):
    return tomllib.loads((HERE / "classes" / (name + ".toml")).read_text(encoding="utf-8"))


def write_shown(device, path):
    """The facts of a class as the layer reads them, one a line."""
    lines = ["name " + device["name"], "api " + device["api"].replace(".", " "), f"samples {sum(device['samples'])}"]
    lines += ["feature " + name for name in device["features"]]
    lines += ["trap " + name for name in device.get("traps", [])]
    lines += ["extension " + name for name in device["extensions"]]
    lines += [f"limit {name} {value}" for name, value in device["limits"].items()]
    lines += [f"lacks {FORMATS[name]} {sum(FEATURES[f] for f in lacks)}" for name, lacks in device.get("lacks", {}).items()]
    pathlib.Path(path).write_text("\n".join(lines) + "\n", encoding="utf-8")


def environment(device, folder):
    env = {k: v for k, v in os.environ.items() if not k.startswith(("EDGECASE_", "VK_"))}
    if device is not None:
        shown = pathlib.Path(folder) / "class"
        write_shown(device, shown)
        env |= {"VK_LAYER_PATH": str(LAYER), "VK_INSTANCE_LAYERS": "VK_LAYER_EDGECASE_device_class",
                "EDGECASE_DEVICE_CLASS": str(shown)}
    return env


def doctor(device, folder, suite=SOURCE / "cases" / "suite"):
    """What doctor tells of a device of the class, above all what of the suite it can draw; nothing if it is not usable."""
    env = environment(device, folder) | {"EDGECASE_SUITE": str(suite)}
    done = subprocess.run([PROGRAM, "doctor", "--json"], env=env, capture_output=True, text=True)
    return next((d for d in json.loads(done.stdout)["devices"] if d["name"].startswith("llvmpipe")), None)


def run(device, folder, words=(), suite=SOURCE / "cases" / "suite"):
    """(exit code, results or nothing, what was printed) of a run on a device of the class; of nothing, on lavapipe itself."""
    out = pathlib.Path(folder) / "out"
    results = out / "results.json"
    results.unlink(missing_ok=True)
    command = [PROGRAM, "run", "--suite", str(suite), "--device", "llvmpipe", "--no-diagnosis", "-o", str(out),
               "--html", "/dev/null", *words]
    done = subprocess.run(command, env=environment(device, folder), capture_output=True, text=True)
    parsed = json.loads(results.read_text(encoding="utf-8")) if results.exists() else None
    return done.returncode, parsed, done.stdout + done.stderr
