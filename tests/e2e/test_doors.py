# SPDX-FileCopyrightText: The Edgecase authors
# SPDX-License-Identifier: Apache-2.0
"""Doors on lavapipe: what a run is asked for, what it draws, and what it tells of the rest."""
import json
import unittest

from support import ProgramTest

CASE = """format = 1
description = "Two triangles."
rules = ["cover.inside"]
[target]
size = [8, 8]
[[draw]]
vertices = [[0,0], [4,0], [0,8],  [8,8], [4,8], [8,0]]
"""
STRIP = CASE.replace("[[draw]]", "[[draw]]\ntopology = \"triangle-strip\"")


class Doors(ProgramTest):
    def setUp(self):
        super().setUp()
        for name, text in (("a/one", CASE), ("a/strip", STRIP), ("b/two", CASE)):
            (self.folder / "own" / name).parent.mkdir(parents=True, exist_ok=True)
            (self.folder / "own" / (name + ".toml")).write_text(text)

    def run_doors(self, *words, check=0, fault=""):
        done = self.edgecase("run", "--suite", "own", "--device", "llvmpipe", "-o", "out", *words, check=check, fault=fault)
        results = self.folder / "out" / "results.json"
        return done, json.loads(results.read_text()) if results.exists() else None

    def test_pictures_are_counted_by_door(self):
        done, results = self.run_doors("--doors", "index-16,restart-extra", "-v")
        self.assertEqual(results["doors"], [
            {"door": "index-16", "pictures": 3, "left_out": 0, "unsupported": 0, "reason": ""},
            {"door": "restart-extra", "pictures": 1, "left_out": 2, "unsupported": 0, "reason": ""}])
        self.assertIn("doors: 4 pictures through 2 of 2 doors; 2 left out, since the case cannot take the door\n", done.stdout)
        self.assertIn("  index-16: 3 pictures\n", done.stdout)
        done, results = self.run_doors()
        self.assertEqual(results["doors"], [])
        self.assertNotIn("doors:", done.stdout)

    def test_another_picture_is_a_finding_that_names_the_door(self):
        done, results = self.run_doors("--doors", "index-16", "--retries", "0", check=1, fault="flip-derived@a/one")
        case = next(c for c in results["cases"] if c["status"] == "fail")
        self.assertEqual((case["id"], case["findings"][0]["rule"]), ("a/one", "door.index"))
        self.assertTrue(case["findings"][0]["quantity"].endswith(", door index-16"))
        self.assertIn(" --doors index-16", case["rerun"])
        # A program that draws the plain picture would not show it.
        ends = [json.loads(line) for line in (self.folder / "out" / "journal.jsonl").read_text().splitlines()[1:]]
        ends = {end["id"]: end for end in ends if end.get("record") == "end"}
        self.assertEqual((ends["a/one"]["reproducer"], ends["a/one"]["no_reproducer"]), ("", "doors alone"))

    def test_a_broken_door_does_not_hide_another(self):
        done, results = self.run_doors("--doors", "index-16,index-32", "--retries", "0", "-v", check=1, fault="flip-derived@a/one")
        told = {(cause["rule"], cause["door"], len(cause["cases"])) for cause in results["causes"]}
        self.assertEqual(told, {("door.index", "index-16", 1), ("door.index", "index-32", 1)})
        self.assertRegex(done.stdout, r"FAIL a/one   .*   door\.index=index-16 \[vulkan: not conformant\]")
        self.assertRegex(done.stdout, r"also: door\.index=index-32 \[vulkan\], \d+ wrong value")
        for door in ("index-16", "index-32"):
            self.assertRegex(done.stdout, rf"fail: door\.index={door} value in a, 1 case \[vulkan\]   rerun: .* --doors {door}\n")
        # One that is known can be left out of all.
        done, results = self.run_doors("--doors", "all,-index-16", "--retries", "0", check=1, fault="flip-derived@a/one")
        doors = {d["door"] for d in results["doors"]}
        self.assertNotIn("index-16", doors)
        self.assertIn("index-32", doors)
        self.assertRegex(next(c for c in results["cases"] if c["id"] == "a/one")["rerun"], " --doors index-8( |$)")
        _, results = self.run_doors("--doors", "default,-index-16", "--retries", "0", check=1)
        doors = {d["door"] for d in results["doors"] if d["pictures"] > 0}
        self.assertNotIn("index-16", doors)
        self.assertIn("index-32", doors)

    def test_a_door_that_a_file_knows_to_be_broken_is_left_out_of_sets(self):
        (self.folder / "known.txt").write_text("# edgecase-expectations 2\n# device: llvmpipe*\n"
                                               "door=index-16   skip   bug-7   # It is broken.\n")
        for words, is_drawn in (("all", False), ("default", False), ("index-16", True)):
            done, results = self.run_doors("--doors", words, "--expect", "known.txt", "--retries", "0",
                                           check=0 if is_drawn else 1)
            door = next(d for d in results["doors"] if d["door"] == "index-16")
            self.assertEqual((door["pictures"] > 0, door.get("skipped_by")), (is_drawn, None if is_drawn else "bug-7"))
            self.assertEqual("; 1 is known to be broken" in done.stdout, not is_drawn)
            self.assertGreater(sum(d["pictures"] for d in results["doors"]), 2)

    def test_default_draws_each_door_with_each_family(self):
        _, results = self.run_doors("--doors", "default", "!a/strip", "--retries", "0", check=1)
        for door in results["doors"]:
            self.assertEqual(door["pictures"] + door["unsupported"], 2, door)
        self.assertGreaterEqual(len(results["doors"]), 20)
        _, results = self.run_doors("--doors", "default", "a/*", "--retries", "0", check=1)
        self.assertEqual({d["pictures"] + d["unsupported"] for d in results["doors"]}, {1})

    def test_wrong_words(self):
        done, _ = self.run_doors("--doors", "index-17", check=2)
        self.assertIn("--doors: there is no door 'index-17', did you mean 'index-16'?; 'edgecase doors' lists them", done.stderr)
        for words, told in (
                ("all,foo", "there is no door 'foo'; 'edgecase doors'"),
                ("all,index-33", "there is no door 'index-33', did you mean 'index-32'?"),
                ("all,index-32", "behind 'all' stand only doors to leave out; did you mean '-index-32'?"),
                ("none,all", "'all' stands first or not at all, and behind it only '-NAME'"),
                ("none,index-8", "'none' stands alone"),
                ("index-8,-index-16", "'-index-16' leaves a door out of a set, so 'all' or 'default' stands first: all,-index-16")):
            done, _ = self.run_doors("--doors", words, check=2)
            self.assertIn("--doors: " + told, done.stderr)
        done, _ = self.run_doors("--doors", "restart-extra", "b/*", check=4)
        self.assertIn("no selected case can go through the door 'restart-extra', which takes a strip or a fan", done.stderr)
        done = self.edgecase("run", "--suite", "own", "--renderer", "reference", "--doors", "all", "-o", "out", check=2)
        self.assertIn("--doors needs a Vulkan driver", done.stderr)

    def test_resuming_goes_through_the_same_doors(self):
        self.run_doors("--doors", "index-16,restart-extra")
        journal = self.folder / "out" / "journal.jsonl"
        lines = journal.read_text().splitlines(keepends=True)
        journal.write_text("".join(line for line in lines if '"b/two"' not in line or '"run"' in line[:20]))
        done = self.edgecase("run", "--resume", "out", check=0)
        results = json.loads((self.folder / "out" / "results.json").read_text())
        self.assertEqual([(d["door"], d["pictures"], d["left_out"]) for d in results["doors"]],
                         [("index-16", 3, 0), ("restart-extra", 1, 2)], done.stdout)

    def test_the_list_has_every_door(self):
        listed = self.edgecase("doors", check=0).stdout.splitlines()
        words = {line for line in listed if not line.startswith(" ")}
        # Behind them stand ways, each with its sentence and its group.
        words -= {listed[k] for k in range(len(listed)) if any("group: bare;" in line for line in listed[k + 1:k + 4] if line.startswith(" "))
                  and not listed[k].startswith(" ")}
        _, results = self.run_doors("--doors", "all", "--retries", "0", check=1)
        told = {d["door"] for d in results["doors"]}
        self.assertEqual(words, told)


if __name__ == "__main__":
    unittest.main()
