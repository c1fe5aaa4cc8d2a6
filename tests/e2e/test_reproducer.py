# SPDX-FileCopyrightText: The Edgecase authors
# SPDX-License-Identifier: Apache-2.0
"""Cases as C programs for bug reports: compiled as strictly as can be, and run on the system's lavapipe (Mesa 22.3)."""
import re
import subprocess

from support import SOURCE, ProgramTest

HEAD = """format = 1
description = "One triangle over a corner."
rules = ["cover.inside"]
[target]
size = [8, 8]
{target}
"""
DRAW = """[[draw]]
{draw}
vertices = [[0,0], [8,0], [0,8]]
"""


class Reproducer(ProgramTest):
    def setUp(self):
        super().setUp()
        self.program = self.folder / "repro.c"

    def export(self, case_id, *words, check=0):
        return self.edgecase("export", "--reproducer", case_id, "-o", self.program, *words, check=check)

    def draw(self, check):
        """Compiles and runs the program; its output."""
        built = self.folder / "repro"
        subprocess.run(["cc", "-std=c99", "-Wall", "-Wextra", "-Werror", "-pedantic", self.program, "-lvulkan", "-lm", "-o", built],
                       check=True, timeout=100)
        done = subprocess.run([built], env=self.environment(), capture_output=True, text=True, timeout=100, check=False)
        self.assertEqual(done.returncode, check, done.stdout + done.stderr)
        return done.stdout + done.stderr

    def of_suite(self):
        self.suite = SOURCE / "cases" / "suite"

    def write(self, target="", draw="", case_id="fam/one"):
        self.write_case(case_id, HEAD.format(target=target) + DRAW.format(draw=draw))
        return case_id


