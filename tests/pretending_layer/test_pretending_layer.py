# SPDX-FileCopyrightText: The Edgecase authors
# SPDX-License-Identifier: Apache-2.0
"""No driver here has VK_EXT_conservative_rasterization and VK_KHR_fragment_shading_rate. A layer pretends that lavapipe
has them: the program asks for their limits, enables them and makes pipelines with them, and judges what lavapipe draws,
which covers by samples as ever, and whose fragments have one pixel."""
import json
import os
import pathlib
import subprocess
import tempfile
import unittest

SOURCE = pathlib.Path(__file__).resolve().parents[2]
PROGRAM = os.environ.get("EDGECASE_PROGRAM", str(SOURCE / "build" / "release" / "bin" / "edgecase"))
LAYER = os.environ.get("EDGECASE_PRETENDING_LAYER", str(SOURCE / "build" / "release" / "pretending_layer"))


class PretendingLayer(unittest.TestCase):
    def run_cases(self, *selectors, pretends=True):
        """Status and reason or rule of each case, and what pipelines asked for."""
        with tempfile.TemporaryDirectory(prefix="edgecase-pretended-") as folder:
            env = {k: v for k, v in os.environ.items() if not k.startswith(("EDGECASE_", "VK_"))}
            env["EDGECASE_SUITE"] = str(SOURCE / "cases" / "suite")
            log = pathlib.Path(folder, "asked")
            if pretends:
                env |= {"VK_LAYER_PATH": LAYER, "VK_INSTANCE_LAYERS": "VK_LAYER_EDGECASE_pretending",
                        "EDGECASE_PRETENDED": str(log)}
            out = pathlib.Path(folder, "out")
            done = subprocess.run([PROGRAM, "run", *selectors, "-o", str(out)], env=env, capture_output=True, text=True)
            self.assertIn(done.returncode, (0, 1, 6), done.stdout + done.stderr)
            results = json.loads((out / "results.json").read_text())
            asked = set(log.read_text().splitlines()) if log.exists() else set()
            return {case["id"]: case for case in results["cases"]}, asked

    def test_without_the_extension_cases_are_unsupported(self):
        cases, _ = self.run_cases("conservative/overestimate", pretends=False)
        case = cases["conservative/overestimate"]
        self.assertEqual((case["status"], case["reason"]),
                         ("unsupported", "the device lacks VK_EXT_conservative_rasterization"))

    def test_a_driver_that_ignores_the_state_fails(self):
        cases, asked = self.run_cases("conservative/overestimate", "conservative/underestimate", "coverage/half-square")
        self.assertEqual(asked, {"overestimate 0", "underestimate 0"})
        self.assertEqual(cases["coverage/half-square"]["status"], "pass")
        for name in ("overestimate", "underestimate"):
            case = cases["conservative/" + name]
            self.assertEqual(case["status"], "fail", case)
            self.assertIn("conservative." + name, json.dumps(case))

    def test_limits_are_asked(self):
        cases, asked = self.run_cases("conservative/extra", "conservative/degenerate")
        self.assertEqual(asked, {"overestimate 0", "overestimate 0.25"})
        for name, case in cases.items():
            if "extra=0.75" in name:
                self.assertEqual((case["status"], case["reason"]),
                                 ("unsupported", "the draw enlarges its triangles by 0.75 pixels, the device allows 0.5 "
                                                 "(maxExtraPrimitiveOverestimationSize)"))
            elif "conservative/extra" in name:
                self.assertEqual(case["status"], "fail", case)
            else:  # the layer says that triangles without area are culled, and so does lavapipe
                self.assertEqual(case["status"], "pass", case)

    def test_fragment_sizes_are_asked(self):
        cases, asked = self.run_cases("fragment-size/shared-edge", "fragment-size/stencil", "fragment-size/mask-in")
        self.assertEqual(asked, {"size 2 1", "size 2 2"})
        for name, case in cases.items():
            if "wide=4" in name and "mask-in" not in name:
                sides = "4 x 1" if "high=1" in name else "4 x 2"
                self.assertEqual((case["status"], case["reason"]),
                                 ("unsupported",
                                  f"the device has no fragments of {sides} pixels at sample count 1"))
            elif "mask-in" in name:
                self.assertEqual(case["status"], "unsupported", case)
            else:
                self.assertEqual(case["status"], "fail", case)
                self.assertIn("fragment-size.area", json.dumps(case))

    def test_without_the_feature_sizes_are_unsupported(self):
        cases, _ = self.run_cases("fragment-size/shared-edge", pretends=False)
        self.assertEqual({(case["status"], case["reason"]) for case in cases.values()},
                         {("unsupported", "the device lacks the feature pipelineFragmentShadingRate "
                                          "(VK_KHR_fragment_shading_rate)")})


if __name__ == "__main__":
    unittest.main()
