#!/usr/bin/env python3
# SPDX-FileCopyrightText: The Edgecase authors
# SPDX-License-Identifier: Apache-2.0
"""Holds the sources to the table of folders in docs/design.md ("Rooms and folders").

Each row of that table names a folder, the file to read first, and the folders that it may include (a folder stands
for all inside it). Checked: every folder with sources has one row; includes follow the rows; the arrows run one way;
the file to read first exists; libraries stay where they belong; a source is compiled into one library; nothing lists
the planes of a capture or the fields of a structure a second time; a source has its header, the functions of a class
have one file, and a command has a file with its name; identifiers of Vulkan stand in the rooms that draw by it alone.

usage: check_rooms.py SOURCE_DIR [COMPILE_COMMANDS] | --self-test
"""
import collections
import json
import pathlib
import re
import shutil
import sys
import tempfile

# Third-party headers that belong to one folder (with the folders inside).
ONLY_IN = {
    r"(vulkan/|volk\.|vk_(?!harness/))": "vk_harness",
    r"OpenImageIO/": "capture/image/image_io",
    r"CLI/": "cli",
    r"toml(\+\+/|\.hpp)": "cases/toml",
}
FACTORY = "cli/renderers"  # the table of renderers, which alone knows the harness
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
                continue
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
    for folder in sorted({str(p.parent.relative_to(root)) for r in table.rooms for p in sources(root, r)}):
        if folder not in table.rows:
            yield f"{folder}: error: no row of docs/design.md tells what lives in this folder"
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
                if other.startswith("vk_harness/") and not folder.startswith(("vk_harness", FACTORY)):
                    yield f"{relative}:{number}: error: {name} may be included in vk_harness/ and {FACTORY}/ alone"
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
    """A source of a room is compiled once: one room, one library; and every source is."""
    owners = collections.defaultdict(set)
    for entry in json.loads(commands.read_text()):
        file = pathlib.Path(entry["directory"], entry["file"])
        target = re.search(r"CMakeFiles/([^/]+)\.dir/", entry.get("output", entry["command"]))
        one_of = [file]
        if re.search(r"/Unity/unity_\w+\.cxx$", str(file)):  # files compiled as one (EDGECASE_UNITY)
            one_of = [pathlib.Path(name) for name in re.findall(r'^#include "(.*)"', file.read_text(), re.M)]
        for source in (each.resolve() for each in one_of):
            if source.is_relative_to(root) and target:
                owners[source.relative_to(root)].add(target.group(1))
    for source, targets in sorted(owners.items()):
        if len(targets) > 1 and source.parts[0] != "tests":
            yield f"{source}: error: two libraries claim this file: {', '.join(sorted(targets))}"
    for folder in sorted({source.parent for source in owners}):  # others are of libraries that are not installed
        for source in sorted(p.relative_to(root) for p in (root / folder).glob("*.cpp")):
            if source not in owners and source.parts[0] != "tests":
                yield f"{source}: error: nobody compiles this file"


DEFINED = re.compile(r"^(?![ #/}])(?:[^()\n=;]*[ &*>])?(\w+)\(", re.M)  # free functions
MEMBER = re.compile(r"^(?![ #/}])(?:[^()\n=;]*[ &*>])?(\w+)(?:::\w+)*::~?(?:\w+|operator\S+)\(", re.M)
DECLARED = re.compile(r"^(?:class|struct) (\w+)(?: final)?(?: :|\s*\{)", re.M)
COMMAND = re.compile(r"^Command ((\w+)_command)\(", re.M)


def has_header(path, text):
    """Its own; or it holds one part of several: 'X_table_pipes.cpp' beside 'X.hpp', or the function that a header of
    its folder declares and that has its name ('grid.cpp' holds generate_grid). Programs have none, nor what linkers
    or macros of a library make.
    """
    words = path.stem.split("_")
    if any(path.with_name("_".join(words[:k]) + ".hpp").is_file() for k in range(len(words), 0, -1)):
        return True
    if not DEFINED.search(text) and not MEMBER.search(text):
        return True  # a library's implementation, which macros make
    own = {name for name in DEFINED.findall(text) if f"_{path.stem}_" in f"_{name}_"}
    headers = [code.read_text(errors="replace") for code in path.parent.glob("*.hpp")]
    return "main" in DEFINED.findall(text) or 'extern "C"' in text or any(
        re.search(rf"\b{name}\(", header) for name in own for header in headers)


