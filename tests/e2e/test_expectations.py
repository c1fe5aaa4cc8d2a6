# SPDX-FileCopyrightText: The Edgecase authors
# SPDX-License-Identifier: Apache-2.0
"""Expectation files: known problems do not fail a run, news of any kind does."""
import re
import shutil
import unittest

from support import ProgramTest

HEADER = "# edgecase-expectations 2\n# device: Edgecase*   driver: built\n"


FLIPPED = "double:cover.outside@vulkan<=1"  # what flip-pixel does to a case of the suite


class ExpectationTest(ProgramTest):
    def expectations(self, text, header=HEADER):
        folder = self.suite.parent / "expectations"
        folder.mkdir(exist_ok=True)
        (folder / "reference.txt").write_text(header + text)
        return folder / "reference.txt"


class OwnCases(ExpectationTest):
    """Files beside a suite speak of that suite's cases alone, others of all that is drawn."""

    def setUp(self):
        super().setUp()
        self.mine = self.folder / "mine" / "fam" / "new.toml"  # its id, fam/new, matches a pattern of the suite's file
        self.mine.parent.mkdir(parents=True)
        self.mine.write_text((self.suite / "fam/c3.toml").read_text())
        self.path = self.expectations(f"fam/*  fail  bug#1  {FLIPPED}  # It is known.\n")

    def test_a_failure_of_a_case_of_ones_own_is_news(self):
        self.run_suite("mine", "fam/c3", fault="flip-pixel", check=1)
        self.assertEqual(self.statuses(), {"fam/c3": "xfail", "fam/new": "fail"})
        self.run_suite("mine", "--expect", self.path, fault="flip-pixel", check=0)
        self.assertEqual(self.statuses(), {"fam/new": "xfail"})
        self.expectations("fam/*  skip  -  # Too slow.\n")
        self.run_suite("mine", check=0)
        self.assertEqual(self.statuses(), {"fam/new": "pass"})

    def test_captures_of_a_case_of_ones_own(self):
        self.expectations(f"fam/*  fail  bug#1  missing:cover.inside@vulkan<=30 missing:cover.shared-edge@vulkan<=30  # It is known.\n",
                          "# edgecase-expectations 2\n# device: mine*\n")
        self.edgecase("export", "mine", "fam/c3", "-o", "exported", check=0)
        for case_id in ("fam/new", "fam/c3"):
            plane = self.folder / "captures" / case_id / "hits.u8"
            plane.parent.mkdir(parents=True)
            plane.write_bytes(bytes(64))  # nothing is drawn
        self.edgecase("diff", "--captures", "captures", "--exported", "exported", "--name", "mine", "-o", self.out, check=1)
        self.assertEqual(self.statuses(), {"fam/c3": "xfail", "fam/new": "fail"})

    def test_update(self):
        self.run_suite("--no-expect", "mine", "fam/c3", fault="flip-pixel", check=1)
        before = self.path.read_text()
        done = self.edgecase("expect", self.path, "--update", self.out, "--bug", "bug#2", check=0)
        self.assertEqual(self.path.read_text(), before)
        self.assertIn("note: 1 case of the run left out: a file beside the suite speaks of its cases alone", done.stdout)
        other = self.folder / "other.txt"
        self.edgecase("expect", other, "--update", self.out, "--bug", "bug#2", check=0)
        self.assertRegex(other.read_text(), r"(?m)^fam/new +fail +bug#2 ")
        self.run_suite("mine", "fam/c3", "--expect", other, fault="flip-pixel", check=0)


