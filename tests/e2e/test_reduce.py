# SPDX-FileCopyrightText: The Edgecase authors
# SPDX-License-Identifier: Apache-2.0
"""edgecase reduce: a failing case made as small as it can be, on lavapipe and with other renderers."""
import pathlib
import signal
import subprocess
import sys
import time
import unittest

from support import PROGRAM, SOURCE, ProgramTest


class Reduce(ProgramTest):
    def reduce(self, *words, fault="", check=None):
        # A folder for temporary files of its own, in which nothing must stay.
        return self.edgecase("reduce", *words, check=check, env=self.environment(fault) | {"TMPDIR": str(self.folder)})

    def test_a_case_of_the_suite(self):
        """lavapipe's scissor with several samples: a mesh in four draws becomes two triangles."""
        self.suite = SOURCE / "cases" / "suite"
        done = self.reduce("multisample/scissor-tiled:samples=4", "-o", "smaller.toml", check=0)
        self.assertRegex(done.stderr, r"(?m)^from 4 draws, 248 triangles, 16 x 16 with 4 samples to 2 draws, 2 triangles, \d+ x \d+ with 4 samples")
        text = (self.folder / "smaller.toml").read_text()
        self.assertRegex(text, r"\A# double of scissor.half-open \[vulkan\], reduced from multisample/scissor-tiled:samples=4\.\n")
        self.assertIn("# It passes with 1 sample in place of 4.\n", text)
        self.assertNotIn("with 1 sample.\n", text)  # which would say it twice
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

    def test_smaller_cases_that_die(self):
        """Nobody knows whether they fail: the smallest that does may be none."""
        done = self.reduce("fam/c3", "--renderer=reference", fault="flip-pixel@**,segv@1", check=0)
        self.assertRegex(done.stderr, r"; it may be larger than it has to be, since \d+ cases? had no sure result\n\Z")
        done = self.reduce("fam/c3", "--renderer=reference", fault="flip-pixel@**", check=0)
        self.assertNotIn("since", done.stderr)

    def command(self, *words):
        """A command line that draws with the renderer of docs/examples."""
        return " ".join([sys.executable, str(SOURCE / "docs/examples/rasterize.py"), "%in", "%out", *words])

    def test_a_renderer_without_vulkan(self):
        """docs/examples' renderer with its planted mistake: samples on edges go to the bottom and right ones."""
        done = self.reduce("fam/c3", "--captures-command", self.command("--reverse-ties"), "-o", "smaller.toml", check=0)
        self.assertRegex(done.stderr, r"(?m)^from 1 draw, 2 triangles, 8 x 8 to 1 draw, 2 triangles, [1-7] x [1-7], after drawing \d+ cases\n\Z")
        text = (self.folder / "smaller.toml").read_text()
        self.assertTrue(text.startswith("# order of tie.top-left [direct3d], reduced from fam/c3.\n"), text)
        # What is left fails with the mistake and passes without it, by the way that docs/other-renderers.md tells.
        for words, code in ((["--reverse-ties"], 1), ([], 0)):
            self.edgecase("export", "smaller.toml", "-o", "cases2")
            subprocess.run(self.command(*words).replace("%in", "cases2").replace("%out", "captures"), shell=True, check=True,
                           cwd=self.folder)
            self.edgecase("diff", "--captures", "captures", "--exported", "cases2", "-o", self.folder / f"d{code}", check=code)
        self.assertIn("fam/c3 does not fail here (pass)", self.reduce("fam/c3", "--captures-command", self.command(), check=6).stderr)

    def test_a_renderer_that_dies(self):
        """Candidates that a command cannot draw do not end the reduction; its death can be what is reduced."""
        script = self.folder / "renderer.sh"
        picky = "grep -rqE '\"width\": ?[1-4],' \"$1\" && exit 3\n"
        script.write_text("#!/bin/sh\n" + picky + self.command("--reverse-ties").replace("%in", '"$1"').replace("%out", '"$2"') + "\n")
        script.chmod(0o755)
        done = self.reduce("fam/c3", "--captures-command", "./renderer.sh %in %out", check=0)
        self.assertIn("# order of tie.top-left [direct3d]", done.stdout)
        self.assertRegex(done.stdout, r"\nsize = \[[5-8], \d\]\n")
        script.write_text("#!/bin/sh\nkill -SEGV $$\n")
        done = self.reduce("fam/c3", "--captures-command", "./renderer.sh %in %out", check=0)
        self.assertTrue(done.stdout.startswith("# crash by SIGSEGV, reduced from fam/c3.\n"), done.stdout)
        script.write_text("#!/bin/sh\nexec sleep 60\n")
        done = self.reduce("fam/c3", "--captures-command", "./renderer.sh %in %out", "--timeout=0.2", "-q", check=0)
        self.assertTrue(done.stdout.startswith("# timeout, reduced from fam/c3.\n"), done.stdout)
        self.assert_no_orphans()
        self.assertEqual(list(self.folder.glob("edgecase-reduce-*")), [])

    def test_names_of_folders_are_words_to_the_shell(self):
        """Whatever stands in TMPDIR and wherever the command has its folders: they are never read as commands."""
        hostile = ("t%in; touch pwned #", "$(touch pwned)", "`touch pwned`", "a'b\"c\\d", "two  words", "*", "-n", "%out", "new\nline")
        for name in hostile:
            folder = self.folder / "tmp" / name
            folder.mkdir(parents=True)
            for words in ("%in %out", "\"%in\" \"%out\"", "'%in' '%out'", "--in=%in --out=%out", "'a \"'%in\"' b\"%out"):
                done = self.edgecase("reduce", "fam/c3", "--captures-command", f"printf '%s|' {words} >said; exit 9",
                                     env=self.environment() | {"TMPDIR": str(folder)}, check=7)
                self.assertIn("exit code 9", done.stderr)
                said = (self.folder / "said").read_text()
                with self.subTest(name=name, words=words, said=said):
                    self.assertEqual(said.count("|"), 2 if " b" not in words else 1)
                    self.assertEqual(said.count(f"/tmp/{name}/edgecase-reduce-"), 2)
                    self.assertFalse(list(self.folder.rglob("pwned")))

    def test_an_interruption_keeps_what_was_reached(self):
        ready = self.folder / "ready"
        script = self.folder / "renderer.sh"  # fails always, and waits from the sixth call on
        script.write_text(f'#!/bin/sh\necho >>{ready}\n[ $(wc -l <{ready}) -lt 6 ] || {{ touch {ready}.now; sleep 60; }}\nkill -SEGV $$\n')
        script.chmod(0o755)
        process = subprocess.Popen([PROGRAM, "reduce", "fam/c3", "--captures-command", "./renderer.sh %in %out", "-o", "smaller.toml"],
                                   env=self.environment() | {"TMPDIR": str(self.folder)}, cwd=self.folder, stderr=subprocess.PIPE)
        while not pathlib.Path(f"{ready}.now").exists():
            time.sleep(0.01)
        process.send_signal(signal.SIGINT)
        _, said = process.communicate(timeout=60)
        self.assertEqual(process.returncode, 130, said)
        self.assertIn(b"interrupted; what it had come to is written", said)
        text = (self.folder / "smaller.toml").read_text()
        self.assertTrue(text.startswith("# crash by SIGSEGV, reduced from fam/c3.\n"), text)
        self.edgecase("list", "smaller.toml", check=0)
        self.assert_no_orphans()

    def test_wrong_commands(self):
        def refused(command, sentence, code=7, *words):
            done = self.reduce("fam/c3", "--captures-command", command, *words, check=code)
            self.assertIn(sentence, done.stderr)
            self.assertEqual((done.stdout, done.stderr.count("\n")), ("", 1), done.stderr)
        refused("no_such_renderer %in %out", "the shell could not start the command 'no_such_renderer %in %out' (exit code 127): it said ")
        refused("false %in %out", "the command ended with exit code 1: it said nothing")
        refused("echo first; echo 'no such mode'; exit 3; %in %out", "the command ended with exit code 3: it said 'no such mode'")
        refused("true %in %out", "the command ended well and delivered no plane of the case in '%out/fam/c3'")
        refused("mkdir -p %out/fam/c3; echo x > %out/fam/c3/hits.u8; : %in", "hits.u8")
        refused("mkdir -p %out/fam/c3; echo lazy > %out/fam/c3/unsupported.txt; : %in", "does not fail here (unsupported: the renderer says: lazy)", 6)
        refused("my-renderer %out", "--captures-command has no %in, the folder of the exported cases", 2)
        refused("my-renderer %in", "--captures-command has no %out, the folder of the captures", 2)
        refused("my-renderer %in %out", "--renderer chooses a device, and --captures-command draws without one", 2, "--renderer=reference")
        self.assertIn("--subpixel-bits is for a renderer that --captures-command starts",
                      self.reduce("fam/c3", "--subpixel-bits=4", check=2).stderr)

    def test_wrong_input(self):
        self.assertIn("fam/c3 does not fail here (pass), so there is nothing to reduce", self.reduce("fam/c3", check=6).stderr)
        self.assertIn("did not fail the same way again", self.reduce("fam/c3", fault="flip-pixel@fam/c3", check=1).stderr)
        self.assertIn("none is named; give its id", self.reduce(check=2).stderr)
        self.assertIn("no case matches", self.reduce("fam/c33", check=4).stderr)
        self.assertIn("/nowhere.json", self.reduce("fam/c3", "--icd", "/nowhere.json", check=5).stderr)
        self.assertIn("cannot be written", self.reduce("fam/c3", "-o", "no/where.toml", fault="segv@*,segv@*/*", check=7).stderr)


if __name__ == "__main__":
    unittest.main()
