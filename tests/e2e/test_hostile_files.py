# SPDX-FileCopyrightText: The Edgecase authors
# SPDX-License-Identifier: Apache-2.0
"""Folders that a stranger may hand over: no command reads, writes or deletes outside of them, or waits for ever.

docs/files.md says what each command reads, writes and deletes. A new command fails here until it has a row."""
import json
import os
import re
import shutil
import unittest

from support import CASE, SOURCE, ProgramTest

SECRET = "a secret of somebody's"
LONG = "x" * 5000


class Hostile(ProgramTest):
    def setUp(self):
        super().setUp()
        self.outside = self.folder / "outside"
        self.outside.mkdir()
        (self.outside / "keep.toml").write_text(SECRET)
        (self.outside / "folder").mkdir()
        (self.outside / "folder" / "keep.json").write_text(SECRET)
        self.own = self.folder / "own.toml"
        self.own.write_text(CASE.format(n=99))
        self.good = self.folder / "good"
        self.given = self.folder / "given"  # what the stranger gave
        self.made = self.folder / "made"    # where the command may write

    def make_run(self):
        self.run_suite("fam/c1", out=self.good, check=0)

    def make_hunt(self):
        """A hunt that knows a cause of an earlier one, has found one, and has one to reduce."""
        self.edgecase("fuzz", "--renderer=reference", "--cases=4", "fam/**", "-o", self.good, check=0)
        ledger = json.loads((self.good / "fuzz.json").read_text())
        self.causes = []
        for number, (name, is_reduced) in enumerate((("found/001-cover.inside.toml", True), ("earlier/001-cover.inside.toml", True),
                                                     ("known/001-cover.inside.toml", True), ("found/not-reduced-3.toml", False))):
            self.causes.append({"symptom": "extra of cover.inside [vulkan]", "file": name, "is_known": number in (1, 2),
                                "is_reduced": is_reduced, "is_minimal": True, "first_case": 3, "count": 1, "essentials": [], "needs": [],
                                "also": []})
            (self.good / name).parent.mkdir(exist_ok=True)
            (self.good / name).write_text(f"# {number}\n" + CASE.format(n=number))
        (self.good / "fuzz.json").write_text(json.dumps(ledger | {"causes": self.causes}))

    def make_captures(self):
        """An export that carries a case of one's own, with what was drawn of it in the same folder."""
        self.edgecase("export", "fam/c1", self.own, "-o", self.good, check=0)
        for case in ("fam/c1", "own"):
            (self.good / case).mkdir(exist_ok=True)
            (self.good / case / "coverage.u8").write_bytes(bytes(1 if 1 <= x < 7 and 1 <= y < 7 else 0 for y in range(8) for x in range(8)))

    def state(self):
        """All that is there but for what was given and made: kind, time, contents."""
        state = {}
        for path in sorted(self.folder.rglob("*")):
            if path.is_relative_to(self.given) or path.is_relative_to(self.made):
                continue
            status = path.lstat()
            state[str(path)] = (status.st_mode, status.st_mtime_ns, path.read_bytes() if path.is_file() and not path.is_symlink() else b"")
        return state

    def secrets(self):
        """Files of the given and the made folder that hold what stands outside."""
        return [str(f) for folder in (self.given, self.made) for f in folder.rglob("*")
                if f.is_file() and not f.is_symlink() and f.stat().st_size < 1 << 24 and SECRET.encode() in f.read_bytes()]

    # Commands -----------------------------------------------------------------------------------------------------------------

    def takers(self, kind):
        """The commands that take a folder of this kind, each with its name first."""
        given, made = self.given, self.made
        reference = "--renderer=reference"
        return {
            "run": [
                ["run", "--resume", given], ["run", reference, "-o", given, "-q"], ["run", reference, "--failed-in", given, "-o", made],
                ["gtest", reference, "-o", given], ["report", given], ["report", given, "-o", made], ["report", "--merge", given, "-o", made],
                ["report", "--merge", self.good, "-o", given], ["compare", given, self.good], ["compare", self.good, given, "--json", made / "c.json"],
                ["diagnose", given], ["expect", made / "new.toml", "--update", given, "--bug", "x"],
                ["diff", "--captures", self.folder / "captures", "-o", given]],
            "hunt": [
                ["fuzz", "--resume", given, reference, "--cases=4"],
                ["fuzz", reference, "--known", given, "--cases=4", "fam/**", "-o", made],
                ["fuzz", reference, "--cases=4", "fam/**", "-o", given]],
            "captures": [
                ["diff", "--captures", given, "-o", made], ["diff", "--captures", given, "--exported", given, "-o", made],
                ["export", "fam/c1", self.own, "-o", given]],
            "suite": [
                ["list"], ["lint"], ["explain", "fam/c1"], ["render", "fam/c1", "-o", made / "a.json"], ["export", "-o", made / "export"],
                ["export", "--reproducer", "fam/c1", "-o", made / "a.c"], ["run", reference, "-o", made / "run"], ["gtest", reference],
                ["fuzz", reference, "--cases=4", "fam/**", "-o", made / "hunt"], ["reduce", "fam/c1", reference],
                ["doctor", reference], ["bench", reference, "--runs=1"], ["completion", "bash"], ["expect", given / "expectations/ref.toml"]],
            "file": [
                ["probe", "--renderer=flat-parts", "--compare", given / "file", given / "file"],
                ["run", "--renderer=reference", "--expect", given / "file", "-o", made],
                ["expect", given / "file"], ["expect", given / "file.pictures"], ["lint", given / "file.toml"],
                ["reduce", given / "file.toml", "--renderer=reference"], ["explain", given / "file.toml"]],
            "none": [["doors"], ["man"], ["version"]],
        }[kind]

    def attack(self, kind, what, arrange):
        """Gives each command a fresh copy of the good folder with something hostile in it."""
        for words in self.takers(kind):
            if words[0] == "bench" and not what.startswith("suite/"):
                continue  # it measures for seconds where nothing is wrong with the cases
            for folder in (self.given, self.made):
                shutil.rmtree(folder, ignore_errors=True)
            shutil.copytree(self.good, self.given, symlinks=True)
            self.made.mkdir()
            arrange()
            before = self.state()
            env = self.environment() | {"TMPDIR": str(self.made)}
            if kind == "suite":
                env["EDGECASE_SUITE"] = str(self.given / "suite")
            with self.subTest(what=what, words=[str(w).replace(str(self.folder), ".") for w in words]):
                done = self.edgecase(*words, env=env, text=False)
                told = done.stdout + done.stderr
                self.assertIn(done.returncode, (0, 1, 2, 3, 4, 5, 6, 7), told)
                self.assertNotIn(b"internal error", done.stderr)
                if done.returncode in (2, 3, 4, 5):  # else reports tell what is wrong
                    self.assertRegex(done.stderr.decode(), r"\A[^\n]+\n\Z")
                self.assertEqual(self.state(), before)
                self.assertNotIn(SECRET.encode(), told)
                self.assertEqual(self.secrets(), [])

    def replaced(self, name, kind):
        """Puts something else in the place of a file or folder of what was given."""
        path = self.given / name
        if path.is_dir() and not path.is_symlink():
            shutil.rmtree(path)
        else:
            path.unlink(missing_ok=True)
        path.parent.mkdir(parents=True, exist_ok=True)
        if kind == "link to a file":
            path.symlink_to(self.outside / "keep.toml")
        elif kind == "link up":
            path.symlink_to(os.path.relpath(self.outside / "keep.toml", path.parent))
        elif kind == "link to a folder":
            path.symlink_to(self.outside / "folder")
        elif kind == "link to what is not there":
            path.symlink_to(self.outside / "new")
        elif kind == "link to itself":
            path.symlink_to(path)
        elif kind == "device":
            path.symlink_to("/dev/zero")
        elif kind == "pipe":
            os.mkfifo(path)
        else:
            path.mkdir()

    KINDS = ("link to a file", "link up", "link to a folder", "link to what is not there", "link to itself", "device", "pipe", "folder")

    def attack_files(self, folder_kind, names):
        for name in names:
            for kind in self.KINDS:
                self.attack(folder_kind, f"{name}: {kind}", lambda name=name, kind=kind: self.replaced(name, kind))


