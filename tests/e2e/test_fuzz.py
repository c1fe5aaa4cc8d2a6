# SPDX-FileCopyrightText: The Edgecase authors
# SPDX-License-Identifier: Apache-2.0
"""edgecase fuzz: hunts on the reference with planted faults, and on lavapipe."""
import json
import os
import re
import signal
import subprocess
import time
import unittest

from support import PROGRAM, ProgramTest


class FuzzTest(ProgramTest):
    def fuzz(self, *words, fault="", out=None, check=None, renderer=("--renderer=reference",)):
        return self.edgecase("fuzz", *renderer, "-o", out or self.folder / "hunt", *words, fault=fault, check=check)

    def ledger(self, folder="hunt"):
        return json.loads((self.folder / folder / "fuzz.json").read_text())

    def found(self, folder="hunt"):
        return {p.name: p.read_text() for p in (self.folder / folder / "found").glob("*.toml")}


class Hunts(FuzzTest):
    def test_nothing_is_found_where_nothing_is_wrong(self):
        done = self.fuzz("--cases=2048", check=0)
        ledger = self.ledger()
        self.assertEqual((ledger["causes"], ledger["failed_cases"], ledger["unjudged_cases"]), ([], 0, 0))
        self.assertTrue(ledger["is_finished"])
        # Not a hunt that judged nothing.
        self.assertGreater(ledger["judged_cases"], 1000)
        self.assertEqual(ledger["judged_cases"] + ledger["unsupported_cases"] + ledger["empty_cases"], 2048)
        self.assertIn("0 cases failed, by 0 causes", done.stdout)

    def test_a_fault_is_found_reduced_and_kept(self):
        self.fuzz("--cases=1024", fault="flip-pixel@**", check=1)
        found = self.found()
        self.assertTrue(found)
        for name, text in found.items():
            self.assertRegex(text, r"\A# \w+ of \S+ \[\w+\], found by 'edgecase fuzz --seed 1' in case \d+ on Edgecase reference\.\n")
            path = self.folder / "hunt/found" / name
            self.edgecase("lint", path, check=0)
            self.edgecase("run", path, "--renderer=reference", "-o", "run", fault="flip-pixel@**", check=1)
            self.edgecase("run", path, "--renderer=reference", "-o", "run", check=0)
        # A flipped pixel needs nothing: one triangle, one pixel or two.
        smallest = min(found.values(), key=len)
        self.assertEqual(smallest.count("[[draw]]"), 1)
        self.assertLess(len(smallest), 330, smallest)
        for cause in self.ledger()["causes"]:
            self.assertTrue(cause["is_minimal"])
            self.assertFalse(cause["is_known"])

    def test_the_same_seed_finds_the_same(self):
        for folder in ("a", "b"):
            self.fuzz("--cases=1024", "-j1", fault="flip-pixel@**", out=self.folder / folder, check=1)
        self.assertEqual(self.found("a"), self.found("b"))
        self.fuzz("--cases=256", "--seed=2", fault="flip-pixel@**", out=self.folder / "c", check=1)
        self.assertNotEqual(self.found("a"), self.found("c"))

    def test_shards_share_out_the_cases(self):
        self.fuzz("--cases=1024", check=0)
        whole = self.ledger()["judged_cases"]
        parts = []
        for part in ("1/3", "2/3", "3/3"):
            self.fuzz("--cases=1024", f"--shard={part}", out=self.folder / "part", check=0)
            parts.append(self.ledger("part")["judged_cases"])
            subprocess.run(["rm", "-r", self.folder / "part"], check=True)
        self.assertEqual(sum(parts), whole)
        self.assertGreater(min(parts), 0)

    def test_what_is_known_is_no_news(self):
        self.fuzz("--cases=1024", fault="flip-pixel@**", check=1)
        done = self.fuzz("--cases=1024", "--known", self.folder / "hunt", fault="flip-pixel@**", out=self.folder / "again", check=0)
        self.assertIn("known ones", done.stdout)
        self.assertEqual(self.found("again"), {})
        self.assertTrue(all(c["is_known"] and c["count"] > 0 for c in self.ledger("again")["causes"][:1]))
        # Another fault is news beside it.
        self.fuzz("--cases=1024", "--known", self.folder / "hunt", fault="shift-value@**", out=self.folder / "other", check=1)
        self.assertTrue(self.found("other"))

    def test_a_crash_is_a_cause(self):
        self.fuzz("--cases=128", fault="segv@77", check=1)
        # Reduced cases have other names, so the planted death does not come again there.
        self.assertEqual([c["symptom"] for c in self.ledger()["causes"]], [])
        self.fuzz("--cases=128", fault="segv@*", out=self.folder / "all", check=1)
        self.assertIn("crash by SIGSEGV", [c["symptom"] for c in self.ledger("all")["causes"]])

    def test_an_interrupted_hunt_goes_on(self):
        program = subprocess.Popen([PROGRAM, "fuzz", "--renderer=reference", "-o", "hunt"], cwd=self.folder,
                                   env=self.environment(), stdout=subprocess.PIPE, text=True)
        ledger = self.folder / "hunt/fuzz.json"
        while not ledger.exists():
            time.sleep(0.05)
        os.kill(program.pid, signal.SIGINT)
        out = program.communicate(timeout=60)[0]
        self.assertEqual(program.returncode, 130, out)
        self.assertIn("go on with 'edgecase fuzz --resume hunt'", out)
        reached = self.ledger()["next_case"]
        self.assertGreater(reached, 0)
        self.edgecase("fuzz", "--resume", "hunt", "--renderer=reference", "--cases", str(reached + 1024), check=0)
        self.assertEqual(self.ledger()["next_case"], reached + 1024)
        parts = self.ledger()["judged_cases"]
        self.fuzz("--cases", str(reached + 1024), out=self.folder / "whole", check=0)
        self.assertEqual(self.ledger("whole")["judged_cases"], parts)

    def test_a_killed_hunt_goes_on(self):
        program = subprocess.Popen([PROGRAM, "fuzz", "--renderer=reference", "-o", "hunt"], cwd=self.folder,
                                   env=self.environment(), stdout=subprocess.DEVNULL)
        while not (self.folder / "hunt/fuzz.json").exists():
            time.sleep(0.05)
        program.kill()
        program.wait()
        reached = self.ledger()["next_case"]
        self.edgecase("fuzz", "--resume", "hunt", "--renderer=reference", "--cases", str(reached + 256), check=0)
        self.assertEqual(self.ledger()["next_case"], reached + 256)


