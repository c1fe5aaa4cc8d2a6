# SPDX-FileCopyrightText: The Edgecase authors
# SPDX-License-Identifier: Apache-2.0
"""edgecase fuzz: hunts on lavapipe, whose defects and planted faults are found without a case of the suite."""
import fractions
import json
import os
import pathlib
import re
import shutil
import signal
import subprocess
import time
import tomllib
import unittest

import jsonschema

from support import CASE, PROGRAM, SOURCE, ProgramTest


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

    def interrupted(self, *words, fault=""):
        """A hunt that is interrupted after its first step, of which every failing case is known or waits."""
        program = subprocess.Popen([PROGRAM, "fuzz", "-o", "hunt", *words], cwd=self.folder,
                                   env=self.environment(fault), stdout=subprocess.PIPE, text=True)
        ledger = self.folder / "hunt/fuzz.json"
        while not ledger.exists() or self.ledger()["next_case"] == 0:
            time.sleep(0.05)
        os.kill(program.pid, signal.SIGINT)
        out = program.communicate(timeout=60)[0]
        self.assertEqual(program.returncode, 130, out)
        self.assertIn("go on with 'edgecase fuzz --resume hunt'", out)
        return out


class Hunts(FuzzTest):
    def test_what_was_not_judged_is_not_counted(self):
        """Quads draw no target of the fuzzer's: no triangle of such a case was judged."""
        done = self.fuzz("--renderer=quads", "--cases=128", check=6)
        ledger = self.ledger()
        self.assertEqual(ledger["unsupported_cases"], 128)
        self.assertEqual((ledger["judged_cases"], ledger["triangles"]), (0, 0))
        self.assertIn("0 cases and 0 triangles judged in ", done.stdout)

    def test_causes_are_reduced_and_kept(self):
        done = self.fuzz("--seed=6", "--cases=1152", check=1)
        ledger, found = self.ledger(), self.found()
        jsonschema.Draft7Validator(json.loads((SOURCE / "docs/schema/fuzz-1.json").read_text())).validate(ledger)
        self.assertTrue(ledger["is_finished"])
        self.assertEqual(ledger["unjudged_cases"], 0)
        self.assertLess(ledger["judged_cases"] + ledger["unsupported_cases"] + ledger["empty_cases"], 1153)
        self.assertGreater(ledger["judged_cases"], 300)
        # lavapipe loses what a scissor that ends beyond 65535 leaves (docs/findings/lavapipe-scissor-16-bits.md).
        scissor = [c for c in ledger["causes"] if c["essentials"] == ["draw.scissor", "draw.scissor beyond 32767"]]
        self.assertTrue(scissor, done.stdout)
        self.assertIn("not without scissor", scissor[0]["needs"])
        # One entry a cause, not one a failing case.
        self.assertLess(len(ledger["causes"]), 16, done.stdout)
        self.assertGreater(ledger["failed_cases"], 25)
        self.assertEqual(ledger["waiting"], [])
        self.assertEqual(self.accounted(ledger), ledger["failed_cases"])
        self.assertEqual(len(found), len(ledger["causes"]))
        for cause in ledger["causes"]:
            path = self.folder / "hunt" / cause["file"]
            text = path.read_text()
            self.assertTrue(text.startswith(f"# {cause['symptom']}, found by 'edgecase fuzz --seed 6' in case "), text)
            self.assertTrue(cause["is_minimal"])
            self.assertRegex(cause["seen"], ": expected .+, got .+; .+")
            self.assertIn(f"\n# Seen: {cause['seen']}.\n", text)
            self.assertIn(f"\n      seen: {cause['seen']}\n", done.stdout)
            if "a suite wants one more" in text:
                self.assertIn("so a device that draws nothing would pass", self.edgecase("lint", path, check=3).stderr)
            else:
                self.edgecase("lint", path, check=0)
        # Three times out of three, in fresh processes: all the files at once.
        for _ in range(3):
            self.edgecase("run", self.folder / "hunt/found", "--no-expect", "-q", "-o", self.folder / "run", check=1)
            self.assertEqual(set(self.statuses(self.folder / "run").values()), {"fail"})
            self.assertEqual(len(self.statuses(self.folder / "run")), len(found))
        # What is known is no news. (A few causes may be: the first hunt reduced a part of what failed.)
        done = self.fuzz("--seed=6", "--cases=1152", "--known", self.folder / "hunt", out=self.folder / "again")
        known = {(c["symptom"], *c["essentials"]) for c in ledger["causes"]}
        again = self.ledger("again")["causes"]
        fresh = [c for c in again if not c["is_known"]]
        self.assertLess(len(fresh), len(found) / 2, done.stdout)
        self.assertFalse(known & {(c["symptom"], *c["essentials"]) for c in fresh}, done.stdout)
        self.assertGreater(sum(c["count"] for c in again if c["is_known"]), 10)
        # Two hunts that know a third one bring its causes once.
        self.fuzz("--cases=128", "--known", self.folder / "hunt", "--known", self.folder / "again", out=self.folder / "third")
        files = [c["file"] for c in self.ledger("third")["causes"] if c["is_known"]]
        self.assertEqual(len(files), len(set(files)))
        self.assertEqual(len(files), len(again))

    def test_what_the_validation_layer_says_is_told(self):
        """Of what is valid it says nothing, unless it is asked for its opinion on what is good."""
        self.fuzz("--cases=128", "--validation")
        self.assertEqual(self.ledger()["unjudged_cases"], 0)
        os.environ["VK_LAYER_ENABLES"] = "VK_VALIDATION_FEATURE_ENABLE_BEST_PRACTICES_EXT"
        self.addCleanup(os.environ.pop, "VK_LAYER_ENABLES")
        done = self.fuzz("--cases=128", "--validation", out=self.folder / "opinion", check=7)
        self.assertGreater(self.ledger("opinion")["unjudged_cases"], 0)
        self.assertIn("a case could not be judged: the validation layer says: ", done.stderr)

    def test_a_planted_fault(self):
        """Known defects of the driver hide none."""
        self.fuzz("--cases=256")
        self.fuzz("--cases=256", "--known", self.folder / "hunt", fault="flip-pixel@*", out=self.folder / "flipped", check=1)
        found = self.found("flipped")
        self.assertTrue(any("cover.outside" in name for name in found), found.keys())
        smallest = min(found.values(), key=len)
        self.assertEqual(smallest.count("[[draw]]"), 1)
        text = "".join(line for line in smallest.splitlines(True) if not line.startswith("#"))
        self.assertLess(len(text), 320, smallest)

    def test_the_same_seed_finds_the_same(self):
        for folder in ("a", "b"):
            self.fuzz("--cases=96", fault="flip-pixel@*", out=self.folder / folder, check=1)
        self.assertGreater(len(self.found("a")), 1)
        self.assertEqual(self.found("a"), self.found("b"))
        self.fuzz("--cases=96", "--seed=2", fault="flip-pixel@*", out=self.folder / "c", check=1)
        self.assertNotEqual(self.found("a"), self.found("c"))

    def test_shards_share_out_the_cases(self):
        self.fuzz("--seed=4", "--cases=384")
        whole = self.ledger()
        parts = []
        for part in "123":
            self.fuzz("--seed=4", "--cases=384", f"--shard={part}/3", out=self.folder / part)
            parts.append(self.ledger(part))
        for key in ("judged_cases", "unsupported_cases", "empty_cases"):
            self.assertEqual(sum(part[key] for part in parts), whole[key], key)
        self.assertGreater(min(part["judged_cases"] for part in parts), 0)

    def test_a_crash_is_a_cause(self):
        self.fuzz("--seed=2", "--cases=64", fault="segv@*", check=1)
        causes = self.ledger()["causes"]
        self.assertEqual([c["symptom"] for c in causes], ["crash by SIGSEGV"])
        self.assertEqual(causes[0]["essentials"], [])
        # A death that does not come again when the case is drawn alone is no cause, but the case is kept.
        done = self.fuzz("--cases=64", fault="segv@37", out=self.folder / "one", check=1)
        self.assertNotIn("crash by SIGSEGV", [c["symptom"] for c in self.ledger("one")["causes"]])
        self.assertEqual(self.ledger("one")["unrepeated_failures"], 1)
        self.assertIn("did not come again when drawn alone: 1 failing case; see ", done.stdout)
        self.assertEqual((self.folder / "one/unrepeated-1.toml").read_text(), self.edgecase("fuzz", "--print=37").stdout)

    def test_what_waits_when_a_hunt_ends_is_kept(self):
        """Some reductions are done after the first step: nothing of what else failed is lost."""
        out = self.interrupted("--cases=1024", fault="flip-pixel@*")
        ledger, found = self.ledger(), self.found()
        jsonschema.Draft7Validator(json.loads((SOURCE / "docs/schema/fuzz-1.json").read_text())).validate(ledger)
        self.assertGreater(ledger["failed_cases"], 100)
        waiting = len(ledger["waiting"])
        self.assertGreater(waiting, 0)
        self.assertEqual(self.accounted(ledger), ledger["failed_cases"])
        self.assertIn(f"not reduced, and explained by no cause: {waiting} failing case", out)
        self.assertEqual(sorted(found), sorted(c["file"].removeprefix("found/") for c in ledger["causes"]))
        open_causes = [c for c in ledger["causes"] if not c["is_reduced"]]
        self.assertEqual(sum(c["count"] for c in open_causes), waiting)
        self.assertEqual(len({c["symptom"] for c in open_causes}), len(open_causes))
        for cause in open_causes:
            text = (self.folder / "hunt" / cause["file"]).read_text()
            self.assertIn("\n# Not reduced: the hunt ended before.", text)
            self.assertIn(f"FOUND {cause['symptom']}, not reduced\n", out)
            # As it was drawn, but for what says what was shown.
            drawn = tomllib.loads(self.edgecase("fuzz", f"--print={cause['first_case']}").stdout)
            kept = tomllib.loads(text)
            for key in ("description", "rules"):
                kept.pop(key, None), drawn.pop(key, None)
            self.assertEqual(kept, drawn)
        # What is not reduced is not known to another hunt, and one that goes on reduces it first.
        self.fuzz("--cases=32", "--known", self.folder / "hunt", fault="flip-pixel@*", out=self.folder / "b")
        self.assertEqual(len([c for c in self.ledger("b")["causes"] if c["is_known"]]), len(found) - len(open_causes))
        done = self.edgecase("fuzz", "--resume", "hunt", "--cases", str(ledger["next_case"]), fault="flip-pixel@*", check=1)
        after = self.ledger()
        self.assertEqual((after["waiting"], after["left"], after["next_case"]), ([], [], ledger["next_case"]))
        self.assertTrue(all(c["is_reduced"] for c in after["causes"]))
        self.assertEqual(self.accounted(after), after["failed_cases"])
        self.assertGreaterEqual(after["failed_cases"], ledger["failed_cases"])
        self.assertFalse([name for name in self.found() if name.startswith("not-reduced")])

    def test_an_interrupted_hunt_goes_on(self):
        self.interrupted()
        reached = self.ledger()["next_case"]
        self.assertGreater(reached, 0)
        self.edgecase("fuzz", "--resume", "hunt", "--cases", str(reached + 256))
        self.assertEqual(self.ledger()["next_case"], reached + 256)
        parts = self.ledger()["judged_cases"]
        self.fuzz("--cases", str(reached + 256), out=self.folder / "whole")
        self.assertEqual(self.ledger("whole")["judged_cases"], parts)

    def test_a_hunt_whose_time_ends_within_a_chunk_goes_on(self):
        """Its first chunk has hardly begun when the time is over; whatever it has judged counts once."""
        self.fuzz("--cases=256", "--time=0.001s")
        first = self.ledger()
        jsonschema.Draft7Validator(json.loads((SOURCE / "docs/schema/fuzz-1.json").read_text())).validate(first)
        done = [first[key] for key in ("judged_cases", "unsupported_cases", "empty_cases")]
        self.assertEqual(sum(done) + len(first["left"]), 256)
        self.edgecase("fuzz", "--resume", "hunt", "--cases=256")
        after = self.ledger()
        self.assertEqual(after["left"], [])
        self.fuzz("--cases=256", out=self.folder / "whole")
        for key in ("judged_cases", "unsupported_cases", "empty_cases", "triangles"):
            self.assertEqual(after[key], self.ledger("whole")[key], key)

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
        self.refused(["nonsense/**"], "no case matches nonsense/**", 4)
        self.refused(["fam/c0", "fam/c00"], "no case matches fam/c00", 4)
        self.refused(["!**"], "", 4)
        self.refused(["-"], "'-' does not go with fuzz; name the cases")
        self.refused(["--renderer", "referenc"], "referenc")
        self.refused(["--icd", "/nowhere.json"], "/nowhere.json", 5)

    def test_a_value_that_makes_no_case(self):
        file = self.folder / "open.toml"
        text = ('format = 1\ndescription = "a"\ncatches = "b"\nrules = ["cover.inside"]\n[fuzz]\nface = FACES\n'
                'x = { from = 4, to = 7 }\n[target]\nsize = [8, 8]\n[[draw]]\ncull = "face"\nvertices = [[0, 0], ["x", 0], [0, 8]]\n')
        sentence = 'with the value sideways of the [fuzz] key face no case can be loaded: '
        file.write_text(text.replace("FACES", '["none", "sideways"]'))
        self.refused([str(file), "--cases", "4"], sentence, 3)
        done = self.edgecase("lint", str(file), check=3)
        self.assertIn(f"{file}:6:1: error: {sentence}", done.stderr)
        self.assertIn("1 case checked, 1 error", done.stdout)
        file.write_text(text.replace("FACES", '["none", "back"]'))
        self.assertIn("1 case checked, 0 errors", self.edgecase("lint", str(file), check=0).stdout)

    def test_a_hunt_that_goes_on_cannot_change(self):
        self.refused(["--resume", "hunt", "--print", "7"], "--print and --resume exclude each other; leave out one of the two")
        for words in (["--seed", "3"], ["--shard", "1/2"], ["--profile", "vulkan"], ["-o", "other"]):
            name = {"-o": "--output"}.get(words[0], words[0])
            self.refused(["--resume", "hunt", *words], f"so {name} cannot be given; leave it out or start a new hunt")
        self.refused(["--resume", "hunt", "fam/**"], "so no selector can be given; leave it out or start a new hunt")

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