class Runs(Hostile):
    def test_folders(self):
        self.make_run()
        self.attack_files("run", ["journal.jsonl", "journal.jsonl.old", "results.json", "junit.xml", "report.html"])

    def test_names(self):
        self.make_run()
        journal = (self.good / "journal.jsonl").read_text()
        for name in (str(self.outside / "keep.toml"), "../outside/keep.toml", "/dev/zero", str(self.folder / "pipe"), LONG, "a\\nb\\u0000"):
            if not (self.folder / "pipe").exists():
                os.mkfifo(self.folder / "pipe")
            for field in ("file", "suite_root", "expectation_file", "PWD"):
                new = re.sub(rf'("{field}"[:,])"[^"]*"', lambda m: f'{m.group(1)}"{name}"', journal)
                new = re.sub(r'("sources":\[\[)"[^"]*"', lambda m: f'{m.group(1)}"{name}"', new)
                self.attack("run", f"{field}: {name[:40]}", lambda new=new: (self.given / "journal.jsonl").write_text(new))

    def test_a_journal_starts_nothing_and_writes_nowhere_else(self):
        self.make_run()
        touched = self.outside / "touched"
        program = self.folder / "program"
        program.write_text(f"#!/bin/sh\ntouch {touched}\n")
        program.chmod(0o755)
        journal = (self.good / "journal.jsonl").read_text()
        for option, value in (("--json", touched), ("--junit", "outside/touched"), ("--html", touched), ("--icd", program),
                              ("--debugger", program)):
            new = journal.replace('"--renderer=reference"', f'"--renderer={"vulkan" if option == "--icd" else "reference"}","{option}","{value}"', 1)
            self.assertNotEqual(new, journal)
            (self.good / "journal.jsonl").write_text(new)
            done = self.edgecase("run", "--resume", self.good, check=2)
            self.assertRegex(done.stderr, r"\Aedgecase: the run began with [^\n]*\n\Z")
            self.assertFalse(touched.exists())
        # What is said again is done.
        (self.good / "journal.jsonl").write_text(journal.replace('"--renderer=reference"', f'"--renderer=reference","--json","{touched}"', 1))
        self.edgecase("run", "--resume", self.good, "--json", "other.json", check=2)
        self.edgecase("run", "--resume", self.good, "--json", "outside/touched", check=0)
        self.assertTrue(touched.exists())
        (self.good / "journal.jsonl").write_text(journal)
        self.assertIn("did not begin with --json", self.edgecase("run", "--resume", self.good, "--json", "x.json", check=2).stderr)


