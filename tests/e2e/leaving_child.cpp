// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// No driver: a library that leaves a child behind while it is loaded, which holds all descriptors.
#include <unistd.h>

[[gnu::constructor]] static void leave_a_child() {
    if (::fork() == 0) {
        ::sleep(600);
        ::_exit(0);
    }
}
