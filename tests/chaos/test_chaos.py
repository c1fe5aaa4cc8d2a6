# SPDX-FileCopyrightText: The Edgecase authors
# SPDX-License-Identifier: Apache-2.0
"""A few rounds of every kind, and that the checks of a round see what is wrong."""
import ctypes
import os
import pathlib
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import unittest
from unittest import mock

import disturbances
import rounds
import schema
from disturbances import Disturbance
from place import LAYER, SOURCE

CLONE_NEWNS, MS_REC, MS_PRIVATE = 0x20000, 0x4000, 1 << 18


class Rounds(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.undisturbed = rounds.Undisturbed()

    def perform(self, on, workload, words=("equal",)):
        outcome = rounds.perform(on, workload, self.undisturbed)
        self.assertEqual(outcome.problems, [], f"{on.kind} ({on.what}), {workload}, exit {outcome.exits}")
        self.assertIn(outcome.word, words)
        return outcome


class Signals(Rounds):
    def test_a_worker_is_killed(self):
        on = Disturbance("signals to workers", "KILL", signals=[(0.3, "worker", signal.SIGKILL)], charges=1)
        self.perform(on, "suite", ("equal", "named"))

    def test_the_parent_is_killed_and_interrupted(self):
        for name in ("suite", "hunt"):
            for what in (signal.SIGKILL, signal.SIGINT):
                on = Disturbance("signals to the parent", what.name, signals=[(0.4, "parent", what)], may_interrupt=True,
                                 may_stop=True)
                # One that was over before the signal came is equal.
                self.perform(on, name, ("resumed", "equal", "named"))

    def test_the_parent_stands_still(self):
        on = Disturbance("signals to the parent", "STOP", signals=[(0.3, "parent", signal.SIGSTOP), (0.3, "continue", signal.SIGCONT)])
        self.perform(on, "reduce")


class Layer(Rounds):
    def act(self, words, workload="suite", starts=1, **more):
        env = {"EDGECASE_HOSTILE": words, "EDGECASE_HOSTILE_STARTS": str(starts)}
        outcome = self.perform(Disturbance("driver", words, env=env, charges=-1, may_stop=True, **more), workload, ("equal", "named"))
        self.assertGreaterEqual(outcome.hits, 1, words)
        return outcome

    def test_ends(self):
        for words in ("exit", "throw:2", "stack-overflow", "leave-a-child-and-exit"):
            self.assertEqual(self.act(words).word, "named", words)

    def test_descriptors(self):
        for words in ("close-results", "results-garbage:2", "results-half-a-frame", "shared-truncated", "output-esc-and-nul"):
            self.act(words)

    def test_answers(self):
        for words, workload in (("wait-lost:3", "suite"), ("no-device-memory:9", "hunt"), ("submit-lost:5", "reduce")):
            self.act(words, workload)

    def test_what_alters_nothing_that_is_drawn(self):
        for words in ("locale", "umask", "other-folder", "block-signals", "clear-environment", "unlink-files"):
            self.assertEqual(self.act(words, starts=9).word, "equal", words)

    def test_a_night_has_the_whole_table(self):
        names = [name for name, _ in disturbances.behaviours()]
        self.assertEqual(len(names), len(set(names)))
        self.assertGreaterEqual(len(names), 30)
        layer = pathlib.Path(LAYER, "libhostile_layer.so").read_bytes()
        for name in names:  # found in the sources, and built
            self.assertIn(name.encode() + b"\0", layer)
        drawn = [rounds.choose(3, number)[0].what.partition("@")[0] for number in range(0, 2 * len(names), 2)]
        self.assertEqual(sorted(drawn), sorted(names))

    def test_a_behaviour_that_is_none(self):
        with self.assertRaises(AssertionError):
            self.act("segfault")


class Surroundings(Rounds):
    def test_limits(self):
        for name, words in (("fsize", ("named", "resumed")), ("nofile", ("equal", "named", "resumed"))):
            on = Disturbance("limits", name, prefix=["prlimit", f"--{name}=20:20"], charges=-1, may_stop=True)
            self.perform(on, "suite-reference", words)

    def test_the_clock_jumps(self):
        self.perform(disturbances.of_the_clock(random.Random(1)), "suite-reference")

    def test_frames(self):
        for how, words in (("short", ("equal",)), ("bit", ("named",))):
            self.perform(disturbances.of_frames(random.Random(1), how), "suite-reference", words)

    def test_disks(self):
        libc = ctypes.CDLL(None)
        if libc.unshare(CLONE_NEWNS) != 0 or libc.mount(None, b"/", None, MS_REC | MS_PRIVATE, None) != 0:
            self.skipTest("no mount namespace here")
        for disks, fills in (({"out": 2**16}, []), ({"out": 0}, []), ({"out": 2**26}, [(0.3, "out")])):
            on = Disturbance("disks", str(disks), disks=disks, fills=fills, may_stop=True)
            self.perform(on, "suite-reference", ("named", "resumed", "equal"))


class Checks(unittest.TestCase):
    """A program that does something wrong in each round, which has to be seen."""

    @classmethod
    def setUpClass(cls):
        cls.undisturbed = rounds.Undisturbed()
        cls.undisturbed.of("reduce")
        cls.record = tempfile.mkdtemp(prefix="edgecase-chaos-")
        cls.addClassCleanup(shutil.rmtree, cls.record)
        for name in ("suite-reference", "hunt-reference"):
            cls.undisturbed.of(name)
            place = rounds.Place()
            end = rounds.execute(place, rounds.WORKLOADS[name].words(place), rounds.WORKLOADS[name].env)
            [folder] = place.out.iterdir()
            shutil.copytree(folder, pathlib.Path(cls.record, folder.name))
            pathlib.Path(cls.record, folder.name, "code").write_text(str(end.code))
            place.remove()

    def setUp(self):
        self.folder = tempfile.mkdtemp(prefix="edgecase-chaos-")
        self.addCleanup(shutil.rmtree, self.folder)

    def problems(self, lines, on=None, workload="suite-reference"):
        script = pathlib.Path(self.folder, "program")
        kept = "hunt" if "hunt" in workload else "run"
        script.write_text(f"#!/bin/bash\nkept={self.record}/{kept} out=$EDGECASE_TEST_MARK/out/{kept}\n{lines}\n")
        script.chmod(0o755)
        with mock.patch.object(rounds, "PROGRAM", str(script)):
            outcome = rounds.perform(on or Disturbance("none", "none"), workload, self.undisturbed)
        return "\n".join(outcome.problems)

    RUN = "cp -r $kept $out; code=$(cat $kept/code)\n"  # what the program leaves, sooner

    def test_nothing_wrong(self):
        self.assertEqual(self.problems(self.RUN + "exit $code"), "")

    def test_results(self):
        edit = self.RUN + "python3 - \"$out/results.json\" <<'END'\nimport json, sys\nr = json.load(open(sys.argv[1]))\n{}\n" \
            "json.dump(r, open(sys.argv[1], 'w'))\nEND\nexit $code"
        for change, told in (("r['cases'][3]['status'] = 'fail'", "is fail instead of pass"),
                             ("r['cases'][3]['status'] = 'crash'", "is crash without a reason"),
                             ("r['cases'][3].update(status='crash', reason='x')", "1 cases are not as undisturbed, after 0 signals"),
                             ("r['cases'][3]['bits'] = '0'", "is pass with other bits or findings"),
                             ("del r['cases'][3]", "results.json has other cases"),
                             ("r['cases'][3]['status'] = 'good'", "is no value of this member"),
                             ("r['run']['exit_code'] = 1", "tells of exit 1, the program ended with 0")):
            self.assertIn(told, self.problems(edit.format(change)), change)

    def test_files(self):
        for line, told in (("truncate -s -9 $out/results.json", "results.json is not whole"),
                           ("truncate -s -9 $out/junit.xml", "junit.xml"), ("truncate -s -9 $out/report.html", "report.html does not end"),
                           ("rm -r $out", "ended with 0 and without results")):
            self.assertIn(told, self.problems(f"{self.RUN}{line}; exit $code"))
        self.assertIn("of fuzz.json is not whole", self.problems(f"{self.RUN}rm $out/found/*; exit $code", workload="hunt-reference"))
        self.assertIn("which is not there", self.problems(f"{self.RUN}sed -i 's/\"symptom\": \"/&x/' $out/fuzz.json; exit $code",
                                                          workload="hunt-reference"))

    def test_a_reduction(self):
        self.assertIn("is another one, and no word", self.problems("echo '[ ]' > $EDGECASE_TEST_MARK/out/small.toml", workload="reduce"))
        self.assertIn("small.toml is not whole", self.problems("echo '[ ' > $EDGECASE_TEST_MARK/out/small.toml", workload="reduce"))
        self.assertIn("and without a file", self.problems("exit 0", workload="reduce"))

    def test_ends(self):
        for lines, told in ((self.RUN + "kill -9 $$", "it ended with -9"), (self.RUN + "exit 99", "it ended with 99"),
                            ("exit 7", "without a word"), ("echo wrong >&2; exit 2", "it ended with 2: wrong"),
                            (self.RUN + "exit 130", "it tells of an interruption"),
                            (self.RUN + "echo 'please report it' >&2; exit $code", "an internal error")):
            self.assertIn(told, self.problems(lines), lines)
        with mock.patch.object(rounds, "LONGEST", 3):
            self.assertIn("it had not ended after 3 s", self.problems("exec sleep 1000"))
        on = Disturbance("signals to the parent", "TERM", signals=[(0.1, "parent", signal.SIGTERM)], may_interrupt=True, may_stop=True)
        with mock.patch.object(rounds, "LONGEST", 9):
            self.assertIn("after a signal that ends it", self.problems("trap '' TERM; while :; do sleep 1; done", on))

    def test_what_is_around(self):
        for line, told in (("touch here", "left in the working folder"), ("touch $TMPDIR/x", "left in TMPDIR"),
                           ("echo >> $EDGECASE_TEST_MARK/canary/keep1.toml", "keep1.toml changed or vanished"),
                           ("touch $EDGECASE_TEST_MARK/canary/x", "canary/x is new")):
            self.assertIn(told, self.problems(f"{self.RUN}{line}; exit $code"))
        with mock.patch.object(rounds.Place, "left_over", lambda self, patience=0.5, real=rounds.Place.left_over: real(self, 0.5)):
            self.assertIn("left running: sleep 1000", self.problems(f"{self.RUN}sleep 1000 & exit $code"))

    def test_memory(self):
        with mock.patch.object(rounds, "MOST_MEMORY", 2**20):
            self.assertIn("it took more than 1 GiB", self.problems("exec sleep 1000"))

    def test_schema(self):
        shape = {"type": "object", "required": ["a"], "properties": {"a": {"type": "integer", "minimum": 1}, "b": {"enum": ["x"]}},
                 "additionalProperties": False}
        self.assertEqual(schema.problems({"a": 1, "b": "x"}, shape), [])
        for value in ([], {}, {"a": 0}, {"a": True}, {"a": 1, "b": "y"}, {"a": 1, "c": 1}):
            self.assertNotEqual(schema.problems(value, shape), [], value)
        with self.assertRaises(ValueError):
            schema.problems({}, {"oneOf": []})

    def test_the_command(self):
        """A round that is wrong tells how it is repeated, and the command ends with 1."""
        words = [sys.executable, SOURCE / "tests" / "chaos" / "chaos.py", "--seed", "4", "--round"]
        env = os.environ | {"EDGECASE_SOURCE_DIR": str(SOURCE)}
        number = next(k for k in range(1000) if rounds.choose(4, k)[0].kind == "clock" and rounds.choose(4, k)[1] == "hunt-reference")
        done = subprocess.run([*words, str(number)], env=env, capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertRegex(done.stdout, rf"chaos: seed 4.*\nround {number}: clock \(jumps\), hunt on reference: equal")
        self.assertRegex(done.stdout, r"\| clock \| 1 \| 1 \| 0 ")
        with mock.patch.object(rounds, "MOST_MEMORY", 1), mock.patch.object(sys, "argv", ["chaos.py", *words[2:], str(number)]):
            import chaos
            with mock.patch.object(chaos, "isolate"), mock.patch("builtins.print") as told:
                undisturbed = self.undisturbed
                with mock.patch.object(rounds, "Undisturbed", lambda: undisturbed):
                    self.assertEqual(chaos.main(), 1)
        self.assertIn(f"chaos.py --seed 4 --round {number}", str(told.mock_calls))


if __name__ == "__main__":
    unittest.main()