def home_problems(root, table):
    """A source has a header, a class one file for its functions: the one beside its header."""
    for room in sorted(table.rooms):
        texts = {p: p.read_text(errors="replace") for p in sources(root, room) if p.suffix != ".js"}
        homes = collections.defaultdict(set)
        for path, text in texts.items():
            for name in DECLARED.findall(text):
                homes[name].add(path.with_suffix(".cpp"))
        for path, text in texts.items():
            name = str(path.relative_to(root))
            if path.suffix != ".cpp":
                continue
            if not has_header(path, text):
                yield f"{name}: error: this source has no header; give it one, or the name of what a header declares"
            for owner in sorted(set(MEMBER.findall(text))):
                if owner in homes and path not in homes[owner]:
                    home = min(str(p.relative_to(root)) for p in homes[owner])
                    yield f"{name}: error: functions of {owner} are here, whose home is {home}"


def command_problems(root):
    """The command 'edgecase NAME' is cli/NAME.cpp."""
    for function, name in COMMAND.findall((root / "cli/commands.hpp").read_text()):
        home = root / "cli" / f"{name}.cpp"
        if not home.is_file() or function not in DEFINED.findall(home.read_text()):
            yield f"cli/commands.hpp: error: the command '{name}' is not in cli/{name}.cpp"


FIELDS = re.compile(r"static void fields\(auto&& \w+, auto&\.\.\. \w+\) \{(.*?)\n    \}", re.S)
STRUCT = re.compile(r"^(?:struct|class) (\w+)", re.M)
PLANES = "capture/capture.hpp"
LEAST_FIELDS = 8  # smaller structures are used field by field everywhere
MOST_SHARE = 0.9  # of the entries, within two lines an entry


def lists_of(root, table):
    """(what it lists, file that owns the list, names): structures with `fields`, and the planes of a capture."""
    for room in sorted(table.rooms):
        for path in sources(root, room):
            text = path.read_text(errors="replace")
            for match in FIELDS.finditer(text):
                names = re.findall(r'visit\("(\w+)"|visit\(Field\("(\w+)"|visit\(\{"(\w+)"', match.group(1))
                names = [a or b or c for a, b, c in names]
                owners = STRUCT.findall(text[: match.start()])
                if len(names) >= LEAST_FIELDS and owners:
                    yield f"the fields of {owners[-1]}", str(path.relative_to(root)), names
    if (root / PLANES).is_file():
        names = re.findall(r'\badd\("(\w+)"', (root / PLANES).read_text())
        if len(names) >= LEAST_FIELDS - 2:
            yield "the planes of a capture", PLANES, names


def entries_of(names, is_plane):
    """What finds a listed entry in a line: a plane that is named, a field copied or sent under its own name."""
    name = "(" + "|".join(names) + r")\b(?!\()"
    if is_plane:
        return [re.compile(rf"(?:\.|->){name}")]
    return [re.compile(rf"(?:\.|->){name} = .*(?:\.|->)\1\b"), re.compile(rf'"{name}", [^"]*(?:\.|->)\1\b')]


def second_lists(root, table):
    """Nothing but a list's owner has most of its entries, one after the other."""
    texts = {
        path.relative_to(root): [
            (number, line.split("//")[0])
            for number, line in enumerate(code_of(path), 1)
            if not line.lstrip().startswith(("visit(", "//"))  # `fields` of another structure, comments
        ]
        for room in table.rooms
        for path in sources(root, room)
        if path.suffix != ".js"
    }
    for what, owner, names in lists_of(root, table):
        entries = entries_of(names, owner == PLANES)
        for path, lines in texts.items():
            if str(path) == owner:
                continue
            hits = [(n, m) for n, line in lines for entry in entries for m in entry.findall(line)]
            for k, (begin, _) in enumerate(hits):
                seen = {m for n, m in hits[k:] if n < begin + 2 * len(names)}
                if len(seen) >= MOST_SHARE * len(names):
                    yield f"{path}:{begin}: error: this lists {what} a second time; walk the list of {owner}"
                    break


# What only its home does, since limits, links and hostile names are met there: what, words of code, homes.
HOMES = (
    ("starts a thread", re.compile(r"std::(thread\(|async\(|jthread)|\bpthread_create\b"), {"cases/base/parallel.hpp"}),
    ("makes a file", re.compile(r"std::ofstream\b|\bO_CREAT\b|\bO_TMPFILE\b|\bfopen\((?!\"/dev/null)"),
     {"cases/base/output_file.cpp", "report/journal/journal.cpp", "cli/prepare/ci.cpp", "cli/bench.cpp", "shaders/compile.cpp"}),
    ("starts a shell", re.compile(r"std::system\(|\bpopen\(|\"/bin/sh\""), {"cli/fuzzing/captures_command.cpp"}),
)


