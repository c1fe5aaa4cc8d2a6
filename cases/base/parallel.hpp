// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Threads. Nothing else starts one: where a limit leaves none, what they would have done takes
// longer and nothing else changes.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <functional>
#include <future>
#include <memory>
#include <optional>
#include <system_error>
#include <thread>
#include <utility>
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

// A thread that does the work; none if the system has no more (a limit of processes, no memory for
// its stack).
inline std::optional<std::thread> try_thread(std::function<void()> work) {
    try {
        return std::thread(std::move(work));
    } catch (const std::system_error&) {
        return std::nullopt;
    }
}

// The work is done beside the caller, or, where there is no thread for it, by whoever waits for its
// result. The future waits for a thread at its end; work that waits for get() is then dropped.
template <class Work>
auto beside(Work work) {
    const auto kept = std::make_shared<Work>(std::move(work));
    const auto call = [kept] { return (*kept)(); };
    try {
        return std::async(std::launch::async, call);
    } catch (const std::system_error&) {
        return std::async(std::launch::deferred, call);
    }
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
        others.push_back(beside(take_some));
    }
    take_some();
    for (std::future<void>& other : others) {
        other.get();
    }
}

}  // namespace cases