class Statuses(ExpectationTest):
    def outcome(self, expected, fault, status, exit_code):
        cause = {"fail": FLIPPED, "crash": "signal=SIGSEGV", "flake": FLIPPED}[expected]
        self.expectations(f"fam/c3  {expected}  bug#1  {cause}  # It is known.\n")
        self.run_suite(fault=f"{fault}@fam/c3" if fault else "", check=exit_code)
        self.assertEqual(self.statuses()["fam/c3"], status)

    def test_expected_fail(self):
        self.outcome("fail", "flip-pixel", "xfail", 0)

    def test_expected_crash(self):
        self.outcome("crash", "segv", "xfail", 0)

    def test_crash_is_no_expected_fail(self):
        self.outcome("fail", "segv", "crash", 1)

    def test_improvement(self):
        self.outcome("crash", "flip-pixel", "improved", 1)

    def test_unexpected_pass(self):
        self.outcome("fail", "", "xpass", 1)

    def test_flake_is_no_expected_fail_when_asked_twice(self):
        self.outcome("flake", "flake", "xfail", 0)

    def test_a_known_flake_may_fail_the_same_way_twice(self):
        self.outcome("flake", "flip-pixel", "xfail", 0)
        self.expectations("fam/c3 flake bug#1 extra:cover.outside@vulkan<=9  # Known.\n")
        self.run_suite(fault="flip-pixel@fam/c3", check=1)
        self.assertEqual(self.statuses()["fam/c3"], "fail")

    def test_an_update_keeps_a_known_flake_that_failed_as_known(self):
        path = self.expectations(f"fam/c3 flake bug#1 {FLIPPED}  # Known.\n")
        self.run_suite(fault="flip-pixel@fam/c3", check=0)
        self.edgecase("expect", path, "--update", self.out, "--bug", "bug#2", check=0)
        self.assertRegex(path.read_text(), rf"(?m)^fam/c3 +flake +bug#1 +{FLIPPED} ")
        path = self.expectations("fam/c3 flake bug#1 signal=SIGSEGV  # Known.\n")
        self.run_suite(fault="flip-pixel@fam/c3", check=1)
        self.edgecase("expect", path, "--update", self.out, "--bug", "bug#2", check=0)
        self.assertRegex(path.read_text(), r"(?m)^fam/c3 +fail +bug#")

    def test_a_flaky_known_failure_is_a_flake(self):
        # What is expected is drawn again, too: a failure that comes and goes is no expected one.
        self.outcome("fail", "flake", "flake", 1)
        self.run_suite("--retries", "0", fault="flake@fam/c3", check=0)
        self.assertEqual(self.statuses()["fam/c3"], "xfail")

    def test_skip(self):
        self.expectations("fam/c3  skip  -  # Too slow here.\n")
        self.run_suite(fault="segv@fam/c3", check=0)
        self.assertEqual(self.statuses()["fam/c3"], "skip")

    def test_no_expect(self):
        self.expectations(f"fam/c3  fail  bug#1  {FLIPPED}  # It is known.\n")
        self.run_suite("--no-expect", fault="flip-pixel@fam/c3", check=1)


    def rerun(self, done):
        return re.search(r"rerun: (?:\w+=\S+ )*\S+ (.*)\n", done.stdout)[1]

    def test_the_rerun_line_repeats_how_it_was_judged(self):
        path = self.expectations(f"fam/c3  fail  bug#1  {FLIPPED}  # It is known.\n")
        done = self.run_suite("--no-expect", fault="flip-pixel@fam/c3", check=1)
        self.assertEqual(self.rerun(done), f"run fam/c3 --suite {self.suite} --renderer reference --no-expect")
        done = self.run_suite("--expect", path, "--timeout", "7.5", "fam/c1", fault="flip-pixel@fam/c1", check=1)
        self.assertEqual(self.rerun(done), f"run fam/c1 --suite {self.suite} --renderer reference --timeout 7.5 --expect {path}")

    def test_an_unexpected_pass_names_the_command(self):
        path = self.expectations(f"fam/c3  fail  bug#1  {FLIPPED}  # It is known.\n")
        line = f"      update: edgecase expect --update {self.out} {path}\n"
        self.assertIn(line, self.run_suite(check=1).stdout)
        self.assertIn(line, self.edgecase("report", self.out, check=0).stdout)
        self.edgecase("expect", "--update", self.out, path, check=0)
        self.run_suite(check=0)