OPEN = """format = 1
description = "A triangle that is open in three ways."
rules = ["cover.inside"]
[fuzz]
x    = { from = 0, to = 4, step = "1/256" }
y    = { from = -2, to = 2, nominal = 1 }
face = ["none", "back"]
[target]
size = [8, 8]
[[draw]]
cull = "face"
vertices = [["2+x", 2], [2, "6+y"], [7, 7]]
"""


class Starts(FuzzTest):
    """Hunts that start from cases: of the suite, or of one's own."""

    def numbers(self, ledger):
        return sum(ledger[key] for key in ("judged_cases", "unsupported_cases", "empty_cases", "numbers_without_case"))

    def test_cases_of_the_suite_are_changed(self):
        """lavapipe's scissor that ends beyond 65535 is a change away from triangles without one."""
        self.suite = SOURCE / "cases" / "suite"
        done = self.fuzz("ties/**", "--cases=4096", "--no-expect", check=1)
        ledger, found = self.ledger(), self.found()
        jsonschema.Draft7Validator(json.loads((SOURCE / "docs/schema/fuzz-1.json").read_text())).validate(ledger)
        self.assertRegex(done.stdout, r"\Afuzzing .* from \d+ cases on, with seed 1 at profile direct3d")
        self.assertRegex(done.stdout, r"; \d+ changes that made no case\n")
        self.assertEqual((ledger["selectors"], ledger["unjudged_cases"]), (["ties/**"], 0))
        self.assertEqual(self.numbers(ledger), 4096)
        self.assertGreater(ledger["refused_changes"], 0)
        self.assertEqual(self.accounted(ledger), ledger["failed_cases"])
        self.assertTrue([c for c in ledger["causes"] if c["essentials"] == ["draw.scissor", "draw.scissor beyond 32767"]], done.stdout)
        for name, text in found.items():
            self.assertRegex(text, r"\A# .*, found by 'edgecase fuzz ties/\*\* --seed 1' in case \d+ on ", name)
        # The case before its reduction says what it was and what was changed; it fails, and its start passes.
        number = next(c["first_case"] for c in ledger["causes"])
        text = self.edgecase("fuzz", "ties/**", f"--print={number}", check=0).stdout
        start = tomllib.loads(text)["description"]
        self.assertRegex(start, r"\AMade by edgecase fuzz of ties/\S+: \S.*\.\Z")
        (self.folder / "printed.toml").write_text(text)
        self.edgecase("run", "printed.toml", "--no-expect", "-q", "-o", "run", check=1)
        self.edgecase("run", start.removeprefix("Made by edgecase fuzz of ").split(": ")[0], "-q", "-o", "run2", check=0)

    def test_a_file_of_ones_own(self):
        (self.folder / "own.toml").write_text(CASE.format(n=77))
        self.fuzz("own.toml", "--cases=512", fault="flip-pixel@*", check=1)
        self.assertEqual(self.numbers(self.ledger()), 512)
        self.assertIn("of own: ", self.edgecase("fuzz", "own.toml", "--print=5", check=0).stdout)

    def test_what_a_file_leaves_open_is_varied(self):
        (self.folder / "open.toml").write_text(OPEN)
        self.fuzz("open.toml", "--cases=256", check=0)
        self.assertEqual(self.ledger()["judged_cases"], 256)
        seen = set()
        for number in range(24):
            draw = tomllib.loads(self.edgecase("fuzz", "open.toml", f"--print={number}", check=0).stdout)["draw"][0]
            (x, top), (left, y), corner = draw["vertices"]
            self.assertEqual((top, left, corner), (2, 2, [7, 7]))
            x = sum(fractions.Fraction(part) for part in re.findall(r"[+-]?[^+-]+", str(x)))
            self.assertTrue(2 <= x <= 6 and (x * 256).denominator == 1 and y in (4, 5, 6, 7, 8), draw)
            seen.add((x, y, draw.get("cull", "none")))
        self.assertGreater(len(seen), 20)
        # A fault on some of it only is found, and ordinary commands draw the nominal case.
        self.fuzz("open.toml", "--cases=64", fault="flip-pixel@7", out=self.folder / "faulty", check=1)
        self.assertEqual(self.ledger("faulty")["unrepeated_failures"], 1)
        self.edgecase("lint", "open.toml", check=0)
        self.edgecase("run", "open.toml", "-q", "-o", "run", check=0)
        self.assertIn("here x = 0, y = 1, face = none", self.edgecase("list", "--long", "open.toml").stdout)
        (self.folder / "wrong.toml").write_text(OPEN.replace("from = 0, to = 4", "from = 4, to = 0"))
        for words in (["fuzz", "wrong.toml"], ["lint", "wrong.toml"], ["run", "wrong.toml"]):
            self.assertIn("wrong.toml:5:17: error: the range of x goes from 4 to 0; exchange from and to",
                          self.edgecase(*words, check=3).stderr)

    def test_shards_and_going_on(self):
        self.fuzz("fam/**", "--cases=768")
        whole, parts = self.ledger(), []
        for part in "123":
            self.fuzz("fam/**", "--cases=768", f"--shard={part}/3", out=self.folder / part)
            parts.append(self.numbers(self.ledger(part)))
        self.assertEqual(sum(parts), self.numbers(whole))
        self.assertEqual(max(parts), 256)
        self.fuzz("fam/**", "--cases=300", out=self.folder / "first")
        self.edgecase("fuzz", "--resume", "first", "--cases=768")
        for key in ("judged_cases", "triangles", "numbers_without_case", "refused_changes"):
            self.assertEqual(self.ledger("first")[key], whole[key], key)
        # With other cases the numbers mean other ones.
        self.write_case("fam/c0", CASE.format(n=0).replace("[1,1]", "[2,1]"))
        self.assertIn("the cases that it starts from have changed", self.edgecase("fuzz", "--resume", "first", check=3).stderr)

    def test_what_waits_is_reduced_later(self):
        """Cases that wait for their reduction are made again from their numbers."""
        self.interrupted("fam/**", "--cases=1024", fault="flip-pixel@*")
        before = self.ledger()
        self.assertGreater(len(before["waiting"]), 0)
        self.edgecase("fuzz", "--resume", "hunt", "--cases", str(before["next_case"]), fault="flip-pixel@*", check=1)
        after = self.ledger()
        self.assertEqual((after["waiting"], after["left"]), ([], []))
        self.assertEqual(self.accounted(after), after["failed_cases"])