def homeless(root, table):
    for room in sorted(table.rooms):
        for path in sources(root, room):
            name = str(path.relative_to(root))
            for number, line in enumerate(code_of(path), 1):
                for what, words, homes in HOMES:
                    if name not in homes and path.suffix in (".cpp", ".hpp") and words.search(line.split("//")[0]):
                        yield f"{name}:{number}: error: this {what}, which is done in {', '.join(sorted(homes))} alone"


# Vulkan's words are the harness's, the shaders' and the reproducer's C program's: in code, or as a whole literal (the
# name of a variable, of a file). Sentences quote them; rules and statements name them as anchors of the specification.
API_ROOMS = ("vk_harness/", "shaders/", "cli/reproducer/")
API_ANCHORS = ("cases/model/rule.cpp", "cases/statement/")
API_WORD = re.compile(r"\b(?:vk[A-Z]|Vk[A-Z]|VK_[A-Z]|PFN_|volk|[Ss]pirv|SPIRV|Spv[A-Z])\w*")
CODE = re.compile(r'"((?:[^"\\\n]|\\.)*)"|//[^\n]*|/\*.*?\*/', re.S)


def api_words(root, table):
    """Identifiers of the API in rooms that know none."""
    for room in sorted(table.rooms):
        for path in sources(root, room):
            name = str(path.relative_to(root))
            if name.startswith(API_ROOMS):
                continue

            def without_sentences(match):
                literal = match.group(1) or ""
                is_word = API_WORD.fullmatch(literal) and not name.startswith(API_ANCHORS)
                return literal if is_word else "\n" * match.group(0).count("\n")

            code = CODE.sub(without_sentences, path.read_text(errors="replace"))
            for number, line in enumerate(code.splitlines(), 1):
                for word in API_WORD.findall(line):
                    yield f"{name}:{number}: error: {word} is an identifier of the API, which {room}/ does not know"


def problems(root: pathlib.Path, commands=None):
    table = Table(root)
    yield from folder_problems(root, table)
    yield from include_problems(root, table)
    yield from second_lists(root, table)
    yield from homeless(root, table)
    yield from api_words(root, table)
    yield from home_problems(root, table)
    yield from command_problems(root)
    if commands:
        yield from library_problems(commands, root)


def plant(root, name, text):
    with (root / name).open("a") as file:
        file.write(text)


def plant_commands(root, compiled):
    """What compiles the sources of diff/: pairs of a target and a file, all files once but for `compiled`'s."""
    pairs = compiled + [("edgecase_diff", p.name) for p in (root / "diff").glob("*.cpp") if p.name != "verdict.cpp"]
    (root / "commands.json").write_text(json.dumps([
        {"directory": str(root), "file": f if "/" in f else f"diff/{f}", "command": f"-o CMakeFiles/{t}.dir/{f}.o"}
        for t, f in pairs]))


def plant_unity(root):
    """Both libraries' files with the same source in them, as CMake writes such files."""
    pairs = []
    for target in ("edgecase_diff", "edgecase_run"):
        file = root / f"build/CMakeFiles/{target}.dir/Unity/unity_0_cxx.cxx"
        file.parent.mkdir(parents=True)
        file.write_text(f'/* generated by CMake */\n\n#include "{root}/diff/verdict.cpp"\n\n')
        pairs.append((target, str(file)))
    plant_commands(root, pairs)


# What is planted -> the words of the complaint.
def plant_harness(root: pathlib.Path):
    """A room that takes the harness, and writes that into its row."""
    design = root / "docs/design.md"
    design.write_text(re.sub(r"^(\| `probe/base/` \|.*) \|$", r"\1, `vk_harness/public` |", design.read_text(), flags=re.M))
    plant(root, "probe/base/bench.hpp", '#include "vk_harness/public/harness.hpp"\n')


