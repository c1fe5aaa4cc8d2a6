# SPDX-FileCopyrightText: The Edgecase authors
# SPDX-License-Identifier: Apache-2.0
"""Ways on lavapipe: which are drawn, what they are called, and what commands and expectation files make of them."""
import json
import unittest

from support import ProgramTest

CASE = """format = 1
description = "Two triangles."
rules = ["cover.inside"]
[target]
size = [8, 8]
[[draw]]
vertices = [[0,0], [4,0], [0,8],  [8,8], [4,8], [8,0]]
"""
COLOUR = CASE.replace("size = [8, 8]", 'size = [8, 8]\n[target.color]\nformat = "rgba8-unorm"').replace(
    "[[draw]]", "[[draw]]\ncolor = { value = [1, 0, 1, 1] }")


class Ways(ProgramTest):
    def setUp(self):
        super().setUp()
        for name, text in (("a/one", CASE), ("a/colour", COLOUR), ("b/two", CASE)):
            (self.folder / "own" / name).parent.mkdir(parents=True, exist_ok=True)
            (self.folder / "own" / (name + ".toml")).write_text(text)

    def run_ways(self, *words, check=0, fault=""):
        done = self.edgecase("run", "--suite", "own", "--device", "llvmpipe", "-o", "out", *words, check=check, fault=fault)
        results = self.folder / "out" / "results.json"
        return done, {c["id"]: c["status"] for c in json.loads(results.read_text())["cases"]} if results.exists() else None

    def test_a_way_makes_a_case(self):
        _, cases = self.run_ways("--ways", "bare-color-texture,prepass")
        self.assertEqual(cases, {name: "pass" for name in (
            "a/colour", "a/one", "b/two", "a/one@bare-color-texture", "a/one@prepass", "b/two@bare-color-texture", "b/two@prepass")})
        _, cases = self.run_ways()
        self.assertEqual(sorted(cases), ["a/colour", "a/one", "b/two"])

    def test_all_ways_are_right(self):
        listed = self.edgecase("doors", check=0).stdout
        bare = listed.count("group: bare")
        self.assertGreater(bare, 10)
        _, cases = self.run_ways("--ways", "all", "b/**")
        # Nothing tests a depth, so one way has nothing to show beside the colour.
        self.assertEqual(len(cases), 1 + bare - 1)
        self.assertEqual(set(cases.values()), {"pass"})

    def test_default_is_some_with_each_file(self):
        _, cases = self.run_ways("--ways", "default")
        for name in ("a/one", "b/two"):
            self.assertEqual(sum(c.startswith(name + "@") for c in cases), 3, cases)
        self.assertEqual(set(cases.values()), {"pass"})

    def test_selectors_name_ways(self):
        _, cases = self.run_ways("a/one@bare-*s*", "b/two")
        self.assertEqual(sorted(cases), sorted(["b/two"] + ["a/one@bare-" + way for way in (
            "color-constant", "color-mask", "color-offset", "color-push", "color-sampled", "color-second", "color-smooth", "color-storage",
            "color-texels", "depth-sampled", "stencil")]))
        done = self.edgecase("explain", "--suite", "own", "a/one@bare-depth", "--pixel", "0,0", check=0).stdout
        self.assertIn("a/one@bare-depth\n", done)
        self.assertIn("must be covered", done)
        mine = self.folder / "mine.toml"
        mine.write_text(CASE)
        _, cases = self.run_ways(f"{mine}@bare-color-push")
        self.assertEqual(cases, {"mine@bare-color-push": "pass"})

    def test_lint_claims_only_what_a_way_shows(self):
        same = CASE.replace("[[0,0], [4,0], [0,8],  [8,8], [4,8], [8,0]]", "[[0,0], [8,0], [0,8]]\n[[draw]]\nvertices = [[0,0], [8,0], [0,8]]").replace(
            '"cover.inside"', '"order.primitive", "cover.inside"')
        apart = same.replace("[[draw]]\nvertices = [[0,0], [8,0]", '[[draw]]\nvertices = [[0,0,"1/4"], [8,0,"1/4"]', 1).replace("[0,8]]", '[0,8,"1/4"]]', 1)
        for text, order in ((same, 0), (apart, 28)):
            (self.folder / "own/b/two.toml").write_text(text)
            for way, shown in (("bare-depth", order), ("bare-stencil", 0), ("bare-color-push", 28)):
                told = self.edgecase("lint", "--suite", "own", "b/two@" + way, check=0).stdout
                self.assertIn(f"order.primitive: {shown} of 64 samples", told, (way, text))
                # Of two fragments of one depth either may be lost.
                self.assertEqual("cover.inside: 0 of" in told, (way, text) == ("bare-depth", same), way)

    def test_wrong_words(self):
        done, _ = self.run_ways("--ways", "bare-color-psh", check=2)
        self.assertIn("--ways: there is no way 'bare-color-psh'; did you mean 'bare-color-push'?", done.stderr)
        done, _ = self.run_ways("--ways", "bare-beside", check=4)
        self.assertIn("no selected case is drawn by 'bare-beside', which takes cases", done.stderr)
        done, _ = self.run_ways("a/one@bare-color-psh", check=4)
        self.assertIn("'a/one' is drawn by no way 'bare-color-psh'; did you mean 'bare-color-push'?", done.stderr)
        done, _ = self.run_ways("a/on@bare-color-push", check=4)
        self.assertIn("did you mean a/one?", done.stderr)

    def test_expectations_speak_of_cases_or_of_ways(self):
        words = ("--ways", "bare-color-push,bare-color-flat", "b/**")
        expected = self.folder / "e.txt"
        head = "# edgecase-expectations 2\n# device: llvmpipe*\n"
        wrong = "b#1  value:store.unorm@vulkan<=1 value:blend.equation@vulkan<=1 missing:cover.inside@vulkan<=1 extra:cover.outside@vulkan<=1  # Known.\n"
        expected.write_text(head + "b/two@bare-color-p* fail " + wrong)
        _, cases = self.run_ways(*words, "--expect", expected, check=0, fault="flip-pixel@b/two@bare-color-push")
        self.assertEqual(cases, {"b/two": "pass", "b/two@bare-color-flat": "pass", "b/two@bare-color-push": "xfail"})
        expected.write_text(head + "b/two fail " + wrong)
        _, cases = self.run_ways(*words, "--expect", expected, check=1, fault="flip-pixel@b/two@bare-color-push")
        self.assertEqual(cases, {"b/two": "xpass", "b/two@bare-color-flat": "pass", "b/two@bare-color-push": "fail"})
        # A line of a way that this run does not draw is no mistake, one of no way at all is.
        expected.write_text(head + "b/two@prepass skip b#1 # Known.\n")
        self.run_ways("--ways", "bare-color-push", "--expect", expected, check=0)
        expected.write_text(head + "b/two@prepas skip b#1 # Known.\n")
        done, _ = self.run_ways("--ways", "bare-color-push", "--expect", expected, check=3)
        self.assertIn("matches no case", done.stderr)

    def test_expectations_beside_a_suite_never_speak_of_ones_own_cases(self):
        (self.folder / "expectations").mkdir()
        (self.folder / "expectations/x.txt").write_text(
            "# edgecase-expectations 2\n# device: llvmpipe*\n**@bare-depth skip b#1 # Known.\n")
        (self.folder / "mine.toml").write_text(CASE)
        for words in (("--ways", "bare-depth", "b/two", "mine.toml"), ("b/two@bare-depth", "mine.toml@bare-depth")):
            _, cases = self.run_ways(*words)
            self.assertEqual((cases["b/two@bare-depth"], cases["mine@bare-depth"]), ("skip", "pass"), words)

    def test_a_case_is_drawn_once(self):
        done, cases = self.run_ways("a/one@bare-depth", "a/one@bare-*pth", "a/one", "--ways", "bare-depth")
        self.assertEqual(sorted(cases), ["a/one", "a/one@bare-depth"])
        self.assertIn("2 cases  2 pass", done.stdout)

    def test_paths_may_have_the_sign(self):
        for name in ("my@home/x.toml", "x@2x.toml", "dir@home/y.toml"):
            (self.folder / name).parent.mkdir(exist_ok=True)
        (self.folder / "my@home/x.toml").write_text(CASE)
        (self.folder / "dir@home/y.toml").write_text(CASE)
        self.assertEqual(self.run_ways("my@home/x.toml")[1], {"x": "pass"})
        self.assertEqual(self.run_ways("dir@home")[1], {"y": "pass"})
        self.assertEqual(self.run_ways("my@home/x.toml@bare-depth")[1], {"x@bare-depth": "pass"})

    def test_lines_to_repeat(self):
        (self.folder / "mine.toml").write_text(CASE)
        for words in (("mine.toml", "--ways", "bare-depth"), ("mine.toml@bare-depth",)):
            _, cases = self.run_ways(*words, check=1, fault="flip-pixel@mine@bare-depth")
            self.assertEqual(cases["mine@bare-depth"], "fail")
            record = next(c for c in json.loads((self.folder / "out/results.json").read_text())["cases"] if c["id"] == "mine@bare-depth")
            for line in (record["rerun"], record["explain"]):
                self.assertIn(" mine.toml@bare-depth", line)

    def test_a_file_of_pictures_keeps_what_ways_draw(self):
        fault = "flip-pixel@b/two@bare-depth"
        self.run_ways("--ways", "bare-depth", check=1, fault=fault)
        self.edgecase("expect", "--suite", "own", "new.txt", "--update", "out", "--bug", "b#2", check=0)
        self.run_ways("--ways", "bare-depth", "--expect", "new.txt", check=0, fault=fault)
        for kept in ("1 added, 0 kept", "0 added, 1 kept"):
            done = self.edgecase("expect", "--suite", "own", "new.pictures", "--update", "out", check=0)
            self.assertIn(f"0 removed, {kept}", done.stdout)
        self.assertRegex((self.folder / "new.pictures").read_text(), r"b/two@bare-depth [0-9a-f]{16}")
        (self.folder / "expectations").mkdir(exist_ok=True)
        (self.folder / "new.pictures").rename(self.folder / "expectations/new.pictures")
        self.edgecase("lint", "--suite", "own", check=0)

    def test_an_expectation_file_learns_of_ways(self):
        self.run_ways("--ways", "bare-depth", check=1, fault="flip-pixel@b/two@bare-depth")
        self.edgecase("expect", "--suite", "own", "new.txt", "--update", "out", "--bug", "b#2", check=0)
        self.assertRegex((self.folder / "new.txt").read_text(), r"(?m)^b/two@bare-depth +fail +b#2 +\w+:")
        _, cases = self.run_ways("--ways", "bare-depth", "--expect", "new.txt", fault="flip-pixel@b/two@bare-depth")
        self.assertEqual(cases["b/two@bare-depth"], "xfail")

    def test_a_known_case_is_drawn_by_no_way_by_default(self):
        expected = self.folder / "e.txt"
        expected.write_text("# edgecase-expectations 2\n# device: llvmpipe*\nb/two skip b#1 # Known.\n")
        _, cases = self.run_ways("--ways", "default", "--expect", expected)
        self.assertEqual([c for c in cases if c.startswith("b/")], ["b/two"])
        self.assertEqual(sum(c.startswith("a/one@") for c in cases), 3)

    def test_a_run_goes_on_and_is_run_again(self):
        _, cases = self.run_ways("--ways", "bare-color-push", check=1, fault="flip-pixel@b/two@bare-color-push")
        self.assertEqual(cases["b/two@bare-color-push"], "fail")
        failed = self.edgecase("run", "--suite", "own", "--device", "llvmpipe", "--failed-in", "out", "-o", "again", check=0)
        self.assertIn("1 case  1 pass", failed.stdout)
        journal = self.folder / "out" / "journal.jsonl"
        lines = journal.read_text().splitlines(keepends=True)
        kept = [line for line in lines[1:] if '"b/two@bare-color-push"' not in line]
        self.assertLess(len(kept), len(lines) - 1)
        journal.write_text(lines[0] + "".join(kept))
        self.edgecase("run", "--resume", "out", check=0)
        results = json.loads((self.folder / "out" / "results.json").read_text())
        self.assertEqual(len(results["cases"]), 5)

    def test_a_case_that_shows_nothing_so_is_unsupported(self):
        far = CASE.replace("[[draw]]", "[[draw]]\ndepth = { compare = \"equal\" }\nvertices = [[0,0,0.375], [8,0,0.375], [0,8,0.375]]\n[[draw]]")
        (self.folder / "own/b/two.toml").write_text(far.replace("vertices = [[0,0], [4,0], [0,8],  [8,8], [4,8], [8,0]]\n", "vertices = [[0,0,0.375], [4,0,0.375], [0,8,0.375]]\n"))
        _, cases = self.run_ways("--ways", "bare-depth", "b/**")
        self.assertEqual(cases, {"b/two": "pass", "b/two@bare-depth": "unsupported"})


