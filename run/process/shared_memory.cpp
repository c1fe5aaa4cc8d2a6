// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "run/process/shared_memory.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <utility>

namespace run {

std::shared_ptr<SharedMemory> SharedMemory::create() {
    const Fd low(::memfd_create("edgecase captures", MFD_CLOEXEC | MFD_ALLOW_SEALING));
    // Above the numbers that a child's fixed descriptors take.
    Fd fd(low.is_open() ? ::fcntl(low.get(), F_DUPFD_CLOEXEC, 10) : -1);
    // Sealed, so that a worker cannot take away what the parent has mapped.
    if (!fd.is_open() || ::ftruncate(fd.get(), off_t{kBytes}) != 0 ||
        ::fcntl(fd.get(), F_ADD_SEALS, F_SEAL_SHRINK | F_SEAL_GROW | F_SEAL_SEAL) != 0) {
        return nullptr;
    }
    void* data = ::mmap(nullptr, kBytes, PROT_READ, MAP_SHARED, fd.get(), 0);
    if (data == MAP_FAILED) {
        return nullptr;
    }
    return std::shared_ptr<SharedMemory>(
        new SharedMemory(std::move(fd), static_cast<const std::byte*>(data)));
}

SharedMemory::~SharedMemory() {
    ::munmap(const_cast<std::byte*>(data_), kBytes);
}

bool SharedMemory::has_free() const {
    return std::any_of(is_taken_.begin(), is_taken_.begin() + kRegions,
                       [](const std::atomic<bool>& taken) { return !taken; });
}

void SharedMemory::give_back(size_t k, bool is_large) const {
    if (is_large) {
        // If the system cannot, the memory is used again all the same.
        static_cast<void>(::fallocate(fd_.get(), FALLOC_FL_PUNCH_HOLE | FALLOC_FL_KEEP_SIZE,
                                      static_cast<off_t>(k * kRegionBytes + kKeptBytes),
                                      static_cast<off_t>(bytes_of(k) - kKeptBytes)));
    }
    is_taken_.at(k) = false;  // not before: the next batch writes there
}

std::shared_ptr<const Region> SharedMemory::take(uint64_t bytes) {
    // A capture that is read keeps the mapping.
    struct Reader {
        std::shared_ptr<const SharedMemory> memory;
        size_t k;
        bool is_large;
        Region region;
        Reader(std::shared_ptr<const SharedMemory> m, size_t number, bool large)
            : memory(std::move(m)),
              k(number),
              is_large(large),
              region{k * kRegionBytes, {memory->data_ + k * kRegionBytes, bytes_of(k)}} {}
        Reader(const Reader&) = delete;
        Reader& operator=(const Reader&) = delete;
        ~Reader() { memory->give_back(k, is_large); }
    };
    for (size_t k = bytes > kRegionBytes ? kRegions : 0; k < is_taken_.size(); ++k) {
        if (bytes <= bytes_of(k) && (k < kRegions || bytes > kRegionBytes) &&
            !is_taken_.at(k).exchange(true)) {
            const auto reader =
                std::make_shared<const Reader>(shared_from_this(), k, bytes > kKeptBytes);
            return {reader, &reader->region};
        }
    }
    return nullptr;
}

SharedWriter::SharedWriter(int fd) {
    struct stat status {};
    if (::fstat(fd, &status) != 0 || status.st_size != off_t{SharedMemory::kBytes}) {
        return;
    }
    void* data = ::mmap(nullptr, SharedMemory::kBytes, PROT_READ, MAP_SHARED, fd, 0);
    data_ = data == MAP_FAILED ? nullptr : static_cast<std::byte*>(data);
}

void SharedWriter::open(uint64_t offset, uint64_t size) {
    begin_ = next_ = end_ = 0;
    if (data_ != nullptr && size > 0 && offset <= SharedMemory::kBytes &&
        size <= SharedMemory::kBytes - offset &&
        ::mprotect(data_ + offset, size, PROT_READ | PROT_WRITE) == 0) {
        begin_ = next_ = offset;
        end_ = offset + size;
    }
}

std::span<std::byte> SharedWriter::place(uint64_t bytes) {
    if (bytes == 0 || end_ - next_ < bytes) {
        return {};
    }
    const std::span<std::byte> placed(data_ + next_, bytes);
    next_ = std::min(end_, (next_ + bytes + 63) / 64 * 64);
    return placed;
}

uint64_t SharedWriter::offset_of(std::span<std::byte> placed) const {
    return static_cast<uint64_t>(placed.data() - data_);
}

void SharedWriter::lock() {
    if (end_ > begin_) {
        ::mprotect(data_ + begin_, end_ - begin_, PROT_READ);
    }
    next_ = end_;
}

}  // namespace run