class Hunts(Hostile):
    def test_folders(self):
        self.make_hunt()
        self.attack_files("hunt", ["fuzz.json", "found", "known", "earlier", "found/001-cover.inside.toml", "found/not-reduced-3.toml",
                                   "known/001-cover.inside.toml"])

    def test_names(self):
        self.make_hunt()
        ledger = json.loads((self.good / "fuzz.json").read_text())
        for name in (str(self.outside / "keep.toml"), "../outside/keep.toml", "found/../../outside/keep.toml", "found//001-cover.inside.toml",
                     "/dev/zero", "fuzz.json", "found", "found/", "", ".", "found/a\0b.toml", "found/a\nb.toml", f"found/{LONG}.toml",
                     "found/not-reduced-4.toml", "known/not-reduced-3.toml"):
            causes = [self.causes[-1] | {"file": name}]
            (self.good / "fuzz.json").write_text(json.dumps(ledger | {"causes": causes}))
            self.attack("hunt", f"file: {name[:40]}", lambda: None)
            for words in (["--resume", self.good], ["--known", self.good, "-o", self.made]):
                done = self.edgecase("fuzz", "--renderer=reference", "--cases=4", *words, check=3)
                self.assertRegex(done.stderr, r"\Aedgecase: [^\n]* is malformed: [^\n]*\n\Z")
        # Files are named by what a cause shows, too.
        causes = [self.causes[0] | {"symptom": "extra of x/../../../outside/folder/y [vulkan]"}]
        (self.good / "fuzz.json").write_text(json.dumps(ledger | {"causes": causes}))
        self.attack("hunt", "symptom", lambda: None)
        for name in (str(self.folder / "pipe"), "/dev/zero", "../outside/keep.toml", LONG):
            if not (self.folder / "pipe").exists():
                os.mkfifo(self.folder / "pipe")
            for field in ({"expect": [name]}, {"suite": name}, {"selectors": [name]}):
                (self.good / "fuzz.json").write_text(json.dumps(ledger | field))
                self.attack("hunt", f"{field}", lambda: None)

    def test_a_hunt_keeps_what_it_knows(self):
        """Also when the earlier hunt is gone; what was to be reduced is, and its file deleted."""
        self.make_hunt()
        self.edgecase("fuzz", "--renderer=reference", "--cases=4", "fam/**", "--known", self.good, "--known", self.good, "-o", "next", check=0)
        shutil.rmtree(self.good)
        self.edgecase("fuzz", "--renderer=reference", "--cases=8", "--resume", "next", check=0)
        causes = json.loads((self.folder / "next/fuzz.json").read_text())["causes"]
        self.assertEqual([c["file"] for c in causes], [f"earlier/00{n}-cover.inside.toml" for n in (1, 2, 3)])
        self.assertEqual([(self.folder / "next" / c["file"]).read_text()[:4] for c in causes], ["# 0\n", "# 1\n", "# 2\n"])
        self.make_hunt()
        self.edgecase("fuzz", "--renderer=reference", "--cases=4", "--resume", self.good)
        self.assertEqual([f.name for f in (self.good / "found").iterdir()], ["001-cover.inside.toml"])