class WrongInput(FuzzTest):
    def refused(self, words, sentence, code=2):
        done = self.edgecase("fuzz", *words, check=code)
        self.assertIn(sentence, done.stderr)
        self.assertEqual(done.stderr.count("\nedgecase: "), 0, done.stderr)

    def test_options(self):
        self.refused(["--time", "soon"], "--time: 'soon' is not a value that it takes; write TIME")
        self.refused(["--time", "-5"], "--time")
        self.refused(["--time", "0"], "--time: '0' is not a value")
        self.refused(["--cases", "0"], "--cases")
        self.refused(["--shard", "3/2"], "--shard")
        self.refused(["ties/**"], "ties/**")
        self.refused(["--renderer", "referenc"], "referenc")
        self.refused(["--icd", "/nowhere.json"], "/nowhere.json", 5)

    def test_folders(self):
        self.refused(["--resume", "nothing"], "'nothing' is not the folder of a hunt", 3)
        self.refused(["--known", "nothing"], "'nothing' is not the folder of a hunt", 3)
        (self.folder / "file").write_text("")
        self.refused(["--renderer=reference", "-o", "file/x"], "cannot be made")
        self.fuzz("--cases=128", check=0)
        self.refused(["--renderer=reference", "-o", "hunt"], "holds a hunt already; go on with it by --resume")
        self.refused(["--renderer=tiles", "--resume", "hunt"], "the hunt cannot go on", 5)
        ledger = self.folder / "hunt/fuzz.json"
        ledger.write_text(ledger.read_text()[:200])
        self.refused(["--resume", "hunt"], "is malformed", 3)

    def test_two_hunts_in_one_folder(self):
        program = subprocess.Popen([PROGRAM, "fuzz", "--renderer=reference", "-o", "hunt"], cwd=self.folder,
                                   env=self.environment(), stdout=subprocess.DEVNULL)
        try:
            while not (self.folder / "hunt/fuzz.json").exists():
                time.sleep(0.05)
            self.refused(["--renderer=reference", "--resume", "hunt"], "another hunt is writing to 'hunt'")
        finally:
            program.kill()
            program.wait()


class Driver(FuzzTest):
    """On lavapipe: its known defects are found without a case of the suite."""

    def test_lavapipe(self):
        done = self.fuzz("--cases=12288", renderer=(), check=1)
        causes = self.ledger()["causes"]
        scissor = [c for c in causes if c["symptom"].startswith(("missing", "extra")) and "draw.scissor" in c["essentials"]]
        self.assertTrue(scissor, done.stdout)
        self.assertLess(len(causes), 16, done.stdout)
        again = self.edgecase("run", self.folder / "hunt/found", "--no-expect", "-o", "run", check=1)
        self.assertNotIn("pass", re.search(r"\n\d+ cases? .*\n", again.stdout)[0])


if __name__ == "__main__":
    unittest.main()
