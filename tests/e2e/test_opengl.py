# SPDX-FileCopyrightText: The Edgecase authors
# SPDX-License-Identifier: Apache-2.0
"""docs/examples/opengl: cases that OpenGL draws with llvmpipe and softpipe, judged end to end."""
import os
import subprocess
import unittest

from support import PROGRAM, SOURCE, ProgramTest

OPENGL = os.environ.get("EDGECASE_OPENGL", "")
# What an adaptor can get wrong: ties, windows, faces, depths, stencils, samples, outputs, each of its words.
SELECTORS = ["attributes/**", "ties/**", "facing/**", "provoking/**", "viewport/**", "depth-clamp/**",
             "depth-test/**", "stencil/**", "blend/**", "layer/**", "clip-distance/**", "cull-distance/**",
             "interpolate-at/**", "blit/**", "store/**", "topology/restart*", "logic/passed", "scissor/rectangles",
             "!**:*samples=8*", "!**:*samples=2*", "!**:*samples=16*"]


class Judged(ProgramTest):
    def setUp(self):
        super().setUp()
        if not OPENGL:
            self.skipTest("built without EGL or OpenGL (libegl-dev, libopengl-dev, libgl-dev), or under a sanitizer")

    def judge(self, driver, *words, env=None, opengl=OPENGL):
        variables = {**self.environment(), "EDGECASE_PROGRAM": PROGRAM, "EDGECASE_OPENGL": str(opengl), **(env or {})}
        del variables["EDGECASE_SUITE"]
        return subprocess.run([SOURCE / "scripts" / "judge-opengl", driver, *words, f"--output={self.out}"], env=variables,
                              cwd=self.folder, capture_output=True, text=True, timeout=240, check=False)

    def passes(self, driver, selectors):
        done = self.judge(driver, *selectors)
        if done.returncode == 5:
            self.skipTest(done.stderr.strip())
        self.assertIn(done.returncode, (0, 1), done.stdout + done.stderr)
        if "Mesa 22.3" not in done.stdout:
            self.skipTest(f"cases/expectations knows what OpenGL of Mesa 22.3 gets wrong, and this is {done.stdout.splitlines()[1]}")
        self.assertEqual(done.returncode, 0, done.stdout[-3000:] + done.stderr)
        cases = self.results(self.out / "report")["cases"]
        return {c["id"]: c for c in cases}, done.stdout

    def count(self, cases, status):
        return sum(c["status"] == status for c in cases.values())

    def test_softpipe(self):
        cases, said = self.passes("softpipe", SELECTORS)
        self.assertGreater(self.count(cases, "pass"), 500)
        self.assertGreater(self.count(cases, "xfail"), 60)
        self.assertEqual(cases["depth-clamp/perspective:w=1"]["status"], "xfail")
        # All planes are there, and what is left out is told by its reason.
        self.assertEqual([c["reason"] for c in cases.values() if c["id"] == "attributes/components"], [""])
        self.assertRegex(said, r"\d+ left out: the driver has one sample a pixel\n")

    def test_llvmpipe(self):
        cases, _ = self.passes("llvmpipe", ["attributes/components", "layer/**", "multisample/**:samples=4*", "depth/samples:*",
                                            "scissor/rectangles:x=65536,*", "discard/fragments:*", "store/half-overflow"])
        self.assertGreater(self.count(cases, "pass"), 50)
        self.assertGreater(self.count(cases, "xfail"), 30)
        self.assertTrue(any("samples=4" in i and c["status"] == "pass" for i, c in cases.items()))

    def test_half_a_pixel_off(self):
        wrong = self.folder / "wrong"
        wrong.write_text(f'#!/bin/sh\nexec "{OPENGL}" "$@" --half-pixel\n')
        wrong.chmod(0o755)
        done = self.judge("softpipe", "ties/**", opengl=wrong)
        if done.returncode == 5:
            self.skipTest(done.stderr.strip())
        self.assertEqual(done.returncode, 1, done.stdout + done.stderr)
        statuses = list(self.statuses(self.out / "report").values())
        self.assertGreater(statuses.count("fail"), len(statuses) / 2)

    def test_without_egl(self):
        done = self.judge("softpipe", "ties/**", env={"__EGL_VENDOR_LIBRARY_DIRS": str(self.folder)})
        self.assertEqual(done.returncode, 5)
        self.assertEqual(done.stderr, "error: EGL has neither a surfaceless platform nor a device: install libegl1, "
                         "libegl-mesa0 and libgl1-mesa-dri, or the EGL of your driver\n")

    def test_wrong_words(self):
        for words in (["only-one"], ["a", "b", "--half"], ["a", "b", "c"]):
            done = subprocess.run([OPENGL, *words], capture_output=True, text=True, check=False)
            self.assertEqual(done.returncode, 2)
            self.assertTrue(done.stderr.startswith("usage: opengl EXPORT CAPTURES"))
        done = subprocess.run([OPENGL, self.folder / "none", self.folder / "to"], capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 1)
        self.assertEqual(done.stderr.count("\n"), 1)


if __name__ == "__main__":
    unittest.main()