class Support(ExpectationTest):
    """Who must support a case can say so."""

    def test_support_is_required(self):
        fault = "unsupported@fam/c3"
        self.run_suite(fault=fault, check=0)
        done = self.run_suite("--require-support", fault=fault, check=1)
        self.assertIn("FAIL fam/c3   unsupported\n", done.stdout)
        self.assertIn("unsupported, where --require-support asks for support: unsupported on purpose", done.stdout)
        self.assertIn(" --require-support", done.stdout.partition("rerun: ")[2].partition("\n")[0])
        case = next(c for c in self.results()["cases"] if c["id"] == "fam/c3")
        self.assertEqual((case["status"], case["actual"]), ("fail", "unsupported"))
        self.run_suite("--require-support", check=0)

    def test_a_known_failure_that_is_supported_no_more(self):
        self.expectations(f"fam/c3  fail  bug#1  {FLIPPED}  # It is known.\n")
        self.run_suite(fault="unsupported@fam/c3", check=0)
        self.run_suite("--require-support", fault="unsupported@fam/c3", check=1)

    def test_an_update_writes_a_skip(self):
        self.run_suite("--require-support", fault="unsupported@fam/c3", check=1)
        path = self.expectations("")
        self.edgecase("expect", "--update", self.out, path, "--bug", "bug#1", check=0)
        self.assertRegex(path.read_text(), r"\nfam/c3   skip   bug#1   # unsupported, where .*\n\Z")
        self.run_suite("--require-support", fault="unsupported@fam/c3", check=0)


