# SPDX-FileCopyrightText: The Edgecase authors
# SPDX-License-Identifier: Apache-2.0
"""What scripts/run-suite hands to 'edgecase run'."""
import os
import pathlib
import shutil
import subprocess
import tempfile
import unittest

from support import SOURCE


class RunSuite(unittest.TestCase):
    def setUp(self):
        self.root = pathlib.Path(tempfile.mkdtemp(prefix="edgecase-e2e-"))
        self.addCleanup(shutil.rmtree, self.root, ignore_errors=True)
        (self.root / "sub").mkdir()
        for name, text in (("scripts/install-packages", "exit 0"), ("scripts/build", "exit 0"),
                           ("build/release/bin/edgecase", 'printf "%s\\n" "$0" "$PWD" "$@"')):
            path = self.root / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(f"#!/bin/sh\n{text}\n")
            path.chmod(0o755)
        shutil.copy(SOURCE / "scripts/run-suite", self.root / "scripts/run-suite")

    def words(self, *words, folder=".", **variables):
        env = {k: v for k, v in os.environ.items() if not k.startswith(("EDGECASE_", "VK_"))} | variables
        done = subprocess.run([self.root / "scripts/run-suite", *words], env=env, cwd=self.root / folder,
                              capture_output=True, text=True, timeout=60, check=True)
        program, where, *given = done.stdout.splitlines()
        self.assertEqual(os.path.realpath(where), os.path.realpath(self.root / folder))
        self.assertTrue((self.root / folder / program).exists(), program)
        return given

    def test_lavapipe_unless_another_is_chosen(self):
        self.assertEqual(self.words(), ["run", "--device", "llvmpipe", "-o", "out/suite"])
        for name in ("EDGECASE_DEVICE", "EDGECASE_ICD", "VK_DRIVER_FILES", "VK_ICD_FILENAMES"):
            self.assertEqual(self.words(**{name: "x"}), ["run", "-o", "out/suite"], name)
        for word in ("--device=x", "--icd=x", "--renderer=tiles"):
            self.assertEqual(self.words(word), ["run", "-o", "out/suite", word])

    def test_a_resumed_run_gets_nothing_of_its_own(self):
        self.assertEqual(self.words("--resume", "x"), ["run", "--resume", "x"])

    def test_paths_count_from_the_folder_of_the_caller(self):
        self.assertEqual(self.words("mine.toml", folder="sub"),
                         ["run", "--device", "llvmpipe", "-o", "../out/suite", "mine.toml"])
        self.assertEqual(self.words("-o", "here", folder="sub"), ["run", "--device", "llvmpipe", "-o", "here"])


if __name__ == "__main__":
    unittest.main()
