# SPDX-FileCopyrightText: The Edgecase authors
# SPDX-License-Identifier: Apache-2.0
"""Words that are wrong get a sentence, the nearest right one, and the documented exit code."""
import json
import re
import resource
import shutil
import subprocess
import unittest

from support import CASE, PROGRAM, SOURCE, ProgramTest

LAYERED = CASE.format(n=99).replace("size = [8, 8]", "size = [8, 8]\nlayers = 2").replace("[[draw]]", "[[draw]]\nlayer = 1")
COMMANDS = ["run", "gtest", "list", "lint", "explain", "render", "export", "diff", "doctor", "bench", "report", "compare", "expect", "completion", "man", "version"]


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
        self.assertIn("problem: the driver library ./junk.so does not load: ", done.stdout)
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

    def test_rule_selector(self):
        self.refused(["run", "@rule:cover.insid"], "cover.inside", 4)

    def test_invalid_case_file(self):
        self.write_case("fam/bad", "format = 1\ndescriptoin = 'x'\n")
        self.refused(["run"], "bad.toml:2:", 3)

    def test_the_readme_puts_the_program_on_the_path(self):
        lines = (SOURCE / "README.md").read_text().splitlines()
        first = next(k for k, line in enumerate(lines) if line.startswith("    edgecase run "))
        self.assertIn("build/release/bin:$PATH", lines[first - 1])

    def test_help_needs_nothing(self):
        env = self.environment() | {"EDGECASE_SUITE": "nowhere", "VK_DRIVER_FILES": "nowhere", "VK_ICD_FILENAMES": "nowhere"}
        for words in (["--help"], ["run", "--help"], ["man"], ["completion", "bash"], ["version"]):
            self.edgecase(*words, env=env, check=0)

    def test_no_suite(self):
        self.refused(["run", "--suite", "nowhere"], "nowhere", 3)

    def test_resume_takes_no_selector(self):
        self.refused(["run", "fam/c1", "--resume", "x"], "--resume")

    def test_resume_refuses_what_it_would_ignore(self):
        for option in (["--profile", "vulkan"], ["--seed", "3"], ["--json", "x"], ["-o", "y"], ["--batch", "16"]):
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