class Pictures(ExpectationTest):
    """Within a count another error of the same cause is excused, but not without a word."""
    SENTENCE = "1 of 2 known failures is drawn with bits that nobody has seen before: fam/c4; --strict makes them unexpected\n"

    def known(self):
        path = self.expectations(f"fam/c3 fail bug#1 {FLIPPED}  # Known.\nfam/c4 fail bug#1 {FLIPPED}  # Known.\n")
        return path.with_suffix(".pictures")

    def learn(self, path):
        self.run_suite(fault="flip-pixel@fam/c3,flip-pixel@fam/c4", check=0)
        return self.edgecase("expect", "--update", self.out, path, check=0)

    def test_a_picture_that_nobody_has_seen(self):
        path = self.known()
        other = "flip-pixel@fam/c3,flip-pixel+1@fam/c4"
        self.assertNotIn("seen before", self.run_suite(fault=other, check=0).stdout)  # nothing is known of pictures
        self.assertEqual(self.learn(path).stdout, f"{path}: 0 removed, 2 added, 0 kept\n")
        self.assertRegex(path.read_text(), r"\A# edgecase-pictures 1\n# device: Edgecase reference\nfam/c3 [0-9a-f]{16}\nfam/c4 [0-9a-f]{16}\n\Z")
        self.assertEqual(self.learn(path).stdout, f"{path}: 0 removed, 0 added, 2 kept; nothing to write\n")
        self.assertNotIn("seen before", self.run_suite(fault="flip-pixel@fam/c3,flip-pixel@fam/c4", check=0).stdout)
        done = self.run_suite(fault=other, check=0)
        self.assertIn(self.SENTENCE, done.stdout)
        self.assertEqual({c["id"] for c in self.results()["cases"] if c["unseen_picture"]}, {"fam/c4"})
        self.assertIn("2 of 10 judged cases fail, as is known, 1 of them with bits that nobody has seen before",
                      (self.out / "report.html").read_text())
        self.assertIn(self.SENTENCE, self.edgecase("report", self.out, check=0).stdout)  # the journal has it
        # Once it is known it is no news.
        self.edgecase("expect", "--update", self.out, path, check=0)
        self.assertNotIn("seen before", self.run_suite(fault=other, check=0).stdout)
        self.assertNotIn("seen before", self.run_suite(fault="flip-pixel@fam/c3,flip-pixel@fam/c4", check=0).stdout)

    def test_strict(self):
        path = self.known()
        other = "flip-pixel@fam/c3,flip-pixel+1@fam/c4"
        done = self.run_suite("--strict", fault=other, check=2)
        self.assertIn("no file of pictures for this device", done.stderr)
        self.learn(path)
        done = self.run_suite("--strict", fault=other, check=1)
        self.assertRegex(done.stdout, r"not as \S+ says \(bug#1\): the picture, bits [0-9a-f]{16}, is none that was seen before\n")
        self.assertEqual((self.statuses()["fam/c3"], self.statuses()["fam/c4"]), ("xfail", "fail"))
        self.assertNotIn("seen before: ", done.stdout)
        self.assertRegex(done.stdout, r"rerun: .* run .* --strict")
        self.run_suite("--strict", fault="flip-pixel@fam/c3,flip-pixel@fam/c4", check=0)
        self.assertIn("--no-expect", self.run_suite("--strict", "--no-expect", check=2).stderr)

    def test_beside_a_named_file(self):
        mine = self.folder / "mine.txt"
        mine.write_text(HEADER + f"fam/c3 fail bug#1 {FLIPPED}  # Known.\n")
        self.run_suite("--no-expect", "fam/c3", fault="flip-pixel@fam/c3", check=1)
        self.edgecase("expect", "--update", self.out, "mine.pictures", check=0)
        done = self.run_suite("--expect", mine, "fam/c3", fault="flip-pixel+1@fam/c3", check=0)
        self.assertIn("1 of 1 known failure is drawn with bits that nobody has seen before: fam/c3;", done.stdout)

    def test_the_device_and_the_driver_of_a_file_are_told(self):
        path = self.folder / "mine.txt"
        path.write_text("# edgecase-expectations 2\n# device: Card*   driver: Maker >=22.3 <23\n"
                        "fam/c3 fail bug#1 value:store.unorm@vulkan<=1  # Known.\n")
        done = self.edgecase("expect", path, "--suite", self.suite, check=0)
        self.assertTrue(done.stdout.endswith("; for Card*, Maker >=22.3 <23\n"), done.stdout)

    def test_files_of_pictures_are_checked(self):
        path = self.known()
        self.learn(path)
        self.assertEqual(self.edgecase("expect", path, check=0).stdout, f"{path}: 2 pictures of 2 cases; for Edgecase reference\n")
        before = path.read_text()
        path.write_text(before.replace("fam/c4", "fam/c44"))
        self.assertIn(f"{path}: error: 'fam/c44' is no case", self.edgecase("lint", check=3).stderr)
        self.assertIn("'fam/c44' is no case; remove its line", self.edgecase("expect", path, check=3).stderr)
        self.run_suite("fam/c3", fault="flip-pixel@fam/c3", check=0)  # an old line harms no run
        self.assertEqual(self.edgecase("expect", "--update", self.out, path, check=0).stdout, f"{path}: 1 removed, 0 added, 1 kept\n")
        path.write_text(before + "fam/c5 x\n")
        self.assertIn(f"{path}:5:1: error: 'x' is no picture", self.run_suite(check=3).stderr)
        path.write_text(before.replace("Edgecase reference", "other"))
        self.run_suite("fam/c3", fault="flip-pixel@fam/c3", check=0)
        self.assertIn("does not fit the run", self.edgecase("expect", "--update", self.out, path, check=5).stderr)
        self.assertIn("says how failures look", self.edgecase("expect", "--update", self.out, path, "--bug", "b#1", check=2).stderr)