PLANTED = {
    "an arrow back inside ref/": (
        lambda root: plant(root, "ref/number/rational.hpp", '#include "ref/value/reference.hpp"\n'),
        ["ref/number/ must not include ref/value/reference.hpp", "folders include each other"],
    ),
    "identifiers of the API in rooms that are neutral": (
        lambda root: plant(root, "run/judge.cpp", "// vkCmdDraw as a word of a sentence\nint f(VkFormat format);\n"
                                                  'const char* const kVariable = "VK_DRIVER_FILES";\n'
                                                  'const char* const kSentence = "as vkCmdDraw draws it";\n'),
        ["VkFormat is an identifier of the API, which run/ does not know",
         "VK_DRIVER_FILES is an identifier of the API, which run/ does not know"],
    ),
    "the harness outside the table of renderers, though a row allows it": (
        plant_harness,
        ["vk_harness/public/harness.hpp may be included in vk_harness/ and cli/renderers/ alone"],
    ),
    "Vulkan outside vk_harness/": (
        lambda root: plant(root, "diff/verdict.hpp", "#include <vulkan/vulkan.h>\n"),
        ["vulkan/vulkan.h may be included in vk_harness/ alone"],
    ),
    "a TOML header in ref/": (
        lambda root: plant(root, "ref/color/color.cpp", "#include <toml++/toml.h>\n"),
        ["toml++/toml.h may be included in cases/toml/ alone"],
    ),
    "a second list of planes": (
        lambda root: plant(
            root,
            "run/judge.cpp",
            "void copy(A& a, const A& b) {\n"
            + "".join(f"    a.{n} = b.{n};\n" for n in ("hits", "writers", "frag_coord", "depth", "color", "stencil",
                                                       "resolved_color", "resolved_depth", "resolved_stencil"))
            + "}\n",
        ),
        ["lists the planes of a capture a second time"],
    ),
    "a second list of fields": (
        lambda root: plant(
            root,
            "run/judge.cpp",
            "void copy(A& a, const A& b) {\n"
            + "".join(f"    a.{n} = b.{n};\n" for _, owner, names in lists_of(root, Table(root))
                      if owner == "cases/model/draw.hpp" and "topology" in names for n in names)
            + "}\n",
        ),
        ["lists the fields of Draw a second time"],
    ),
    "a thread, a file and a shell beside the others": (
        lambda root: plant(root, "run/judge.cpp", "void f() { std::thread([] {}).detach(); }\nstd::ofstream file;\n"
                                                  'int g() { return std::system("ls"); }\n'),
        ["this starts a thread, which is done in cases/base/parallel.hpp alone", "this makes a file, which is done in",
         "this starts a shell, which is done in cli/fuzzing/captures_command.cpp alone"],
    ),
    "a source without a header": (
        lambda root: plant(root, "diff/lonely.cpp", "int lonely() { return 0; }\n"),
        ["diff/lonely.cpp: error: this source has no header"],
    ),
    "a class in two files": (
        lambda root: plant(root, "run/judge.cpp", "bool Schedule::is_done() const { return true; }\n"),
        ["run/judge.cpp: error: functions of Schedule are here, whose home is run/schedule.cpp"],
    ),
    "a command in another one's file": (
        lambda root: (
            plant(root, "cli/commands.hpp", "Command echo_command();\n"),
            plant(root, "cli/list.cpp", "Command echo_command() {}\n"),
        ),
        ["the command 'echo' is not in cli/echo.cpp"],
    ),
    "a source that nobody compiles": (
        lambda root: plant_commands(root, []),
        ["diff/verdict.cpp: error: nobody compiles this file"],
    ),
    "a folder that two rows claim": (
        lambda root: plant(root, "docs/design.md", "| `diff/` | twice | `verdict.hpp` | `ref` |\n"),
        ["two rows claim the folder diff/"],
    ),
    "a folder that nobody claims": (
        lambda root: ((root / "ref/other").mkdir(), plant(root, "ref/other/a.hpp", "#pragma once\n")),
        ["no row of docs/design.md tells what lives in this folder"],
    ),
    "a file in two libraries": (
        lambda root: plant_commands(root, [("edgecase_diff", "verdict.cpp"), ("edgecase_run", "verdict.cpp")]),
        ["two libraries claim this file: edgecase_diff, edgecase_run"],
    ),
    "a file in two libraries that compile several files as one": (
        plant_unity,
        ["two libraries claim this file: edgecase_diff, edgecase_run"],
    ),
}


def self_test(source: pathlib.Path) -> int:
    """Plants breaches into a copy of the sources, one at a time: each has to be told, and nothing else."""
    failed = 0
    rooms = Table(source).rooms
    for what, (breach, told) in PLANTED.items():
        with tempfile.TemporaryDirectory() as name:
            root = pathlib.Path(name).resolve()
            for room in rooms | {"docs"}:
                shutil.copytree(source / room, root / room, ignore=shutil.ignore_patterns("suite", "*.md.*", "findings"))
            breach(root)
            commands = root / "commands.json"
            found = list(problems(root, commands if commands.exists() else None))
        if not all(any(t in f for f in found) for t in told) or not all(any(t in f for t in told) for f in found):
            print(f"the check does not tell of {what} alone:", *found, sep="\n")
            failed = 1
    return failed


def main() -> int:
    if sys.argv[1:2] == ["--self-test"]:
        return self_test(pathlib.Path(sys.argv[2]).resolve())
    commands = pathlib.Path(sys.argv[2]) if len(sys.argv) > 2 else None
    found = list(problems(pathlib.Path(sys.argv[1]).resolve(), commands))
    print("\n".join(found) or "all sources follow the table of folders")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