class Exchange(Hostile):
    def test_folders(self):
        self.make_captures()
        self.attack_files("captures", ["index.json", "fam", "fam/c1", "fam/c1/coverage.u8", "fam/c1/hits.u32", "fam/c1/unsupported.txt", "fam/c1.json",
                                       "own-cases", "own-cases/own.toml", "own-cases/more"])

    def test_names(self):
        self.make_captures()
        for name in (str(self.outside / "keep"), "../outside/keep", LONG, "a\0b", "a\nb"):
            index = json.loads((self.good / "index.json").read_text())
            index["cases"] = [{"id": name, "file": name, "folder": name, "needs": []}]
            self.attack("captures", name[:40], lambda index=index: (self.given / "index.json").write_text(json.dumps(index)))

    def test_what_a_link_leads_to_is_not_read(self):
        """Also if it would fit."""
        self.make_captures()
        shutil.copytree(self.good, self.outside / "export")
        for name, words, code in (("fam/c1/coverage.u8", [], 7), ("fam/c1", [], 7), ("fam", ["fam/c1"], 7), ("own-cases", [], 3),
                                  ("own-cases/own.toml", [], 3), ("index.json", ["--exported", self.given], 3)):
            for folder in (self.given, self.made):
                shutil.rmtree(folder, ignore_errors=True)
            shutil.copytree(self.good, self.given)
            diff = ["diff", "--captures", self.given, "-o", self.made, *words]
            self.edgecase(*diff, check=0)
            self.replaced(name, "folder")
            (self.given / name).rmdir()
            (self.given / name).symlink_to(self.outside / "export" / name)
            done = self.edgecase(*diff, check=code)
            self.assertRegex(done.stdout + done.stderr, "link leads out of the|is no list of exported cases", name)


class Named(Hostile):
    def test_every_command_is_attacked(self):
        """By the list of the program's own help; and the page has a row for each."""
        commands = set(re.findall(r"^  ([a-z]+)  ", self.edgecase("--help", check=0).stdout, re.M))
        self.assertGreater(len(commands), 15)
        attacked = {str(words[0]) for kind in ("run", "hunt", "captures", "suite", "file", "none") for words in self.takers(kind)}
        self.assertEqual(attacked, commands)
        page = (SOURCE / "docs" / "files.md").read_text(encoding="utf-8")
        self.assertEqual(set(re.findall(r"^\| `([a-z]+)", page, re.M)), commands)

    def test_suites(self):
        """A suite is named by the user, so that links are followed; nothing waits for a pipe or a device."""
        shutil.copytree(self.suite, self.good / "suite")
        (self.good / "expectations").mkdir()
        for name in ("suite/fam/c1.toml", "expectations/ref.toml", "expectations/ref.pictures"):
            for kind in ("link to what is not there", "link to itself", "device", "pipe", "folder"):
                self.attack("suite", f"{name}: {kind}", lambda name=name, kind=kind: self.replaced(name, kind))

    def test_files(self):
        self.good.mkdir()
        for kind in ("link to what is not there", "link to itself", "device", "pipe", "folder"):
            def arrange(kind=kind):
                for name in ("file", "file.toml", "file.pictures"):
                    self.replaced(name, kind)
            self.attack("file", kind, arrange)

    def test_commands_without_files(self):
        self.good.mkdir()
        self.attack("none", "nothing", lambda: None)


if __name__ == "__main__":
    unittest.main()
