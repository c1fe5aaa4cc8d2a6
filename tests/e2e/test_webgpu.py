# SPDX-FileCopyrightText: The Edgecase authors
# SPDX-License-Identifier: Apache-2.0
"""docs/examples/webgpu: cases that WebGPU draws, judged end to end where npm's package webgpu has been installed."""
import os
import subprocess
import unittest

from support import PROGRAM, SOURCE, ProgramTest


class Judged(ProgramTest):
    def test_families(self):
        if not (SOURCE / "out" / "webgpu" / "node_modules" / "webgpu").is_dir():
            self.skipTest("npm's package webgpu is not in out/webgpu: scripts/judge-webgpu installs it")
        variables = {**os.environ, "EDGECASE_PROGRAM": PROGRAM}
        done = subprocess.run([SOURCE / "scripts" / "judge-webgpu", "--driver=lvp26", "attributes/**", "ties/**", "facing/**",
                               "depth-test/**", "blend/**"], env=variables, cwd=self.folder, capture_output=True, text=True,
                              timeout=240, check=False)
        if done.returncode == 5:
            self.skipTest(done.stderr.strip().splitlines()[-1])
        self.assertEqual(done.returncode, 0, done.stdout[-3000:] + done.stderr[-1000:])
        statuses = list(self.statuses(SOURCE / "out" / "webgpu" / "report").values())
        self.assertGreater(statuses.count("pass"), 200)


if __name__ == "__main__":
    unittest.main()
