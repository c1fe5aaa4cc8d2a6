# SPDX-FileCopyrightText: The Edgecase authors
# SPDX-License-Identifier: Apache-2.0
"""Lists and runs Edgecase's cases for lit; a module of its own, since lit sends tests to processes."""
import os
import shlex
import shutil
import subprocess
import tempfile

import lit.formats
import lit.Test

PROGRAM = os.environ.get("EDGECASE_PROGRAM", "edgecase")
# What the exit codes of 'edgecase run' mean; any other is a mistake in the set-up, or a case that cannot be judged.
RESULTS = {0: lit.Test.PASS, 1: lit.Test.FAIL, 6: lit.Test.UNSUPPORTED}


class Edgecase(lit.formats.TestFormat):
    def getTestsInDirectory(self, suite, path_in_suite, lit_config, local_config):
        selectors = shlex.split(os.environ.get("EDGECASE_SELECTORS", ""))
        listed = subprocess.run([PROGRAM, "list", "--ids", "--", *selectors], stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                text=True, check=False)
        if listed.returncode != 0:
            lit_config.fatal(listed.stderr.strip())
        # What each test will be given has to be known there, too: a case of a file or folder outside the suite is not.
        again = subprocess.run([PROGRAM, "list", "--ids", "-"], input=listed.stdout, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                               text=True, check=False)
        if again.returncode != 0:
            lit_config.fatal("EDGECASE_SELECTORS choose cases outside the suite; run them alone, with EDGECASE_SUITE and the folder that they are in")
        return [lit.Test.Test(suite, (case,), local_config) for case in listed.stdout.split()]

    def execute(self, test, lit_config):
        folder = tempfile.mkdtemp(prefix="case-", dir=test.suite.exec_root)
        words = [PROGRAM, "run", "-o", folder, "--progress", "none", "--ci", "none",
                 *shlex.split(os.environ.get("EDGECASE_OPTIONS", "")), "--", *test.path_in_suite]
        done = subprocess.run(words, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
        result = RESULTS.get(done.returncode, lit.Test.UNRESOLVED)
        if result in (lit.Test.PASS, lit.Test.UNSUPPORTED):
            shutil.rmtree(folder)  # what failed keeps its report, which the output names
        return result, done.stdout
