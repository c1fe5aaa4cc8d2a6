# SPDX-FileCopyrightText: The Edgecase authors
# SPDX-License-Identifier: Apache-2.0
"""The suite itself, on lavapipe: it has to pass at every profile, silently under the validation layer, and a
broken picture has to fail it. A machine without lavapipe fails these tests: they are never skipped."""
import os
import shutil
import unittest

import support
from shares import share_of
from support import ProgramTest


class Suite(ProgramTest):
    def environment(self, fault=""):
        env = super().environment(fault)
        env["EDGECASE_SUITE"] = str(support.SOURCE / "cases" / "suite")
        return env

    def run_lavapipe(self, *words, fault="", check=None):
        return self.edgecase("run", "-o", self.out, "--device", "llvmpipe", *words, fault=fault, check=check)

    def share(self, parts):
        """As --shard takes it: one of these parts, another one as the suite grows. By night all of it (.ci/nightly)."""
        count = len(self.edgecase("list", "--ids", check=0).stdout.splitlines())
        return share_of(parts, count)

    def of_share(self, profile, share, *words):
        cases = self.of_profile(profile, "--shard", share, *words)
        self.assertGreater(len(cases) * int(share.split("/")[1]), 4000)
        return cases

    def of_profile(self, profile, *words):
        """Runs the suite and checks what holds at every profile; its cases by their ids."""
        self.run_lavapipe("--profile", profile, *words, check=0)
        return self.checked(profile, self.results())

    def checked(self, profile, results):
        self.assertEqual(results["totals"]["cases"], results["totals"]["pass"] + results["totals"]["xfail"] + results["totals"]["unsupported"])
        self.assertGreaterEqual(results["totals"]["cases"], 200)
        self.assertLessEqual(results["totals"]["xfail"], 233)  # each told in cases/expectations
        self.assertLess(results["worst"]["ratio"], 2)
        # What is left free must stay the exception: a suite of "either" would judge nothing.
        # Triangles with bad numbers are free by their nature.
        judged = [case for case in results["cases"] if case["status"] != "unsupported"]
        bounded = [case for case in judged if not case["id"].startswith("bad-numbers/")]
        free = sum(case["either_samples"] for case in bounded)
        samples = sum(case["compared_samples"] for case in bounded)
        self.assertLess(free, samples / {"vulkan": 20, "practice": 100, "direct3d": 500}[profile])
        for case in judged:
            self.assertGreater(case["must_samples"], 0, case["id"])
        return {case["id"]: case for case in results["cases"]}

    def test_profile_vulkan(self):
        """What passes at direct3d, at which all of it is drawn below, passes here: an eighth shows that."""
        self.of_share("vulkan", self.share(8))

    def test_silent_under_the_validation_layer(self):
        """At profile practice, at which it passes like that, too."""
        cases = self.of_share("practice", self.share(3), "--validation")
        self.assertEqual({i: case["messages"] for i, case in cases.items() if case["messages"]}, {})

    def test_profile_direct3d_where_two_workers_agree_with_one(self):
        def told(c):
            return (c["id"], c["status"], c["counts"], c["either_samples"], c["worst_ratio"])

        shutil.rmtree(self.folder / "cases")  # which would be found first
        env = {k: v for k, v in self.environment().items() if k != "EDGECASE_SUITE"}
        self.edgecase("run", "-j", "2", "--device", "llvmpipe", "-o", self.out, env=env, check=0)
        results = self.results()
        two = self.checked("direct3d", results)
        self.check_default_doors(results, env)
        share = self.share(4)
        self.run_lavapipe("-j", "1", "--shard", share, check=0)
        one = self.results()["cases"]
        self.assertGreater(len(one) * int(share.split("/")[1]), 4000)
        # What the other run drew through doors may be wrong there.
        alike = [c for c in one if "--doors" not in two[c["id"]]["rerun"] and not any(g.get("door") for g in two[c["id"]]["groups"])]
        self.assertGreater(len(alike), len(one) / 2)
        self.assertEqual([told(c) for c in alike], [told(two[c["id"]]) for c in alike])

    def check_default_doors(self, results, env):
        """Whoever draws the whole suite that comes with the program draws each door with each family."""
        pictures = {d["door"]: d["pictures"] for d in results["doors"]}
        self.assertEqual(len(pictures), self.edgecase("doors", check=0).stdout.count("; rule: "))
        self.assertGreater(sum(pictures.values()), 1500)
        # lavapipe has shader objects since Mesa 25.
        lacking = {d["door"] for d in results["doors"] if d["pictures"] == 0 and d["reason"].startswith("the device lacks ")}
        self.assertLessEqual(lacking, {"shader-objects", "mesh-shader"})
        broken = {d["door"] for d in results["doors"] if d["pictures"] == 0 and d.get("skipped_by")}
        self.assertLessEqual(broken, {"query-first", "transform-feedback"})  # of 22.3 and 25, of 25 and 26
        self.assertEqual({door for door, count in pictures.items() if count == 0}, lacking | broken)
        # A failure of the plain picture is drawn again without them.
        known = [c for c in results["cases"] if c["status"] == "xfail" and not any(g.get("door") for g in c["groups"])]
        self.assertGreater(len(known), 50)
        self.assertEqual([c["rerun"] for c in known if "--doors" in c["rerun"]], [])
        # And who draws a part of it draws none.
        done = self.edgecase("run", "--device", "llvmpipe", "-o", self.out, "coverage/bow-tie:*", env=env, check=0)
        self.assertNotIn("doors:", done.stdout)

    def test_the_reference_passes_its_own_judge(self):
        # It draws by rationals, minutes for all of these.
        for words in (("--quick",), ("multisample/**", "clip/**"), ("multisample/**", "clip/**", "--profile", "vulkan")):
            self.edgecase("run", "-o", self.out, "--renderer", "reference", *words, "--shard", self.share(24), "--timeout", "100", check=0)
            results = self.results()
            left_out = {case["id"]: case["reason"] for case in results["cases"] if case["status"] == "unsupported"}
            self.assertEqual(results["totals"]["pass"] + len(left_out), results["totals"]["cases"])
            for case, reason in left_out.items():  # what has no Vulkan has no doors; all else is drawn
                self.assertTrue(case.startswith("door/"), case)
                self.assertIn("no doors", reason)

    def test_one_flipped_pixel_in_every_case_fails_every_case(self):
        self.run_lavapipe("--no-expect", "--no-diagnosis", "--retries", "0", "--capture", "none", "--shard", self.share(8),
                          fault="flip-pixel", check=1)
        # Of triangles with bad numbers nothing is asked: the flipped sample may be one of theirs.
        statuses = {status for case_id, status in self.statuses().items() if not case_id.startswith("bad-numbers/")}
        self.assertEqual(statuses, {"fail", "unsupported"})

    def test_pictures_drawn_by_hand(self):
        with_picture = sum(1 for path in (support.SOURCE / "cases" / "suite").rglob("*.toml")
                           if "[expect" in path.read_text())
        self.assertGreaterEqual(with_picture, 40)
        self.edgecase("lint", check=0)


if __name__ == "__main__":
    os.environ.setdefault("EDGECASE_PROGRAM", "edgecase")
    unittest.main()
