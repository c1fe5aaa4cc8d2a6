# SPDX-FileCopyrightText: The Edgecase authors
# SPDX-License-Identifier: Apache-2.0
"""What is left of a run that is killed, interrupted, resumed."""
import json
import os
import signal
import subprocess
import time
import unittest

from support import CASE, PROGRAM, ProgramTest, processes_with


class JournalTest(ProgramTest):
    def start_hanging(self, *words):
        """A run that settles eight cases and then hangs in fam/c8."""
        process = subprocess.Popen(
            [PROGRAM, "run", "--renderer=reference", "-o", self.out, "--batch", "4", "--timeout", "60", *words],
            env=self.environment("hang@fam/c8"), cwd=self.folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        journal = self.out / "journal.jsonl"
        for _ in range(600):
            if journal.exists():
                text = journal.read_text()
                ends = sum(1 for line in text.splitlines() if '"end"' in line[:60])
                if ends >= 8 and '{"record":"begin","id":"fam/c8"' in text:
                    return process
            time.sleep(0.05)
        process.kill()
        self.fail("the run never reached its eighth end")

    def wait_for_no_orphans(self):
        for _ in range(100):
            if not processes_with(str(self.folder)):
                return
            time.sleep(0.05)
        self.assert_no_orphans()


def comparable(results):
    """The cases of a run without what no two runs share."""
    cases = []
    for case in results["cases"]:
        cases.append({k: v for k, v in case.items() if k not in ("seconds", "attempts", "rerun", "explain")})
    return json.dumps(cases, sort_keys=True)


class Resume(JournalTest):
    def test_after_kill(self):
        process = self.start_hanging()
        process.kill()
        process.communicate()
        self.wait_for_no_orphans()
        self.edgecase("run", "--resume", self.out, check=0)
        whole = self.folder / "whole"
        self.run_suite(out=whole, check=0)
        self.assertEqual(comparable(self.results()), comparable(self.results(whole)))

    def test_what_failed_before_is_named(self):
        process = self.start_hanging()
        process.kill()
        process.communicate()
        journal = self.out / "journal.jsonl"
        self.wait_for_no_orphans()
        self.assertIn("   cut off   seed", self.edgecase("report", self.out).stdout)
        text = journal.read_text().replace('"status":"pass"', '"status":"fail"', 2)
        journal.write_text(text)
        done = self.edgecase("run", "--resume", self.out, "-q", check=1)
        self.assertEqual(done.stdout, f"2 unexpected results before the interruption: edgecase report {self.out}\n")

    def test_variables_of_the_first_part_count(self):
        env = self.environment() | {"EDGECASE_PROFILE": "vulkan"}
        self.edgecase("run", "--renderer=reference", "-o", self.out, env=env, check=0)
        self.edgecase("run", "--resume", self.out, env=env, check=0)
        self.edgecase("run", "--resume", self.out, env=self.environment() | {"EDGECASE_DEVICE": "x"}, check=0)
        self.assertEqual(self.results()["profile"], "vulkan")

    def test_a_finished_run_draws_nothing(self):
        self.run_suite(check=0)
        lines = len((self.out / "journal.jsonl").read_text().splitlines())
        self.edgecase("run", "--resume", self.out, check=0)
        begins = [line for line in (self.out / "journal.jsonl").read_text().splitlines()[lines:] if '"begin"' in line]
        self.assertEqual(begins, [])

    def test_a_case_that_is_gone(self):
        process = self.start_hanging()
        process.kill()
        process.communicate()
        (self.suite / "fam/c9.toml").unlink()
        self.assertIn("fam/c9", self.edgecase("run", "--resume", self.out, check=3).stderr)

    def killed(self, *words):
        process = self.start_hanging(*words)
        process.kill()
        process.communicate()
        self.wait_for_no_orphans()

    def cannot_go_on(self, why):
        before = (self.out / "journal.jsonl").read_text()
        done = self.edgecase("run", "--resume", self.out, check=3)
        self.assertEqual(done.stderr, f"edgecase: the run cannot go on: {why}; start a new run\n")
        self.assertEqual((self.out / "journal.jsonl").read_text(), before)

    def test_another_suite(self):
        """Also if the file that changed is of a case that is drawn already, or of one that was not selected."""
        self.killed()
        why = f"the files of the suite '{self.suite}' are not those that it began with"
        text = (self.suite / "fam/c0.toml").read_text()
        self.write_case("fam/c0", text.replace("[7,7]", "[6,6]"))
        self.cannot_go_on("'fam/c0' is another case under the same id than the run began with")
        self.write_case("fam/c0", text)
        self.write_case("fam/new", text)
        self.cannot_go_on(why)
        (self.suite / "fam/new.toml").unlink()
        self.edgecase("run", "--resume", self.out, check=0)

    def test_own_files(self):
        """A file, a leaf of one and a folder, all named from where the run began."""
        for name in ("a", "b", "folder/deep/c"):
            path = self.folder / f"{name}.toml"
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(CASE.format(n=50).replace("[target]", "[matrix]\nk = [1, 2]\n[target]").replace("[1,1]", "[\"k\",1]"))
        self.killed("fam/*", "a.toml", "b.toml:k=2", "folder")
        self.assertEqual(len(json.loads((self.out / "journal.jsonl").read_text().splitlines()[0])["cases"]), 15)
        own = self.folder / "folder/deep/c.toml"
        text = own.read_text()
        own.write_text(text + "\n")
        self.cannot_go_on("the file 'folder/deep/c.toml' is not as it was when it began")
        own.write_text(text)
        self.edgecase("run", "--resume", self.out, check=0)
        self.assertEqual(set(self.statuses().values()), {"pass"})

    def test_other_expectations(self):
        known = self.folder / "known.txt"
        text = "# edgecase-expectations 2\n# device: Edgecase*\n"
        known.write_text(text)
        self.killed("--expect", "known.txt")
        known.write_text(text + "fam/c9 skip - # Too slow.\n")
        self.cannot_go_on("the expectation files are not those that it began with")
        known.write_text(text)
        self.edgecase("run", "--resume", self.out, check=0)

    def test_another_version(self):
        self.killed()
        journal = self.out / "journal.jsonl"
        version = self.results()["tool_version"] if (self.out / "results.json").exists() else \
            json.loads(journal.read_text().splitlines()[0])["tool_version"]
        journal.write_text(journal.read_text().replace(f'"tool_version":"{version}"', '"tool_version":"0.0.1"', 1))
        self.cannot_go_on(f"it began with edgecase 0.0.1 and this is {version}")

    def test_no_journal(self):
        self.edgecase("run", "--resume", self.folder, check=3)

    def test_torn_last_line(self):
        self.run_suite(check=0)
        journal = self.out / "journal.jsonl"
        lines = journal.read_bytes().splitlines(keepends=True)
        last_end = max(k for k, line in enumerate(lines) if b'"end"' in line[:60])
        journal.write_bytes(b"".join(lines[:last_end]) + lines[last_end][:30])
        self.edgecase("run", "--resume", self.out, check=0)
        self.assertEqual(set(self.statuses().values()), {"pass"})


class TwoRuns(JournalTest):
    def test_a_folder_takes_one_run_at_a_time(self):
        process = self.start_hanging()
        journal = self.out / "journal.jsonl"
        for words in (["--renderer=reference", "-o", self.out], ["--resume", self.out]):
            before = journal.read_text()
            done = self.edgecase("run", *words, check=2)
            self.assertIn("another run is writing", done.stderr)
            self.assertTrue(journal.read_text().startswith(before))
        process.kill()
        process.communicate()
        self.wait_for_no_orphans()
        self.edgecase("run", "--resume", self.out, check=0)


    def test_reports_of_an_earlier_run_go(self):
        """Else a shorter or interrupted run lies beside pages of another one."""
        self.edgecase("run", "--renderer=reference", "-o", self.out, "--ci", "gitlab", check=0)
        for name in ("report-2.html", "report-x.html", "notes.txt"):
            (self.out / name).write_text("mine")
        (self.out / "journal.jsonl").unlink()  # else its ends would be taken for those of the next run
        process = self.start_hanging()
        names = {file.name for file in self.out.iterdir()}
        process.kill()
        process.communicate()
        self.wait_for_no_orphans()
        self.assertEqual(names, {"journal.jsonl", "report-x.html", "notes.txt"})


class OldReports(JournalTest):
    """What a run wrote says nothing of the next one in its folder."""

    REPORTS = {"results.json", "junit.xml", "report.html", "gl-code-quality.json"}

    def setUp(self):
        super().setUp()
        self.run_suite("--ci", "gitlab", check=0)
        (self.out / "report-2.html").write_text("a second part")
        (self.out / "mine.txt").write_text("of somebody else")

    def left(self):
        return {f.name for f in self.out.iterdir()}

    def test_a_run_that_cannot_begin(self):
        extra = self.folder / "extra.xml"
        extra.write_text("<?xml version=\"1.0\"?><testsuites/>")
        done = self.edgecase("run", "--icd", "nowhere.json", "-o", self.out, "--junit", extra)
        self.assertIn(done.returncode, (3, 5))
        self.assertEqual(self.left(), {"journal.jsonl.old", "mine.txt"})
        self.assertFalse(extra.exists())
        self.edgecase("report", self.out, check=3)

    def test_a_selection_of_nothing(self):
        self.run_suite("no/such", check=4)
        self.assertEqual(self.left(), {"journal.jsonl.old", "mine.txt"})

    def hanging(self):
        (self.out / "journal.jsonl").unlink()  # start_hanging waits for what the new one says
        return self.start_hanging()

    def test_a_run_that_is_killed(self):
        process = self.hanging()
        self.assertEqual(self.left(), {"journal.jsonl", "mine.txt"})
        process.kill()
        process.communicate()
        self.wait_for_no_orphans()
        self.assertEqual(self.left() & self.REPORTS, set())

    def test_a_folder_that_is_read_stays(self):
        before = self.left()
        self.run_suite("--failed-in", self.out, check=4)
        self.assertEqual(self.left(), before)

    def test_another_run_keeps_its_folder(self):
        process = self.hanging()
        before = self.left()
        for words in (["-o", self.out], ["no/such", "-o", self.out]):
            self.assertIn(self.edgecase("run", "--renderer=reference", *words).returncode, (2, 4))
            self.assertEqual(self.left(), before)
        process.kill()
        process.communicate()
        self.wait_for_no_orphans()

    def test_diff(self):
        (self.folder / "captures/fam/c1").mkdir(parents=True)
        (self.folder / "captures/fam/c1/unsupported.txt").write_text("not yet")
        self.edgecase("diff", "--captures", "captures", "-o", self.out, check=6)
        self.assertTrue(self.REPORTS - self.left() == {"gl-code-quality.json"}, self.left())
        self.edgecase("diff", "--captures", "nowhere", "-o", self.out, check=3)
        self.assertEqual(self.left(), {"journal.jsonl.old", "mine.txt"})


class OtherCases(JournalTest):
    """A case that was edited is another case under the same id."""

    def edit(self, path, old="[7,7]", new="[6,7]"):
        text = path.read_text()
        self.assertIn(old, text)
        path.write_text(text.replace(old, new))

    def own(self):
        mine = self.folder / "mine.toml"
        mine.write_text((self.suite / "fam/c1.toml").read_text())
        return mine

    def test_compare(self):
        mine = self.own()
        self.run_suite(mine, fault="flip-pixel@mine", out=self.folder / "a", check=1)
        self.edit(mine, "number 1", "number 11")  # what nobody draws
        self.run_suite(mine, out=self.folder / "b", check=0)
        self.assertIn("fixes: 1 case got better", self.edgecase("compare", "a", "b", check=0).stdout)
        self.edit(mine)
        self.run_suite(mine, out=self.folder / "c", check=0)
        done = self.edgecase("compare", "a", "c", check=1)
        self.assertIn("B: another case under the same id", done.stdout)
        self.assertNotIn("fixes", done.stdout)
        self.edgecase("compare", "--common", "a", "c", check=4)

    def test_resume(self):
        process = self.start_hanging()
        process.kill()
        process.communicate()
        self.wait_for_no_orphans()
        self.edit(self.suite / "fam/c0.toml")
        done = self.edgecase("run", "--resume", self.out, check=3)
        self.assertIn("start a new run", done.stderr)

    def test_resume_of_ones_own(self):
        mine = self.own()
        self.run_suite(mine, check=0)
        self.edgecase("run", "--resume", self.out, check=0)
        self.edit(mine)
        done = self.edgecase("run", "--resume", self.out, check=3)
        self.assertIn("the run cannot go on: 'mine' is another case under the same id than the run began with; start a new run",
                      done.stderr)

    def test_merge(self):
        mine = self.own()
        mine.write_text(mine.read_text().replace("[[1,1]", '[["1 + 0 * a",1]') + "[matrix]\na = [1, 2, 3, 4, 5, 6]\n")
        self.run_suite(mine, "--shard", "1/2", out=self.folder / "a", check=0)
        self.edit(mine)
        self.run_suite(mine, "--shard", "2/2", out=self.folder / "b", check=0)
        done = self.edgecase("report", "--merge", "a", "b", "-o", "merged", check=3)
        self.assertEqual(done.stderr, f"edgecase: the case file '{mine}' is not the same in all parts; only parts of one run can be "
                                      "merged, use 'edgecase compare' for different ones\n")


class Interrupt(JournalTest):
    def interrupt(self, number):
        process = self.start_hanging("-j", "2")
        process.send_signal(number)
        output, _ = process.communicate(timeout=20)
        self.assertEqual(process.returncode, 130, output)
        statuses = self.statuses()
        self.assertEqual([statuses[i] for i in self.ids[:8]], ["pass"] * 8)
        self.assertEqual(statuses["fam/c8"], "not_run")
        self.assertIn(f"edgecase: interrupted; go on with 'edgecase run --resume {self.out}'\n".encode(), output)
        self.wait_for_no_orphans()

    def test_sigint(self):
        self.interrupt(signal.SIGINT)

    def test_sigterm(self):
        self.interrupt(signal.SIGTERM)


if __name__ == "__main__":
    unittest.main()
