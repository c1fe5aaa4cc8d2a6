# SPDX-FileCopyrightText: The Edgecase authors
# SPDX-License-Identifier: Apache-2.0
"""The datasheet of a rasterizer, drawn in workers like everything else."""
import json
import unittest

import jsonschema

from support import SOURCE, ProgramTest


class Probe(ProgramTest):
    def answers(self, name):
        sheet = json.loads((self.folder / name).read_text())
        schema = json.loads((SOURCE / "docs/schema/probe-1.json").read_text())
        jsonschema.Draft7Validator(schema).validate(sheet)
        return {p["id"]: p["answer"] for p in sheet["properties"]}

    def test_datasheets_and_what_differs(self):
        done = self.edgecase("probe", "--renderer", "software", "--json", "a.json", "--html", "a.html", check=0)
        self.assertIn("Edgecase software rasterizer", done.stdout)
        self.assertRegex(done.stdout, r"Which edges own the samples on them +top-left  \(\d+ of \d+\)\n")
        self.assertEqual(self.answers("a.json")["ties.rule"], "top-left")
        self.assertTrue((self.folder / "a.html").read_text().startswith("<!DOCTYPE html>"))
        choices = "software:ties=bottom-right,subpixel-bits=6"
        self.edgecase("probe", "--renderer", choices, "--json", "b.json", "-v", check=0)
        self.assertEqual(self.answers("b.json")["ties.rule"], "bottom-right")
        self.assertEqual(self.answers("b.json")["grid.bits.x"], "6")
        same = self.edgecase("probe", "--compare", "a.json", "a.json", check=0)
        self.assertIn("no other answers", same.stdout)
        other = self.edgecase("probe", "--compare", "a.json", "b.json", check=1)
        self.assertIn("[ties.rule]\n    A: top-left\n    B: bottom-right\n", other.stdout)
        self.assertIn("[grid.bits.x]\n    A: 8\n    B: 6\n", other.stdout)

    def test_a_worker_that_dies_leaves_what_can_be_told(self):
        done = self.edgecase("probe", "--renderer", "software", "--json", "c.json", fault="segv@probe/ties", check=0)
        self.assertEqual(self.answers("c.json")["ties.rule"], "cannot tell")
        self.assertEqual(self.answers("c.json")["grid.bits.x"], "8")
        self.assertRegex(done.stdout, r"cannot tell\n +the worker was killed by SIGSEGV")

    def test_wrong_input(self):
        (self.folder / "no.json").write_text('{"schema": "edgecase-results-1"}')
        (self.folder / "half.json").write_text('{"schema": "edgecase-probe-1", "device": {}}')
        for words, code, sentence in (
                (["--renderer", "softwear"], 2, "'softwear' is none of "),
                (["--renderer", "software:tie=left"], 2, "the software rasterizer has no choice 'tie'"),
                (["--renderer", "software:ties=left"], 2, "'left' is no value of 'ties'"),
                (["--compare", "a.json"], 2, "--compare"),
                (["--json", "none/a.json"], 2, "there is no folder"),
                (["--compare", "no.json", "no.json"], 3, "it is no datasheet of 'edgecase probe --json'"),
                (["--compare", "half.json", "half.json"], 3, "a member of the datasheet is missing"),
                (["--compare", "gone.json", "no.json"], 3, "there is no file 'gone.json'"),
                (["--icd", "gone_icd.json"], 5, "gone_icd.json"),
                (["--compare", "no.json", "no.json", "--json", "x.json"], 2, "--json"),
                (["somewhere"], 2, "somewhere")):
            done = self.edgecase("probe", *words, check=code)
            self.assertIn(sentence, done.stderr)
            self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
            self.assertEqual(done.stdout, "")


if __name__ == "__main__":
    unittest.main()
