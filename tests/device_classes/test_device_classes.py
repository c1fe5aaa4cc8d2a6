# SPDX-FileCopyrightText: The Edgecase authors
# SPDX-License-Identifier: Apache-2.0
"""The program on lavapipe that looks like other devices. A machine without lavapipe fails these tests: they are never
skipped."""
import collections
import functools
import json
import pathlib
import shutil
import subprocess
import tempfile
import unittest

import device_classes
import devices_page
from shares import share_of

WIDE = {"r32-sfloat", "r32g32-sfloat", "r32g32b32a32-sfloat"}


class ClassTest(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="edgecase-class-"))
        self.addCleanup(shutil.rmtree, self.folder, ignore_errors=True)

    def statuses(self, device, selectors=()):
        code, results, printed = device_classes.run(device, self.folder, selectors)
        self.assertIsNotNone(results, printed)
        return results, {case["id"]: case["status"] for case in results["cases"]}, printed


class Layer(ClassTest):
    def test_what_the_class_lacks_is_asked_first(self):
        device = device_classes.read("nvidia")
        device["features"].remove("shaderClipDistance")
        results, statuses, printed = self.statuses(device, ["clip-distance/attributes:rotation=0", "coverage/half-square"])
        self.assertEqual(statuses["coverage/half-square"], "pass", printed)
        reasons = {case["reason"] for case in results["cases"] if case["status"] == "unsupported"}
        self.assertEqual(reasons, {"the device lacks the feature shaderClipDistance"})

    def test_what_is_used_without_being_advertised_ends_the_process(self):
        # What the program uses if it is told that it is there, but what the class does not have.
        for feature, selector in (("shaderClipDistance", "clip-distance/attributes:rotation=0"),
                                  ("depthClamp", "depth-clamp/bias:format=d32-float,slope=-8,near=0.25"),
                                  ("sampleRateShading", "multisample/shading-coverage:samples=4,shading=0.5"),
                                  ("geometryShader", "coverage/half-square")):
            with self.subTest(feature=feature):
                device = device_classes.read("nvidia")
                device["traps"] = [feature]
                code, results, printed = device_classes.run(device, self.folder, [selector])
                self.assertEqual(code, 1, printed)
                crashes = [case for case in results["cases"] if case["status"] == "crash"]
                self.assertNotEqual(crashes, [], printed)
                self.assertIn(f"the feature {feature} is used, which a device of the class 'NVIDIA' does not advertise",
                              crashes[0]["stderr"])

    def test_a_device_without_what_every_case_needs(self):
        # 16-bit floats have to be blended where wider ones are not.
        device = device_classes.read("nvidia")
        device["lacks"] = {name: ["blend"] for name in [*WIDE, "r16g16-sfloat", "r16g16b16a16-sfloat"]}
        code, _, printed = device_classes.run(device, self.folder, ["coverage/half-square"])
        self.assertEqual(code, 5, printed)
        self.assertIn("R16G16B16A16_SFLOAT as a blended colour attachment, which counts hits", printed)
        device = device_classes.read("nvidia")
        device["api"] = "1.0"
        code, _, printed = device_classes.run(device, self.folder, ["coverage/half-square"])
        self.assertEqual(code, 5, printed)
        self.assertIn("Vulkan 1.1 is needed, the device has 1.0", printed)

    def test_a_device_with_samples_of_its_own_is_asked_where_they_are(self):
        # lavapipe's are the standard ones, whatever the class promises of them.
        device = device_classes.read("v3dv-pi5")
        results, statuses, printed = self.statuses(device, ["multisample/large-triangle", "multisample/mesh"])
        self.assertEqual(results["device"]["sample_locations"], "6,2;14,6;2,10;10,14")
        self.assertIn("pass", statuses.values(), printed)
        self.assertLessEqual(set(statuses.values()), {"pass", "unsupported"}, printed)
        environment = device_classes.environment(device, self.folder) | {"EDGECASE_FAULT": "flip-pixel"}
        done = subprocess.run([device_classes.PROGRAM, "run", "multisample/large-triangle", "-o", self.folder / "faulty"],
                              env=environment, capture_output=True, text=True)
        self.assertEqual(done.returncode, 1, done.stdout + done.stderr)
        self.assertRegex(done.stdout, r"explain: \S+ explain \S+ .*--sample-locations '6,2;14,6;2,10;10,14'")
        device["features"].remove("sampleRateShading")
        results, statuses, printed = self.statuses(device, ["multisample/large-triangle"])
        self.assertEqual((results["device"]["sample_locations"], set(statuses.values())), ("", {"unsupported"}))
        self.assertIn("does not tell its own at sample count 4 by gl_SamplePosition", "".join(c["reason"] for c in results["cases"]))

    def test_a_reproducer_for_samples_of_its_own(self):
        device = device_classes.read("nvidia")
        device["limits"]["standardSampleLocations"] = 0
        environment = device_classes.environment(device, self.folder) | {"EDGECASE_SUITE": str(device_classes.SOURCE / "cases" / "suite")}
        case = "multisample/interior-square-4x:winding=given"

        def draw(*words):
            source, program = self.folder / "repro.c", self.folder / "repro"
            subprocess.run([device_classes.PROGRAM, "export", "--reproducer", case, "-o", source, *words], env=environment, check=True,
                           capture_output=True)
            subprocess.run(["cc", "-std=c99", source, "-lvulkan", "-lm", "-o", program], check=True)
            done = subprocess.run([program], env=environment, capture_output=True, text=True)
            return done.returncode, done.stdout + done.stderr

        code, printed = draw()
        self.assertEqual(code, 2, printed)
        self.assertIn("write it with --sample-locations for its own", printed)
        code, printed = draw("--sample-locations", "6,2;14,6;2,10;10,14")
        self.assertEqual(code, 0, printed)
        code, printed = draw("--sample-locations", "2,2;14,2;14,10;2,14")  # which they are not
        self.assertEqual(code, 1, printed)

    def test_a_wrong_class_stops_the_run(self):
        device = device_classes.read("nvidia")
        device["name"] = ""
        code, _, printed = device_classes.run(device, self.folder, ["coverage/half-square"])
        self.assertEqual(code, 5, printed)
        self.assertIn("EDGECASE_DEVICE_CLASS names no file", printed)


