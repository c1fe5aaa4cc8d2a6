# SPDX-FileCopyrightText: The Edgecase authors
# SPDX-License-Identifier: Apache-2.0
"""What found.json says of the fuzzer is true: every fault stands there, a sample of the finds is found again, and what is
never found has a reason."""
import json
import subprocess
import unittest

import hunt

RECORD = json.loads(hunt.FOUND.read_text())
REASONS = json.loads(hunt.UNFOUND.read_text())


def record_hunt(kind, *words):
    out = subprocess.run([hunt.PROGRAM, kind, *map(str, words)], stdout=subprocess.PIPE, text=True, check=True).stdout
    return [line.split("\t") for line in out.splitlines()]


class Record(unittest.TestCase):
    def test_every_fault_was_hunted(self):
        for kind in RECORD.keys() & hunt.KINDS:
            later = RECORD.get("later", {}).get(kind, [])  # which the page names
            names = [name for name in hunt.all_faults(kind) if name not in later]
            self.assertEqual(len(set(later)), len(hunt.all_faults(kind)) - len(names), "a fault that is not there is not hunted later")
            for seed, rows in RECORD[kind].items():
                self.assertEqual(sorted(rows), sorted(names), f"{kind}, seed {seed}")
                names = hunt.unfound(rows)

    def test_what_is_never_found_has_a_reason(self):
        for kind in RECORD.keys() & hunt.KINDS:
            self.assertEqual(sorted(REASONS[kind]), sorted(hunt.summary(RECORD, REASONS, kind)["never"]), kind)

    def test_the_page_shows_it(self):
        self.assertIn(hunt.table(RECORD, REASONS), hunt.PAGE.read_text())


class Finds(unittest.TestCase):
    """The recorded case finds its fault: some of each kind, those that a generator reaches soon."""

    def check(self, kind, count):
        for place, (seed, rows) in enumerate(RECORD[kind].items()):
            early = [(name, row) for name, row in sorted(rows.items()) if row[0] is not None and row[0] < 4096]
            if place == 0:
                self.assertGreater(len(early), count)
            for name, (number, symptom) in early[int(seed) % 7::max(1, len(early) // count)]:
                with self.subTest(kind=kind, seed=seed, fault=name):
                    found = record_hunt(kind, "--seed", seed, "--first", number, "--cases", number + 1, name)
                    self.assertEqual([row[:3] for row in found], [[name, str(number), symptom]])

    def test_some_of_each_kind(self):
        for kind in RECORD.keys() & hunt.KINDS:
            self.check(kind, {"software": 8, "layer": 4}[kind])


if __name__ == "__main__":
    unittest.main()
