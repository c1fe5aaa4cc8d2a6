// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Memory of GMP's numbers. Exact arithmetic makes and drops millions of numbers of one to four
// limbs; taking each from malloc costs more than computing with it. Small blocks are kept here, a
// list a size and thread, and never go back to the system; large ones come from malloc. What a
// thread leaves when it ends is the next one's that begins.
//
// Not under AddressSanitizer, which must see every number.
#include <gmp.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <mutex>

// Named by the linker option that keeps this file in every program (CMakeLists.txt).
extern "C" const int edgecase_number_memory = 1;

#ifndef __SANITIZE_ADDRESS__

namespace {

constexpr size_t kStep = 16;      // sizes are multiples of it, and so is every alignment
constexpr size_t kLargest = 512;  // bytes of a block that is kept
constexpr size_t kChunk = size_t{64} << 10;
static_assert(kStep >= alignof(std::max_align_t) && kStep >= sizeof(void*));

struct Block {
    Block* next;
};

// Trivial, so that numbers may be dropped while a thread or the process ends.
struct Memory {
    std::array<Block*, kLargest / kStep> kept;  // [k]: of (k + 1) kStep bytes
    std::byte* fresh;
    size_t fresh_bytes;
};
thread_local Memory memory{};

// What threads that have ended left.
struct Left {
    Memory memory;
    Left* next;
};
constinit std::mutex mutex;
Left* left = nullptr;

void take_over() {
    Left* one = nullptr;
    {
        const std::lock_guard lock(mutex);
        one = left;
        left = one == nullptr ? nullptr : one->next;
    }
    if (one != nullptr) {
        memory = one->memory;
        std::free(one);
    }
}

void leave() {
    void* room = std::malloc(sizeof(Left));
    if (room != nullptr) {
        const std::lock_guard lock(mutex);
        left = new (room) Left{memory, left};
        memory = {};  // for numbers that are dropped later
    }
}

// Made with a thread's first number, so that it is there before any block is kept.
struct Tenant {
    Tenant() { take_over(); }
    Tenant(const Tenant&) = delete;
    Tenant& operator=(const Tenant&) = delete;
    ~Tenant() { leave(); }
};

void move_in() {
    static thread_local const Tenant tenant;
}

size_t list_of(size_t bytes) {
    return bytes == 0 ? 0 : (bytes - 1) / kStep;
}

// GMP has no way to hand on a failure.
void* must_have(void* p, size_t bytes) {
    if (p == nullptr) {
        std::fprintf(stderr, "edgecase: out of memory (%zu bytes for a number)\n", bytes);
        std::abort();
    }
    return p;
}

void* allocate(size_t bytes) {
    if (bytes > kLargest) {
        return must_have(std::malloc(bytes), bytes);
    }
    Memory& m = memory;
    const size_t list = list_of(bytes);
    if (Block* block = m.kept[list]; block != nullptr) {
        m.kept[list] = block->next;
        return block;
    }
    const size_t size = (list + 1) * kStep;
    if (m.fresh == nullptr) {
        move_in();
        if (Block* block = m.kept[list]; block != nullptr) {
            m.kept[list] = block->next;
            return block;
        }
    }
    if (m.fresh_bytes < size) {  // what is left of the last chunk is not worth keeping
        m.fresh = static_cast<std::byte*>(must_have(std::malloc(kChunk), kChunk));
        m.fresh_bytes = kChunk;
    }
    std::byte* block = m.fresh;
    m.fresh += size;
    m.fresh_bytes -= size;
    return block;
}

void release(void* p, size_t bytes) {
    if (bytes > kLargest) {
        std::free(p);
        return;
    }
    if (memory.fresh == nullptr) {
        move_in();
    }
    Block*& kept = memory.kept[list_of(bytes)];
    kept = new (p) Block{kept};
}

void* reallocate(void* p, size_t from, size_t to) {
    if (from > kLargest && to > kLargest) {
        return must_have(std::realloc(p, to), to);
    }
    if (from <= kLargest && to <= kLargest && list_of(from) == list_of(to)) {
        return p;
    }
    void* moved = allocate(to);
    std::memcpy(moved, p, std::min(from, to));
    release(p, from);
    return moved;
}

// Before any other initialization: a number must come from where it goes back to.
__attribute__((constructor(101))) void install() {
    mp_set_memory_functions(allocate, reallocate, release);
}

}  // namespace

#endif
