# SPDX-FileCopyrightText: The Edgecase authors
# SPDX-License-Identifier: Apache-2.0
"""The whole way through a real Vulkan driver. A machine without one fails these tests: they are never skipped."""
import unittest

from support import SOURCE, ProgramTest


class Driver(ProgramTest):
    def run_driver(self, *words, fault="", check=None):
        return self.edgecase("run", "-o", self.out, *words, fault=fault, check=check)

    def test_small_suite(self):
        self.run_driver(check=0)
        self.assertEqual(set(self.statuses().values()), {"pass"})

    def test_flipped_pixel_is_found(self):
        self.run_driver(fault="flip-pixel@fam/c3", check=1)
        self.assertEqual([i for i, s in self.statuses().items() if s == "fail"], ["fam/c3"])

    def test_crash_in_the_driver_process(self):
        self.run_driver(fault="segv@fam/c3", check=1)
        self.assertEqual([i for i, s in self.statuses().items() if s == "crash"], ["fam/c3"])
        self.assert_no_orphans()

    def test_a_known_failure_hides_no_other(self):
        """In each case that is known to fail on this driver a second fault is planted, and seen."""
        self.suite = SOURCE / "cases" / "suite"
        self.run_driver("-q", check=0)
        cases = [c for c in self.results()["cases"] if c["status"] == "xfail"]
        self.assertGreater(len(cases), 10)
        for fault in ("flip-pixel", "shift-value"):
            left = [c["id"] for c in cases]
            # A fault at a sample that is wrong already changes what it shows, not what is wrong: then another sample
            # has it.
            for skipped in (0, 1, 2, 5, 11, 13, 37, 53, 70, 101, 150, 211, 280):
                self.run_driver("-q", *left, fault=",".join(f"{fault}+{skipped}@{i}" for i in left))
                left = [i for i, s in self.statuses().items() if s == "xfail"]
            # There the device draws nothing but wrong samples, of the kind that is planted.
            left = [i for i in left if not i.startswith("scissor/rectangles:x=65536,")]
            self.assertEqual(left, [], fault)

    def test_missing_manifest(self):
        done = self.run_driver("--icd", "/nowhere/icd.json", check=5)
        self.assertIn("/nowhere/icd.json", done.stderr)

    def test_unknown_device(self):
        done = self.run_driver("--device", "no such device", check=5)
        self.assertIn("no such device", done.stderr)


if __name__ == "__main__":
    unittest.main()