class Causes(ExpectationTest):
    """A known failure hides no other one."""

    def unexpected(self, cause, fault, words, status="fail"):
        path = self.expectations(f"fam/c3 {status} bug#1 {cause}  # Known.\n")
        done = self.run_suite(fault=fault, check=1)
        self.assertEqual(self.statuses()["fam/c3"], status)
        self.assertIn(f"not as {path}:3 says (bug#1): {words}\n", done.stdout)
        return done

    def test_another_rule(self):
        self.unexpected("missing:cover.inside@vulkan<=30", "flip-pixel@fam/c3", "1 double of cover.outside [vulkan] is new")

    def test_another_kind_beside_the_known_one(self):
        done = self.unexpected(FLIPPED, "flip-pixel@fam/c3,shift-value+1@fam/c3", "1 value of fragcoord.xy [vulkan] is new")
        self.assertIn("frag_coord.x: expected ", done.stdout)  # what is new is told, and how it is explained

    def test_another_level(self):
        self.unexpected("double:cover.outside@direct3d<=1", "flip-pixel@fam/c3", "1 double of cover.outside [vulkan] is new")

    def test_another_signal(self):
        self.unexpected("signal=SIGSEGV", "abort@fam/c3", "the signal is 'SIGABRT' and not 'SIGSEGV'", "crash")

    def test_the_bits(self):
        self.expectations("fam/c3 fail bug#1 bits=0000000000000000  # Known.\n")
        self.run_suite(fault="flip-pixel@fam/c3", check=1)
        bits = next(c for c in self.results()["cases"] if c["id"] == "fam/c3")["bits"]
        self.expectations(f"fam/c3 fail bug#1 bits={bits}  # Known.\n")
        self.run_suite(fault="flip-pixel@fam/c3", check=0)
        self.run_suite(fault="flip-pixel@fam/c3,shift-value+1@fam/c3", check=1)

    def test_several_pictures(self):
        """An update teaches a line that knows bits the picture of another driver, too."""
        path = self.expectations(f"fam/c3 fail bug#1 {FLIPPED} bits=0123456789abcdef  # Known.\n")
        done = self.run_suite(fault="flip-pixel@fam/c3", check=1)
        self.assertRegex(done.stdout, r"not as \S+ says \(bug#1\): the bits are '[0-9a-f]{16}' and not '0123456789abcdef'\n")
        self.edgecase("expect", "--update", self.out, path, check=0)
        self.assertRegex(path.read_text(), rf"fam/c3 fail bug#1   {FLIPPED} bits=[0-9a-f]{{16}},[0-9a-f]{{16}}   # Known\.\n")
        self.run_suite(fault="flip-pixel@fam/c3", check=0)
        self.run_suite(fault="flip-pixel+1@fam/c3", check=1)  # as many wrong samples, another one

    def test_a_line_a_picture(self):
        """With --bits a glob becomes a line a case, and no other picture is excused."""
        path = self.expectations(f"fam/c* fail bug#1 {FLIPPED}  # Known.\n")
        faults = "flip-pixel@fam/c*"
        self.run_suite(fault=faults, check=0)
        self.edgecase("expect", "--update", self.out, path, check=0)
        self.assertIn("fam/c* fail bug#1", path.read_text())  # without --bits it stays
        self.edgecase("expect", "--update", self.out, path, "--bits", check=0)
        for k in "12":
            self.assertRegex(path.read_text(), rf"\nfam/c{k}   fail   bug#1   {FLIPPED} bits=[0-9a-f]{{16}}   # Known\.\n")
        self.assertNotIn("fam/c*", path.read_text())
        self.run_suite(fault=faults, check=0)
        self.run_suite(fault=",".join(f"flip-pixel{'+1' if i == 'fam/c2' else ''}@{i}" for i in self.statuses()), check=1)
        self.assertEqual((self.statuses()["fam/c1"], self.statuses()["fam/c2"]), ("xfail", "fail"))

    def test_a_flake_without_a_cause_excuses_no_finding(self):
        self.unexpected("", "flake@fam/c3", "1 double of cover.outside [vulkan] is new", "flake")

    def test_a_flake_is_no_death(self):
        self.unexpected("signal=SIGSEGV", "flake@fam/c3",
                        "the worker did not die; other bits were drawn; 1 double of cover.outside [vulkan] is new", "flake")

    def die_once(self, case_id, *words, check):
        """The first worker that begins dies over the case, no other one does."""
        script = self.folder / "once.sh"
        script.write_text(f'#!/bin/sh\nif mkdir {self.folder}/once 2>/dev/null; then export EDGECASE_FAULT=segv@{case_id}; fi\nexec "$@"\n')
        script.chmod(0o755)
        env = self.environment() | {"EDGECASE_SELF_PREFIX": str(script)}
        shutil.rmtree(self.folder / "once", ignore_errors=True)
        return self.edgecase("run", "--renderer=reference", "-o", self.out, *words, env=env, check=check)

    def test_a_death_that_nobody_repeats_is_excused_by_no_line_of_another_case(self):
        for cause in (FLIPPED, "signal=SIGSEGV", ""):
            path = self.expectations(f"fam/c0 flake bug#1 {cause}  # Known.\n")
            done = self.die_once("fam/c3", "-j", "1", check=1)
            self.assertIn(f"not as {path}:3 says (bug#1): a worker died over it and others, so that it may be another case's doing",
                          done.stdout)
            self.assertIn("no case of its batch repeated that alone; it may be any of fam/c0, fam/c1, ", done.stdout)
            self.assertRegex(done.stdout, r"rerun: .* run fam/c0 .*--repeat 10 fam/c1 fam/c2 fam/c3 ")
            self.assertEqual(self.statuses()["fam/c0"], "flake")

    def test_a_death_of_a_case_that_was_drawn_alone(self):
        self.expectations("fam/c3 flake bug#1 signal=SIGSEGV  # Known.\n")
        self.die_once("fam/c3", "fam/c3", check=0)
        self.assertEqual(self.statuses()["fam/c3"], "xfail")
        for cause, words in ((FLIPPED, "the worker died, which the line does not say"),
                             ("signal=SIGABRT", "the signal is 'SIGSEGV' and not 'SIGABRT'")):
            self.expectations(f"fam/c3 flake bug#1 {cause}  # Known.\n")
            self.assertIn(words, self.die_once("fam/c3", "fam/c3", check=1).stdout)

    def test_bits_hold_no_other_rendering(self):
        text = (self.suite / "fam/c3.toml").read_text()
        self.write_case("fam/c3", text.replace("[target]", 'relations = ["same-twice"]\n[target]'))
        self.run_suite("fam/c3", check=0)
        [case] = self.results()["cases"]
        path = self.expectations(f"fam/c3 fail bug#1 bits={case['bits']}  # Known.\n")
        done = self.run_suite("fam/c3", fault="flip-derived@fam/c3", check=1)
        self.assertRegex(done.stdout, rf"not as {path}:3 says \(bug#1\): \d+ value of repeat.same \[vulkan\] (is|are) new\n")
        self.expectations(f"fam/c3 fail bug#1 value:repeat.same@vulkan<=9 bits={case['bits']}  # Known.\n")
        self.run_suite("fam/c3", fault="flip-derived@fam/c3", check=0)

    def test_wrong_words(self):
        for cause, sentence in (
                ("", "names no cause; write KIND:RULE@LEVEL<=COUNT"),
                ("double:cover.outsid@vulkan<=1", "'cover.outsid' is no rule; did you mean 'cover.outside'?"),
                ("twice:cover.outside@vulkan<=1", "'twice' is no kind of finding; write missing, extra, double, value or order"),
                ("double:cover.outside@vulcan<=1", "'vulcan' is no level; write vulkan, practice or direct3d"),
                ("double:cover.outside", "'' is no level"),
                ("double:cover.outside@vulkan", "'vulkan' does not say how far the cause reaches; write 'vulkan<=COUNT'"),
                ("double:cover.outside@vulkan<=0", "does not say how far"),
                ("double:cover.outside@vulkan<=1x", "does not say how far"),
                ("double:cover.outside@vulkan<=1,vulkan<=2", "gives a second count for the same findings"),
                ("bits=", "'bits=' does not name pictures; write each as 16 digits"),
                ("bits=0123456789abcdeF", "does not name pictures"),
                ("bits=0123456789abcdef,012", "does not name pictures"),
                ("signal=SIGBUS signal=SIGFPE " + FLIPPED, "'signal=SIGFPE' stands beside another one"),
                ("signal=SIGSEVG " + FLIPPED, "'SIGSEVG' is no signal; did you mean 'SIGSEGV'?"),
                ("signal=SIGFOOBAR " + FLIPPED, "'SIGFOOBAR' is no signal")):
            path = self.expectations(f"fam/c3 fail bug#1 {cause}  # Known.\n")
            done = self.edgecase("expect", path, check=3)
            self.assertIn(sentence, done.stderr)
            # One mistake is told once: a line that is not understood does not lack what it says.
            self.assertEqual(done.stderr.count(": error: "), 1, done.stderr)
        for text, sentence in (("fam/c3 crash bug#1  # Known.\n", "does not say how it crashes; write signal=NAME or step=NAME"),
                               (f"fam/c3 skip - {FLIPPED}  # Slow.\n", "a case that is not drawn has no cause")):
            self.assertIn(sentence, self.edgecase("expect", self.expectations(text), check=3).stderr)

    def test_a_zero_byte(self):
        path = self.expectations(f"fam/c3 fail bug#1 {FLIPPED}  # Kno\0wn.\n")
        self.assertIn("zero byte", self.edgecase("expect", path, check=3).stderr)

    def test_an_older_file(self):
        """It is refused by a run, and an update gives its lines causes."""
        path = self.expectations("fam/c3 fail bug#1  # Known.\n", HEADER.replace("expectations 2", "expectations 1"))
        done = self.run_suite(fault="flip-pixel@fam/c3", check=3)
        self.assertIn(f"edgecase: {path}:1:1: error: the file is of format 1, whose lines name no cause; bring it to "
                      f"format 2 with 'edgecase expect --update RUN {path}'\n", done.stderr)
        self.run_suite("--no-expect", fault="flip-pixel@fam/c3", check=1)
        self.edgecase("expect", "--update", self.out, path, check=0)
        self.assertEqual(path.read_text(), HEADER + f"fam/c3 fail bug#1   {FLIPPED}   # Known.\n")
        self.run_suite(fault="flip-pixel@fam/c3", check=0)


