# SPDX-FileCopyrightText: The Edgecase authors
# SPDX-License-Identifier: Apache-2.0
"""The suite on lavapipe under every fault of the breaking layer. Each fault has to be reached, and caught by the cases
that catches.json names for it; matrix.py finds them. A machine without lavapipe fails these tests: they are never
skipped."""
import json
import pathlib
import re
import shutil
import subprocess
import tempfile
import unittest

import broken
from shares import is_in_share

CATCHES = json.loads((pathlib.Path(__file__).parent / "catches.json").read_text())
# The faults that no case can see on this driver, with the reason (README.md).
UNSEEN = json.loads((pathlib.Path(__file__).parent / "unseen.json").read_text())


# Cases of one colour, without the attachments that tell of fragments.
COLORED = ["store/constants:format=rgba8-unorm", "blend/presets", "blend/painter:*attachments=color", "combination/triangle-counts:format=rgba8-unorm,*",
           "depth-test/prepass-bare:*samples=1,*", "alpha-to-coverage/masks", "logic/once:*format=rgba8-unorm"]


class LayerTest(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="edgecase-breaking-"))
        self.addCleanup(shutil.rmtree, self.folder, ignore_errors=True)

    def run_cases(self, fault, ids, *words):
        """Runs these cases alone: a suite of their files, which loads faster than the whole one."""
        suite = self.folder / "suite"
        shutil.rmtree(suite, ignore_errors=True)
        for case_id in ids:
            file = re.split("[:@]", case_id)[0] + ".toml"
            (suite / file).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(broken.SOURCE / "cases" / "suite" / file, suite / file)
        return broken.run(fault, ids, self.folder, ["--suite", str(suite), *words])

    def statuses(self, run):
        self.assertIsNotNone(run.results, run.err)
        return {case["id"]: case["status"] for case in run.results["cases"]}


class Table(LayerTest):
    def test_every_fault_has_its_cases(self):
        names = [name for name, _ in broken.faults() if not broken.is_deadly(name)]
        self.assertEqual(len(names), len(set(names)))
        self.assertGreaterEqual(len(names), 100)
        self.assertEqual(sorted(names), sorted([*CATCHES, *UNSEEN]))
        for name, ids in CATCHES.items():
            self.assertGreaterEqual(len(ids), 1, name)

    def test_what_the_catalogue_has_is_said_there(self):
        """A fault of the layer names a row of cases/fault, or is one of its own: with a name and a sentence of its own."""
        text = "".join(p.read_text() for p in sorted((broken.SOURCE / "cases/fault").glob("*_rows.hpp")))
        rows = {name: "".join(re.findall(r'"([^"]*)"', sentence))
                for name, sentence in re.findall(r'\{"([a-z0-9-]+)",\s*((?:"[^"]*"\s*)+?),', text)}
        self.assertGreaterEqual(len(rows), 500)
        for name, sentence, row in broken.table():
            with self.subTest(name):
                if row == "-":
                    self.assertFalse(name in rows or sentence in rows.values(), "the catalogue has it")
                else:
                    self.assertEqual(sentence, rows[row])
                    self.assertIn(row, (name, row) if name not in rows else (name,))

    def test_unknown_faults_stop_the_run(self):
        for wrong in ("viewport-x", "nothing-every-nth:0", "nothing-every-nth:x", "nothing-every-nth:"):
            run = self.run_cases(wrong, ["coverage/half-square"])
            self.assertEqual(run.code, 5, run.err)
            # Whoever mistypes a fault must not suspect the driver.
            told = "the parameter in EDGECASE_BREAK is no number from 1 up" if ":" in wrong else "EDGECASE_BREAK names no fault of the layer"
            self.assertIn(f"  printed: breaking layer: error: {told}: '{wrong}'", run.err)

    def test_without_a_fault_nothing_changes(self):
        known = {"door/resolve:samples=4"}  # lavapipe 22.3 has it wrong by itself: docs/findings/lavapipe-resolve-layer.md
        ids = sorted({case_id for ids in CATCHES.values() for case_id in ids} - known)
        run = self.run_cases("", ids)
        self.assertEqual((run.code, run.altered), (0, 0), run.out)
        self.assertEqual(set(self.statuses(run).values()), {"pass"})


