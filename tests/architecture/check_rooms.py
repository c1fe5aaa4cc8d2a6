#!/usr/bin/env python3
# SPDX-FileCopyrightText: The Edgecase authors
# SPDX-License-Identifier: Apache-2.0
"""Holds the sources to the table of folders in docs/design.md ("Rooms and folders").

Each row of that table names a folder, the file to read first, and the folders that it may include (a folder stands
for all inside it). Checked: every folder with sources has one row; includes follow the rows; the arrows run one way;
the file to read first exists; a folder has at most MOST_FILES files; libraries stay where they belong; no file is
compiled into two libraries; nothing lists the planes of a capture or the fields of a structure a second time.

usage: check_rooms.py SOURCE_DIR [COMPILE_COMMANDS] | --self-test
"""
import collections
import json
import pathlib
import re
import shutil
import sys
import tempfile

MOST_FILES = 24
# Third-party headers that belong to one folder (with the folders inside).
ONLY_IN = {
    r"(vulkan/|volk\.|vk_)": "vk_harness",
    r"OpenImageIO/": "capture/image/image_io",
    r"CLI/": "cli/options",
    r"toml(\+\+/|\.hpp)": "cases/toml",
}
INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^">]+)[">]')
SUFFIXES = {".cpp", ".hpp", ".js"}


class Table:
    """The rows of docs/design.md: | `folder/` | what | `first` | `may`, `include` |"""

    def __init__(self, root: pathlib.Path):
        self.rows = {}
        self.twice = []
        text = (root / "docs/design.md").read_text()
        for line in text.splitlines():
            cells = [c.strip() for c in line.strip().strip("|").split("|")]
            if len(cells) != 4 or not re.fullmatch(r"`[\w/]+/`", cells[0]):
                continue
            folder = cells[0].strip("`/")
            if folder in self.rows:
                self.twice.append(folder)
            may = [m.rstrip("/") for m in re.findall(r"`([\w/]+)`", cells[3])]
            self.rows[folder] = (cells[2].strip("`"), may)
        self.rooms = {folder.split("/")[0] for folder in self.rows}

    def allows(self, folder: str, other: str) -> bool:
        return folder == other or any(other == m or other.startswith(m + "/") for m in self.rows[folder][1])


def code_of(path: pathlib.Path):
    return path.read_text(errors="replace").splitlines()


def sources(root: pathlib.Path, room: str):
    return sorted(p for p in (root / room).rglob("*") if p.suffix in SUFFIXES)


def folder_problems(root, table):
    for folder in table.twice:
        yield f"docs/design.md: error: two rows claim the folder {folder}/"
    files = collections.Counter(str(p.parent.relative_to(root)) for r in table.rooms for p in sources(root, r))
    for folder, count in sorted(files.items()):
        if folder not in table.rows:
            yield f"{folder}: error: no row of docs/design.md tells what lives in this folder"
        elif count > MOST_FILES:
            yield f"{folder}: error: {count} files; a folder holds at most {MOST_FILES}, so divide it"
    for folder, (first, _) in table.rows.items():
        if not (root / folder / first).is_file():
            yield f"docs/design.md: error: the file to read first, {folder}/{first}, is not there"


def include_problems(root, table):
    arrows = collections.defaultdict(set)
    for room in sorted(table.rooms):
        for path in sources(root, room):
            relative = path.relative_to(root)
            folder = str(relative.parent)
            if folder not in table.rows:
                continue
            for number, line in enumerate(code_of(path), 1):
                match = INCLUDE.match(line)
                if not match:
                    continue
                name = match.group(2)
                other = name.rpartition("/")[0]
                if other.split("/")[0] in table.rooms:
                    if other != folder:
                        arrows[folder].add(other)
                    if not table.allows(folder, other):
                        yield f"{relative}:{number}: error: {folder}/ must not include {name}; see docs/design.md"
                for pattern, home in ONLY_IN.items():
                    if re.match(pattern, name) and not (folder + "/").startswith(home + "/"):
                        yield f"{relative}:{number}: error: {name} may be included in {home}/ alone"
    yield from circles(arrows)


def circles(arrows):
    """Folders that include each other, directly or around: each circle once."""
    done = set()

    def visit(folder, path):
        if folder in path:
            yield path[path.index(folder):] + [folder]
        elif folder not in done:
            for other in sorted(arrows.get(folder, ())):
                yield from visit(other, path + [folder])
            done.add(folder)

    for folder in sorted(arrows):
        for circle in visit(folder, []):
            yield f"{circle[0]}: error: folders include each other: {' -> '.join(circle)}"


def library_problems(commands: pathlib.Path, root: pathlib.Path):
    """A source of a room is compiled once: one room, one library."""
    owners = collections.defaultdict(set)
    for entry in json.loads(commands.read_text()):
        source = pathlib.Path(entry["directory"], entry["file"]).resolve()
        target = re.search(r"CMakeFiles/([^/]+)\.dir/", entry.get("output", entry["command"]))
        if source.is_relative_to(root) and target:
            owners[source.relative_to(root)].add(target.group(1))
    for source, targets in sorted(owners.items()):
        if len(targets) > 1 and source.parts[0] != "tests":
            yield f"{source}: error: two libraries claim this file: {', '.join(sorted(targets))}"


@@LISTS@@

def problems(root: pathlib.Path, commands=None):
    table = Table(root)
    yield from folder_problems(root, table)
    yield from include_problems(root, table)
    yield from second_lists(root, table)
    if commands:
        yield from library_problems(commands, root)


@@SELFTEST@@

def main() -> int:
    if sys.argv[1:2] == ["--self-test"]:
        return self_test(pathlib.Path(sys.argv[2]).resolve())
    commands = pathlib.Path(sys.argv[2]) if len(sys.argv) > 2 else None
    found = list(problems(pathlib.Path(sys.argv[1]).resolve(), commands))
    print("\n".join(found) or "all sources follow the table of folders")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