class Files(ExpectationTest):
    def refused(self, text, words, header=HEADER, exit_code=3):
        self.expectations(text, header)
        done = self.run_suite(check=exit_code)
        self.assertIn(words, done.stderr)

    def test_no_reason(self):
        self.refused(f"fam/c3 fail bug#1 {FLIPPED}\n", "reason")

    def test_no_bug(self):
        self.refused("fam/c3 fail -  # Known.\n", "bug")

    def test_unknown_status(self):
        self.refused("fam/c3 fial bug#1  # Known.\n", "did you mean 'fail'")

    def test_past_date(self):
        """It excuses nothing, is told, and is news whatever happens; lint refuses the file."""
        ended = "ended on 2020-01-01: re-check it, or extend the date"
        path = self.expectations(f"fam/c3 fail bug#1 {FLIPPED} until=2020-01-01  # Known.\n")
        done = self.run_suite(fault="flip-pixel@fam/c3", check=1)
        self.assertEqual(self.statuses()["fam/c3"], "fail")
        self.assertIn(f", the expectation of fail (bug#1) {ended}\n", done.stdout)
        done = self.run_suite(check=1)
        self.assertEqual(self.statuses()["fam/c3"], "xpass")
        self.assertIn(f"XPASS fam/c3   passes; the expectation of fail (bug#1) {ended}\n", done.stdout)
        self.assertEqual(self.edgecase("lint", check=3).stderr,
                         f"edgecase: {path}:3:1: error: the expectation of 'fam/c3' ended on 2020-01-01; re-check it, "
                         "or extend the date\n")
        self.expectations("fam/c3 skip - until=2020-01-01  # Too slow.\n")
        self.run_suite(fault="flip-pixel@fam/c3", check=1)
        self.assertEqual(self.statuses()["fam/c3"], "fail")

    def test_no_day_of_the_calendar(self):
        self.refused(f"fam/c3 fail bug#1 {FLIPPED} until=2026-02-30  # Known.\n",
                     "'until=2026-02-30' is not understood; after the bug may stand causes, like "
                     "'extra:cover.outside@vulkan<=3', and 'until=YYYY-MM-DD'")

    def test_line_that_matches_nothing(self):
        self.refused(f"fam/cc3 fail bug#1 {FLIPPED}  # Known.\n", "did you mean 'fam/c")

    def test_line_that_matches_nothing_of_a_part(self):
        self.expectations(f"fam/cc3 fail bug#1 {FLIPPED}  # Known.\n")
        self.run_suite("fam/c1", check=0)

    def test_conflict(self):
        self.refused(f"fam/c3 fail bug#1 {FLIPPED}  # Known.\nfam/c* crash bug#2 signal=SIGSEGV  # Known.\n", "disagrees")

    def test_expect_checks_what_a_run_checks(self):
        for text, sentence in ((f"fam/cc3 fail bug#1 {FLIPPED}  # Known.\n", "did you mean 'fam/c"),
                               (f"fam/c3 fail bug#1 {FLIPPED}  # Known.\nfam/c* crash bug#2 signal=SIGSEGV  # Known.\n", "disagrees about 'fam/c3'")):
            path = self.expectations(text)
            self.assertIn(sentence, self.edgecase("expect", path, check=3).stderr)
        self.edgecase("expect", self.expectations(f"fam/c3 fail bug#1 {FLIPPED}  # Known.\n"), check=0)

    def test_a_file_that_is_something_else(self):
        path = self.expectations("", header="{\"a\": 1,\n \"b\x01\": 2}\n")
        self.assertEqual(self.edgecase("expect", path, check=3).stderr,
                         f"edgecase: {path}:1:1: error: the first line must be '# edgecase-expectations 2'\n")
        path = self.expectations("fam/c3 f\x1b[31m bug#1  # Known.\n")
        self.assertNotIn("\x1b", self.edgecase("expect", path, check=3).stderr)

    def test_no_header(self):
        self.refused(f"fam/c3 fail bug#1 {FLIPPED}  # Known.\n", "first line", header="")

    def test_another_device_is_passed_over(self):
        self.expectations(f"fam/c3 fail bug#1 {FLIPPED}  # Known.\n", HEADER.replace("Edgecase*", "Other*"))
        self.run_suite(check=0)

    def test_another_version_is_passed_over(self):
        self.expectations(f"fam/c3 fail bug#1 {FLIPPED}  # Known.\n", HEADER.replace("built", "built >=1"))  # the reference has no version
        self.run_suite(check=0)

    def test_a_named_file_must_fit(self):
        path = self.expectations(f"fam/c3 fail bug#1 {FLIPPED}  # Known.\n", HEADER.replace("Edgecase*", "Other*"))
        done = self.run_suite("--expect", path, check=5)
        self.assertIn("Edgecase reference", done.stderr)

    def test_another_profile_is_passed_over(self):
        self.expectations(f"fam/c3 fail bug#1 {FLIPPED}  # Known.\n", HEADER + "# profile: vulkan\n")
        self.run_suite(check=0)


if __name__ == "__main__":
    unittest.main()
