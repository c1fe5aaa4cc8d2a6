#!/usr/bin/env python3
# SPDX-FileCopyrightText: The Edgecase authors
# SPDX-License-Identifier: Apache-2.0
"""Fails when an include breaks the arrows between the rooms (docs/design.md, "Rooms").

usage: check_includes.py SOURCE_DIR | --self-test
"""
import pathlib
import re
import sys
import tempfile

# What each room may include, itself included.
MAY_KNOW = {
    "cases": {"cases"},
    "ref": {"ref", "cases"},
    "diff": {"diff", "cases", "ref"},
    "vk_harness": {"vk_harness", "cases", "capture/capture.hpp"},
    "report": {"report", "diff", "cases"},
    "cli": {"cli", "cases", "ref", "diff", "vk_harness", "report"},
}
# The Vulkan headers and loader belong to one room; image files to one module.
ONLY_IN = {
    re.compile(r"^(vulkan/|volk\.|vk_)"): {"vk_harness"},
    re.compile(r"^OpenImageIO/"): {"report/image_io"},
    re.compile(r"^CLI/"): {"cli"},
    re.compile(r"^toml\+\+/|^toml\.hpp"): {"cases"},
}
INCLUDE = re.compile(r'^\s*#\s*include\s*[<"]([^">]+)[">]')


def problems(root: pathlib.Path):
    for room, known in MAY_KNOW.items():
        files = [p for p in (root / room).rglob("*") if p.suffix in {".cpp", ".hpp"}]
        for path in files:
            relative = path.relative_to(root)
            for number, line in enumerate(path.read_text(errors="replace").splitlines(), 1):
                match = INCLUDE.match(line)
                if not match:
                    continue
                name = match.group(1)
                first = name.split("/")[0]
                if first in MAY_KNOW and first not in known and name not in known:
                    yield f"{relative}:{number}: error: {room}/ must not know {name}; see docs/design.md, Rooms"
                for pattern, rooms in ONLY_IN.items():
                    if pattern.match(name) and first not in MAY_KNOW and not any(
                        str(relative).startswith(r + "/") for r in rooms
                    ):
                        yield f"{relative}:{number}: error: {name} may be included in {', '.join(sorted(rooms))}/ alone"


def self_test() -> int:
    with tempfile.TemporaryDirectory() as name:
        root = pathlib.Path(name)
        for room in MAY_KNOW:
            (root / room).mkdir()
        (root / "ref/a.cpp").write_text('#include "vk_harness/harness.hpp"\n#include <gmpxx.h>\n')
        (root / "diff/b.hpp").write_text("#include <vulkan/vulkan.h>\n")
        (root / "vk_harness/c.cpp").write_text('#include "capture/capture.hpp"\n#include "diff/verdict.hpp"\n#include <volk.h>\n')
        found = sorted(problems(root))
    expected = ["diff/b.hpp:1", "ref/a.cpp:1", "vk_harness/c.cpp:2"]
    if [f.split(": error")[0] for f in found] != expected:
        print("the check does not see planted breaches:", *found, sep="\n")
        return 1
    return 0


def main() -> int:
    if sys.argv[1:] == ["--self-test"]:
        return self_test()
    found = list(problems(pathlib.Path(sys.argv[1])))
    print("\n".join(found) or "all includes follow the rooms")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
