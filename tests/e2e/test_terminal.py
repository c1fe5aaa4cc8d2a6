# SPDX-FileCopyrightText: The Edgecase authors
# SPDX-License-Identifier: Apache-2.0
"""What a person sees: colours, widths, progress, help, completion, the manual page."""
import fcntl
import json
import os
import pty
import re
import select
import shutil
import struct
import subprocess
import termios
import unittest

from support import PROGRAM, SOURCE, ProgramTest


class TerminalTest(ProgramTest):
    def on_terminal(self, *words, columns=80, fault="", **variables):
        """Output of the program on a terminal of that many columns."""
        env = self.environment(fault)
        env.update({"TERM": "xterm"}, **variables)
        parent, child = pty.openpty()
        fcntl.ioctl(child, termios.TIOCSWINSZ, struct.pack("HHHH", 30, columns, 0, 0))
        with subprocess.Popen([PROGRAM, *map(str, words)], env=env, cwd=self.folder, stdin=child, stdout=child,
                              stderr=child) as process:
            os.close(child)
            text = b""
            while True:
                try:
                    part = os.read(parent, 65536)
                except OSError:  # the other end is closed
                    break
                if not part:
                    break
                text += part
        os.close(parent)
        return text.decode().replace("\r\n", "\n")


class Terminal(TerminalTest):
    RUN = ("run", "--renderer=reference", "-o", "out")

    def test_colours(self):
        self.assertIn("\x1b[34m10 pass\x1b[0m", self.on_terminal(*self.RUN))
        self.assertNotIn("\x1b[34m", self.on_terminal(*self.RUN, NO_COLOR="1"))
        self.assertIn("\x1b[34m", self.on_terminal(*self.RUN, "--color", "always", NO_COLOR="1"))
        self.assertNotIn("\x1b[34m", self.on_terminal(*self.RUN, "--color", "never"))
        self.assertNotIn("\x1b[", self.run_suite(check=0).stdout)
        self.assertIn("\x1b[34m", self.run_suite("--color", "always", check=0).stdout)

    def test_a_list_breaks_no_word(self):
        self.write_case("fam/long", (self.suite / "fam/c1.toml").read_text().replace("number 1", "number " + "twenty-seven " * 12))
        for words in (("list", "fam/long"), ("list", "--long", "fam/long")):
            lines = self.on_terminal(*words).splitlines()
            told = [line for line in lines if "file:" not in line]
            self.assertLessEqual(max(map(len, told)), 80)
            self.assertEqual(" ".join(told).split().count("twenty-seven"), 12)
        self.assertIn("fam/c1  A square", self.on_terminal("list", "fam/c1"))

    def test_what_draws_without_a_driver_tells_no_vulkan(self):
        first = self.edgecase("run", "--renderer=areas", "fam/c1", "-o", "out").stdout.splitlines()[0]
        self.assertRegex(first, r"  Edgecase algorithm areas  built in  8 subpixel bits  profile direct3d  seed 1$")
        self.assertRegex(self.run_suite("fam/c1", check=0).stdout, r"\nlargest accepted error \S+ of 2 allowed budgets[ ,]")

    def test_forty_columns(self):
        text = self.on_terminal(*self.RUN, "--color", "never", columns=40, fault="flip-pixel@fam/c1")
        self.assertIn("FAIL fam/c1", text)
        for line in re.sub(r"\r\x1b\[K[^\r\n]*", "", text).splitlines():
            if "rerun: " not in line and "explain: " not in line and " " in line.strip():
                self.assertLessEqual(len(line), 40, line)
        # A command is never broken, so that it can be copied.
        self.assertRegex(text, r"\n      rerun: (?:\w+=\S+ )*\S+ run fam/c1 --suite \S+ --renderer reference\n")

    def test_a_picture_with_v(self):
        text = self.run_suite("-v", fault="flip-pixel@fam/c1", check=1).stdout
        rows = [line[6:] for line in text.splitlines() if re.fullmatch(r"      [#.~MXDVO]{8}", line)]
        self.assertEqual(len(rows), 8)
        self.assertEqual(sum(row.count("M") + row.count("X") + row.count("D") for row in rows), 1, rows)

    def test_progress(self):
        # The hanging case holds the run up for some of the fifth of a second between two lines.
        words = (*self.RUN, "--timeout", "1", "--retries", "0")
        text = self.on_terminal(*words, fault="hang@fam/c9")
        self.assertRegex(text, r"\r\x1b\[K\[\d+/10\] \d+%  \d+ unexpected")
        # What has failed counts at once, although it is drawn again at the end.
        text = self.on_terminal(*self.RUN, "--batch", "1", "--jobs", "1", "--timeout", "1", fault="flip-pixel@fam/c1,hang@fam/c9")
        self.assertRegex(text, r"\r\x1b\[K\[8/10\] 80%  1 unexpected")
        self.assertNotIn("\r\x1b[K[", self.on_terminal(*words, fault="hang@fam/c9", CI="true"))
        self.assertNotIn("\r\x1b[K[", self.on_terminal(*words, "--progress", "none", fault="hang@fam/c9"))


