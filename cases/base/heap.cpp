// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "cases/base/heap.hpp"

#include <malloc.h>
#include <unistd.h>

#include <atomic>
#include <cstdint>
#include <fstream>

namespace cases {

namespace {

// Bytes of memory that only this process has; 0 if the system does not tell. Linux, proc(5).
int64_t own_bytes() {
    std::ifstream file("/proc/self/statm");
    int64_t pages = 0, resident = 0, shared = 0;
    return file >> pages >> resident >> shared ? (resident - shared) * ::sysconf(_SC_PAGESIZE) : 0;
}

}  // namespace

void give_back_memory() {
    static constexpr int64_t kGrowth = int64_t{64} << 20;
    static std::atomic<int64_t> after_last = 0;
    int64_t last = after_last;
    const int64_t now = own_bytes();
    // One of several threads that come at once.
    if (now - last > kGrowth && after_last.compare_exchange_strong(last, now)) {
        ::malloc_trim(0);
        after_last = own_bytes();
    }
}

}  // namespace cases