class Wrong(Reproducer):
    def test_known_defects(self):
        """Coverage, hits of both kinds, depth, attributes, colours with and without instruments, sample shading, what
        functions make of inputs, other drawings of a case: the samples are those that a run tells."""
        self.of_suite()
        cases = ["multisample/mask-one-sample:mask=4294967294", "multisample/centroid-scissor:samples=4",
                 "clip/noperspective:swap=0,lean=0", "depth-bias/clipped-exponent:rotation=90,first=2",
                 "store/unorm-ramp:format=r5g6b5-unorm,attachments=color", "combination/stored-beside-blended:format=r5g6b5-unorm",
                 "combination/interpolated-colours:format=rgba32-float,attachments=color,samples=1,topology=triangle-fan,"
                 "mode=noperspective,beyond=20",
                 "combination/interpolated-colours:format=rgba8-unorm,attachments=all,samples=4,topology=triangle-strip,"
                 "mode=noperspective,beyond=20",
                 "multisample/places:samples=4,far=1", "multisample/shading-inputs:samples=4", "interpolate-at/centroid-4x",
                 "interpolate-at/offset-4x:auxiliary=none", "tiled/multisample:class=sliver,tile=3",
                 "combination/sampled-states:topology=triangle-strip,auxiliary=sample,depth=d32-float,cull=none,mode=smooth,"
                 "beyond=20,provoking=last,volume=zero-to-one,slope=0,clamp=true", "clip/once-eye", "layer/scissor:samples=4",
                 "tiled/multisample:class=on-grid,tile=3"]
        self.edgecase("run", "--no-expect", "--no-diagnosis", "-q", "-o", self.out, *cases, check=1)
        told = {c["id"]: c for c in self.results()["cases"]}
        for case_id in cases:
            with self.subTest(case_id):
                self.export(case_id)
                text = self.draw(check=1)
                found = {tuple(map(int, m)) for m in re.findall(r"^(?:layer \d+ )?pixel \((\d+), (\d+)\) sample (\d+): ", text, re.M)}
                wrong = {(f["sample"]["x"], f["sample"]["y"], f["sample"]["index"]) for f in told[case_id]["findings"]}
                # A run counts the samples of other drawings, but does not keep which they are beyond the first.
                count = told[case_id].get("wrong_samples") or sum(told[case_id]["counts"].values())
                self.assertGreater(len(wrong), 0)
                if count <= 100:
                    self.assertLessEqual(wrong, found)  # of a cause, results.json has the first findings
                self.assertIn(f"\n{count} of ", text)

    def test_lines_are_capped_and_the_rest_counted(self):
        self.write_case("fam/wide", HEAD.format(target="").replace("[8, 8]", "[32, 32]") +
                        "[[draw]]\nvertices = [[0,0], [32,0], [0,32],  [32,0], [32,32], [0,32]]\n")
        self.export("fam/wide")
        text = self.program.read_text()
        bounds = re.search(r"kBounds\[\] = \{\n    \{(.*)\},\n", text)
        self.program.write_text(text.replace(bounds[1], "0, 0, 0, 0, 0, 0, 0, 0"))
        shown = self.draw(check=1)
        self.assertEqual(len(re.findall("^pixel ", shown, re.M)), 100)
        self.assertIn("... and 924 more\n1024 of 1024 samples are wrong\n", shown)

    def test_each_expected_number_counts(self):
        """Every table of what is right: an edited number is seen."""
        self.write_case("fam/one", HEAD.format(target="") +
                        "[[draw]]\nvertices = [[0,0,0.5], [8,0,0.5], [0,8,0.5]]\n"
                        '[[draw.attribute]]\nvalues = [1, 2, 4]\n[[draw.attribute]]\nvalues = [5, 6, 7]\ninterpolation = "flat"\n')
        self.export("fam/one")
        text = self.program.read_text()
        self.draw(check=0)
        ranges = re.search(r"kRanges\[\] = \{\n(.*?)\n\};", text, re.S)[1]
        first = re.findall(r"\{[^{}]*\}", ranges.splitlines()[0])
        self.assertEqual(len(first), 3 + 4 + 4)
        for k, name in ((0, "FragCoord.z"), (1, "FragCoord.w"), (2, "depth"), (3, "attribute 0.x"), (7, "attribute 1.x")):
            with self.subTest(name):
                edited = first[:k] + ["{7.0F, 7.0F}"] + first[k + 1:]
                self.program.write_text(text.replace(ranges.splitlines()[0], "    " + ", ".join(edited) + ", "))
                self.assertIn(f": {name}: expected 7 to 7, got ", self.draw(check=1))
        writer = re.search(r"kWriters\[\] = \{\n    \{0, 0,", text)[0]
        self.program.write_text(text.replace(writer, writer.replace("{0, 0,", "{0, 1,")))
        self.assertIn("last triangle: expected draw 0 vertex 1, got draw 0 vertex 0", self.draw(check=1))

    def test_each_code_of_a_colour_counts(self):
        color = '\ncolor = {{ format = "{}", clear = [0.2, 0.4, 0.6, 0.8] }}'
        blend = 'color = { value = [0.5, 0.25, 0.75, 1], blend = "alpha" }'
        for attachments in ("all", "color"):
            with self.subTest(attachments):
                self.write(color.format("rgba8-unorm") + f'\nattachments = "{attachments}"', blend)
                self.export("fam/one")
                self.draw(check=0)
                text = self.program.read_text()
                table = re.search(r"kColors\[\] = \{\n(.*?)\n\};", text, re.S)[1]
                numbers = re.findall(r"\{\d+, \d+, \d+, \d+, \{(.*?)\}, \{(.*?)\}\},", table)
                self.assertGreaterEqual(len(numbers), 2)  # drawn, and clear
                for k in range(4):
                    wrong = table
                    for low, high in numbers:
                        moved = [str(int(v) + (5 if n == k else 0)) for n, v in enumerate(low.split(", "))]
                        wrong = wrong.replace(f"{{{low}}}, {{{high}}}", f"{{{', '.join(moved)}}}, {{300, 300, 300, 300}}")
                    self.program.write_text(text.replace(table, wrong))
                    shown = self.draw(check=1)
                    self.assertIn(": colour: expected codes ", shown)
                    self.assertIn("\n64 of 64 samples are wrong", shown)

    def test_what_a_colour_holds_of_an_attribute_is_held_to_that_number(self):
        """With instruments the device's own number decides, without its range."""
        self.write('\ncolor = { format = "rgba16-float", clear = [0, 0, 0, 0] }', 'color = { attribute = "a" }')
        with (self.suite / "fam/one.toml").open("a") as file:
            file.write('[[draw.attribute]]\nname = "a"\nvalues = [[0.1, 0.3, 0, 1], [0.7, 0.2, 0, 1], [0.4, 0.9, 0, 1]]\n')
        self.export("fam/one")
        text = self.program.read_text()
        self.assertRegex(text, r"kColors\[\] = \{\n(.*\n)*?    \{1, 0, 0, 1, ")
        self.draw(check=0)
        self.program.write_text(text.replace("captured[n] = number(", "captured[n] = 1.01F * number("))
        self.assertIn(": colour: ", self.draw(check=1))

    def test_places_of_samples_count(self):
        self.of_suite()
        self.export("multisample/shading-inputs:samples=4")
        text = self.program.read_text()
        self.program.write_text(re.sub(r"(kPlaces\[SAMPLES\]\[2\] = )\{.*\}", r"\1{{1, 1}, {1, 1}, {1, 1}, {1, 1}}", text))
        self.assertIn(": FragCoord.xy: expected a sample of the fragment", self.draw(check=1))

    def test_other_drawings_count(self):
        """Tiles that overlap draw samples twice; what is cleared to is told apart from what is drawn."""
        self.of_suite()
        for case_id, edits, shown in (
                ("tiled/order:tile=2", [("x += drawing->tile[0]", "x += drawing->tile[0] - 1")], "scissor-tiles 2x2: attachment "),
                ("repeat/clears-and-masks:class=on-grid", [("= clear_number(drawing, plane);", "= clear_number(drawing, plane) + (drawing->other_clears ? 16.0F : 0);")], "other-clears: attachment 0 word "),
                ("repeat/clears-and-masks:class=on-grid", [("colorWriteMask = is_masked(drawing, k) ? 0 : 0xf", "colorWriteMask = 0xf")], "write-masks, every other attachment: attachment "),
        ):
            with self.subTest(case_id):
                self.export(case_id)
                text = self.program.read_text()
                self.draw(check=0)
                for before, after in edits:
                    self.assertIn(before, text)
                    text = text.replace(before, after)
                self.program.write_text(text)
                self.assertIn(": " + shown, self.draw(check=1))

    def test_what_was_left_is_checked_where_nothing_hits(self):
        self.write()
        self.export("fam/one")
        text = self.program.read_text()
        self.program.write_text(re.sub(r"(#define DEPTH_CLEAR_(LOW|HIGH)) .*", r"\1 0.75F", text))
        self.assertIn("no hit, but something was written", self.draw(check=1))