class Explain(TerminalTest):
    def test_a_rule(self):
        text = self.edgecase("explain", "--rule", "tie.top-left", check=0).stdout
        self.assertTrue(text.startswith("tie.top-left: "))
        for part in ("    profile   direct3d", "    text      ", "    Direct3D  ", "    exercised by a sample ", "    code      ref/",
                     "    cases     0 in 0 files ('edgecase run @rule:tie.top-left')"):
            self.assertIn(part, text)
        self.assertIn("    cases     10 in 10 files", self.edgecase("explain", "--rule", "cover.inside", check=0).stdout)

    def test_a_drawing_and_what_follows(self):
        text = self.edgecase("explain", "fam/c1", "--pixel", "1,1", check=0).stdout
        self.assertIn("\n     . . . . . . . .\n     .[#]# # # # # .\n", text)
        self.assertIn("therefore the sample must be covered exactly once\n", text)
        self.assertIn("therefore the sample must not be covered\n",
                      self.edgecase("explain", "fam/c1", "--pixel", "0,0", check=0).stdout)

    def test_a_case_as_a_whole(self):
        text = self.edgecase("explain", "fam/c1", check=0).stdout
        self.assertRegex(text, r"\n\d+ of 64 samples must be covered; profile direct3d, 8 subpixel bits\n")
        self.assertTrue(text.endswith("\n--pixel X,Y explains a sample\n"), text)
        (self.folder / "asked.toml").write_text(
            'format = 1\ndescription = "a"\ncatches = "b"\nrules = ["query.occlusion"]\ntarget = { size = [4, 4] }\n'
            '[[draw]]\nquery = "occlusion-precise"\nvertices = [[0, 0], [4, 0], [0, 4]]\n'
            '[[draw]]\nquery = "occlusion"\nvertices = [[0, 0], [4, 0], [0, 4]]\n')
        text = self.edgecase("explain", self.folder / "asked.toml", check=0).stdout
        # Below the diagonal, whose own samples belong to the other side.
        self.assertIn("\nthe query of draw 0 has to give 6\n"
                      "the query of draw 1 is not precise: of 6 samples it has to give any number but 0\n", text)
        (self.folder / "counted.toml").write_text(
            'format = 1\ndescription = "a"\ncatches = "b"\nrules = ["query.statistics"]\ntarget = { size = [4, 4] }\n'
            '[[draw]]\nquery = "vertex-invocations"\nvertices = [[0, 0], [4, 0], [0, 4]]\nindices = [0, 1, 2, 2, 1, 0]\n')
        counted = self.edgecase("explain", self.folder / "counted.toml", check=0).stdout
        self.assertIn("\nthe query of draw 0 has to give 3 to 6 vertex-invocations\n", counted)
        text = self.edgecase("explain", self.folder / "asked.toml", "--pixel", "0,0", check=0).stdout
        self.assertIn("\nthe query of draw 0 counts 1 here\nthe query of draw 1 counts 1 here\n", text)
        self.assertIn("\nthe query of draw 0 has to give 6\n", text)

    def test_what_is_said_of_places_is_true(self):
        def explained(first):
            (self.folder / "one.toml").write_text(
                'format = 1\ndescription = "a"\ncatches = "b"\nrules = ["cover.inside"]\ntarget = { size = [8, 8] }\n'
                f"[[draw]]\nvertices = [{first}, [7, 1, 0, 1], [1, 7, 0, 1]]\n")
            return self.edgecase("explain", self.folder / "one.toml", "--pixel", "1,1", check=0).stdout
        free, placeless = "a device may have a vertex at more than one place", "a vertex has no place in the picture"
        # Half a unit of the grid beside it is rounded to either side.
        on_grid, off_grid, behind = explained("[1, 1, 0, 1]"), explained("[1.001953125, 1, 0, 1]"), explained("[1, 1, 0, -1]")
        self.assertTrue(free not in on_grid and placeless not in on_grid, on_grid)
        self.assertTrue(free in off_grid and placeless not in off_grid, off_grid)
        self.assertTrue(free not in behind and placeless in behind, behind)

    def refused(self, sentence, *words, code=2):
        done = self.edgecase("explain", *words, check=code)
        self.assertEqual((done.stdout, done.stderr), ("", f"edgecase: {sentence}\n"))

    def test_wrong_words(self):
        self.refused("there is no rule 'tie.topleft'; did you mean 'tie.top-left'?", "--rule", "tie.topleft", code=4)
        self.refused("--sample and --layer name a sample of a pixel; add --pixel; see 'edgecase explain --help'",
                     "fam/c1", "--sample", "1")
        self.refused("--rule explains a rule, not a case; leave out the selector and --pixel; see 'edgecase explain --help'",
                     "fam/c1", "--rule", "tie.top-left")
        self.refused("--rule explains a rule, not a case; leave out the selector and --pixel; see 'edgecase explain --help'",
                     "--pixel", "1,1", "--rule", "tie.top-left")
        self.refused("--pixel: 'x' is not a value that it takes; write X,Y; see 'edgecase explain --help'", "fam/c1", "--pixel", "x")


