// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What the heap keeps of memory that was freed.
#pragma once

namespace cases {

// Gives the system what the heap keeps, if the process holds 64 MiB more than after the last time.
// To be called between cases, by any thread: memory that comes and goes with every case stays, and
// what a few large ones have left in each thread's heap does not add up.
void give_back_memory();

}  // namespace cases