class Bare(LayerTest):
    """Faults of pipelines as applications have them: only ways, and the cases of the family bare, show them."""

    FAULTS = {name: ids for name, ids in CATCHES.items() if name.startswith("bare-")}

    def test_each_is_seen_by_ways(self):
        self.assertGreaterEqual(len(self.FAULTS), 40)
        for name, ids in self.FAULTS.items():
            with self.subTest(fault=name):
                self.assertTrue(all("@" in i or i.startswith("bare/") for i in ids), ids)

    def test_none_is_seen_without(self):
        """The cases whose ways catch a fault never reach it by themselves, nor does what else has one colour."""
        ids = sorted({i.split("@")[0] for ids in self.FAULTS.values() for i in ids if "@" in i} | set(COLORED))
        for place, name in enumerate(self.FAULTS):
            if not is_in_share(place, 8, len(self.FAULTS)):
                continue
            with self.subTest(fault=name):
                run = self.run_cases(name, ids)
                self.assertEqual((run.code, run.altered), (0, 0), run.out)
                self.assertLessEqual(set(self.statuses(run).values()), {"pass", "unsupported"})


def is_diagnosed(place):
    """Whether the failures of the fault at this place are diagnosed, too. No verdict here depends on the diagnosis, which
    takes five times as long as all the rest: that it lives is seen at one fault of eight, others as the faults grow in
    number, and by night at all (.ci/nightly)."""
    return is_in_share(place // 4, 8, len(CATCHES))  # of four in a row one is in each part


def part(number, parts):
    """A part of the faults, as a test class of its own: ctest runs them side by side."""

    class Part(LayerTest):
        def uncaught(self, name, ids, *words):
            """Why the run does not show that the cases catch the fault; nothing if it does."""
            run = self.run_cases(name, ids, *words)
            told = {c["id"]: f"{c['status']}: {c['reason']}" for c in (run.results or {"cases": []})["cases"] if not broken.is_caught(c)}
            if run.altered > 0 and run.code in (1, 7) and not told and set(self.statuses(run)) == set(ids):
                return ""
            return f"{name}: {run.altered} calls altered, exit code {run.code}, not caught: {told}\n{run.out}{run.err}"

        def test_faults_are_caught(self):
            for place, (name, ids) in list(enumerate(CATCHES.items()))[number::parts]:
                with self.subTest(fault=name):
                    words = [] if is_diagnosed(place) else ["--no-diagnosis"]
                    # Alone and once, which is quick; where a driver under a fault dies of it, as users run it.
                    if first := self.uncaught(name, ids, "--retries", "0", *words):
                        self.assertEqual(self.uncaught(name, ids, *words), "", first)

    Part.__name__ = Part.__qualname__ = f"Part{number}"
    return Part


Part0, Part1, Part2, Part3 = (part(number, 4) for number in range(4))


class Known(LayerTest):
    """Known failures excuse what stays within their counts, but not without a word where the picture is another one."""

    SELECTORS = ["scissor/rectangles:x=65536,w=12*", "scissor/rectangles:x=65536,w=600*"]
    SENTENCE = "drawn with bits that nobody has seen before: scissor/rectangles:"

    def run_known(self, fault, *words):
        return broken.run(fault, self.SELECTORS, self.folder, ["--suite", str(self.folder / "suite"), *words])

    def test_a_scissor_that_is_ignored(self):
        for part in ("suite/scissor/rectangles.toml", "expectations/llvmpipe-scissor.txt"):
            (self.folder / part).parent.mkdir(parents=True)
            shutil.copy(broken.SOURCE / "cases" / part, self.folder / part)
        run = self.run_known("")
        self.assertEqual((run.code, set(self.statuses(run).values())), (0, {"xfail"}), run.out + run.err)
        self.assertNotIn(self.SENTENCE, run.out)  # nothing is known of pictures yet
        subprocess.run([broken.PROGRAM, "expect", "--update", str(self.folder / "out"), str(self.folder / "expectations/llvmpipe.pictures"),
                        "--suite", str(self.folder / "suite")], check=True, capture_output=True)
        run = self.run_known("", "--strict")
        self.assertEqual(run.code, 0, run.out + run.err)
        run = self.run_known("scissor-ignored")
        self.assertGreater(run.altered, 0)
        self.assertEqual((run.code, set(self.statuses(run).values())), (0, {"xfail"}), run.out + run.err)
        self.assertIn(self.SENTENCE, run.out)
        self.assertEqual(self.run_known("scissor-ignored", "--strict").code, 1)


class Memory(LayerTest):
    """What is written beside an attachment's memory: told with its place, and charged to no innocent case."""

    CASE = """format = 1
description = "A triangle."
rules = ["cover.inside"]
[target]
size = [8, 8]
[[draw]]
vertices = [[1,1], [7,1], [1,7]]
"""

    def run_memory(self, fault, *words):
        suite = self.folder / "suite"
        suite.mkdir()
        for name in "abcd":
            (suite / "fam").mkdir(exist_ok=True)
            (suite / "fam" / (name + ".toml")).write_text(self.CASE)
        run = broken.run(fault, [], self.folder, ["--suite", str(suite), "--retries", "0", "-j", "1", *words])
        self.assertGreater(run.altered, 0)
        self.assertEqual(run.code, 1, run.out + run.err)
        return run

    def assert_told(self, finding, side, distance):
        self.assertEqual((finding["rule"], finding["level"]), ("write.outside", "vulkan"))
        self.assertRegex(finding["quantity"], f"^memory {side} [a-z]")
        self.assertEqual((finding["expected"], finding["got"]), ("0xed9eca5e", "0x57a7157a"))
        self.assertIn(distance, finding["why"])

    def test_before_and_after(self):
        for fault, side, distance in (("write-before-attachment", "before", "4 bytes before the first byte"),
                                      ("write-after-attachment", "after", "0 bytes after the last byte")):
            with self.subTest(fault=fault):
                shutil.rmtree(self.folder / "suite", ignore_errors=True)
                run = self.run_memory(fault)
                self.assertEqual(set(self.statuses(run).values()), {"fail"})
                for case in run.results["cases"]:
                    self.assertIn(f"memory {side} depth", [f["quantity"] for f in case["findings"]])
                    for finding in case["findings"]:
                        self.assert_told(finding, side, distance)

    def test_the_next_case_is_not_blamed(self):
        # Every second rendering: each case alone in its submission, all on the same attachments.
        run = self.run_memory("write-after-attachment:2", "--batch", "1")
        self.assertEqual(sorted(self.statuses(run).values()), ["fail", "fail", "pass", "pass"])


class Device(LayerTest):
    """A device that dies: told as what it is, charged to no innocent case, and never a pass."""

    ids = ["coverage/half-square", "coverage/no-centre", "ties/apex"]

    def setUp(self):
        super().setUp()
        if not all((broken.SOURCE / "cases" / "suite" / (i + ".toml")).exists() for i in self.ids):
            self.fail("the cases of this test have been renamed")

    def run_dying(self, fault, *words):
        run = self.run_cases(fault, self.ids, *words)
        self.assertGreater(run.altered, 0)
        return run

    def test_lost_at_every_submission(self):
        for fault in ("lost-at-submit", "lost-every-nth-submit", "lost-at-wait"):
            run = self.run_dying(fault)
            self.assertEqual(run.code, 1, run.out + run.err)
            self.assertEqual(set(self.statuses(run).values()), {"device_lost"})

    def test_lost_now_and_then_is_a_flake(self):
        # The second submission of a worker is lost; a case alone is the first of its worker.
        run = self.run_dying("lost-every-nth-submit:2", "--batch", "1")
        self.assertEqual(run.code, 1, run.out + run.err)
        statuses = list(self.statuses(run).values())
        self.assertIn("flake", statuses)
        self.assertEqual(set(statuses), {"flake", "pass"})

    def test_hang(self):
        run = self.run_dying("hang-at-wait", "--timeout", "1")
        self.assertEqual(run.code, 1, run.out + run.err)
        self.assertEqual(set(self.statuses(run).values()), {"timeout"})

    def test_crash(self):
        for fault in ("crash-at-submit", "crash-at-pipeline"):
            run = self.run_dying(fault)
            self.assertEqual(run.code, 1, run.out + run.err)
            self.assertEqual(set(self.statuses(run).values()), {"crash"})
            self.assertEqual({case["signal"] for case in run.results["cases"]}, {"SIGSEGV"})

    def test_pipeline_refused(self):
        run = self.run_dying("pipeline-refused")
        self.assertEqual(run.code, 7, run.out + run.err)
        self.assertIn("error", self.statuses(run).values())

    def test_a_call_that_fails_is_an_error(self):
        # What fails was promised: 'unsupported', and exit 6 or 0, would hide a broken driver.
        for fault, told in (("refused-every-nth-allocation", r"memory: vkAllocateMemory failed with VK_ERROR_OUT_OF_DEVICE_MEMORY for \d+ bytes"),
                            ("refused-every-nth-image", "memory: vkCreateImage failed with VK_ERROR_OUT_OF_DEVICE_MEMORY"),
                            ("refused-every-nth-map", "memory: vkMapMemory failed with VK_ERROR_OUT_OF_DEVICE_MEMORY"),
                            ("refused-every-nth-submit", "submit: vkQueueSubmit failed with VK_ERROR_OUT_OF_DEVICE_MEMORY"),
                            ("refused-every-nth-pipeline", "pipeline: vkCreateGraphicsPipelines failed with VK_ERROR_UNKNOWN")):
            with self.subTest(fault=fault):
                run = self.run_dying(fault)
                self.assertEqual(run.code, 7, run.out + run.err)
                self.assertEqual(set(self.statuses(run).values()), {"error"})
                for case in run.results["cases"]:
                    self.assertRegex(case["reason"], "^" + told)

    def test_a_call_that_fails_now_and_then_is_never_a_pass_of_all(self):
        # A worker's first case passes; the call of a later one fails, and works again in a fresh worker.
        for fault, call in (("refused-every-nth-allocation:3", "vkAllocateMemory failed with VK_ERROR_OUT_OF_DEVICE_MEMORY"),
                            ("refused-every-nth-submit:2", "vkQueueSubmit failed with VK_ERROR_OUT_OF_DEVICE_MEMORY"),
                            ("refused-every-nth-image:5", "vkCreateImage failed with VK_ERROR_OUT_OF_DEVICE_MEMORY")):
            with self.subTest(fault=fault):
                run = self.run_dying(fault, "-j", "1", "--batch", "1")
                self.assertIn(run.code, (1, 7), run.out + run.err)
                bad = [case for case in run.results["cases"] if case["status"] in ("flake", "error")]
                self.assertNotEqual(bad, [], self.statuses(run))
                self.assertNotIn("unsupported", self.statuses(run).values())
                for case in bad:
                    self.assertIn(call, case["reason"])

    def test_nothing_every_second_rendering(self):
        run = self.run_dying("nothing-every-nth:2", "--batch", "1", "--retries", "1")
        self.assertEqual(run.code, 1, run.out + run.err)
        self.assertIn("flake", self.statuses(run).values())


if __name__ == "__main__":
    unittest.main()
