// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The memory of GMP's numbers, through the functions that GMP itself calls.
#include <gmp.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <random>
#include <thread>
#include <vector>

namespace {

struct Functions {
    void* (*allocate)(size_t) = nullptr;
    void* (*reallocate)(void*, size_t, size_t) = nullptr;
    void (*release)(void*, size_t) = nullptr;
    Functions() { mp_get_memory_functions(&allocate, &reallocate, &release); }
};

struct Held {
    uint8_t* at;
    size_t bytes;
    uint8_t mark;
    bool is_intact() const {
        return std::all_of(at, at + bytes, [this](uint8_t b) { return b == mark; });
    }
};

TEST(NumberMemory, ResizedBlocksKeepTheirContentAndNeverOverlap) {
    const Functions f;
    std::mt19937 random(1);
    std::vector<Held> held;
    for (int k = 0; k < 20000; ++k) {
        const size_t bytes = std::uniform_int_distribution<size_t>(1, 700)(random);
        const auto mark = static_cast<uint8_t>(random());
        if (held.size() < 200) {
            auto* at = static_cast<uint8_t*>(f.allocate(bytes));
            ASSERT_EQ(reinterpret_cast<uintptr_t>(at) % alignof(std::max_align_t), 0U);
            std::fill_n(at, bytes, mark);
            held.push_back({at, bytes, mark});
            continue;
        }
        const size_t n = std::uniform_int_distribution<size_t>(0, held.size() - 1)(random);
        Held& h = held[n];
        ASSERT_TRUE(h.is_intact()) << "block of " << h.bytes << " bytes, step " << k;
        if ((mark & 1U) != 0) {
            f.release(h.at, h.bytes);
            h = held.back();
            held.pop_back();
            continue;
        }
        h.at = static_cast<uint8_t*>(f.reallocate(h.at, h.bytes, bytes));
        const size_t kept = std::min(h.bytes, bytes);
        ASSERT_TRUE((Held{h.at, kept, h.mark}.is_intact())) << h.bytes << " to " << bytes;
        std::fill_n(h.at, bytes, h.mark);
        h.bytes = bytes;
    }
    for (const Held& h : held) {
        EXPECT_TRUE(h.is_intact());
        f.release(h.at, h.bytes);
    }
}

TEST(NumberMemory, BlocksMayBeReleasedByAnotherThread) {
    const Functions f;
    std::vector<Held> held;
    std::thread([&] {
        for (size_t bytes = 1; bytes <= 600; ++bytes) {
            auto* at = static_cast<uint8_t*>(f.allocate(bytes));
            std::fill_n(at, bytes, uint8_t{7});
            held.push_back({at, bytes, 7});
        }
    }).join();
    for (const Held& h : held) {
        EXPECT_TRUE(h.is_intact());
        f.release(h.at, h.bytes);
    }
    for (size_t bytes = 1; bytes <= 512; ++bytes) {  // the released blocks come back, each once
        auto* at = static_cast<uint8_t*>(f.allocate(bytes));
        std::fill_n(at, bytes, static_cast<uint8_t>(bytes));
        held[bytes - 1] = {at, bytes, static_cast<uint8_t>(bytes)};
    }
    for (size_t bytes = 1; bytes <= 512; ++bytes) {
        EXPECT_TRUE(held[bytes - 1].is_intact()) << bytes;
        f.release(held[bytes - 1].at, bytes);
    }
}

#ifndef __SANITIZE_ADDRESS__
TEST(NumberMemory, ABlockIsUsedAgainForTheSameSize) {
    const Functions f;
    void* first = f.allocate(24);
    f.release(first, 24);
    EXPECT_EQ(f.allocate(17), first) << "17 to 32 bytes share a list";
    f.release(first, 17);
}

TEST(NumberMemory, AThreadHasWhatTheLastOneLeft) {
    const Functions f;
    void* first = nullptr;
    std::thread([&] {
        first = f.allocate(24);
        f.release(first, 24);
    }).join();
    std::thread([&] {
        // A block that comes to a thread before it has a number of its own stays, too.
        void* other = nullptr;
        std::thread([&] { other = f.allocate(40); }).join();
        f.release(other, 40);
        EXPECT_EQ(f.allocate(40), other);
        EXPECT_EQ(f.allocate(24), first);
        f.release(other, 40);
        f.release(first, 24);
    }).join();
}
#endif

}  // namespace
