# SPDX-FileCopyrightText: The Edgecase authors
# SPDX-License-Identifier: Apache-2.0
"""The program and its image module are linked and compiled hardened."""
import os
import pathlib
import subprocess
import unittest

from support import PROGRAM


def readelf(*words):
    return subprocess.run(["readelf", "--wide", *map(str, words)], capture_output=True, text=True, check=True).stdout


class Hardening(unittest.TestCase):
    """Not of a build with sanitizers, which replace these checks by their own."""
    files = [pathlib.Path(PROGRAM), pathlib.Path(os.environ.get("EDGECASE_IMAGE_MODULE"))]

    def test_relocations_are_read_only_at_start(self):
        for file in self.files:
            self.assertIn("GNU_RELRO", readelf("-l", file), file)
            self.assertRegex(readelf("-d", file), r"BIND_NOW|FLAGS_1\).*NOW", file)

    def test_the_stack_is_guarded_and_not_executable(self):
        for file in self.files:
            self.assertIn("__stack_chk_fail", readelf("-s", "-D", file), file)
            stack = next(line for line in readelf("-l", file).splitlines() if "GNU_STACK" in line)
            self.assertIn(" RW ", stack, file)

    def test_the_program_loads_at_any_address(self):
        self.assertIn("DYN (", readelf("-h", PROGRAM))

    def test_copies_are_checked(self):
        self.assertIn("_chk@", readelf("-s", "-D", PROGRAM).replace("__stack_chk", ""))


if __name__ == "__main__":
    unittest.main()
