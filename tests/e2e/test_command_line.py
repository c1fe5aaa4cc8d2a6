# SPDX-FileCopyrightText: The Edgecase authors
# SPDX-License-Identifier: Apache-2.0
"""Words that are wrong get a sentence, the nearest right one, and the documented exit code."""
import re
import unittest

from support import CASE, SOURCE, ProgramTest

COMMANDS = ["run", "gtest", "list", "lint", "explain", "render", "export", "diff", "diagnose", "doctor", "doors", "bench", "fuzz", "reduce", "probe", "report",
            "compare", "expect", "completion", "man", "version"]


class Usage(ProgramTest):
    def refused(self, words, part, exit_code=2):
        done = self.edgecase(*words, check=exit_code)
        self.assertIn(part, done.stderr)
        self.assertEqual(done.stdout, "")

    def test_a_value_of_the_wrong_form_is_named(self):
        for words, option, value in ((("run", "--shard", "0/3"), "--shard", "0/3"),
                                     (("explain", "fam/c1", "--pixel", "x"), "--pixel", "x")):
            done = self.edgecase(*words, check=2)
            self.assertIn(f"{option}: '{value}' is not a value that it takes", done.stderr)

    def test_command(self):
        self.refused(["rnu"], "did you mean 'run'?")
        # Words of other programs that no nearest command explains.
        self.refused(["help"], "unknown command 'help'; did you mean '--help'?")
        self.refused(["merge", "a", "b"], "unknown command 'merge'; did you mean 'report --merge'?")

    def test_no_command(self):
        self.refused([], "command")

    def test_option(self):
        self.refused(["run", "--shufle"], "did you mean '--shuffle'?")

    def test_value(self):
        self.refused(["run", "--profile", "direct3"], "did you mean 'direct3d'?")

    def test_missing_value(self):
        self.refused(["run", "--shard"], "--shard needs a value; write --shard I/N")
        self.refused(["run", "--seed"], "--seed needs a value; write --seed N")

    def test_an_empty_value_is_not_none(self):
        """Of a variable that is not set; the table of all options is walked over in tests/unit/cli."""
        for words, name, form in ((["run", "--icd", "", "--renderer=reference"], "--icd", "FILE"), (["doctor", "--device="], "--device", "DEVICE"),
                                  (["run", "--icd=", "fam/c1"], "--icd", "FILE"), (["run", "-o", ""], "--output", "DIR"),
                                  (["fuzz", "--known", ""], "--known", "DIR"), (["run", "--expect", "", "--expect", "x"], "--expect", "FILE")):
            self.refused(words, f"edgecase: {name}: the value is empty; write {name} {form} or leave it out; see 'edgecase {words[0]} --help'\n")
        self.refused(["report", ""], "DIR: the value is empty")
        self.refused(["run", ""], "", 4)

    def test_options_that_exclude_each_other(self):
        for words, one, other in ((["list", "--ids", "--long"], "--long", "--ids"), (["list", "--json", "--ids"], "--ids", "--json"),
                                  (["fuzz", "--print", "3", "--cases", "5"], "--print", "--cases")):
            self.refused(words, f"{one} and {other} exclude each other; leave out one of the two")

    def test_form_of_a_time(self):
        self.refused(["fuzz", "--time", "5x"], "--time: '5x' is not a value that it takes; write TIME as seconds or like 90s, 10m or 2h")

    def test_a_folder_of_expectations(self):
        self.refused(["run", "--renderer=reference", "--expect", "cases"], "cases: error: this is a folder; name an expectation file in it", 3)

    def test_reports_that_cannot_be_written_are_told_before_the_run(self):
        for words, why in ((["--json", "no/such/x.json"], "--json: there is no folder 'no/such'; make it first"),
                           (["--html", "cases"], "--html: 'cases' is a folder; name a file"),
                           (["--junit", "/proc/version/x"], "--junit: '/proc/version' is no folder")):
            self.refused(["run", "--renderer=reference", "-o", self.out, *words], why)
            self.assertFalse(self.out.exists())
        self.run_suite("fam/c1", "--json", "out/more.json", check=0)  # the run makes the folder
        self.edgecase("run", "--renderer=reference", "fam/c1", "-o", "a/b/c", "--json", "a/b/x.json", check=0)
        self.assertTrue((self.folder / "a/b/x.json").exists() and (self.out / "more.json").exists())

    def test_a_report_takes_no_other_files_place(self):
        case = self.suite / "fam" / "c1.toml"
        text = case.read_text()
        expected = self.folder / "e.txt"
        expected.write_text("# edgecase-expectations 2\n# device: *\n")
        for words in (("--json", case), ("--junit", expected, "--expect", expected), ("--html", case)):
            done = self.edgecase("run", "--renderer=reference", "-o", self.out, *words, check=2)
            self.assertIn("holds something else than such a report", done.stderr)
        self.assertEqual((case.read_text(), expected.read_text()[:1]), (text, "#"))
        for words, part in ((("--json", "x", "--junit", "./x"), "the same file as --json"),
                            (("--junit", self.out / "results.json"), "the run itself writes"),
                            (("--json", self.out / "journal.jsonl"), "a run's journal")):
            self.assertIn(part, self.edgecase("run", "--renderer=reference", "-o", self.out, *words, check=2).stderr)
        # What an earlier command left is replaced.
        for _ in range(2):
            self.edgecase("run", "--renderer=reference", "-q", "-o", self.out, "--json", self.folder / "r.json", "--junit", self.folder / "r.xml",
                          "--html", self.folder / "r.html", check=0)
        self.edgecase("compare", self.out, self.out, "--html", self.folder / "r.html", check=0)

    def test_form_of_a_value(self):
        self.refused(["explain", "fam/c1", "--pixel", "3"], "--pixel: '3' is not a value that it takes; write X,Y")

    def test_files_that_are_not_there(self):
        self.refused(["run", "my-case.toml"], "there is no case file my-case.toml", 4)
        self.refused(["expect", "nowhere.txt"], "nowhere.txt: error: there is no such expectation file", 3)

    def test_family(self):
        self.refused(["run", "fam"], "did you mean fam/**?", 4)

    def test_numbers(self):
        for words in (["--timeout", "x"], ["-j", "0"], ["--repeat", "-1"], ["--shard", "3/2"], ["--shard", "0/2"],
                      ["--seed", "1x"], ["--batch", "99999999999999999999"]):
            self.refused(["run", *words], words[0].lstrip("-")[:3])

    def test_numbers_outside_their_range(self):
        for words, sentence in ((["--seed", "-1"], "--seed: '-1' is no whole number from 0 to 18446744073709551615"),
                                (["--seed", "9" * 23], f"--seed: '{'9' * 23}' is no whole number from 0 to 18446744073709551615"),
                                (["-j", "abc"], "--jobs: 'abc' is no whole number from 1 to 256"),
                                (["--timeout", "0"], "--timeout: '0' is no number from 0.01 to 86400"),
                                (["--shard", "0/4"], "--shard: '0/4' is not a value that it takes; write I/N with 1 <= I <= N")):
            done = self.edgecase("run", *words, check=2)
            self.assertEqual(done.stderr, f"edgecase: {sentence}; see 'edgecase run --help'\n")

    def test_a_variable_is_named(self):
        for name, value in (("PROFILE", "xyzzy"), ("TIMEOUT", "x"), ("JOBS", "0")):
            done = self.edgecase("run", env=self.environment() | {f"EDGECASE_{name}": value}, check=2)
            self.assertTrue(done.stderr.startswith(f"edgecase: EDGECASE_{name}: '{value}' is no"), done.stderr)
            option = f"--{name.lower()}"
            done = self.edgecase("run", option, "0,", env=self.environment() | {f"EDGECASE_{name}": value}, check=2)
            self.assertTrue(done.stderr.startswith(f"edgecase: {option}: '0,' is no"), done.stderr)
        done = self.edgecase("run", env=self.environment() | {"EDGECASE_ICD": "nowhere.json"}, check=5)
        self.assertIn("the driver manifest 'nowhere.json' (EDGECASE_ICD) cannot be read", done.stderr)

    def test_a_device_without_a_driver(self):
        for option in ("--device", "--icd"):
            self.refused(["run", "--renderer", "tiles", option, "x"], f"{option} chooses a driver, and 'tiles' draws without one")
        self.run_suite("--quick", check=0)

    def test_two_reports_on_standard_output(self):
        for words in (["run"], ["report", "x"], ["diff", "--captures", "x"]):
            self.refused([*words, "--json", "-", "--html", "-"], "--json and --html cannot both go to standard output")
        self.refused(["compare", "x", "x", "--json", "-", "--html", "-"], "--json and --html cannot both go to standard output")

    def test_manifests_that_are_none(self):
        (self.folder / "text.json").write_text("hello")
        (self.folder / "gone.json").write_text('{"ICD": {"library_path": "./gone.so"}}')
        (self.folder / "junk.so").write_text("junk")
        (self.folder / "junk.json").write_text('{"file_format_version": "1.0.0", "ICD": {"library_path": "./junk.so", "api_version": "1.3.0"}}')
        for file, sentence in (("text.json", "(--icd) is no driver manifest (no ICD.library_path)"), (".", "(--icd) is a folder; name the JSON file"),
                               ("gone.json", f"(--icd) names a library that does not exist, '{self.folder}/./gone.so'"),
                               ("junk.json", "the driver library './junk.so' does not load: ")):
            done = self.edgecase("run", "--icd", file, check=5)
            self.assertIn(sentence, done.stderr)
            self.assertNotIn("mesa-vulkan-drivers", done.stderr)
        done = self.edgecase("doctor", "--icd", "junk.json", check=5)
        self.assertIn("problem: the driver library './junk.so' does not load: ", done.stdout)
        self.assertNotIn("mesa-vulkan-drivers", done.stdout)

    def test_faults(self):
        env = self.environment("xyzzy")
        self.assertIn("unknown fault 'xyzzy'; there are segv, abort,", self.edgecase("run", "--renderer=reference", env=env, check=5).stderr)
        known = self.edgecase("run", "--renderer=reference", env=env, check=5).stderr.split("there are ")[1].splitlines()[0]
        told = (SOURCE / "docs/cli.md").read_text().split("## Faults on purpose")[1]
        for fault in re.findall(r"[a-z0-9-]+", known):
            self.assertIn(f"`{fault}`", told)
        env = self.environment("sgev")
        self.assertIn("did you mean 'segv'?", self.edgecase("run", "--renderer=reference", env=env, check=5).stderr)
        self.assertEqual(self.run_suite(fault="segv@fam/cc1", check=0).stderr,
                         "edgecase: warning: EDGECASE_FAULT: 'fam/cc1' matches no case\n")

    def test_folders_and_files_that_are_no_cases(self):
        (self.folder / "mine").mkdir()
        (self.folder / "notes.txt").write_text("")
        self.refused(["run", "mine"], "mine is a folder without case files (*.toml)", 4)
        self.refused(["run", "notes.txt"], "notes.txt is no case file (*.toml)", 4)
        (self.folder / "fam").mkdir()
        self.refused(["run", "fam"], "did you mean fam/**?", 4)

    def test_links_to_folders_are_followed(self):
        other = self.folder / "elsewhere"
        other.mkdir()
        (other / "linked.toml").write_text((self.suite / "fam" / "c1.toml").read_text())
        (self.suite / "more").symlink_to(other)
        self.assertIn("more/linked\n", self.edgecase("list", "--ids", check=0).stdout)
        done = self.edgecase("run", "--renderer=reference", "-o", self.out, fault="flip-pixel@more/linked", check=1)
        self.assertIn("more/linked", done.stdout)
        mine = self.folder / "mine"
        mine.mkdir()
        (mine / "sub").symlink_to(other)
        self.assertEqual(self.edgecase("list", "--ids", mine, check=0).stdout, "sub/linked\n")
        (other / "up").symlink_to(self.suite)
        done = self.edgecase("lint", check=3)
        self.assertIn("a folder that holds it", done.stderr)
        self.assertEqual(done.stderr.count("\n"), 1, done.stderr)

    def test_help_of_commands_for_one_case(self):
        for command in ("explain", "render"):
            text = self.edgecase(command, "--help", check=0).stdout
            self.assertIn("the id or the file of one case", text)
            self.assertNotIn("SELECTOR", text)
            self.assertNotIn("CASE...", text)
        self.refused(["explain", "fam/c1", "fam/c2", "--pixel", "1,1"], "this command works on one case, and several are given; give the id of one")

    def test_a_matrix_repeats_no_error(self):
        text = CASE.format(n=1).replace("[target]", "[matrix]\nk = [1, 2, 3]\n[target]", 1)
        self.write_case("fam/m", text.replace("[1,1]", "[nan,1]"))
        done = self.edgecase("lint", check=3)
        self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
        self.assertIn('inf and nan may stand in positions of space "clip" and in attributes only', done.stderr)
        self.assertEqual(done.stdout, "the suite cannot be read, 1 error\n")

    def test_many_errors_of_a_file_are_counted(self):
        self.write_case("fam/many", "".join(f"key{k} = 1\n" for k in range(1000)))
        done = self.edgecase("lint", check=3)
        self.assertLess(done.stderr.count("\n"), 25)
        self.assertRegex(done.stderr, r"many\.toml: and 9\d\d more errors")

    def test_regular_expression(self):
        self.refused(["run", "--require-device", "("], "regular expression")
        self.refused(["run", "--require-device", "(" * 20000], "regular expression")
        self.refused(["run", "--require-device", "(l*)*(([a-zA-Z0-9 .,()]+)+)+!$", "--renderer", "reference"], "does not match the device", 5)

    def test_no_escape_sequence_reaches_the_terminal(self):
        escape = "\x1b]0;owned\x07"
        text = CASE.format(n=1).replace('description = "', 'description = "\\u001b]0;owned\\u0007', 1)
        self.assertIn("owned", text)
        self.write_case("fam/escape", text)
        self.write_case("fam/wrong", text.replace("[target]", f'[target]\n"{escape}" = 1'.replace("\x1b", "\\u001b").replace("\x07", "\\u0007"), 1))
        shown = ""
        for words in (["lint"], ["list"], ["list", escape], ["list", "--suite", escape], ["run", "-o", escape + "/x/y"], ["explain", escape, "--pixel", "1,1"]):
            done = self.edgecase(*words)
            shown += done.stdout + done.stderr
        (self.suite / "fam" / "wrong.toml").unlink()
        for words in (["list"], ["list", "--long"], ["list", "--json"], ["explain", "fam/escape", "--pixel", "1,1"]):
            done = self.edgecase(*words, check=0)
            shown += done.stdout + done.stderr
        shown += self.edgecase("run", env=self.environment() | {"EDGECASE_PROFILE": escape}, check=2).stderr
        self.assertIn("\\x1b]0;owned", shown)
        self.assertNotIn("\x1b", shown)
        self.assertNotIn("\x07", shown)

    def test_selector(self):
        self.refused(["run", "fam/cc3"], "fam/c", 4)

    def test_a_command_on_one_case_without_any(self):
        for command in (["reduce"], ["explain", "--pixel", "1,1"], ["render", "-o", "x.png"]):
            self.refused(command, "this command works on one case, and none is named; give its id, as 'edgecase list' has it, or a file "
                                  "of your own")

    def test_a_family_by_its_beginning(self):
        self.write_case("interpolated/at", CASE.format(n=1))
        self.refused(["run", "interp/persp/**"], "no case matches interp/persp/**; did you mean interpolated/**?", 4)

    def test_rule_selector(self):
        self.refused(["run", "@rule:cover.insid"], "cover.inside", 4)

    def test_invalid_case_file(self):
        self.write_case("fam/bad", "format = 1\ndescriptoin = 'x'\n")
        self.refused(["run"], "bad.toml:2:", 3)

    def test_the_readme_puts_the_program_on_the_path(self):
        lines = (SOURCE / "README.md").read_text().splitlines()
        first = next(k for k, line in enumerate(lines) if line.startswith("    edgecase run "))
        self.assertIn("build/release/bin:$PATH", lines[first - 1])
        # And says under which name its example is saved.
        name = lines[first].split()[2]
        self.assertEqual(name, "my-case.toml")
        block = lines.index("```toml")
        self.assertIn(f"save it as `{name}`", lines[block - 2])
        (self.folder / name).write_text("\n".join(lines[block + 1:lines.index("```")]))
        self.edgecase("lint", name, check=0)
        self.edgecase("explain", name, "--pixel", "3,4", check=0)

    def test_help_needs_nothing(self):
        env = self.environment() | {"EDGECASE_SUITE": "nowhere", "VK_DRIVER_FILES": "nowhere", "VK_ICD_FILENAMES": "nowhere"}
        for words in (["--help"], ["run", "--help"], ["man"], ["completion", "bash"], ["version"]):
            self.edgecase(*words, env=env, check=0)

    def test_no_suite(self):
        self.refused(["run", "--suite", "nowhere"], "nowhere", 3)

    def test_the_folder_above_the_suite(self):
        self.refused(["list", "--suite", str(SOURCE / "cases")], str(SOURCE / "cases/suite"), 3)

    def test_resume_takes_no_selector(self):
        self.refused(["run", "fam/c1", "--resume", "x"], "--resume")

    def test_resume_refuses_what_it_would_ignore(self):
        for option in (["--profile", "vulkan"], ["--seed", "3"], ["-o", "y"], ["--batch", "16"]):
            name = {"-o": "--output"}.get(option[0], option[0])
            self.refused(["run", "--resume", "x", *option], name)

    def test_worker_by_hand(self):
        self.refused(["worker"], "edgecase run")

    def test_pixel_outside(self):
        self.refused(["explain", "fam/c1", "--pixel", "8,0"], "outside")

    def test_two_cases_to_explain(self):
        self.refused(["explain", "fam/*", "--pixel", "1,1"], "one case")

    def test_unknown_image_format(self):
        self.refused(["render", "fam/c1", "-o", "x.bmp"], ".png")

    def test_help_of_every_command(self):
        for command in COMMANDS:
            done = self.edgecase(command, "--help", check=0)
            self.assertIn("--help", done.stdout)
            # Examples are those of the command: "run" has some of its own.
            examples = done.stdout.split("Examples:")[1:]
            self.assertTrue(all(f"edgecase {command}" in text for text in examples), done.stdout)
        self.assertIn("130", self.edgecase("--help", check=0).stdout)

    def test_exit_codes_are_those_of_the_manual(self):
        rows = re.findall(r"^\| (\d+) \| (.*) \|$", (SOURCE / "docs" / "cli.md").read_text(), re.M)
        self.assertEqual(len(rows), 9)
        for text in (self.edgecase("--help", check=0).stdout, self.edgecase("man", check=0).stdout):
            for code, meaning in rows:
                self.assertRegex(text, rf"\b{code}  {re.escape(meaning)}\n")

    def test_version_is_that_of_the_build(self):
        version = re.search(r"^project\(edgecase VERSION ([\d.]+)", (SOURCE / "CMakeLists.txt").read_text(), re.M)[1]
        self.assertTrue(self.edgecase("--version", check=0).stdout.startswith(f"edgecase {version}\n"))
        self.assertIn(f'"edgecase {version}"', self.edgecase("man", check=0).stdout)
        newest = re.search(r"^## ([\d.]+)", (SOURCE / "CHANGELOG.md").read_text(), re.M)[1]
        self.assertEqual(newest, version)

    def test_two_dashes_end_the_options(self):
        for words in (("--", "fam/c1"), ("--ids", "--", "fam/c1"), ("--ids", "fam/c1", "--")):
            self.assertEqual(self.edgecase("list", *words, check=0).stdout.split()[0], "fam/c1")
        self.assertEqual(len(self.edgecase("list", "--ids", "--", check=0).stdout.split()), 10)
        self.refused(["list", "--", "--ids"], "no case matches --ids", exit_code=4)

    def test_manual_lists_every_option(self):
        manual = (SOURCE / "docs" / "cli.md").read_text()
        for command in COMMANDS:
            text = self.edgecase(command, "--help", check=0).stdout.split("Examples:")[0]
            section = manual.split(f"## `edgecase {command}`", 1)[1].split("\n## ", 1)[0]
            for option in set(re.findall(r"--[a-z][a-z_-]+", text)) - {"--help"}:
                self.assertIn(f"`{option}", section, f"docs/cli.md, {command}")


if __name__ == "__main__":
    unittest.main()