class Table(ProgramTest):
    """Help, completion, manual page and docs/cli.md are made of, or held to, one table."""

    def setUp(self):
        super().setUp()
        text = (self.suite / "fam/c1.toml").read_text()
        self.write_case("fam/m", text.replace("[target]", "[matrix]\nrotation = [0, 90]\n[target]")
                        .replace("[[draw]]", "[[draw]]\nrotate = \"rotation\""))
        words = self.folder / "words"
        words.write_text("#!/bin/sh\nprintf begin; IFS='|'; printf '=%s=end\\n' \"$*\"\n")
        words.chmod(0o755)

    def commands(self):
        text = self.edgecase("--help", check=0).stdout.split("Examples:")[0]
        return re.findall(r"^  ([a-z]+) ", text, re.M)

    def options(self, command):
        text = self.edgecase(command, "--help", check=0).stdout.split("Examples:")[0]
        return sorted(set(re.findall(r"--[a-z][a-z_-]+", text)) - {"--help"})

    def test_nothing_is_missing_anywhere(self):
        outputs = {shell: self.edgecase("completion", shell, check=0).stdout for shell in ("bash", "zsh", "fish")}
        man = self.edgecase("man", check=0).stdout.replace("\\-", "-")
        docs = (SOURCE / "docs/cli.md").read_text()
        commands = self.commands()
        self.assertGreaterEqual(len(commands), 13)
        for command in commands:
            section = man.split(f".SS edgecase {command}\n")[1].split(".SS ")[0]
            page = docs.split(f"## `edgecase {command}`", 1)[1].split("\n## ", 1)[0]
            bash = re.findall(rf"^ +{command}\) _edgecase_words .*$", outputs["bash"], re.M)
            zsh = outputs["zsh"].split(f"({command}) entries=(")[1].split(") ;;")[0]
            fish = "".join(x for x in outputs["fish"].splitlines(True) if f"from {command}'" in x)
            for option in self.options(command):
                self.assertIn(f"\\fB{option}\\fR", section)
                self.assertIn(f"`{option}", page)
                self.assertTrue(any(f'{option} ' in x or f'{option}"' in x for x in bash), (command, option))
                self.assertIn(f"'{option}:", zsh)
                self.assertIn(f"-l {option[2:]} ", fish)

    def test_help_has_groups_and_examples(self):
        text = self.edgecase("--help", check=0).stdout
        for group in ("Checking a device:", "Cases:", "The program:", "Examples:", "Exit codes:"):
            self.assertIn(group, text)
        for command in self.commands():
            if command != "version":
                self.assertIn("Examples:", self.edgecase(command, "--help", check=0).stdout)

    def complete(self, *words):
        """What bash is told; it breaks the words itself, so the line alone counts."""
        script = ('source <("$0" completion bash); COMP_LINE="$1"; COMP_POINT=${#COMP_LINE}; _edgecase; '
                  'printf "%s\\n" "${COMPREPLY[@]}"')
        done = subprocess.run(["bash", "-c", script, PROGRAM, " ".join(("edgecase", *words))], env=self.shell_environment(),
                              cwd=self.folder, capture_output=True, text=True, timeout=60, check=True)
        self.assertEqual(done.stderr, "")
        return done.stdout.split()

    def test_doors_and_ways_are_proposed(self):
        for option, words in (("--doors", {"all", "default", "none", "index-16", "mesh-shader"}),
                              ("--ways", {"all", "default", "none", "bare-depth", "prepass"})):
            self.assertLessEqual(words, set(self.complete("run", option, "")))
            for shell in ("zsh", "fish"):
                line = next(x for x in self.edgecase("completion", shell, check=0).stdout.splitlines()
                            if ("run " + option in x if shell == "zsh" else f"-l {option[2:]} " in x))
                self.assertLessEqual(words, set(re.findall(r"[a-z0-9-]+", line)))
        self.assertEqual(self.complete("run", "--doors", "index-8"), ["index-8", "index-8-largest"])

    def shell_environment(self):
        env = self.environment()
        env["PATH"] = f"{os.path.dirname(PROGRAM)}:{env['PATH']}"
        return env | {"TERM": "xterm", "HOME": str(self.folder), "ZDOTDIR": str(self.folder), "INPUTRC": "/dev/null",
                      "XDG_CONFIG_HOME": str(self.folder), "XDG_DATA_HOME": str(self.folder)}

    def typed(self, shell, start, line):
        """The words of a command line after Tab, as a shell on a terminal has them: Ctrl-A puts a command before them."""
        parent, child = pty.openpty()
        fcntl.ioctl(child, termios.TIOCSWINSZ, struct.pack("HHHH", 30, 200, 0, 0))
        with subprocess.Popen(shell, env=self.shell_environment(), cwd=self.folder, stdin=child, stdout=child, stderr=child,
                              start_new_session=True, preexec_fn=lambda: fcntl.ioctl(0, termios.TIOCSCTTY, 0)) as process:
            os.close(child)
            seen = b""

            def read_until(mark, send):
                nonlocal seen
                seen = b""
                os.write(parent, send)
                while mark not in seen:
                    ready, _, _ = select.select([parent], [], [], 60)
                    self.assertTrue(ready, seen)
                    seen += os.read(parent, 65536)
                return seen.decode(errors="replace")

            read_until(b"ready-8", (start + "; echo ready-7 | tr 7 8\r").encode())
            os.write(parent, line.encode() + b"\t")
            text = read_until(b"=end", b"\x01./words \x05\r")
            process.kill()
            process.wait()
        os.close(parent)
        return re.search(r"begin=(.*?)=end", text, re.S).group(1).split("|")

    def test_bash_completes(self):
        self.assertEqual(self.complete("co"), ["compare", "completion"])
        self.assertEqual(self.complete("run", "--pro"), ["--profile", "--progress"])
        self.assertEqual(self.complete("run", "--profile", "d"), ["direct3d"])
        self.assertEqual(self.complete("explain", "fam/c"), self.ids)
        self.assertEqual(self.complete("completion", "z"), ["zsh"])
        self.assertEqual(self.complete("report", "ca"), ["cases/"])
        self.assertEqual(self.complete("run", "--seed", ""), [])
        # What readline keeps, since it breaks words at '=', ':' and '@', is not told again.
        self.assertEqual(self.complete("run", "--profile=p"), ["practice"])
        self.assertEqual(self.complete("run", "@rule:cover.i"), ["cover.inside"])
        self.assertEqual(self.complete("run", "'@rule:cover.i"), ["@rule:cover.inside"])
        self.assertEqual(self.complete("explain", "--rule", "cover.i"), ["cover.inside"])
        self.assertEqual(self.complete("run", "!fam/c1"), ["!fam/c1"])
        self.assertEqual(self.complete("lint", "fam/m:r"), ["rotation=0", "rotation=90"])
        self.assertEqual(self.complete("lint", "fam/m:rotation=9"), ["90"])

    TYPED = ((("run", "--profile=pr"), "--profile=practice"), (("run", "@rule:tie.t"), "@rule:tie.top-left"),
             (("explain", "--rule", "tie.t"), "tie.top-left"), (("lint", "fam/m:rotation=9"), "fam/m:rotation=90"),
             (("run", "--prof"), "--profile"), (("run", "--icd", "no"), "note.json"), (("lint", "./ca"), "./cases/"))

    def check_shell(self, shell, start):
        (self.folder / "note.json").write_text("{}")
        for words, last in self.TYPED:
            got = self.typed(shell, start, " ".join(("edgecase", *words)))
            got[-1] += "/" * (last.endswith("/") and not got[-1].endswith("/"))  # zsh takes it away again at Return
            self.assertEqual(got, ["edgecase", *words[:-1], last])

    def test_bash_on_a_terminal(self):
        self.check_shell(["bash", "--norc", "--noprofile", "-i"], "bind 'set enable-bracketed-paste off'; source <(edgecase completion bash)")

    def test_zsh_on_a_terminal(self):
        self.check_shell(["zsh", "-f", "-i"], "autoload -Uz compinit; compinit -u -D; source <(edgecase completion zsh)")

    def test_fish_on_a_terminal(self):
        self.check_shell(["fish", "--no-config", "-i"], "edgecase completion fish | source")

    def test_scripts_are_of_their_shells(self):
        for shell, check in (("bash", ["-n"]), ("zsh", ["-n"]), ("fish", ["--no-execute"])):
            with self.subTest(shell):
                script = self.edgecase("completion", shell, check=0).stdout
                done = subprocess.run([shell, *check], input=script, capture_output=True, text=True, timeout=60,
                                      check=False)
                self.assertEqual((done.returncode, done.stderr), (0, ""), shell)

    def test_manual_page(self):
        text = self.edgecase("man", check=0).stdout
        self.assertIn('.TH EDGECASE 1 "" "edgecase ', text)
        self.assertIn(".SH NAME\nedgecase \\- check", text)
        if shutil.which("groff"):
            done = subprocess.run(["groff", "-man", "-Tutf8", "-ww"], input=text, capture_output=True, text=True,
                                  timeout=60, check=True)
            self.assertEqual(done.stderr, "")

    def test_wrong_shell(self):
        done = self.edgecase("completion", "csh", check=2)
        self.assertEqual(done.stderr, "edgecase: SHELL: 'csh' is none of bash, fish, zsh; did you mean 'zsh'? "
                                      "See 'edgecase completion --help'\n")


