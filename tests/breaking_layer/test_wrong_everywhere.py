# SPDX-FileCopyrightText: The Edgecase authors
# SPDX-License-Identifier: Apache-2.0
"""A broken driver is named by one sentence, whatever else a run does: doors, ways, no pictures, a part of the cases."""
import pathlib
import shutil
import tempfile
import unittest

import broken

FAMILIES = ["coverage/**", "ties/**", "shared-edge/**", "topology/**", "facing/**"]  # some 250 cases
WORDS = (["--doors", "none", "--ways", "none"], ["--doors", "default", "--ways", "default"], ["--capture", "none"],
         ["--quick"], ["--tell", "20"], ["--shuffle"])
FAULTS = {"viewport-x-half": "Vertices lie 1/2 pixel too far right",
          "first-vertex-off-by-one": "A draw without indices begins one vertex late",
          "viewport-mirrored": "The picture is upside down"}


class WrongEverywhere(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="edgecase-wrong-"))
        self.addCleanup(shutil.rmtree, self.folder, ignore_errors=True)

    def test_one_sentence(self):
        for fault, sentence in FAULTS.items():
            for words in WORDS if fault == "viewport-x-half" else WORDS[1:2]:
                with self.subTest(fault, words=words):
                    run = broken.run(fault, FAMILIES, self.folder, ["--no-expect", "--retries", "0", *words])
                    self.assertEqual([d["what"] for d in run.results["diagnoses"][:1]], [[sentence]], run.out[-600:])
                    self.assertEqual(sum(line.startswith("diagnosis: " + sentence) for line in run.out.splitlines()[-4:]), 1, run.out[-600:])

    def test_doors_that_differ_from_each_picture_take_nothing_away(self):
        """A door with indices draws what the plain picture does not: nearly every sample has other bits."""
        fault = "first-vertex-off-by-one"
        run = broken.run(fault, ["coverage/**", "ties/**"], self.folder, ["--no-expect", "--retries", "0", "--doors", "all"])
        self.assertEqual([d["what"] for d in run.results["diagnoses"]], [[FAULTS[fault]]], run.out[-600:])
        self.assertGreater(sum(any(g.get("door") for g in case["groups"]) for case in run.results["cases"]), 50)


if __name__ == "__main__":
    unittest.main()
