# SPDX-FileCopyrightText: The Edgecase authors
# SPDX-License-Identifier: Apache-2.0
"""Faults that only a picture through a door shows: nobody sees them without doors, the door of doors.json does, and it
says so by a rule of its own."""
import json
import pathlib
import shutil
import tempfile
import unittest

import broken
import doors
from shares import is_in_share

FOUND = json.loads((pathlib.Path(__file__).parent / "doors.json").read_text())


def of_share(names):
    """Every other one, the others as the faults grow in number; by night all (.ci/nightly)."""
    return [name for place, name in enumerate(names) if is_in_share(place, 2, len(FOUND))]


class Doors(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="edgecase-doors-"))
        self.addCleanup(shutil.rmtree, self.folder, ignore_errors=True)

    def test_every_fault_has_a_door(self):
        self.assertEqual(sorted(doors.names()), sorted(FOUND))
        self.assertGreaterEqual(len(FOUND), 92)
        for name, found in FOUND.items():
            self.assertTrue(found, name)

    def test_each_fault_is_seen_through_its_door_alone(self):
        for name in of_share(FOUND):
            found = FOUND[name]
            with self.subTest(fault=name):
                if found[0] in doors.BROKEN_DOORS and self.is_broken(found[0]):
                    self.skipTest(f"this driver breaks the door {found[0]} itself")
                # The plain pictures are drawn beside those through the door: all that is found is found there.
                caught, run = doors.seen(name, self.folder, found[0])
                door = next(d for d in run.results["doors"] if d["door"] == found[0])
                if found[0] in doors.NEWER_DOORS and door["pictures"] == 0:
                    self.assertRegex(door["reason"], "^the device lacks ")
                    self.assertGreater(door["unsupported"], 50)
                    continue
                self.assertGreater(run.altered, 0)
                self.assertTrue(caught, f"{name} through {found[0]}")
                rules = {f["rule"] for case in run.results["cases"] for f in case["findings"]}
                self.assertTrue(all(rule.startswith("door.") or rule == "write.outside" for rule in rules), rules)
                told = {f["quantity"].split(", door ")[-1] for case in run.results["cases"] for f in case["findings"]}
                self.assertEqual(told, {found[0]})

    def is_broken(self, door):
        """Whether the driver is wrong through the door, or dies, without a fault."""
        run = doors.seen("", self.folder, door)[1]
        return any(case["status"] in ("crash", "fail") for case in run.results["cases"])

    def test_without_a_fault_no_door_is_wrong(self):
        for door in of_share(sorted({found[0] for found in FOUND.values()} - set(doors.BROKEN_DOORS))):
            with self.subTest(door=door):
                caught, run = doors.seen("", self.folder, door)
                self.assertEqual((caught, run.altered), ([], 0), run.out)


if __name__ == "__main__":
    unittest.main()