class Doctor(ProgramTest):
    def test_parts_and_commands(self):
        env = self.environment()
        env.update(XDG_DATA_DIRS=str(self.folder), HOME=str(self.folder))
        text = self.edgecase("doctor", "--renderer=reference", env=env).stdout
        self.assertIn("Parts\n  validation layer, for '--validation': missing\n"
                      "     try: sudo apt install vulkan-validationlayers\n", text)
        self.assertIn(f"  suite, for 'edgecase run' without a selector: {self.suite}\n", text)
        layer = self.folder / "vulkan/explicit_layer.d/VkLayer_khronos_validation.json"
        layer.parent.mkdir(parents=True)
        layer.write_text("{}")
        text = self.edgecase("doctor", "--renderer=reference", env=env).stdout
        self.assertIn(f"for '--validation': {layer}\n", text)

    def test_what_share_of_the_suite_a_device_will_draw(self):
        text = self.edgecase("doctor", "--renderer=tiles", check=0).stdout
        self.assertIn("\n     draws 10 of 10 cases of the suite (100.0 %)\n", text)
        self.write_case("fam/layers", (self.suite / "fam/c1.toml").read_text().replace("[8, 8]", "[8, 8]\nlayers = 2"))
        text = self.edgecase("doctor", "--renderer=tiles", check=0).stdout
        self.assertRegex(text, r"\n     draws 10 of 11 cases of the suite \(90.9 %\); not\n       1 case: .*default attachments")
        # A run agrees, on a driver too.
        self.edgecase("run", "--renderer=tiles", "-o", self.out, check=0)
        share = json.loads(self.edgecase("doctor", "--renderer=tiles", "--json", check=0).stdout)["devices"][0]["suite"]
        self.assertEqual((share["cases"], share["drawn"]), (11, 10))
        reason = next(c["reason"] for c in self.results()["cases"] if c["status"] == "unsupported")
        self.assertEqual(share["lacking"], [{"reason": reason, "cases": 1}])
        self.assertIn("draws 11 of 11 cases of the suite (100.0 %)\n", self.edgecase("doctor", "--device", "llvmpipe", check=0).stdout)

    def test_ready_is_about_what_was_chosen(self):
        text = self.edgecase("doctor", "--renderer=tiles", check=0).stdout
        self.assertIn("Edgecase algorithm tiles", text)
        self.assertIn("ready: 'edgecase run' works here on the renderer tiles\n", text)
        for words, variables in ((["--device", "nosuch"], {}), ([], {"EDGECASE_DEVICE": "nosuch"})):
            done = self.edgecase("doctor", *words, env=self.environment() | variables, check=5)
            self.assertIn("not ready: no device 'nosuch' can run the suite\n", done.stdout)
        self.assertFalse(json.loads(self.edgecase("doctor", "--json", "--device", "nosuch", check=5).stdout)["usable"])
        text = self.edgecase("doctor", "--device", "llvmpipe", check=0).stdout
        self.assertIn("ready: 'edgecase run' works here on the device 'llvmpipe'\n", text)


if __name__ == "__main__":
    unittest.main()