class Files(ProgramTest):
    def lint(self, text, check):
        (self.folder / "case.toml").write_text(text)
        return self.edgecase("lint", "case.toml", check=check).stderr

    def test_wrong_sources_and_attachments(self):
        bare = COLOUR.replace("size = [8, 8]", 'size = [8, 8]\nattachments = "color"')
        self.lint(bare.replace("value = [1, 0, 1, 1]", 'value = [1, 0, 1, 1], from = "uniform"'), 0)
        mapped = "[[draw.attribute]]\nvalues = [[-1,0], [1,0], [1,1],  [1,1], [-1,1], [1,0]]\n"
        negative = '[[draw]]\ndiscard = "negative"'
        self.lint(bare.replace("value = [1, 0, 1, 1]", 'value = [1, 0, 1, 1], from = "mask"').replace("[[draw]]", negative) + mapped, 0)
        for words, told in (
                (COLOUR.replace("value = [1, 0, 1, 1]", 'value = [1, 0, 1, 1], from = "uniform"'), "from is of one colour of numbers alone"),
                (bare.replace("value = [1, 0, 1, 1]", 'value = [1, 0, 1, 1], from = "texture"'), "a texture is read at the draw's first attribute"),
                (bare.replace("value = [1, 0, 1, 1]", 'value = [1, 0, 1, 1], from = "unform"'), 'did you mean "uniform"?'),
                (bare.replace("value = [1, 0, 1, 1]", 'value = [1, 0, 1, 1], from = "storage"').replace("[[draw]]", '[[draw]]\ndiscard = "checker"'),
                 "does nothing else; leave out discard"),
                (bare.replace("value = [1, 0, 1, 1]", 'value = [1, 0, 1, 1], from = "texels"'), "the first attribute says which"),
                (bare.replace("value = [1, 0, 1, 1]", 'value = [1, 0, 1, 1], from = "mask"') + mapped, 'write discard = "negative"'),
                (bare.replace("value = [1, 0, 1, 1]", 'value = [1, 0, 1, "1/4"], from = "mask"').replace("[[draw]]", negative) + mapped, "write 3/4 or more"),
                (bare.replace("[[draw]]", "[[draw]]\nmatrix = true"), "matrix needs a colour from elsewhere"),
                (bare.replace("value = [1, 0, 1, 1]", 'value = [1, 0, 1, 1], from = "constant"').replace(
                    "[[draw]]", '[[draw]]\nmatrix = true\nspace = "clip"').replace(
                        "[[0,0], [4,0], [0,8],  [8,8], [4,8], [8,0]]", '[[0,0,0,1], [1,0,0,1], [0,"0x1p-120",0,1]]'), "a product with 8 or 1/4 keeps"),
                (CASE.replace("size = [8, 8]", 'size = [8, 8]\nframe = "second"'), "without what counts hits"),
                (bare.replace('"rgba8-unorm"', '"rgba32-float"').replace("size = [8, 8]", 'size = [8, 8]\nframe = "sampled"'), "one rgba8-unorm"),
                (CASE.replace("size = [8, 8]", 'size = [8, 8]\nattachments = "depth"\nsamples = 4\nframe = "sampled"'), "of one sample"),
                (CASE.replace("size = [8, 8]", 'size = [8, 8]\nattachments = "stencil"'), "write stencil = true"),
                (COLOUR.replace("size = [8, 8]", 'size = [8, 8]\nattachments = "depth"'), "leaves no place for a colour")):
            self.assertIn(told, self.lint(words, 3), words)


if __name__ == "__main__":
    unittest.main()