class Right(Reproducer):
    def test_cases_of_many_kinds(self):
        self.of_suite()
        for case_id in ("ties/apex-up", "coverage/half-square", "shared-edge/indexed", "topology/long-strip:cull=back", "mesh/fan-on-centre",
                        "topology/restart-parity", "scissor/half-open", "viewport/changes", "clip-distance/constant:d=-1",
                        "cull-distance/several:k=-1", "facing/fan:cull=back", "depth/ends:format=d24-unorm,z=0",
                        "depth/samples:format=d32-float,samples=4", "depth-test/compare:format=d32-float,compare=less,z=0.25",
                        "depth-test/clipped:format=d16-unorm,order=given", "depth-bias/clamp:clamp=-1/32,slope=-1,constant=32768",
                        "multisample/centroid-inside:samples=4,seed=1", "attributes/components", "attributes/constant-third",
                        "order/draws", "bad-numbers/strip:part=3,bad=inf", "discard/among-draws:samples=1,topology=triangle-list", "complement/facing:winding=given,flip=1",
                        "blend/presets:blend=alpha,format=rgba8-unorm", "repeat/clip-distances:class=off-grid", "provoking/fan",
                        "depth-clamp/clip-and-clamp:clip=true,near=0", "depth-clip/symmetric:w=1", "lod/perspective:w=4", "multisample/mask-in:samples=1", "store/srgb:attachments=all",
                        "store/integers:format=rgba8-uint,attachments=all",
                        "repeat/color:format=rgba8-unorm,class=on-grid", "layer/outside:samples=1,width=1,height=5",
                        "derivative/helper-lanes:x=1,y=1,probe=fwidth", "derivative/helper-lanes:x=0,y=7,probe=dfdy-coarse"):
            with self.subTest(case_id):
                self.export(case_id)
                self.assertIn("\n0 of ", self.draw(check=0))

    def test_profile_and_subpixel_bits(self):
        self.write()
        self.export("fam/one", "--profile", "vulkan", "--subpixel-bits", "4")
        self.assertIn("the device has 8 subpixel bits and this program was written for 4; write it with --subpixel-bits 8",
                      self.draw(check=2))
        self.export("fam/one", "--profile", "vulkan")
        self.assertIn("judged at profile vulkan with 8 subpixel bits", self.draw(check=0))
        for words in (("--profile", "vulkan"), ("--subpixel-bits", "8")):
            done = self.edgecase("export", "fam/one", "-o", self.folder / "x", *words, check=2)
            self.assertIn(f"{words[0]} requires --reproducer", done.stderr)

    def test_no_such_device(self):
        self.export(self.write())
        self.draw(check=0)
        done = subprocess.run([self.folder / "repro", "no such device"], env=self.environment(), capture_output=True,
                              text=True, timeout=100, check=False)
        self.assertEqual((done.returncode, done.stderr), (2, "set-up failed: there is no such Vulkan device (0)\n"))

    def test_text_of_a_stranger_stays_a_comment(self):
        text = HEAD.format(target="") + DRAW.format(draw="")
        self.write_case("fam/one", text.replace('"One triangle over a corner."', '\'a \\ "b" */ ??/ \\\''))
        self.export("fam/one")
        self.draw(check=0)


