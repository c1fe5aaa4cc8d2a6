// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Memory that a worker writes captures into and its parent reads them from. The parent decides
// which part a batch may write to, never one whose captures are still read; the worker locks what
// it has written, so that a driver that goes astray later cannot change it.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

#include "run/process/process.hpp"

namespace run {

// A part of the memory; it can be written to again when every copy of the pointer is gone.
struct Region {
    uint64_t offset = 0;               // in the memory
    std::span<const std::byte> bytes;  // in the parent
};

// It is taken from the system only where it is written to.
class SharedMemory : public std::enable_shared_from_this<SharedMemory> {
  public:
    static constexpr size_t kRegions = 4;
    static constexpr uint64_t kRegionBytes = uint64_t{65} << 20;  // a batch has 64 MiB at most
    // One region more, behind the others, for a case that is larger than a batch.
    static constexpr uint64_t kLargeBytes = uint64_t{16} << 30;
    static constexpr uint64_t kBytes = kRegions * kRegionBytes + kLargeBytes;
    static constexpr uint64_t kKeptBytes = uint64_t{8} << 20;  // of a region that is free again

    // Null if the system has no such memory; captures travel through the pipe then.
    static std::shared_ptr<SharedMemory> create();
    ~SharedMemory();
    SharedMemory(const SharedMemory&) = delete;
    SharedMemory& operator=(const SharedMemory&) = delete;

    int fd() const { return fd_.get(); }
    // The first free region that holds a batch of so many bytes; null if none is free. What a large
    // batch had taken from the system goes back to it with the region.
    std::shared_ptr<const Region> take(uint64_t bytes);
    bool has_free() const;  // of those for batches

  private:
    static uint64_t bytes_of(size_t region) {
        return region < kRegions ? kRegionBytes : kLargeBytes;
    }
    SharedMemory(Fd fd, const std::byte* data) : fd_(std::move(fd)), data_(data) {}
    // Of a region that nobody reads any more, on whichever thread that happens.
    void give_back(size_t k, bool is_large) const;
    Fd fd_;
    const std::byte* data_;
    mutable std::array<std::atomic<bool>, kRegions + 1> is_taken_{};
};

// The worker's side. Everything fails softly: what finds no place goes through the pipe.
class SharedWriter {
  public:
    // Maps the memory behind the descriptor; without it, nothing ever finds a place.
    explicit SharedWriter(int fd);
    // Places for the captures of one batch come from [offset, offset + size).
    void open(uint64_t offset, uint64_t size);
    // A place aligned to 64 bytes; empty if the region is full.
    std::span<std::byte> place(uint64_t bytes);
    // Where a place lies in the memory.
    uint64_t offset_of(std::span<std::byte> placed) const;
    // Ends writing: until open(), a write to the region is a segmentation fault.
    void lock();

  private:
    std::byte* data_ = nullptr;
    uint64_t begin_ = 0, next_ = 0, end_ = 0;
};

}  // namespace run
