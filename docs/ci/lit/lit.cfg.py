# SPDX-FileCopyrightText: The Edgecase authors
# SPDX-License-Identifier: Apache-2.0
"""Edgecase's cases as tests of LLVM's lit, each a process of its own: `lit -sv /usr/share/edgecase/ci/lit`.

EDGECASE_SELECTORS (words; without any, the whole suite) chooses cases, and EDGECASE_OPTIONS (words) are options of
'edgecase run':

    EDGECASE_SELECTORS='ties/**' EDGECASE_OPTIONS='--icd my_icd.json --profile vulkan' lit -sv /usr/share/edgecase/ci/lit

Cases of your own are a suite of their own: EDGECASE_SUITE is their folder.
"""
import os
import sys
import tempfile

here = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, here)
import edgecase_format

config.name = "edgecase"
config.test_format = edgecase_format.Edgecase()
config.test_source_root = here
config.test_exec_root = os.path.join(tempfile.gettempdir(), f"edgecase-lit-{os.getuid()}")
os.makedirs(config.test_exec_root, exist_ok=True)  # lit keeps its times there
config.environment = dict(os.environ)
