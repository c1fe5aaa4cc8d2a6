# SPDX-FileCopyrightText: The Edgecase authors
# SPDX-License-Identifier: Apache-2.0
"""What list, lint, explain and render tell of cases."""
import json
import re
import resource
import shutil
import subprocess
import unittest

from support import CASE, PROGRAM, SOURCE, ProgramTest

LAYERED = CASE.format(n=99).replace("size = [8, 8]", "size = [8, 8]\nlayers = 2").replace("[[draw]]", "[[draw]]\nlayer = 1")


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

    def test_explain_tells_which_colour_target_is_judged(self):
        case = "combination/color-targets:shown=1"
        told = self.edgecase("explain", "--suite", SOURCE / "cases" / "suite", case, "--pixel", "2,2", "--layer", "1", check=0).stdout
        self.assertIn("the colour at location 1 of 4 colour targets, of which the others do nothing to it:\n"
                      "    the target is cleared to r 4, g 3, b 2, a 1\n", told)

    def test_explain_tells_what_tests_meet_and_leave(self):
        """By hand: the stencil is cleared to 3. Draw 0 discards pixels whose x + y is odd and has counted to 4 before; draw 1 finds 4
        everywhere and counts to 5; draw 2 finds no 9, so that there is no depth test; draw 3 stores no depth, and as a draw without a
        stencil of its own takes 1 away for a back face."""
        draw = "[[draw]]\nvertices = [[0,0,0.25], [8,0,0.25], [0,8,0.25]]\n"
        count = 'pass = "increment-clamp" }\n'
        self.write_case("fam/tests", CASE.format(n=1).split("[[draw]]")[0].replace("[8, 8]", "[8, 8]\nstencil = true\nstencil_clear = 3")
                        + draw + 'discard = "checker"\nearly_tests = true\nstencil = { compare = "equal", reference = 3, ' + count
                        + draw + 'stencil = { compare = "equal", reference = 4, compare_mask = 7, ' + count
                        + draw + 'stencil = { compare = "equal", reference = 9 }\n'
                        + draw + 'depth = { write = false }\n')
        told = self.edgecase("explain", "fam/tests", "--pixel", "1,2", check=0).stdout
        parts = dict(re.findall(r"triangle 0 of draw (\d)(.*?)(?=\n    triangle|\n\n)", told, re.S))
        for draw, line in (("0", "passes the stencil test of back faces, 3 EQUAL 3"), ("0", "passes the depth test ALWAYS"),
                           ("1", "passes the stencil test of back faces, (4 & 7) EQUAL (4 & 7)"), ("1", "passes the depth test ALWAYS"),
                           ("2", "fails the stencil test of back faces, 9 EQUAL 5"), ("3", "passes the stencil test of back faces, 0 ALWAYS 5")):
            self.assertIn(f"\n        {line}", parts[draw])
        self.assertNotIn("depth test", parts["2"])
        self.assertRegex(parts["1"], r"\n        depth +0\.25 = 1/4")
        self.assertRegex(parts["3"], r"\n        depth +is not written by the draw")
        self.assertNotIn("may pass or fail", told)
        self.assertIn("\nthe stencil then is 4\n", told)

    def test_draws_are_counted_from_zero_everywhere(self):
        vertices = "[[draw]]\nvertices = [[1,1], [7,1], [1,7],  [7,1], [7,7], [1,7]]\n"
        self.write_case("fam/two", CASE.format(n=1) + vertices.replace("7]]", "7], [0.1, 0.3, 0.7, 3], [3, 1], [1, 3]]"))
        told = self.edgecase("list", "--long", "fam/two", check=0).stdout
        self.assertIn("1 sample, 2 draws\n", told)
        self.assertIn("note: draw 1: ", told)
        self.edgecase("render", "fam/two", "-o", "two.json", check=0)
        told = json.loads((self.folder / "two.json").read_text())
        draws = {told["triangles"][w["triangle"]]["draw"] for s in told["samples"] for w in s["writers"]}
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
        self.write_case("fam/c3", text.replace('compare = "less"', "bounds = [0.5, 1]"))
        self.assertIn("every fragment fails the depth test or that of its bounds, so a device that draws nothing would pass; "
                      "depth is cleared to 0.375: choose another depth_clear, bounds or compare\n", self.edgecase("lint", "fam/c3", check=3).stderr)
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
        told = "every sample may hold what it was cleared to"
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
            self.assertIn(f"{own}:first={k} --suite {self.suite} --pixel", line)
            self.assertIn("allowed: ", self.edgecase(*line.split(), check=0).stdout)
        told = self.edgecase("explain", f"{own}:first=3", "--pixel", "1,1", check=4).stderr
        self.assertEqual(told, f"edgecase: the file {own} has no leaf 'first=3'; 'edgecase list {own}' lists them\n")

    def test_lint_tells_which_faults_a_case_catches(self):
        self.assertIn("name the cases", self.edgecase("lint", "--strength", check=2).stderr)
        told = self.edgecase("lint", "--strength", "fam/c3", check=0).stdout
        self.assertRegex(told, r"(?m)^\S+/c3\.toml catches \d+ of \d+ known faults$")
        self.assertRegex(told, r"    draws-nothing: Nothing is drawn\.\n        cover\.inside \[vulkan\]; \d+ other families")
        self.assertIn("    ties-right-too: ", told)  # the diagonal runs through samples
        counts = [int(n) for n in re.findall(r"; (\d+) other famil", told)]
        self.assertEqual(counts, sorted(counts))
        self.write_case("fam/c3", re.sub("vertices = .*", "vertices = [[1.25,1], [7.25,1], [1.25,7.25]]",
                                       CASE.format(n=3).replace(', "cover.shared-edge"', "")))
        told = self.edgecase("lint", "--strength", "fam/c3", check=0).stdout
        self.assertIn("    draws-nothing: ", told)
        self.assertNotIn("ties-right-too", told)  # no sample lies on an edge

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

    def test_vertices_that_make_no_triangle(self):
        text = CASE.format(n=0)
        (self.folder / "mine.toml").write_text(text.replace(", [7,7], [1,7]]", ", [7,7]]").replace("[target]", "[matrix]\nk = [1, 2]\n[target]")
                                               .replace("[[1,1]", '[["k", 1]'))
        warning = "edgecase: warning: mine.toml: draw 0: the last 2 of 5 vertices make no triangle; write 1 more or take them away\n"
        self.assertEqual(self.edgecase("lint", "mine.toml").stderr.count(warning), 1)  # of both leaves
        self.assertNotIn("warning", self.edgecase("lint", "mine.toml", "-q").stderr)
        self.assertEqual(self.edgecase("run", "mine.toml", "--renderer=reference", "-o", "out").stderr.count(warning), 1)
        # Of the suite's own cases a person is told who asks for them.
        self.write_case("fam/c0", text.replace(", [7,7], [1,7]]", ", [7,7]]"))
        self.assertIn("c0.toml: draw 0: the last 2 of 5", self.edgecase("lint", "fam/c0").stderr)
        self.assertNotIn("the last 2 of 5", self.edgecase("lint").stderr)
        self.assertNotIn("the last 2 of 5", self.edgecase("run", "--renderer=reference", "-o", "out").stderr)

    def test_a_run_of_ones_own_tells_how_many_samples_are_free(self):
        text = CASE.format(n=0).replace("[[1,1], [7,1], [1,7],", "[[1,1.5], [7.003,1.5], [1,7],").replace('"cover.inside", "cover.shared-edge"', '"cover.inside"')
        (self.folder / "mine.toml").write_text(text)
        free = r"\nfree: [1-9]\d* of 64 samples at profile vulkan, in 1 case; most in mine: "
        words = ["--renderer=reference", "-o", "out"]
        self.assertRegex(self.edgecase("run", "mine.toml", "--profile=vulkan", *words).stdout, free)
        self.assertNotIn("free:", self.edgecase("run", "fam/c1", "--profile=vulkan", *words).stdout)
        self.write_case("fam/c1", text)
        self.assertNotIn("free:", self.edgecase("run", "fam/c1", "--profile=vulkan", *words).stdout)
        (self.folder / "mine.toml").write_text(CASE.format(n=0).replace("1]", "1.25]"))
        self.assertNotIn("free:", self.edgecase("run", "mine.toml", *words).stdout)  # none is

    def test_a_wrong_picture_is_told_with_its_row(self):
        rows = ["........", *[".111111."] * 6, "........"]
        rows[3] = ".11.111."
        (self.folder / "mine.toml").write_text(CASE.format(n=0) + '[expect]\nhits = """\n' + "\n".join(rows) + '\n"""\n')
        wrong = "the picture has '.' at pixel (3, 3), the reference says 1 hit"
        self.assertEqual(self.edgecase("lint", "mine.toml", check=3).stderr, f"edgecase: mine.toml:13:4: error: mine: {wrong}\n")
        self.assertIn(f"      mine.toml:13:4: error: {wrong}\n",
                      self.edgecase("run", "mine.toml", "--renderer=reference", "-o", "out", check=7).stdout)

    def test_lint_finds_a_wrong_picture(self):
        picture = "\\n".join(["........"] * 8)
        self.write_case("fam/c3", (self.suite / "fam/c3.toml").read_text() + f'[expect]\nhits = "{picture}"\n')
        done = self.edgecase("lint", check=3)
        self.assertRegex(done.stderr, r"^edgecase: .*c3\.toml:")
        self.assertTrue(done.stdout.endswith("\n10 cases checked, 1 error\n"), done.stdout)

    def test_explain(self):
        self.assertIn("must be covered", self.edgecase("explain", "fam/c1", "--pixel", "2,2", check=0).stdout)

    def test_explain_at_samples_of_the_device(self):
        """By hand: right of x = 2.5 the triangle has the standard locations (6, 2) and (14, 6) of pixel 2 with 14 alone; a device whose
        sample 0 is at 15 sixteenths has it inside."""
        self.write_case("fam/samples", CASE.format(n=0).replace("[8, 8]", "[8, 8]\nsamples = 4")
                        .replace("vertices = ", 'vertices = [["2+1/2",0], ["10+1/2",0], ["2+1/2",8]] #'))
        words = ["explain", "fam/samples", "--pixel", "2,1", "--sample", "0"]
        self.assertIn("must not be covered", self.edgecase(*words, check=0).stdout)
        own = ["--sample-locations", "4,4;12,12 15,2;1,6;2,10;3,14"]
        self.assertIn("must be covered", self.edgecase(*words, *own, check=0).stdout)
        self.assertIn("--sample-locations has no list of 4 locations, and 'fam/samples' has 4 samples a pixel",
                      self.edgecase(*words, *own[:1], "4,4;15,2", check=2).stderr)
        self.edgecase("render", "fam/samples", *own, "-o", "own.json", check=0)
        samples = json.loads((self.folder / "own.json").read_text())["samples"]
        self.assertTrue([s for s in samples if (s["x"], s["y"], s["sample"]) == (2, 1, 0)], samples[:3])
        for wrong, sentence in (("16,2;1,6", "'16,2' is no sample location: write x,y in 1/16 pixel, 0 to 15"),
                                ("1,6", "'1,6' has 1 location: write the locations of 2, 4, 8 or 16 samples")):
            self.assertIn(sentence, self.edgecase(*words, "--sample-locations", wrong, check=2).stderr)

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


