# SPDX-FileCopyrightText: The Edgecase authors
# SPDX-License-Identifier: Apache-2.0
"""What the end-to-end tests share: a small suite of ten cases, and the program with faults."""
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import time
import unittest
import xml.etree.ElementTree

sys.path.append(str(pathlib.Path(__file__).parents[1]))  # shares.py

PROGRAM = os.environ.get("EDGECASE_PROGRAM", "edgecase")
SOURCE = pathlib.Path(os.environ.get("EDGECASE_SOURCE_DIR", pathlib.Path(__file__).parents[2]))

CASE = """format = 1
description = "A square of two triangles, number {n}."
rules = ["cover.inside", "cover.shared-edge"]
[target]
size = [8, 8]
[[draw]]
vertices = [[1,1], [7,1], [1,7],  [7,1], [7,7], [1,7]]
"""


def processes_with(text):
    """Ids of processes whose environment holds the text: the workers of one test."""
    found = []
    for entry in pathlib.Path("/proc").iterdir():
        if entry.name.isdigit() and int(entry.name) != os.getpid():
            try:
                if text.encode() in (entry / "environ").read_bytes() and \
                        (entry / "stat").read_text().rsplit(")", 1)[1].split()[0] != "Z":
                    found.append(int(entry.name))
            except OSError:
                pass
    return found


class ProgramTest(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="edgecase-e2e-"))
        self.addCleanup(shutil.rmtree, self.folder, ignore_errors=True)
        self.suite = self.folder / "cases" / "suite"
        self.ids = [f"fam/c{n}" for n in range(10)]
        for n, case_id in enumerate(self.ids):
            self.write_case(case_id, CASE.format(n=n))
        self.out = self.folder / "out"

    def write_case(self, case_id, text):
        path = self.suite / (case_id + ".toml")
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)

    def environment(self, fault=""):
        env = {k: v for k, v in os.environ.items() if not k.startswith(("EDGECASE_", "GITHUB_", "GITLAB_", "CI_"))
               and k not in ("NO_COLOR", "CI")}
        env["EDGECASE_SUITE"] = str(self.suite)
        env["EDGECASE_TEST_MARK"] = str(self.folder)
        if fault:
            env["EDGECASE_FAULT"] = fault
        return env

    def edgecase(self, *words, fault="", check=None, text=True, env=None, stdin=""):
        done = subprocess.run([PROGRAM, *map(str, words)], env=env or self.environment(fault), cwd=self.folder,
                              capture_output=True, input=stdin if text else stdin.encode(), text=text,
                              timeout=120, check=False)
        if check is not None:
            self.assertEqual(done.returncode, check, f"{words}\n{done.stdout}\n{done.stderr}")
        return done

    def run_suite(self, *words, fault="", check=None, out=None):
        return self.edgecase("run", "--renderer=reference", "-o", out or self.out, *words, fault=fault, check=check)

    def results(self, out=None):
        """Parses all three reports and returns results.json."""
        out = pathlib.Path(out or self.out)
        results = json.loads((out / "results.json").read_text(encoding="utf-8"))
        xml.etree.ElementTree.parse(out / "junit.xml")
        self.assertIn("</html>", (out / "report.html").read_text(encoding="utf-8"))
        return results

    def statuses(self, out=None):
        return {case["id"]: case["status"] for case in self.results(out)["cases"]}

    def assert_no_orphans(self):
        """A process that was killed is gone when it next has a processor; one that was not waits for a minute or more."""
        for _ in range(100):
            if not processes_with(str(self.folder)):
                return
            time.sleep(0.1)
        self.assertEqual(processes_with(str(self.folder)), [])
