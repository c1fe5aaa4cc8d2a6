// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Loops over neighbours in a row, on as many lanes as the processor has.
#pragma once

// Compiles a function for AVX2, too; which of the two is called is decided when the program starts.
// Both make the same operations in the same order, none of them fused (-ffp-contract=off), so their
// numbers have the same bits. The helpers of such a function are inlined into it, as
// EDGECASE_INLINED. Not under the sanitizers, whose runtimes start later than that decision is
// made.
#if defined(__x86_64__) && defined(__GLIBC__) && !defined(EDGECASE_SANITIZED)
#define EDGECASE_WIDE __attribute__((target_clones("avx2", "default")))
#else
#define EDGECASE_WIDE
#endif
#define EDGECASE_INLINED inline __attribute__((always_inline))