class Documents(ProgramTest):
    """Cases that pages name are there."""

    # In code: what has a family of the suite, or parameters. Dots stand for what a reader fills in.
    WORD = re.compile(r"(?<![\w/.*@-])!?([a-z][a-z0-9-]*(?:/[a-z0-9*-]+)+(?::[a-z_*][^\s`'\"|;]*)?(?:@[a-z*-]+)?)(?![\w/.]*[/.]\w)")
    CODE = re.compile(r"^```.*?^```|^    .*?$|`[^`]+`", re.M | re.S)

    def setUp(self):
        super().setUp()
        self.all = self.edgecase("list", "--ids", "--suite", SOURCE / "cases/suite", check=0).stdout.split()

    def test_ids_of_cases(self):
        names = set(self.all) | {i.split(":")[0] for i in self.all}
        names |= {name.rsplit("/", 1)[0] for name in names}
        families = {i.split("/")[0] for i in self.all}
        pages = [SOURCE / "README.md", SOURCE / "CONTRIBUTING.md", *SOURCE.glob("docs/**/*.md"), *SOURCE.glob("cases/**/*.md"),
                 *SOURCE.glob("tests/*/README.md")]
        seen, wrong = 0, []
        for page in pages:
            for code in self.CODE.findall(page.read_text(encoding="utf-8")):
                for word in self.WORD.findall(code):
                    word = word.rstrip(".,:").split("@")[0]
                    if word.split("/")[0] not in families and ":" not in word or "..." in word:
                        continue
                    seen += 1
                    glob = re.compile(re.escape(word).replace(r"\*\*", ".*").replace(r"\*", "[^/:]*"))
                    if word not in names and not any(glob.fullmatch(name) for name in names):
                        wrong.append(f"{page.relative_to(SOURCE)}: {word}")
        self.assertGreater(seen, 3000)
        self.assertEqual(wrong, [])

    def test_the_example_of_an_expectation_file(self):
        block = (SOURCE / "cases/expectations/README.md").read_text().split("```\n")[1]
        file = self.folder / "example.txt"
        file.write_text(block)
        self.edgecase("expect", file, "--suite", SOURCE / "cases/suite", check=0)


if __name__ == "__main__":
    unittest.main()
