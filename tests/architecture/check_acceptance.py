# SPDX-FileCopyrightText: The Edgecase authors
# SPDX-License-Identifier: Apache-2.0
"""Every test that docs/acceptance.md names is there.   usage: check_acceptance.py SOURCE [--self-test]"""
import ast
import pathlib
import re
import sys


def python_tests(source):
    """file.Class.test of every test file."""
    for file in (source / "tests").rglob("test_*.py"):
        for node in ast.walk(ast.parse(file.read_text(encoding="utf-8"))):
            if isinstance(node, ast.ClassDef):
                yield from (f"{file.stem}.{node.name}.{f.name}" for f in node.body
                            if isinstance(f, ast.FunctionDef) and f.name.startswith("test_"))


def unit_tests(source):
    """Suite.Test of GoogleTest."""
    for file in (source / "tests").rglob("*.cpp"):
        for suite, test in re.findall(r"^TEST(?:_[FP])?\(\s*(\w+),\s*(\w+)\)", file.read_text(encoding="utf-8"), re.M):
            yield f"{suite}.{test}"


def faults_of(page, known):
    checks = page.partition("\n## ")[0]  # tables of sections are of figures
    rows = [line.split("|") for line in checks.splitlines() if line.startswith("| ") and not line.startswith(("| check", "| ---"))]
    faults = [] if rows else ["docs/acceptance.md has no table"]
    for _, check, tests, _ in rows:
        names = re.findall(r"`([^`]+)`", tests)
        if not names:
            faults.append(f"no test stands beside '{check.strip()}'")
        faults += [f"there is no test {name}, of '{check.strip()}'" for name in names if name not in known]
    return faults


def main():
    source = pathlib.Path(sys.argv[1])
    known = set(python_tests(source)) | set(unit_tests(source))
    page = (source / "docs" / "acceptance.md").read_text(encoding="utf-8")
    if "--self-test" in sys.argv:
        assert faults_of(page.replace("test_segv`", "test_sgev`"), known) and faults_of("", known)
        assert faults_of("| a check | a promise |", known) and not faults_of("| a check | `console.golden` |", known)
        return 0
    faults = faults_of(page, known)
    print("\n".join(faults), file=sys.stderr)
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
