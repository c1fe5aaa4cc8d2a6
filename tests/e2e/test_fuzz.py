# SPDX-FileCopyrightText: The Edgecase authors
# SPDX-License-Identifier: Apache-2.0
"""edgecase fuzz: hunts on lavapipe, whose defects and planted faults are found without a case of the suite."""
import json
import os
import signal
import subprocess
import time
import tomllib
import unittest

import jsonschema

from support import PROGRAM, SOURCE, ProgramTest


class FuzzTest(ProgramTest):
    def fuzz(self, *words, fault="", out=None, check=None):
        return self.edgecase("fuzz", "-o", out or self.folder / "hunt", *words, fault=fault, check=check)

    def ledger(self, folder="hunt"):
        return json.loads((self.folder / folder / "fuzz.json").read_text())

    def accounted(self, ledger):
        """Each failing case counts once: in a cause, in one that is not reduced, or as one that did not come again."""
        return sum(c["count"] for c in ledger["causes"]) + ledger["unrepeated_failures"]

    def found(self, folder="hunt"):
        return {p.name: p.read_text() for p in (self.folder / folder / "found").glob("*.toml")}


class Hunts(FuzzTest):
    def test_causes_are_reduced_and_kept(self):
        done = self.fuzz("--cases=12288", check=1)
        ledger, found = self.ledger(), self.found()
        jsonschema.Draft7Validator(json.loads((SOURCE / "docs/schema/fuzz-1.json").read_text())).validate(ledger)
        self.assertTrue(ledger["is_finished"])
        self.assertEqual(ledger["unjudged_cases"], 0)
        self.assertLess(ledger["judged_cases"] + ledger["unsupported_cases"] + ledger["empty_cases"], 12289)
        self.assertGreater(ledger["judged_cases"], 6000)
        # lavapipe's scissor that ends beyond 65535 draws nothing (docs/findings/lavapipe-scissor-16-bits.md).
        scissor = [c for c in ledger["causes"] if c["essentials"] == ["draw.scissor"]]
        self.assertTrue(scissor, done.stdout)
        self.assertIn("not without scissor", scissor[0]["needs"])
        # One entry a cause, not one a failing case.
        self.assertLess(len(ledger["causes"]), 16, done.stdout)
        self.assertGreater(ledger["failed_cases"], 50)
        self.assertEqual(ledger["waiting"], [])
        self.assertEqual(self.accounted(ledger), ledger["failed_cases"])
        self.assertEqual(len(found), len(ledger["causes"]))
        for cause in ledger["causes"]:
            path = self.folder / "hunt" / cause["file"]
            text = path.read_text()
            self.assertTrue(text.startswith(f"# {cause['symptom']}, found by 'edgecase fuzz --seed 1' in case "), text)
            self.assertTrue(cause["is_minimal"])
            if "a suite wants one triangle more" in text:
                self.assertIn("no sample must be covered", self.edgecase("lint", path, check=3).stderr)
            else:
                self.edgecase("lint", path, check=0)
            # Three times out of three, in fresh processes.
            for _ in range(3):
                self.edgecase("run", path, "--no-expect", "-q", "-o", "run", check=1)
        # What is known is no news. (A few causes may be: the first hunt reduced a part of what failed.)
        done = self.fuzz("--cases=12288", "--known", self.folder / "hunt", out=self.folder / "again")
        known = {(c["symptom"], *c["essentials"]) for c in ledger["causes"]}
        again = self.ledger("again")["causes"]
        fresh = [c for c in again if not c["is_known"]]
        self.assertLess(len(fresh), len(found) / 2, done.stdout)
        self.assertFalse(known & {(c["symptom"], *c["essentials"]) for c in fresh}, done.stdout)
        self.assertGreater(sum(c["count"] for c in again if c["is_known"]), 50)
        # Two hunts that know a third one bring its causes once.
        self.fuzz("--cases=128", "--known", self.folder / "hunt", "--known", self.folder / "again", out=self.folder / "third")
        files = [c["file"] for c in self.ledger("third")["causes"] if c["is_known"]]
        self.assertEqual(len(files), len(set(files)))
        self.assertEqual(len(files), len(again))

    def test_a_planted_fault(self):
        """Known defects of the driver hide none."""
        self.fuzz("--cases=2048")
        self.fuzz("--cases=2048", "--known", self.folder / "hunt", fault="flip-pixel@*", out=self.folder / "flipped", check=1)
        found = self.found("flipped")
        self.assertTrue(any("cover.outside" in name for name in found), found.keys())
        smallest = min(found.values(), key=len)
        self.assertEqual(smallest.count("[[draw]]"), 1)
        self.assertLess(len(smallest), 420, smallest)

    def test_the_same_seed_finds_the_same(self):
        for folder in ("a", "b"):
            self.fuzz("--cases=1024", fault="flip-pixel@*", out=self.folder / folder, check=1)
        self.assertEqual(self.found("a"), self.found("b"))
        self.fuzz("--cases=1024", "--seed=2", fault="flip-pixel@*", out=self.folder / "c", check=1)
        self.assertNotEqual(self.found("a"), self.found("c"))

    def test_shards_share_out_the_cases(self):
        self.fuzz("--cases=1536")
        whole = self.ledger()
        parts = []
        for part in "123":
            self.fuzz("--cases=1536", f"--shard={part}/3", out=self.folder / part)
            parts.append(self.ledger(part))
        for key in ("judged_cases", "unsupported_cases", "empty_cases"):
            self.assertEqual(sum(part[key] for part in parts), whole[key], key)
        self.assertGreater(min(part["judged_cases"] for part in parts), 0)

    def test_a_crash_is_a_cause(self):
        self.fuzz("--cases=128", fault="segv@*", check=1)
        causes = self.ledger()["causes"]
        self.assertEqual([c["symptom"] for c in causes], ["crash by SIGSEGV"])
        self.assertEqual(causes[0]["essentials"], [])
        # A death that does not come again when the case is drawn alone is no cause, but the case is kept.
        done = self.fuzz("--cases=128", fault="segv@77", out=self.folder / "one", check=1)
        self.assertNotIn("crash by SIGSEGV", [c["symptom"] for c in self.ledger("one")["causes"]])
        self.assertEqual(self.ledger("one")["unrepeated_failures"], 1)
        self.assertIn("did not come again when drawn alone: 1 failing case; see ", done.stdout)
        self.assertEqual((self.folder / "one/unrepeated-1.toml").read_text(), self.edgecase("fuzz", "--print=77").stdout)

    def test_what_waits_when_time_ends_is_kept(self):
        """The time is over before the first reduction: nothing of what failed is lost."""
        done = self.fuzz("--time=0.001s", fault="flip-pixel@*", check=1)
        ledger, found = self.ledger(), self.found()
        jsonschema.Draft7Validator(json.loads((SOURCE / "docs/schema/fuzz-1.json").read_text())).validate(ledger)
        self.assertEqual(ledger["reductions"], 0)
        self.assertGreater(ledger["failed_cases"], 100)
        self.assertEqual(len(ledger["waiting"]), ledger["failed_cases"])
        self.assertEqual(self.accounted(ledger), ledger["failed_cases"])
        self.assertIn(f"not reduced, and explained by no cause: {ledger['failed_cases']} failing cases; go on with", done.stdout)
        self.assertEqual(sorted(found), sorted(c["file"].removeprefix("found/") for c in ledger["causes"]))
        self.assertEqual(len({c["symptom"] for c in ledger["causes"]}), len(found))
        for cause in ledger["causes"]:
            self.assertFalse(cause["is_reduced"])
            text = (self.folder / "hunt" / cause["file"]).read_text()
            self.assertIn("\n# Not reduced: the hunt ended before.", text)
            self.assertIn(f"FOUND {cause['symptom']}, not reduced\n", done.stdout)
            # As it was drawn, but for what says what was shown.
            drawn = tomllib.loads(self.edgecase("fuzz", f"--print={cause['first_case']}").stdout)
            kept = tomllib.loads(text)
            for key in ("description", "rules"):
                kept.pop(key, None), drawn.pop(key, None)
            self.assertEqual(kept, drawn)
        # What is not reduced is not known to another hunt, and one that goes on reduces it first.
        self.fuzz("--time=0.001s", "--known", self.folder / "hunt", fault="flip-pixel@*", out=self.folder / "b", check=1)
        self.assertFalse([c for c in self.ledger("b")["causes"] if c["is_known"]])
        done = self.edgecase("fuzz", "--resume", "hunt", "--cases", str(ledger["next_case"]), fault="flip-pixel@*", check=1)
        after = self.ledger()
        self.assertEqual((after["waiting"], after["next_case"]), ([], ledger["next_case"]))
        self.assertTrue(all(c["is_reduced"] for c in after["causes"]))
        self.assertEqual(self.accounted(after), ledger["failed_cases"])
        self.assertFalse([name for name in self.found() if name.startswith("not-reduced")])

    def test_an_interrupted_hunt_goes_on(self):
        program = subprocess.Popen([PROGRAM, "fuzz", "-o", "hunt"], cwd=self.folder,
                                   env=self.environment(), stdout=subprocess.PIPE, text=True)
        ledger = self.folder / "hunt/fuzz.json"
        while not ledger.exists() or self.ledger()["next_case"] == 0:
            time.sleep(0.05)
        os.kill(program.pid, signal.SIGINT)
        out = program.communicate(timeout=60)[0]
        self.assertEqual(program.returncode, 130, out)
        self.assertIn("go on with 'edgecase fuzz --resume hunt'", out)
        reached = self.ledger()["next_case"]
        self.assertGreater(reached, 0)
        self.edgecase("fuzz", "--resume", "hunt", "--cases", str(reached + 1024))
        self.assertEqual(self.ledger()["next_case"], reached + 1024)
        parts = self.ledger()["judged_cases"]
        self.fuzz("--cases", str(reached + 1024), out=self.folder / "whole")
        self.assertEqual(self.ledger("whole")["judged_cases"], parts)

    def test_a_killed_hunt_goes_on(self):
        program = subprocess.Popen([PROGRAM, "fuzz", "-o", "hunt"], cwd=self.folder,
                                   env=self.environment(), stdout=subprocess.DEVNULL)
        while not (self.folder / "hunt/fuzz.json").exists():
            time.sleep(0.05)  # killed within its first step, perhaps
        program.kill()
        program.wait()
        reached = self.ledger()["next_case"]
        self.edgecase("fuzz", "--resume", "hunt", "--cases", str(reached + 256))
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

    def test_a_hunt_that_goes_on_cannot_change(self):
        for words in (["--seed", "3"], ["--shard", "1/2"], ["--profile", "vulkan"], ["-o", "other"], ["--print", "7"]):
            name = {"-o": "--output"}.get(words[0], words[0])
            self.refused(["--resume", "hunt", *words], f"so {name} cannot be given; leave it out or start a new hunt")

    def test_folders(self):
        self.refused(["--resume", "nothing"], "'nothing' is not the folder of a hunt", 3)
        self.refused(["--known", "nothing"], "'nothing' is not the folder of a hunt", 3)
        (self.folder / "file").write_text("")
        self.refused(["-o", "file/x"], "cannot be made")
        self.fuzz("--cases=128")
        self.refused(["-o", "hunt"], "holds a hunt already; go on with it by --resume")
        self.refused(["--renderer=tiles", "--resume", "hunt"], "the hunt cannot go on", 5)
        ledger = self.folder / "hunt/fuzz.json"
        ledger.write_text(ledger.read_text()[:200])
        self.refused(["--resume", "hunt"], "is malformed", 3)

    def test_two_hunts_in_one_folder(self):
        program = subprocess.Popen([PROGRAM, "fuzz", "-o", "hunt"], cwd=self.folder,
                                   env=self.environment(), stdout=subprocess.DEVNULL)
        try:
            while not (self.folder / "hunt/fuzz.json").exists():
                time.sleep(0.05)
            self.refused(["--resume", "hunt"], "another hunt is writing to 'hunt'")
        finally:
            program.kill()
            program.wait()


