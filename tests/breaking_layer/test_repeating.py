# SPDX-FileCopyrightText: The Edgecase authors
# SPDX-License-Identifier: Apache-2.0
"""The lines that repeat a failure of a broken driver: pasted into a shell that knows nothing of the run, each shows it
again, through the one door or way that shows it."""
import json
import os
import pathlib
import shutil
import subprocess
import tempfile
import unittest

import broken

PLAIN = "scissor/one-by-one:columns=1,rows=3,at=0"
BY_WAY = "coverage/one-pixel@bare-color-constant"
# The fault, the case, the words of the run; the rule that leads, and how the line ends.
KINDS = {
    "the plain picture": ("viewport-x-half", PLAIN, ["--doors", "none"], "interp.perspective", ""),
    "the plain picture beside doors": ("viewport-x-half", PLAIN, ["--doors", "index-16,secondary"], "interp.perspective", ""),
    "one of many doors": ("door-first-index-ignored", "coverage/half-square", ["--doors", "all"], "door.first", "--doors first-index "),
    "a way": ("bare-constant-zero", BY_WAY, ["--ways", "all"], "cover.inside", ""),
}


class Repeating(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="edgecase-repeating-"))
        self.addCleanup(shutil.rmtree, self.folder, ignore_errors=True)

    def test_each_kind(self):
        for kind, (fault, case_id, words, rule, end) in KINDS.items():
            with self.subTest(kind):
                run = broken.run(fault, [case_id.split("@")[0]], self.folder, ["--no-expect", "--no-diagnosis", *words])
                line = next(case for case in run.results["cases"] if case["id"] == case_id)["rerun"]
                self.assertTrue(line.startswith(f"EDGECASE_BREAK={fault} "), line)
                self.assertTrue(line.endswith(f" --device llvmpipe {end}--no-expect"), line)
                again = self.pasted(line)
                self.assertEqual((again["id"], again["status"], again["findings"][0]["rule"]), (case_id, "fail", rule), line)

    def pasted(self, line):
        env = {k: v for k, v in os.environ.items() if not k.startswith(("EDGECASE_", "VK_"))}
        out = self.folder / "again"
        subprocess.run(["sh", "-c", f"{line} -o {out}"], env=env, cwd=self.folder, capture_output=True, timeout=120, check=False)
        case, = json.loads((out / "results.json").read_text(encoding="utf-8"))["cases"]
        return case


if __name__ == "__main__":
    unittest.main()