class Refused(Reproducer):
    def test_each_feature_has_a_name(self):
        self.of_suite()
        for case_id, name in {
                "blit/mirrored:sx=1,sy=1,dx=0,dy=1": "a blit",
                "door/indirect-after-count": "doors",
                "stencil/depth-fail:samples=1,compare=less": "a stencil",
                "combination/sampled-states:topology=triangle-fan,auxiliary=sample,depth=d24-unorm,cull=back,mode=smooth,beyond=0,"
                "provoking=first,volume=zero-to-one,slope=0,clamp=false": "several samples of D24",
                "resolve/depth:mode=sample-zero,samples=2": "a resolve",
                "clear/whole:attachments=all,samples=1": "a clear among the draws",
                "load/depth:format=d32-float,samples=1,attachments=all": "load and store operations",
                "multisample/locations-mesh:seed=1": "sample locations of its own",
                "viewport/several:a=0,last=4": "several viewports",
                "color-targets/clamped:shown=1": "several colour targets",
                "depth-bias/exact:format=d24-unorm,constant=4096,slope=2": "a bias by VK_EXT_depth_bias_control",
                "bad-numbers/attribute:interpolation=flat,first=0,bad=nan": "a flat attribute that is no finite number",
        }.items():
            with self.subTest(name):
                done = self.export(case_id, check=2)
                self.assertEqual(done.stderr, f"edgecase: the case '{case_id}' has {name}, which a reproducer cannot draw; send "
                                 "the case file with the output of 'edgecase run' instead\n")
                self.assertFalse(self.program.exists())