class Listing(ProgramTest):
    def test_ids(self):
        self.assertEqual(self.edgecase("list", "--ids", check=0).stdout.split(), self.ids)

    def test_ids_look_at_names_alone(self):
        self.write_case("fam/m", 'format = 1\n[matrix]\nk = [1, 2]\nname = ["a", "b"]\n')  # no case: lint says so
        leaves = [f"fam/m:k={k},name={n}" for k in (1, 2) for n in "ab"]
        self.assertEqual(self.edgecase("list", "--ids", check=0).stdout.split(), self.ids + leaves)
        self.assertEqual(self.edgecase("list", "--ids", "fam/m:k=2,*", "!fam/m:k=2,name=a", check=0).stdout.split(), leaves[3:])
        self.assertIn("did you mean", self.edgecase("list", "--ids", "fam/mm", check=4).stderr)
        # What asks for more than names looks at all.
        for words in (["list"], ["list", "--json"], ["list", "--ids", "@rule:cover.inside"], ["lint"]):
            self.assertIn("m.toml:1:", self.edgecase(*words, check=3).stderr)
        self.write_case("fam/m", "format = \n")
        self.assertIn("m.toml:1:", self.edgecase("list", "--ids", check=3).stderr)

    def test_ids_are_those_of_the_cases(self):
        env = self.environment()
        del env["EDGECASE_SUITE"]
        ids = self.edgecase("list", "--ids", env=env, check=0).stdout.split("\n")[:-1]
        whole = [c["id"] for c in json.loads(self.edgecase("list", "--json", env=env, check=0).stdout)]
        self.assertEqual(ids, whole)

    def test_json(self):
        listed = json.loads(self.edgecase("list", "--json", "fam/c[12]", check=None).stdout or "[]")
        listed = listed or json.loads(self.edgecase("list", "--json", "fam/c1", "fam/c2", check=0).stdout)
        self.assertEqual([c["id"] for c in listed], ["fam/c1", "fam/c2"])

    def test_a_program_reads_a_line_a_case(self):
        self.assertEqual(self.edgecase("list", "fam/c1", check=0).stdout, "fam/c1  A square of two triangles, number 1.\n")

    def test_explain_tells_what_is_discarded(self):
        case = "discard/early-unwritten:samples=1"
        told = self.edgecase("explain", "--suite", SOURCE / "cases" / "suite", case, "--pixel", "1,0", check=0).stdout
        self.assertIn("\n        the fragment shader of the draw discards pixels whose x + y is odd, once depth and stencil\n"
                      "          are stored\n        passes the depth test LESS", told)

    def test_draws_are_counted_from_zero_everywhere(self):
        vertices = "[[draw]]\nvertices = [[1,1], [7,1], [1,7],  [7,1], [7,7], [1,7]]\n"
        self.write_case("fam/two", CASE.format(n=1) + vertices.replace("7]]", "7], [0.1, 0.3, 0.7, 3], [3, 1], [1, 3]]"))
        told = self.edgecase("list", "--long", "fam/two", check=0).stdout
        self.assertIn("1 sample, 2 draws\n", told)
        self.assertIn("note: draw 1: ", told)
        self.edgecase("render", "fam/two", "-o", "two.json", check=0)
        draws = {w["draw"] for s in json.loads((self.folder / "two.json").read_text())["samples"] for w in s["writers"]}
        self.assertEqual(draws, {1})  # the second draw is the last writer everywhere
        explained = self.edgecase("explain", "fam/two", "--pixel", "3,3", check=0).stdout
        self.assertEqual(set(re.findall(r"of draw (\d+)", explained)), {"0", "1"})

    def test_lint_of_ones_own_counts_no_expectation_files(self):
        (self.folder / "mine.toml").write_text(CASE.format(n=0))
        (self.folder / "cases/expectations").mkdir()
        (self.folder / "cases/expectations/x.txt").write_text("device: x\n")
        self.assertTrue(self.edgecase("lint", "mine.toml", check=0).stdout.endswith("\n1 case checked, 0 errors\n"))
        self.assertIn("10 cases and 1 expectation file checked", self.edgecase("lint").stdout)

    def test_ids_on_standard_input(self):
        done = self.edgecase("list", "--ids", "-", stdin="fam/c2\nfam/c5\n", check=0)
        self.assertEqual(done.stdout.split(), ["fam/c2", "fam/c5"])

    def test_lint(self):
        self.assertIn("10 cases", self.edgecase("lint", check=0).stdout)

    def test_lint_tells_what_a_case_tests(self):
        self.write_case("fam/c3", (self.suite / "fam/c3.toml").read_text().replace('"cover.inside"', '"cover.inside", "depth.compare"'))
        done = self.edgecase("lint", "fam/c3", check=3)
        self.assertEqual(done.stdout, "fam/c3\n    cover.inside: 30 of 64 samples\n    depth.compare: 0 of 64 samples\n"
                         "    cover.shared-edge: 6 of 64 samples\n1 case checked, 1 error\n")
        self.assertIn("error: no sample exercises the rule depth.compare, which takes a sample where the depth test", done.stderr)
        self.assertEqual(self.edgecase("lint", "fam/c3", "-q", check=3).stdout, "")

    def test_lint_tells_why_a_case_has_no_sample(self):
        """A claim is of a file: other cases may have the samples, or devices with fewer subpixel bits."""
        text = ('format = 1\ndescription = "A triangle."\nrules = ["cover.inside", "tie.top-left", "snap.nearest"]\n[matrix]\nx = [%s]\n'
                '[target]\nsize = [8, 8]\n[[draw]]\nvertices = [["x", "1/2+3/64"], [8, "1/2+3/64"], ["x", 8]]\n')
        own = self.folder / "own.toml"
        own.write_text(text % '"0", "1/2"')
        self.assertEqual(self.edgecase("lint", own, check=0).stdout,
                         "own:x=0\n    cover.inside: 28 of 64 samples\n    tie.top-left: 0 of 64 samples; other cases of its file have some\n"
                         "    snap.nearest: 0 of 64 samples; 8 with 4 subpixel bits\n"
                         "own:x=1/2\n    cover.inside: 21 of 64 samples\n    tie.top-left: 7 of 64 samples\n"
                         "    snap.nearest: 0 of 64 samples; 15 with 4 subpixel bits\n2 cases checked, 0 errors\n")
        self.assertIn("    tie.top-left: 0 of 64 samples; the rest of its file was not looked at\n", self.edgecase("lint", f"{own}:x=0", check=0).stdout)
        # Where cases are not told one by one, what only some of them have is.
        own.write_text(text % ", ".join(f'"{k}/16"' for k in range(24)))
        self.assertIn("24 cases checked", self.edgecase("lint", own, check=0).stdout)
        self.assertRegex(self.edgecase("lint", own, check=0).stdout, r"(?m)^\S*own\.toml: \d+ of 24 cases have no sample for tie.top-left: own:x=0/16, \.\.\.$")
        self.assertNotIn("no sample for snap.nearest", self.edgecase("lint", own, check=0).stdout)
        self.assertEqual(self.edgecase("lint", own, "-q", check=0).stdout, "")

    def test_a_run_of_ones_own_tells_what_it_does_not_test(self):
        text = CASE.format(n=0)
        (self.folder / "mine.toml").write_text(text)
        self.assertNotIn("warning", self.edgecase("run", "mine.toml", "-o", "out", check=0).stderr)
        (self.folder / "mine.toml").write_text(text.replace('"cover.inside"', '"cover.inside", "depth.compare"'))
        done = self.edgecase("run", "mine.toml", "-o", "out", check=0)
        self.assertIn("warning: mine.toml:3:26: no sample exercises the rule depth.compare, which takes a sample where", done.stderr)
        # A claim that the profile does not judge.
        (self.folder / "mine.toml").write_text(text.replace('"cover.inside"', '"cover.inside",\n"tie.top-left"'))
        self.assertNotIn("is judged at", self.edgecase("run", "mine.toml", "-o", "out").stderr)
        done = self.edgecase("run", "mine.toml", "--profile", "practice", "-o", "out")
        self.assertIn("warning: mine.toml:4:1: the rule tie.top-left is judged at profile direct3d, and this run is at practice: "
                      "it says nothing of it\n", done.stderr)

    def test_a_part_of_a_file_is_not_blamed_for_its_claims(self):
        """What is left out may have the samples."""
        text = CASE.format(n=0).replace('"cover.shared-edge"', '"tie.top-left"').replace("[target]", '[matrix]\nx = [0, "1/2", 1]\n[target]')
        text = re.sub(r"vertices = .*", 'vertices = [["x", "1/8"], [8, "1/8"], ["x", "31/4"]]', text)
        (self.folder / "mine.toml").write_text(text)
        self.assertIn("3 cases checked, 0 errors", self.edgecase("lint", "mine.toml", check=0).stdout)
        for words in (["mine.toml", "--quick"], ["mine.toml:x=0"], ["mine.toml", "!mine:x=1/2"], ["mine.toml", "--shard", "1/2"], ["mine.toml", "--shard", "2/2"]):
            self.assertEqual(self.edgecase("run", *words, "--renderer=reference", "-o", "out", check=0).stderr, "", words)
        self.assertIn("0 of 64 samples; the rest of its file was not looked at", self.edgecase("lint", "mine.toml:x=0", check=0).stdout)
        (self.folder / "mine.toml").write_text(text.replace('0, "1/2", 1', "0, 1, 2"))
        self.assertIn("no sample exercises the rule tie.top-left", self.edgecase("run", "mine.toml", "--renderer=reference", "-o", "out", check=0).stderr)

    def test_what_only_has_the_key_exercises_no_rule(self):
        """A rule is exercised where a device that is wrong about it would draw something else."""
        for rule, keys in (("scissor.half-open", "scissor = [0, 0, 100, 100]"), ("clip.distance", "[[draw.clip_distance]]\nconstant = 1"),
                           ("interp.perspective", "[[draw.attribute]]\nconstant = 0.5")):
            (self.folder / "mine.toml").write_text(CASE.format(n=0).replace('"cover.inside"', f'"cover.inside", "{rule}"') + keys + "\n")
            done = self.edgecase("lint", "mine.toml", check=3)
            self.assertIn(f"\n    {rule}: 0 of 64 samples\n", done.stdout)
            self.assertIn(f"mine.toml:3:26: error: no sample exercises the rule {rule}, which takes a sample ", done.stderr)

    def test_a_draw_that_cannot_be_seen(self):
        case = ('format = 1\ndescription = "Two triangles."\nrules = ["cover.inside"%s]\n[matrix]\nred = [%s]\n'
                '[target]\nsize = [8, 8]\nattachments = "color"\n[target.color]\nformat = "rgba8-unorm"\n'
                '[[draw]]\nvertices = [[0,0], [8,0], [0,8]]\ncolor = { value = ["red", 0, 0, 0] }\n'
                '[[draw]]\nvertices = [[0,0], [4,0], [0,4]]\ncolor = { value = [1, 0, 0, 1] }\n')
        own = self.folder / "own.toml"
        own.write_text(case % ("", "0, -1"))
        told = (r"nothing of draw 0 can be seen: with it, without it and with it twice the attachments hold the same; "
                r"choose another colour or another clear colour, or take the draw away\n")
        self.assertRegex(self.edgecase("lint", own, check=3).stderr, rf"own\.toml:11:\d+: error: {told}")
        self.assertRegex(self.edgecase("run", own, "-o", "out", check=0).stderr, rf"warning: \S*own\.toml:11:\d+: {told}")
        # One case of the file shows it; or the draw is there to be harmless.
        for change in (("", "0, 1"), (', "write.outside"', "0, -1")):
            own.write_text(case % change)
            self.assertEqual(self.edgecase("lint", own, check=0).stderr, "")
            self.assertEqual(self.edgecase("run", own, "-o", "out", check=0).stderr, "")

    def test_a_folder_of_ones_own_tells_what_it_does_not_test(self):
        for name in ("a", "sub/b"):
            path = self.folder / "mine" / f"{name}.toml"
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(CASE.format(n=0).replace('"cover.inside"', '"cover.inside", "depth.compare", "tie.top-left"'))
        done = self.edgecase("run", "mine", "--profile", "practice", "-o", "out", check=0)
        for name in ("a", "sub/b"):
            self.assertIn(f"warning: mine/{name}.toml:3:26: no sample exercises the rule depth.compare, which takes a sample where", done.stderr)
        self.assertEqual(done.stderr.count("the rule tie.top-left is judged at profile direct3d"), 1)
        self.assertIn("it says nothing of it, nor in 1 other file\n", done.stderr)

    def test_render_without_the_module_for_images(self):
        """The program alone, as it may be copied, names the package that doctor names."""
        (self.folder / "bin").mkdir()
        shutil.copy(PROGRAM, self.folder / "bin/edgecase")
        done = subprocess.run([self.folder / "bin/edgecase", "render", "fam/c1", "-o", "x.png"], env=self.environment(""), cwd=self.folder,
                              capture_output=True, text=True, timeout=60, check=False)
        self.assertEqual(done.returncode, 7)
        self.assertIn("get it by 'sudo apt install libopenimageio-dev && scripts/build release', or set EDGECASE_IMAGE_IO", done.stderr)

    def test_a_file_named_twice(self):
        (self.folder / "mine.toml").write_text(CASE.format(n=0))
        for again in ("mine.toml", "./mine.toml", self.folder / "mine.toml"):
            self.assertEqual(self.edgecase("run", "mine.toml", again, check=2).stderr,
                             f"edgecase: the file {again} is named twice; name it once\n")

    def test_lint_of_fragments_that_all_fail_the_depth_test(self):
        text = CASE.format(n=0).replace('"cover.inside"', '"cover.inside", "depth.compare"')
        text = text.replace("size = [8, 8]", 'size = [8, 8]\ndepth = "d32-float"').replace("[[draw]]", '[[draw]]\ndepth = { compare = "less" }')
        self.write_case("fam/c3", text)
        told = self.edgecase("lint", "fam/c3", check=3).stderr
        self.assertIn("fam/c3: at profile vulkan every fragment fails the depth test, so a device that draws nothing would pass; "
                      "depth is cleared to 0.375: choose another depth_clear or compare\n", told)
        self.assertNotIn("triangle", told)
        self.write_case("fam/c3", text.replace("[[draw]]", "depth_clear = 1\n[[draw]]"))
        self.edgecase("lint", "fam/c3", check=0)
        # Without a depth test it is a triangle that lacks.
        self.write_case("fam/c3", CASE.format(n=0).partition("vertices")[0] + "vertices = [[20,20], [24,20], [20,24]]\n")
        self.assertIn("add a triangle that must be seen", self.edgecase("lint", "fam/c3", check=3).stderr)

    def test_counts_of_one_sample(self):
        self.write_case("fam/one", CASE.format(n=0).replace("[8, 8]", "[1, 1]").partition("vertices")[0].replace(', "cover.shared-edge"', "")
                        + "vertices = [[0,0], [4,0], [0,4]]\n")
        done = self.edgecase("run", "fam/one", "-o", "out", fault="flip-pixel@fam/one", check=1)
        self.assertRegex(done.stdout, r"FAIL fam/one +1 \w+ of 1 sample  ")

    def test_a_black_picture_never_passes(self):
        case = ('format = 1\ndescription = "A colour."\nrules = ["store.unorm"]\n[target]\nsize = [8, 8]\nattachments = "color"\n'
                '[target.color]\nformat = "rgba8-unorm"\nclear = [1, 1, 1, 1]\n[[draw]]\n'
                'vertices = [[0,0], [8,0], [0,8]]\ncolor = { value = [%d, 1, 1, 1] }\n')
        self.write_case("fam/c3", case % 1)
        told = "every sample may hold the clear colour"
        self.assertIn(told, self.edgecase("lint", "fam/c3", check=3).stderr)
        self.assertIn(told, self.edgecase("run", "fam/c3", "-o", "out", check=7).stdout)
        self.write_case("fam/c3", case % 0)
        self.edgecase("lint", "fam/c3", check=0)
        self.edgecase("run", "fam/c3", "-o", "out", check=0)
        # Clip space without saying so is one pixel, and not even its centre.
        self.write_case("fam/c3", (case % 0).replace("[[0,0], [8,0], [0,8]]", "[[-1,-1], [1,-1], [-1,1]]"))
        self.assertIn('(draw 0: all vertices lie within a pixel of the corner; their space is "pixels" unless',
                      self.edgecase("lint", "fam/c3", check=3).stderr)

    def test_a_leaf_of_a_file_of_ones_own(self):
        own = self.folder / "own.toml"
        own.write_text((self.suite / "fam/c3.toml").read_text().replace("[target]", "[matrix]\nfirst = [0, 1]\n[target]").replace("[[draw]]", "[[draw]]\nfirst = \"first\""))
        done = self.edgecase("run", own, "-o", "out", check=1, env=self.environment("flip-pixel"))
        explain = re.findall(r"explain: \S+ (explain .*)", done.stdout)
        self.assertEqual(len(explain), 2)
        for k, line in enumerate(explain):
            self.assertIn(f"{own}:first={k} --pixel", line)
            self.assertIn("allowed: ", self.edgecase(*line.split(), check=0).stdout)
        told = self.edgecase("explain", f"{own}:first=3", "--pixel", "1,1", check=4).stderr
        self.assertEqual(told, f"edgecase: the file {own} has no leaf 'first=3'; 'edgecase list {own}' lists them\n")

    def test_lint_tells_which_faults_a_case_catches(self):
        self.assertIn("name the cases", self.edgecase("lint", "--strength", check=2).stderr)
        told = self.edgecase("lint", "--strength", "fam/c3", check=0).stdout
        self.assertRegex(told, r"(?m)^\S+/c3\.toml catches \d+ of \d+ known faults$")
        self.assertRegex(told, r"    draws_nothing: Nothing is drawn\.\n        cover\.inside \[vulkan\]; \d+ other families")
        self.assertIn("    ties_right_too: ", told)  # the diagonal runs through samples
        counts = [int(n) for n in re.findall(r"; (\d+) other famil", told)]
        self.assertEqual(counts, sorted(counts))
        self.write_case("fam/c3", re.sub("vertices = .*", "vertices = [[1.25,1], [7.25,1], [1.25,7.25]]",
                                       CASE.format(n=3).replace(', "cover.shared-edge"', "")))
        told = self.edgecase("lint", "--strength", "fam/c3", check=0).stdout
        self.assertIn("    draws_nothing: ", told)
        self.assertNotIn("ties_right_too", told)  # no sample lies on an edge

    def test_strength_is_told_of_files_beside_one_with_an_error(self):
        good = (self.suite / "fam/c3.toml").read_text()
        own, unread, wrong = (self.folder / f"{name}.toml" for name in ("good", "unread", "wrong"))
        own.write_text(good)
        unread.write_text("format = 1\n")
        wrong.write_text(good.replace('"cover.inside"', '"cover.inside", "depth.repeat"'))
        for bad in (unread, wrong):
            done = self.edgecase("lint", "--strength", own, bad, check=3)
            self.assertRegex(done.stdout, r"(?m)^\S+/good\.toml catches \d+ of \d+ known faults$")
            self.assertIn(f"edgecase: {bad}: its strength cannot be told before its errors are mended\n", done.stderr)
            self.assertNotIn(f"{bad} catches", done.stdout)
        self.assertIn("both draws must have the same state, the depth test included", done.stderr)

    def test_no_suite_is_no_error_of_a_file(self):
        own = self.folder / "good.toml"
        own.write_text((self.suite / "fam/c3.toml").read_text())
        done = self.edgecase("lint", "--strength", own, "--suite", "/nosuch", check=3)
        self.assertEqual(done.stderr, "edgecase: no suite in '/nosuch' (--suite): it is not a folder\n")

    def test_options_that_contradict_each_other_are_refused(self):
        for command in (("lint",), ("run",), ("report", "out"), ("diff", "--captures", "c")):
            told = self.edgecase(*command, "-q", "-v", check=2).stderr
            self.assertEqual(told, "edgecase: -q and -v contradict each other; leave one out\n")
        for words in (["--bits"], ["--bug", "x"], ["--reason", "x"], ["--until", "2099-01-01"], ["--dry-run"]):
            told = self.edgecase("expect", "x.txt", *words, check=2).stderr
            self.assertEqual(told, f"edgecase: {words[0]} says how a file is brought up to date; give --update too; "
                             "see 'edgecase expect --help'\n")

    def test_bench_says_what_run_says(self):
        words = ("--icd", self.folder / "none.json", "fam/c1")
        said = self.edgecase("run", "-q", *words, "-o", "out").stderr
        done = self.edgecase("bench", *words)
        self.assertIn("none.json", said)
        self.assertEqual(done.stderr, said)

    def test_lint_finds_a_wrong_picture(self):
        picture = "\\n".join(["........"] * 8)
        self.write_case("fam/c3", (self.suite / "fam/c3.toml").read_text() + f'[expect]\nhits = "{picture}"\n')
        done = self.edgecase("lint", check=3)
        self.assertRegex(done.stderr, r"^edgecase: .*c3\.toml:")
        self.assertTrue(done.stdout.endswith("\n10 cases checked, 1 error\n"), done.stdout)

    def test_explain(self):
        self.assertIn("must be covered", self.edgecase("explain", "fam/c1", "--pixel", "2,2", check=0).stdout)

    def test_explain_a_layer(self):
        self.write_case("fam/layered", LAYERED)
        inside = self.edgecase("explain", "fam/layered", "--pixel", "2,2", "--layer", "1", check=0).stdout
        self.assertIn("layer 1, pixel (2, 2), sample 0", inside)
        self.assertIn("must be covered", inside)
        beside = self.edgecase("explain", "fam/layered", "--pixel", "2,2", check=0).stdout
        self.assertIn("no draw goes to this layer", beside)
        self.assertIn("the draw goes to layer 1", beside)
        refused = self.edgecase("explain", "fam/layered", "--pixel", "2,2", "--layer", "2", check=2).stderr
        self.assertIn("pixel 2,2 sample 0 layer 2 is outside the target of 8 x 8 pixels with 1 sample and 2 layers",
                      refused)

    def test_render_of_a_large_target_takes_little_memory(self):
        self.write_case("fam/large", CASE.format(n=0).replace("[8, 8]", "[2048, 2048]").replace("vertices = ", "vertices = [[0,0], [2048,0], [0,2048]] #"))
        limit = 1 << 30  # the picture needs 460 MB; with the values of all samples it took 6 GB
        done = subprocess.run([PROGRAM, "render", "fam/large", "-o", "large.png"], env=self.environment(""), cwd=self.folder, capture_output=True, text=True,
                              preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, (limit, limit)))
        self.assertEqual((done.returncode, done.stderr), (0, ""))

    def test_render_layers(self):
        self.write_case("fam/layered", LAYERED)
        self.edgecase("render", "fam/layered", "-o", "x.json", check=0)
        picture = json.loads((self.folder / "x.json").read_text())
        self.assertEqual(picture["layers"], 2)
        self.assertEqual({s["layer"] for s in picture["samples"]}, {1})
        self.assertEqual(len(picture["samples"]), 36)

    def test_render_json(self):
        self.edgecase("render", "fam/c1", "-o", "x.json", check=0)
        picture = json.loads((self.folder / "x.json").read_text())
        self.assertEqual(len(picture["samples"]), 36)
        self.assertEqual({s["class"] for s in picture["samples"]}, {"must"})


