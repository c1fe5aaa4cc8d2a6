# SPDX-FileCopyrightText: The Edgecase authors
# SPDX-License-Identifier: Apache-2.0
"""What the tests of report.html share: a run with wrong samples, and a browser."""
import os
import pathlib
import shutil
import subprocess
import tempfile
import unittest

import devtools

PROGRAM = os.environ.get("EDGECASE_PROGRAM", "edgecase")
CHROMIUM = devtools.find_chromium()

# The diagonal of the square runs through the centres of pixels (1,6), (2,5) ... (6,1).
SQUARE = """format = 1
description = "A square of two triangles{more}."
catches = "a diagonal that is hit twice"
rules = ["cover.inside", "cover.shared-edge"]
[target]
size = [8, 8]{target}
[[draw]]
vertices = [[1,1], [7,1], [1,7],  [7,1], [7,7], [1,7]]
{draw}
"""
CASES = {
    "family/good": SQUARE.format(more=" and <img src=x onerror=alert(1)> </script> &amp;", target="", draw=""),
    "family/wrong": SQUARE.format(more=" that is drawn wrong", target="", draw="[[draw.attribute]]\nvalues = [0, 1, 2, 3, 4, 5]"),
    "samples/four": SQUARE.format(more=" of four samples", target="\nsamples = 4", draw=""),
    "texels/blit": """format = 1
description = "A blit to a larger region."
rules = ["blit.nearest", "blit.outside"]
[target]
size = [8, 8]
color = { format = "rgba8-unorm", clear = [0, 0, 0, 1] }
[blit]
size = [4, 4]
from = [0, 0, 4, 4]
to = [1, 1, 7, 7]
""",
}


@unittest.skipIf(CHROMIUM is None, "there is no Chromium")
class PageTest(unittest.TestCase):
    cases = CASES
    scrollbars = False  # whether the browser shows them
    # One hit too many at the first covered sample from the middle of the target on.
    fault = "flip-pixel@family/wrong,flip-pixel@samples/four,flip-pixel@texels/blit"

    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(tempfile.mkdtemp(prefix="edgecase-page-"))
        cls.addClassCleanup(shutil.rmtree, cls.folder, ignore_errors=True)
        for name, text in cls.cases.items():
            file = cls.folder / "suite" / (name + ".toml")
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_text(text)
        cls.out = cls.folder / "out"
        cls.make_run()
        cls.report = cls.out / "report.html"
        cls.browser = devtools.Browser(CHROMIUM, cls.scrollbars)
        cls.addClassCleanup(cls.browser.close)

    @classmethod
    def make_run(cls):
        cls.edgecase("run", "--renderer=reference", "-o", cls.out, check=1, fault=cls.fault)

    @classmethod
    def edgecase(cls, *words, fault="", check=0):
        environment = {k: v for k, v in os.environ.items() if not k.startswith("EDGECASE_")}
        environment.update(EDGECASE_SUITE=str(cls.folder / "suite"), EDGECASE_FAULT=fault)
        done = subprocess.run([PROGRAM, *map(str, words)], env=environment, cwd=cls.folder, capture_output=True, text=True,
                              timeout=120, check=False)
        if done.returncode != check:
            raise AssertionError(f"{words}: {done.returncode}\n{done.stdout[:2000]}\n{done.stderr[:2000]}")
        return done.stdout

    def open(self, hash_text="", file=None, **window):
        page = devtools.Page(self.browser, **window)
        self.addCleanup(page.close)
        self.addCleanup(self.check_quiet, page)
        page.open(file or self.report, hash_text)
        return page

    def check_quiet(self, page):
        self.assertEqual(page.requests(), [], "the page asks the network for something")
        self.assertEqual(page.complaints(), [], "the console is not empty")

    def at(self, page, x, y, frame=".frame"):
        """Where pixel (x, y) of the picture stands in the window: its middle."""
        zoom = page.run("page.viewer.zoomNow()")
        left, top, _, _ = page.box(frame)
        scroll = page.run(f"[document.querySelector('{frame}').scrollLeft, document.querySelector('{frame}').scrollTop]")
        return left + 1 + (x + 1.5) * zoom - scroll[0], top + 1 + (y + 1.5) * zoom - scroll[1]