def share():
    """The share of the suite that each class draws, as --shard takes it: one of 16, another one as the suite grows. All
    of it takes 16 times as long: EDGECASE_SUITE_SHARE=1/1, for the night."""
    files = len(list((device_classes.SOURCE / "cases" / "suite").rglob("*.toml")))
    return share_of(16, files)


@functools.cache
def of_share(text):
    """What a run of the share says on the device of this JSON, once for all tests."""
    folder = pathlib.Path(tempfile.mkdtemp(prefix="edgecase-class-"))
    try:
        return device_classes.run(json.loads(text), folder, ["--shard", share()])
    finally:
        shutil.rmtree(folder, ignore_errors=True)


def agrees(with_all, status):
    """Whether a device that lacks something may end a case by this status that one which lacks nothing ends as `with_all`,
    an entry of results.json. It may lack what shows an expected failure: without gl_PrimitiveID nobody sees wrong ones, and
    what is wrong through doors alone passes if these are not drawn."""
    allowed = {with_all["status"]}
    if with_all["status"] == "xfail":
        allowed.add("xpass")
        if all(group["rule"].startswith("door.") for group in with_all["groups"]):
            allowed.add("pass")
    return status in allowed


class Suite(ClassTest):
    def statuses(self, device):
        _, results, printed = of_share(json.dumps(device))
        self.assertIsNotNone(results, printed)
        return results, {case["id"]: case["status"] for case in results["cases"]}, printed

    def test_hits_in_halves_are_the_same(self):
        # The same device but for blending of 32-bit floats, then with four attachments, so that many cases are drawn in
        # parts: wherever both run a case, every bit of the picture is the same.
        device = device_classes.read("nvidia")
        found, wide, _ = self.statuses(device)
        bits = {case["id"]: case["bits"] for case in found["cases"]}
        self.assertEqual(device_classes.doctor(device, self.folder)["hit_counting"], "binary32")
        device["lacks"] = {name: ["blend"] for name in WIDE}
        for attachments in (8, 4):
            device["limits"]["maxColorAttachments"] = attachments
            found, halves, printed = self.statuses(device)
            self.assertEqual(device_classes.doctor(device, self.folder)["hit_counting"], "binary16")
            both = [case for case in wide if "unsupported" not in (wide[case], halves[case])]
            shares = int(share().split("/")[1])
            self.assertGreater(len(both), 2800 // shares, printed)
            self.assertEqual({case: (wide[case], halves[case]) for case in both if wide[case] != halves[case]}, {})
            other = {case["id"]: case["bits"] for case in found["cases"]}
            self.assertEqual([case for case in both if bits[case] != other[case]], [])

    def test_render_passes_and_pipelines_that_hold_their_state_draw_the_same(self):
        # The same device of Vulkan 1.1, where a geometry shader names layers and viewports, without dynamic rendering and
        # dynamic state: wherever it runs a case, it says what it says with them. Classes that lack one of them are drawn below.
        lacking = {"shaderOutputLayer", "shaderOutputViewportIndex", "dynamicRendering", "extendedDynamicState",
                   "extendedDynamicState2", "VK_KHR_dynamic_rendering", "VK_EXT_extended_dynamic_state",
                   "VK_EXT_extended_dynamic_state2"}
        device = device_classes.read("nvidia")
        results, usual, _ = self.statuses(device)
        whole = {c["id"]: c for c in results["cases"]}
        device["api"] = "1.1"
        for names in ("features", "extensions"):
            device[names] = [name for name in device[names] if name not in lacking]
        device["extensions"] += ["VK_KHR_create_renderpass2", "VK_KHR_depth_stencil_resolve"]
        told = device_classes.doctor(device, self.folder)
        self.assertEqual((told["has_dynamic_rendering"], told["has_dynamic_state"]), (False, False))
        _, found, printed = self.statuses(device)
        both = [case for case in usual if "unsupported" not in (usual[case], found[case])]
        self.assertGreater(len(both), 2800 // int(share().split("/")[1]), printed)
        differ = {case: (usual[case], found[case]) for case in both if not agrees(whole[case], found[case])}
        self.assertEqual(differ, {})

    def test_no_class_fails_what_lavapipe_does_not(self):
        plain = {c["id"]: c for c in self.statuses(None)[0]["cases"]}
        for name in device_classes.names():
            device = device_classes.read(name)
            _, results, printed = of_share(json.dumps(device))
            with self.subTest(device=name):
                if results is not None:
                    worse = [c["id"] for c in results["cases"]
                             if c["status"] != "unsupported" and not agrees(plain[c["id"]], c["status"])]
                    self.assertEqual(worse, [], printed)
                else:
                    self.assertEqual(device.get("reaches", device["aim"]), 100, printed)

    def test_the_page_is_what_doctor_says(self):
        found = {name: devices_page.measure(name) for name in device_classes.names()}
        for name, facts in found.items():
            device = device_classes.read(name)
            if facts["unsupported"] is not None:
                self.assertLessEqual(100 * facts["unsupported"], device.get("reaches", device["aim"]) * facts["all"], name)
        page = (device_classes.SOURCE / "docs" / "devices.md").read_text(encoding="utf-8")
        self.assertEqual(page, devices_page.page(found), "write it anew: cmake --build --preset release --target devices_page")

    def test_doctor_says_what_runs_say(self):
        """Of families that want much of a device, doors among them, case by case counted by reason."""
        suite = self.folder / "suite"
        for family in ("clip-distance", "combination", "depth-bias", "door", "layer", "multisample", "store"):
            shutil.copytree(device_classes.SOURCE / "cases" / "suite" / family, suite / family)
        for name in ("kosmickrisp", "v3dv-pi5"):
            device = device_classes.read(name)
            with self.subTest(device=name):
                told = device_classes.doctor(device, self.folder, suite)["suite"]
                _, results, printed = device_classes.run(device, self.folder, ["--no-expect"], suite)
                # What is learned only by reading a drawn D24 back, doctor cannot know.
                lacking = collections.Counter(c["reason"] for c in results["cases"] if c["status"] == "unsupported"
                                              and not c["reason"].startswith("a shader of the device reads "))
                self.assertGreater(len(lacking), 4, printed)
                self.assertEqual({r["reason"]: r["cases"] for r in told["lacking"]}, dict(lacking))
                self.assertEqual(told["cases"], len(results["cases"]))


if __name__ == "__main__":
    unittest.main()
