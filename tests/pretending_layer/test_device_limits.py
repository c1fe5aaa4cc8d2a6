# SPDX-FileCopyrightText: The Edgecase authors
# SPDX-License-Identifier: Apache-2.0
"""A layer claims limits in place of lavapipe's (EDGECASE_PRETENDED_LIMITS): what Vulkan does not allow is a finding of
the device, under the id device/limits, and what the reference cannot judge is said by the limit's name."""
import json
import os
import pathlib
import sys
import unittest

sys.path.append(str(pathlib.Path(__file__).parents[1] / "e2e"))
from support import CASE, ProgramTest  # noqa: E402

SOURCE = pathlib.Path(__file__).resolve().parents[2]
LAYER = os.environ.get("EDGECASE_PRETENDING_LAYER", str(SOURCE / "build" / "release" / "pretending_layer"))
ID = "device/limits"
TOO_FEW = "subPixelPrecisionBits=3"
HEAD = "# edgecase-expectations 2\n# device: *\n"


class DeviceLimits(ProgramTest):
    def claim(self, limits, *words, check=None, fault=""):
        env = {k: v for k, v in self.environment(fault).items() if not k.startswith("VK_")}
        env |= {"VK_LAYER_PATH": LAYER, "VK_INSTANCE_LAYERS": "VK_LAYER_EDGECASE_pretending",
                "EDGECASE_PRETENDED_LIMITS": limits}
        return self.edgecase(*words, env=env, check=check)

    def run_claiming(self, limits, *words, check=None, out=None, fault=""):
        return self.claim(limits, "run", "-o", out or self.out, *words, check=check, fault=fault)

    def found(self, out=None):
        """Status of the pseudo-case and (limit, required, claimed) of its findings."""
        case = {case["id"]: case for case in self.results(out)["cases"]}[ID]
        self.assertTrue(all((f["rule"], f["level"]) == ("device.limits", "vulkan") for f in case["findings"]), case)
        return case["status"], [(f["quantity"], f["expected"], f["got"]) for f in case["findings"]]

    def expect(self, text):
        path = self.folder / "known.txt"
        path.write_text(HEAD + text)
        return "--expect", path

    def test_a_right_device_is_not_told_of(self):
        done = self.run_claiming("", check=0)
        self.assertNotIn(ID, self.statuses())
        self.assertNotIn("judged as", done.stdout)

    def test_fewer_bits_than_4_are_a_finding_and_judged_as_4(self):
        for bits in ("0", "3"):
            done = self.run_claiming(f"subPixelPrecisionBits={bits}", "fam/c1", check=1)
            self.assertEqual(self.found(), ("fail", [("subPixelPrecisionBits", "at least 4", bits)]))
            self.assertEqual(self.statuses()["fam/c1"], "pass")
            self.assertIn(f"{bits} subpixel bits (judged as 4)", done.stdout)
            self.assertIn(f"FAIL {ID}   1 wrong value   device.limits [vulkan", done.stdout)
            self.assertIn(f"edgecase run {ID} --suite {self.suite}\n", done.stdout)
            self.assertIn("every case is judged as if the device had 4 bits", done.stdout)
            self.assertIn("subPixelPrecisionBits", (self.out / "junit.xml").read_text())
            self.assertIn("subPixelPrecisionBits", (self.out / "report.html").read_text())

    def test_explanations_are_of_the_bits_that_are_judged(self):
        done = self.run_claiming("subPixelPrecisionBits=0", "fam/c1", fault="flip-pixel@fam/c1", check=1)
        self.assertIn(f"explain fam/c1 --suite {self.suite} --subpixel-bits 4 --pixel", done.stdout)

    def test_several_limits_are_findings_of_one_case(self):
        self.run_claiming("subPixelPrecisionBits=0,framebufferColorSampleCounts=1", "fam/c1", check=1)
        self.assertEqual(self.found()[1], [("subPixelPrecisionBits", "at least 4", "0"),
                                           ("framebufferColorSampleCounts", "the bits 0x5", "0x1")])

    def test_more_bits_than_the_reference_has_are_named(self):
        self.run_claiming("subPixelPrecisionBits=99", check=6)
        cases = self.results()["cases"]
        self.assertEqual({(case["status"], case["reason"]) for case in cases},
                         {("unsupported", "the device snaps vertices to 2^-99 pixels (subPixelPrecisionBits), and the "
                                          "reference judges grids down to 2^-16")})
        self.assertNotIn(ID, self.statuses())  # Vulkan sets no upper bound

    def test_finer_viewports_than_the_reference_has_are_named(self):
        for name, x in (("on", "0.5"), ("off", "0.1")):
            self.write_case(f"fam/{name}", CASE.format(n=0).replace("[[draw]]\n", f"[[draw]]\nviewport = [{x}, 0, 8, 8]\n"))
        self.run_claiming("viewportSubPixelBits=99", "fam/on", "fam/off", "--profile", "vulkan", check=0)
        self.assertEqual(self.statuses(), {"fam/on": "pass", "fam/off": "unsupported"})
        self.assertIn("viewportSubPixelBits", {c["id"]: c for c in self.results()["cases"]}["fam/off"]["reason"])

    def test_ranges_that_are_no_numbers(self):
        self.run_claiming("viewportBoundsRange[0]=nan,viewportBoundsRange[1]=nan", "fam/c1", check=1)
        self.assertEqual(self.found(), ("fail", [("viewportBoundsRange[0]", "at most -32768", "nan"),
                                                 ("viewportBoundsRange[1]", "at least 32767", "nan")]))
        self.assertEqual(self.statuses()["fam/c1"], "unsupported")

    def test_a_range_without_end_is_large_enough(self):
        self.run_claiming("viewportBoundsRange[0]=-inf,viewportBoundsRange[1]=inf", "fam/c1", check=0)
        self.assertEqual(self.statuses(), {"fam/c1": "pass"})

    def test_targets_that_are_too_small(self):
        self.run_claiming("maxFramebufferWidth=100", "fam/c1", check=1)
        self.assertEqual(self.found(), ("fail", [("maxFramebufferWidth", "at least 4096", "100")]))

    def test_with_an_optional_feature(self):
        done = self.run_claiming("maxViewports=1", ID, check=1)
        self.assertEqual(self.found(), ("fail", [("maxViewports", "at least 16", "1")]))
        self.assertIn("Vulkan requires it of a device with the feature multiViewport", done.stdout)

    def test_no_limit_makes_the_program_die(self):
        for byte in ("0", "127", "255"):
            done = self.run_claiming(f"all={byte}", "--timeout", "20")
            self.assertIn(done.returncode, (1, 5), done.stdout + done.stderr)

    def test_other_variants_are_told(self):
        done = self.run_claiming("apiVersion=4294967295", "fam/c1", check=0)
        self.assertIn("Vulkan 127.1023.4095 (variant 7)", done.stdout)

    def test_an_expectation_excuses_it(self):
        words = self.expect(f"{ID}   fail   bug#1   value:device.limits@vulkan<=1   # Known.\n")
        self.run_claiming(TOO_FEW, "fam/c1", *words, check=0)
        self.assertEqual(self.statuses(), {ID: "xfail", "fam/c1": "pass"})
        self.run_claiming(TOO_FEW + ",maxViewports=1", "fam/c1", *words, check=1)
        self.assertEqual(self.found()[0], "fail")
        self.run_claiming("", "fam/c1", *words, check=1)
        self.assertEqual(self.statuses(), {ID: "xpass", "fam/c1": "pass"})
        done = self.claim("", "expect", "--update", self.out, words[1], check=0)
        self.assertIn("1 removed", done.stdout)
        self.assertNotIn(ID, words[1].read_text())

    def test_a_glob_names_no_right_device(self):
        self.run_claiming("", "fam/c1", *self.expect("**   flake   bug#1   # All.\n"), check=0)
        self.assertEqual(self.statuses(), {"fam/c1": "pass"})

    def test_a_skip_line(self):
        words = self.expect(f"{ID}   skip   bug#1   # Known.\n")
        self.run_claiming(TOO_FEW, "fam/c1", *words, check=0)
        self.assertEqual(self.statuses(), {ID: "skip", "fam/c1": "pass"})

    def test_update_adds_a_line(self):
        self.run_claiming(TOO_FEW, check=1)
        file = self.folder / "new.txt"
        self.claim(TOO_FEW, "expect", "--update", self.out, file, "--bug", "bug#1", check=0)
        self.assertIn(f"{ID}   fail   bug#1   value:device.limits@vulkan<=1", file.read_text())
        self.claim(TOO_FEW, "expect", file, check=0)
        self.run_claiming(TOO_FEW, "--expect", file, check=0)
        self.assertEqual(self.found()[0], "xfail")

    def test_it_is_a_selector(self):
        self.run_claiming("", ID, check=0)
        self.assertEqual(self.statuses(), {ID: "pass"})
        self.run_claiming("", ID, "fam/c1", check=0)
        self.assertEqual(self.statuses(), {ID: "pass", "fam/c1": "pass"})
        self.edgecase("run", ID, "--renderer", "reference", "-o", self.out, check=6)
        self.assertEqual(self.statuses(), {ID: "unsupported"})

    def test_failed_in(self):
        self.run_claiming(TOO_FEW, check=1)
        self.run_claiming(TOO_FEW, "--failed-in", self.out, out=self.folder / "again", check=1)
        self.assertEqual(self.statuses(self.folder / "again"), {ID: "fail"})
        self.run_claiming("", "--failed-in", self.out, out=self.folder / "mended", check=0)
        self.assertEqual(self.statuses(self.folder / "mended"), {ID: "pass"})

    def test_fail_fast(self):
        self.run_claiming(TOO_FEW, "--fail-fast", check=1)
        statuses = self.statuses()
        self.assertEqual(statuses.pop(ID), "fail")
        self.assertEqual(set(statuses.values()), {"skip"})

    def test_resume(self):
        self.run_claiming(TOO_FEW, check=1)
        journal = self.out / "journal.jsonl"
        lines = journal.read_text().splitlines(keepends=True)
        whole = self.statuses()
        for kept in (2, 3, 6):  # header and device; the limits' end; some cases
            journal.write_text("".join(lines[:kept]))
            self.claim(TOO_FEW, "run", "--resume", self.out, check=1)
            self.assertEqual(self.statuses(), whole, kept)
            self.assertEqual(self.found(), ("fail", [("subPixelPrecisionBits", "at least 4", "3")]))
            ends = [line for line in journal.read_text().splitlines() if json.loads(line).get("end", {}).get("id") == ID]
            self.assertLessEqual(len(ends), 1)

    def test_shards_tell_each_and_the_merged_report_once(self):
        for shard in ("1", "2"):
            self.run_claiming(TOO_FEW, "--shard", shard + "/2", out=self.folder / shard, check=1)
            self.assertEqual(self.found(self.folder / shard)[0], "fail")
        self.edgecase("report", "--merge", self.folder / "1", self.folder / "2", "-o", self.out, check=1)
        self.assertEqual([case["id"] for case in self.results()["cases"]], [ID, *self.ids])

    def test_compare(self):
        self.run_claiming("", out=self.folder / "right", check=0)
        self.run_claiming("maxViewports=1", check=1)
        done = self.edgecase("compare", self.folder / "right", self.out, check=1)
        self.assertIn("regressions: 1 case", done.stdout)
        done = self.edgecase("compare", self.out, self.folder / "right", check=0)
        self.assertIn("fixes: 1 case", done.stdout)

    def test_doctor(self):
        done = self.claim(TOO_FEW, "doctor", check=0)
        self.assertIn("3 subpixel bits (judged as 4)", done.stdout)
        self.assertIn("wrong limit: subPixelPrecisionBits is 3, and Vulkan requires at least 4 of every device\n", done.stdout)
        told = json.loads(self.claim(TOO_FEW, "doctor", "--json", check=0).stdout)["devices"][0]
        self.assertEqual(told["wrong_limits"], [{"name": "subPixelPrecisionBits", "claimed": "3", "required": "at least 4",
                                                 "of": "of every device"}])
        self.assertNotIn("wrong limit", self.claim("", "doctor", check=0).stdout)

    def test_runners_of_tests_hear_of_it(self):
        done = self.claim(TOO_FEW, "gtest", "--gtest_filter=edgecase.fam/c1", check=0)
        self.assertIn("warning: the device's subPixelPrecisionBits is 3, and Vulkan requires at least 4", done.stderr)
        self.assertNotIn(ID, done.stdout)

    def test_no_file_has_its_id_and_no_case_its_rule(self):
        self.write_case("fam/claims", CASE.format(n=0).replace('"cover.inside"', '"device.limits"'))
        self.assertIn("no case can claim it", self.edgecase("list", check=3).stderr)
        (self.suite / "fam" / "claims.toml").unlink()
        self.write_case(ID, CASE.format(n=0))
        self.assertIn("rename the file", self.edgecase("list", check=3).stderr)


if __name__ == "__main__":
    unittest.main()