class Selection(ProgramTest):
    def test_what_is_not_selected_is_not_read(self):
        """Of the other files of the suite a run of some cases reads names and matrices alone."""
        self.write_case("fam/c4", CASE.format(n=4).replace("[target]", "[target]\nsizes = 3"))
        self.run_suite("fam/c3", check=0)
        self.assertEqual(self.statuses(), {"fam/c3": "pass"})
        for words in ((), ("fam/c3", "fam/c4")):
            self.assertIn("[target] has no key \"sizes\"", self.run_suite(*words, check=3).stderr)

    def order(self, *words):
        self.run_suite(*words, check=0)
        return [c["id"] for c in self.results()["cases"]]

    def test_shuffle_is_repeatable_and_keeps_subsets_in_order(self):
        first = self.order("--shuffle", "--seed", "7")
        self.assertEqual(sorted(first), self.ids)
        self.assertNotEqual(first, self.ids)
        self.assertEqual(self.order("--shuffle", "--seed", "7"), first)
        self.assertNotEqual(self.order("--shuffle", "--seed", "8"), first)
        part = self.order("--shuffle", "--seed", "7", "fam/c1", "fam/c4", "fam/c6", "fam/c9")
        self.assertEqual(part, [i for i in first if i in part])

    def test_shards_partition(self):
        seen = []
        for shard in (1, 2, 3):
            seen += self.order("--shard", f"{shard}/3")
        self.assertEqual(sorted(seen), self.ids)

    def test_quick_takes_the_first_and_the_last_leaf_of_each_file(self):
        (self.suite / "fam/leaves.toml").write_text(
            (self.suite / "fam/c1.toml").read_text().replace("[target]", "[matrix]\nn = [0, 90, 180, 270]\n[target]", 1)
            .replace("[[draw]]", '[[draw]]\nrotate = "n"', 1))
        leaves = [f"fam/leaves:n={n}" for n in (0, 90, 180, 270)]
        self.assertEqual(sorted(self.order("--quick")), sorted(self.ids + [leaves[0], leaves[3]]))
        self.assertEqual(self.order("--quick", "fam/leaves"), [leaves[0], leaves[3]])
        self.assertEqual(self.order("--quick", leaves[1]), [leaves[1]])
        self.assertEqual(self.order("fam/leaves"), leaves)

    def test_failed_in(self):
        self.run_suite(fault="segv@fam/c3,flip-pixel@fam/c5", check=1)
        again = self.folder / "again"
        self.run_suite("--failed-in", self.out, out=again, check=0)
        self.assertEqual(set(self.statuses(again)), {"fam/c3", "fam/c5"})
        self.run_suite("--failed-in", again, check=4)

    def test_failed_in_forgets_no_case_of_ones_own(self):
        (self.folder / "mine.toml").write_text(CASE.format(n=0))
        self.run_suite("fam/c3", "mine.toml", fault="flip-pixel@fam/c3,flip-pixel@mine", check=1)
        again = self.folder / "again"
        done = self.run_suite("--failed-in", self.out, out=again, check=4)
        self.assertEqual(done.stderr, f"edgecase: 1 case that failed in '{self.out}' is not selected: 'mine' of mine.toml; name files or "
                                      "folders of your own, too, and '**' for the suite's cases\n")
        self.run_suite("--failed-in", self.out, "**", "mine.toml", out=again, check=0)
        self.assertEqual(set(self.statuses(again)), {"fam/c3", "mine"})
        done = self.run_suite("--failed-in", self.out, "mine.toml", out=again, check=0)
        self.assertIn("warning: 1 case that failed in", done.stderr)

    def test_empty_shard(self):
        shards = [self.run_suite("fam/c1", "--shard", f"{k}/4").returncode for k in range(1, 5)]
        self.assertEqual(sorted(shards), [0, 4, 4, 4])

    def test_folder_outside_the_suite(self):
        for name in ("a", "sub/b"):
            (self.folder / "mine" / name).parent.mkdir(parents=True, exist_ok=True)
            (self.folder / "mine" / f"{name}.toml").write_text(CASE.format(n=0))
        done = self.run_suite("mine/", fault="flip-pixel@sub/b", check=1)
        self.assertEqual(self.statuses(), {"a": "pass", "sub/b": "fail"})
        # The line to draw it again names the file, which needs no --suite.
        rerun = re.search(r"rerun: (?:\w+=\S+ )*\S+ run (.*)", done.stdout).group(1).split()
        self.assertEqual(rerun[0], "mine/sub/b.toml")
        self.run_suite(*rerun, fault="flip-pixel", check=1)
        self.assertEqual(self.edgecase("list", "--ids", "mine", "fam/c1", check=0).stdout.split(), ["fam/c1", "a", "sub/b"])
        # A folder that holds the suite is none of one's own.
        self.assertEqual(self.edgecase("list", "--ids", "cases", check=0).stdout.split(), self.ids)
        self.write_case("a", CASE.format(n=0))
        self.assertIn("mine/a.toml: error: its id 'a' is already that of",
                      self.edgecase("list", "mine", check=3).stderr)

    def test_a_file_of_ones_own_draws_no_case_of_the_suite(self):
        """A file of one's own whose name means something else to a selector chooses itself alone; that of a suite's file is refused."""
        leaves = CASE.format(n=0).replace("[target]", "[matrix]\nfirst = [{}]\n[target]").replace("[[draw]]", '[[draw]]\nfirst = "first"')
        self.write_case("fam/leaves", leaves.format("0, 1"))
        own = self.folder / "mine" / "fam" / "leaves.toml"
        own.parent.mkdir(parents=True)
        for text in (CASE.format(n=0), leaves.format("2")):
            own.write_text(text)
            for words in (["run", "--renderer=reference"], ["list"]):
                self.assertIn(f"mine/fam/leaves.toml: error: its id 'fam/leaves' is already that of {self.suite}/fam/leaves.toml; rename",
                              self.edgecase(*words, "mine", check=3).stderr)
        own.unlink()
        for name in ("-", "fam"):
            only = self.folder / "mine" / f"{name}.toml"
            only.write_text(CASE.format(n=0))
            self.assertEqual(self.edgecase("list", "--ids", "mine", check=0).stdout.splitlines(), [name])
            only.unlink()
        only.write_text(CASE.format(n=0))
        # What an exclusion takes out stays out, and beside it alone the suite is not meant.
        self.assertEqual(self.edgecase("list", "--ids", "mine", "!fam/c1", check=0).stdout.splitlines(), ["fam"])
        self.assertEqual(self.edgecase("list", "--ids", "mine", "fam/c1", "!fam", check=0).stdout.splitlines(), ["fam/c1"])
        self.assertEqual(self.edgecase("list", "mine/fam.toml", "./mine/fam.toml", check=2).stderr,
                         "edgecase: the file ./mine/fam.toml is named twice; name it once\n")

    def test_file_outside_the_suite(self):
        (self.folder / "mine.toml").write_text((self.suite / "fam/c1.toml").read_text())
        self.run_suite("mine.toml", check=0)
        self.assertEqual(self.statuses(), {"mine": "pass"})


if __name__ == "__main__":
    unittest.main()
