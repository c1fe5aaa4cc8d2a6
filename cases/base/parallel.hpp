// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// One loop for lists whose entries are worked on without each other.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <future>
#include <thread>
#include <vector>

namespace cases {

// The number of cores, at least 1.
inline unsigned cores() {
    return std::max(1U, std::thread::hardware_concurrency());
}

// How many threads for_each_index() takes at most, the caller's among them.
inline unsigned most_threads() {
    return std::min(cores(), 4U);
}

// body(k) for each k below `count`, each once, in no particular order, by the caller and
// other threads. Returns when all are done. An exception of one thread ends its share of the
// work and is thrown on.
template <class Body>
void for_each_index(size_t count, const Body& body) {
    std::atomic<size_t> next = 0;
    const auto take_some = [&] {
        for (size_t k = next++; k < count; k = next++) {
            body(k);
        }
    };
    const size_t threads = std::min<size_t>(most_threads(), count);
    std::vector<std::future<void>> others;
    for (size_t k = 1; k < threads; ++k) {
        others.push_back(std::async(std::launch::async, take_some));
    }
    take_some();
    for (std::future<void>& other : others) {
        other.get();
    }
}

}  // namespace cases