class Reduce(ProgramTest):
    def reduce(self, *words, fault="", check=None):
        return self.edgecase("reduce", *words, fault=fault, check=check)

    def test_a_case_of_the_suite(self):
        """lavapipe's scissor with several samples: a mesh in four draws becomes two triangles."""
        self.suite = SOURCE / "cases" / "suite"
        done = self.reduce("multisample/scissor-tiled:samples=4", "-o", "smaller.toml", check=0)
        self.assertRegex(done.stderr, r"\Afrom 4 draws, 248 triangles, 16 x 16 with 4 samples to 2 draws, 2 triangles, \d+ x \d+ with 4 samples")
        text = (self.folder / "smaller.toml").read_text()
        self.assertRegex(text, r"\A# double of scissor.half-open \[vulkan\], reduced from multisample/scissor-tiled:samples=4\.\n")
        self.assertIn("# It passes, or fails otherwise: not with 1 sample.\n", text)
        self.edgecase("lint", "smaller.toml", check=0)
        self.edgecase("run", "smaller.toml", "--no-expect", "-o", "out", check=1)
        # What it needs is true: without one of it, it passes.
        (self.folder / "less.toml").write_text(text.replace("samples = 4\n", ""))
        self.edgecase("run", "less.toml", "--no-expect", "-o", "out", check=0)
        # A reduced case is not made smaller once more.
        again = self.reduce("smaller.toml", check=0).stdout
        self.assertEqual([line for line in again.splitlines() if not line.startswith("#")],
                         [line for line in text.splitlines() if not line.startswith("#")])
        self.assertIn("exists; name another file", self.reduce("smaller.toml", "-o", "less.toml", check=2).stderr)

    def test_a_crash(self):
        done = self.reduce("fam/c3", fault="segv@*,segv@*/*", check=0)
        self.assertTrue(done.stdout.startswith("# crash by SIGSEGV, reduced from fam/c3.\n"), done.stdout)
        self.assertEqual(done.stdout.count("[[draw]]"), 1)

    def test_wrong_input(self):
        self.assertIn("fam/c3 does not fail here (pass), so there is nothing to reduce", self.reduce("fam/c3", check=6).stderr)
        self.assertIn("did not fail the same way again", self.reduce("fam/c3", fault="flip-pixel@fam/c3", check=1).stderr)
        self.assertIn("give the id of one", self.reduce(check=2).stderr)
        self.assertIn("no case matches", self.reduce("fam/c33", check=4).stderr)
        self.assertIn("/nowhere.json", self.reduce("fam/c3", "--icd", "/nowhere.json", check=5).stderr)
        self.assertIn("cannot be written", self.reduce("fam/c3", "-o", "no/where.toml", fault="segv@*,segv@*/*", check=7).stderr)


if __name__ == "__main__":
    unittest.main()
