# SPDX-FileCopyrightText: The Edgecase authors
# SPDX-License-Identifier: Apache-2.0
"""Shares of what a test would take too long with: the I-th of N by EDGECASE_SUITE_SHARE=I/N, as --shard has it (1/1: all,
by night), else one that moves on as there is more. Tests in C++ have tests/share.hpp."""
import os


def share_of(parts, count):
    """'I/N': without the variable one of so many parts, by how many things there are."""
    return os.environ.get("EDGECASE_SUITE_SHARE", f"{count % parts + 1}/{parts}")


def is_in_share(place, parts, count):
    """Whether the thing at this place, from 0, is of the share: each part has every so-manieth."""
    index, shares = map(int, share_of(parts, count).split("/"))
    return place % shares == index - 1