class Known(FuzzTest):
    """What expectation files explain is known by what it needs, and hides nothing else."""

    def setUp(self):
        super().setUp()
        shutil.copytree(SOURCE / "cases" / "suite" / "coverage", self.suite / "coverage")
        shutil.copytree(SOURCE / "cases" / "suite" / "multisample", self.suite / "multisample")
        shutil.copytree(SOURCE / "cases" / "suite" / "scissor", self.suite / "scissor")
        shutil.copytree(SOURCE / "cases" / "expectations", self.suite.parent / "expectations")

    def layered(self, *words, fault, check):
        """A hunt on lavapipe with a fault of the breaking layer."""
        layer = os.environ.get("EDGECASE_BREAKING_LAYER", str(pathlib.Path(PROGRAM).parents[1] / "breaking_layer"))
        if not pathlib.Path(layer, "libbreaking_layer.so").exists():
            self.skipTest("the breaking layer is not built")
        env = self.environment() | {"VK_LAYER_PATH": layer, "VK_INSTANCE_LAYERS": "VK_LAYER_EDGECASE_breaking",
                                    "EDGECASE_BREAK": fault, "EDGECASE_BREAK_COUNT": str(self.folder / "altered")}
        return self.edgecase("fuzz", *words, env=env, check=check)

    def test_a_hunt_that_is_killed_while_it_reduces_known_failures_goes_on(self):
        # A worker hangs over a known failure, so that this does not end by itself. Cases of the hunt have been drawn
        # before, and one has failed; a log is told of all that every ten seconds.
        hanging = self.environment() | {"EDGECASE_FAULT": "hang@scissor/*"}
        program = subprocess.Popen([PROGRAM, "fuzz", "scissor/**", "--timeout=3000", "-o", "hunt"], cwd=self.folder, env=hanging,
                                   stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        try:
            line = next(line for line in program.stderr if "expected failures" in line)
        finally:
            program.kill()
            program.communicate()
        self.assertRegex(line, r"^[1-9]\d* cases judged, \d+/s, [1-9]\d* failed, 0 causes known and 0 new, drawing expected failures, \d+ s$")
        self.assertEqual((self.ledger()["next_case"], self.ledger()["expectations"]), (0, ""))
        self.edgecase("fuzz", "--resume", "hunt", "--cases=1024")
        known = [c for c in self.ledger()["causes"] if c["is_known"]]
        self.assertTrue(known)
        # Those that were reduced before it was killed are not reduced again.
        ledger = self.folder / "hunt/fuzz.json"
        text = json.loads(ledger.read_text())
        ledger.write_text(json.dumps(text | {"expectations": ""}))
        self.edgecase("fuzz", "--resume", "hunt", "--cases=1536")
        self.assertEqual([c["file"] for c in self.ledger()["causes"] if c["is_known"]][:len(known)], [c["file"] for c in known])

    def test_expected_failures_are_drawn_when_a_case_fails(self):
        # A worker would hang over each of them; no case of the hunt fails.
        self.fuzz("coverage/**", "--cases=256", "--profile=vulkan", "--timeout=3000", fault="hang@scissor/*", check=0)
        self.assertGreater(self.ledger()["judged_cases"], 50)
        self.assertEqual((self.ledger()["causes"], self.ledger()["expectations"]), ([], ""))

    def test_known_defects_are_known_and_others_are_told(self):
        start = ["scissor/**", "multisample/**"]
        # Without expectation files lavapipe's defects are news.
        self.fuzz(*start, "--cases=2048", "--no-expect", check=1)
        defects = [c for c in self.ledger()["causes"] if c["symptom"].startswith("extra of scissor.half-open")]
        self.assertTrue(defects)
        # A hunt that was told to read none reads none when it goes on, unless it is told to.
        resume = ["fuzz", "--resume", "hunt", "--cases=2056"]
        self.assertNotIn("known by", self.edgecase(*resume).stdout)
        self.assertFalse([c for c in self.ledger()["causes"] if c["is_known"]])
        # With them they are not: each is reduced once, from a case that is expected to fail.
        done = self.fuzz(*start, "--cases=2048", out=self.folder / "known")
        ledger = self.ledger("known")
        jsonschema.Draft7Validator(json.loads((SOURCE / "docs/schema/fuzz-1.json").read_text())).validate(ledger)
        known = [c for c in ledger["causes"] if c["is_known"]]
        self.assertRegex(done.stdout, r"^fuzzing [^\n]*\n\d+ cases known to fail by \d+ expectation files?; as soon as a case fails, they are "
                                      r"reduced to causes, once for this hunt; --no-expect leaves it out\n")
        self.assertRegex(done.stdout, rf"known by \d+ expectation files: \d+ cases that fail as expected, by {len(known)} causes, reduced in \d+ s\n")
        self.assertTrue(all(c["bug"] and c["file"].startswith("known/") for c in known))
        self.assertGreater(sum(c["count"] for c in known), 0)
        fresh = [c for c in ledger["causes"] if not c["is_known"]]
        self.assertFalse([c for c in fresh if c["symptom"].startswith("extra of scissor.half-open")], done.stdout)
        for cause in known:
            text = (self.folder / "known" / cause["file"]).read_text()
            self.assertTrue(text.startswith(f"# {cause['symptom']}, known by an expectation file on "), text)
            self.edgecase("lint", self.folder / "known" / cause["file"], check=0)
        # Another hunt that knows this one, and one that goes on, reduce nothing anew.
        for words in (["fuzz", *start, "--cases=16", "--known", "known", "-o", "next"], ["fuzz", "--resume", "known", "--cases=2064"]):
            self.assertNotIn("known by", self.edgecase(*words).stdout)
        self.assertEqual(len([c for c in self.ledger("next")["causes"] if c["is_known"]]), len(ledger["causes"]))
        # A fault beside them that breaks the same rule in the same way, but needs neither several samples nor a scissor
        # that is far away, is told.
        self.layered(*start, "--cases=2048", "--seed=3", "--known", "known", "-o", "faulty", fault="scissor-wider", check=1)
        alike = {c["symptom"] for c in known if "of scissor.half-open" in c["symptom"]}
        told = [c for c in self.ledger("faulty")["causes"] if not c["is_known"] and c["symptom"] in alike]
        self.assertTrue(told, [(c["symptom"], c["essentials"], c["is_reduced"], c["count"]) for c in self.ledger("faulty")["causes"]])
        self.assertFalse([c for c in told if {"several samples", "draw.scissor beyond 32767"} & set(c["essentials"])], told)

    def test_what_a_line_calls_a_flake_is_known(self):
        lines = (self.suite.parent / "expectations" / "llvmpipe-scissor.txt").read_text()
        (self.folder / "flakes.txt").write_text(re.sub(r"^([^#\s]\S*\s+)fail ", r"\1flake ", lines, flags=re.M))
        self.fuzz("scissor/**", "--cases=512", "--expect", "flakes.txt")
        known = [c for c in self.ledger()["causes"] if c["is_known"]]
        self.assertTrue([c for c in known if "of scissor.half-open" in c["symptom"]], known)

    def test_doors_that_an_expectation_file_leaves_out_are_left_out_and_counted(self):
        # Cases 96 to 111 of seed 1 go through the door interleaved.
        (self.folder / "doors.txt").write_text("# edgecase-expectations 2\n# device: llvmpipe*\n"
                                               "door=interleaved   skip   bug/1   # Draws something else.\n")
        whole = self.fuzz("--cases=112", "--no-expect", out=self.folder / "whole")
        self.assertNotIn("leave out", whole.stdout)
        self.assertEqual(self.ledger("whole")["cases_through_broken_doors"], 0)
        done = self.fuzz("--cases=112", "--expect", "doors.txt")
        self.assertIn(", 16 through doors that expectation files leave out; ", done.stdout)
        self.edgecase("fuzz", "--resume", "hunt", "--cases=128")
        self.assertEqual(self.ledger()["cases_through_broken_doors"], 16)
        keys = ("judged_cases", "unsupported_cases", "empty_cases")
        self.edgecase("fuzz", "--resume", "whole", "--cases=128")
        self.assertEqual(sum(self.ledger()[key] for key in keys) + 16, sum(self.ledger("whole")[key] for key in keys))

    def test_wrong_files(self):
        def refused(words, sentence, code):
            self.assertIn(sentence, self.edgecase("fuzz", "--cases=16", *words, check=code).stderr)
        refused(["--expect", "nothing.txt"], "there is no such expectation file", 3)
        refused(["--expect", SOURCE / "cases/expectations/swiftshader.txt"], "does not fit: it is for the device", 5)
        refused(["--expect", "x.txt", "--no-expect"], "--expect and --no-expect exclude each other", 2)


if __name__ == "__main__":
    unittest.main()
