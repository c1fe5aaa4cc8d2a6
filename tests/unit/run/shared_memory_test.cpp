// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "run/process/shared_memory.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstring>

#include "capture/checksum.hpp"
#include "run/judge.hpp"
#include "run/worker/message.hpp"

namespace run {
namespace {

TEST(SharedMemory, AWorkersWordsArriveInTheParent) {
    const std::shared_ptr<SharedMemory> memory = SharedMemory::create();
    ASSERT_TRUE(memory);
    const std::shared_ptr<const Region> first = memory->take(1);
    const std::shared_ptr<const Region> region = memory->take(1);
    SharedWriter writer(memory->fd());
    writer.open(region->offset, region->bytes.size());
    const std::span<std::byte> a = writer.place(5);
    const std::span<std::byte> b = writer.place(7);
    ASSERT_EQ(a.size(), 5U);
    ASSERT_EQ(b.size(), 7U);
    EXPECT_EQ(writer.offset_of(a), region->offset);
    EXPECT_EQ(writer.offset_of(b), region->offset + 64);
    std::memcpy(b.data(), "seven..", 7);
    EXPECT_EQ(std::memcmp(region->bytes.data() + 64, "seven..", 7), 0);
    EXPECT_EQ(static_cast<int>(first->bytes[64]), 0);
}

TEST(SharedMemory, ARegionIsTakenAgainOnlyWhenNobodyReadsIt) {
    const std::shared_ptr<SharedMemory> memory = SharedMemory::create();
    std::vector<std::shared_ptr<const Region>> taken;
    for (size_t k = 0; k < SharedMemory::kRegions; ++k) {
        EXPECT_TRUE(memory->has_free());
        taken.push_back(memory->take(1));
        ASSERT_TRUE(taken.back());
        EXPECT_EQ(taken.back()->offset, k * SharedMemory::kRegionBytes);
    }
    EXPECT_FALSE(memory->has_free());
    EXPECT_FALSE(memory->take(1));
    const std::shared_ptr<const Region> reader = taken[2];
    taken[2].reset();
    EXPECT_FALSE(memory->take(1));
    taken[1].reset();
    const std::shared_ptr<const Region> again = memory->take(1);
    ASSERT_TRUE(again);
    EXPECT_EQ(again->offset, SharedMemory::kRegionBytes);
}

TEST(SharedMemory, ACaseLargerThanABatchHasARegionOfItsOwn) {
    const std::shared_ptr<SharedMemory> memory = SharedMemory::create();
    constexpr uint64_t kLarge = SharedMemory::kRegionBytes + 1;
    std::shared_ptr<const Region> region = memory->take(kLarge);
    ASSERT_TRUE(region);
    EXPECT_EQ(region->offset, SharedMemory::kRegions * SharedMemory::kRegionBytes);
    EXPECT_FALSE(memory->take(kLarge));
    EXPECT_FALSE(memory->take(SharedMemory::kLargeBytes + 1));
    EXPECT_EQ(memory->take(kLarge - 1)->offset, 0U);  // batches have theirs
    SharedWriter writer(memory->fd());
    writer.open(region->offset, kLarge);
    writer.place(kLarge).back() = std::byte{7};
    EXPECT_EQ(region->bytes[kLarge - 1], std::byte{7});
    region.reset();  // back to the system
    region = memory->take(kLarge);
    ASSERT_TRUE(region);
    EXPECT_EQ(region->bytes[kLarge - 1], std::byte{0});
}

TEST(SharedMemory, ReadersOutliveTheOwner) {
    std::shared_ptr<SharedMemory> memory = SharedMemory::create();
    const std::shared_ptr<const Region> region = memory->take(1);
    SharedWriter writer(memory->fd());
    writer.open(region->offset, region->bytes.size());
    writer.place(1)[0] = std::byte{42};
    memory.reset();
    EXPECT_EQ(region->bytes[0], std::byte{42});
}

// A region that held a large batch is empty beyond its first megabytes when it is taken again, one
// that held a small one is as it was: the system need not clear it.
TEST(SharedMemory, ALargeBatchLeavesItsMemoryToTheSystem) {
    const std::shared_ptr<SharedMemory> memory = SharedMemory::create();
    constexpr uint64_t kKept = SharedMemory::kKeptBytes;
    for (const uint64_t bytes : {kKept, kKept + 4096}) {
        std::shared_ptr<const Region> region = memory->take(bytes);
        SharedWriter writer(memory->fd());
        writer.open(region->offset, region->bytes.size());
        writer.place(kKept)[0] = std::byte{1};
        writer.place(4096)[0] = std::byte{2};
        region.reset();
        region = memory->take(1);
        EXPECT_EQ(region->bytes[0], std::byte{1});
        EXPECT_EQ(region->bytes[kKept], bytes > kKept ? std::byte{0} : std::byte{2});
    }
}

TEST(SharedMemory, CannotBeTakenAway) {
    const std::shared_ptr<SharedMemory> memory = SharedMemory::create();
    EXPECT_NE(::ftruncate(memory->fd(), 0), 0);  // sealed: the parent cannot be made to fault
}

TEST(SharedMemory, WithoutRoomThereIsNoPlace) {
    const std::shared_ptr<SharedMemory> memory = SharedMemory::create();
    SharedWriter writer(memory->fd());
    EXPECT_TRUE(writer.place(1).empty());  // not opened
    writer.open(0, 128);
    EXPECT_TRUE(writer.place(129).empty());
    EXPECT_EQ(writer.place(100).size(), 100U);
    EXPECT_TRUE(writer.place(1).empty());  // the next place would begin at 128
    writer.open(SharedMemory::kBytes - 64, 128);
    EXPECT_TRUE(writer.place(1).empty());
    SharedWriter none(-1);
    none.open(0, SharedMemory::kBytes);
    EXPECT_TRUE(none.place(1).empty());
}

TEST(SharedMemoryDeathTest, LockedWordsCannotBeWrittenTo) {
    const std::shared_ptr<SharedMemory> memory = SharedMemory::create();
    SharedWriter writer(memory->fd());
    writer.open(0, SharedMemory::kRegionBytes);
    const std::span<std::byte> place = writer.place(64);
    place[0] = std::byte{1};
    writer.lock();
    EXPECT_TRUE(writer.place(1).empty());
    EXPECT_DEATH(place[0] = std::byte{2}, "");
    writer.open(0, SharedMemory::kRegionBytes);
    place[0] = std::byte{3};
}

TEST(SharedMemory, AResultTellsWhereItsPlanesLie) {
    CaseResult result;
    result.index = 2;
    result.rendered.status = capture::Rendered::Status::drawn;
    result.rendered.capture.target = {4, 2, 1};
    result.rendered.capture.attribute_count = 1;
    result.is_shared = true;
    result.offset = 4096;
    result.bits = 77;
    const std::string bytes = encode_result(result);
    const std::optional<CaseResult> back = decode_result(bytes);
    ASSERT_TRUE(back);
    EXPECT_TRUE(back->is_shared);
    EXPECT_EQ(back->offset, 4096U);
    EXPECT_EQ(back->bits, 77U);
    for (size_t size = 0; size < bytes.size(); ++size) {
        EXPECT_FALSE(decode_result(std::string_view(bytes).substr(0, size))) << size;
    }
}

TEST(SharedMemory, EveryFlippedBitOfACaptureChangesItsSum) {
    const cases::Target target{3, 1, 1};
    alignas(16) std::array<std::byte, 3 * (16 * 4 + 4)> planes{};
    ASSERT_EQ(planes.size(), capture::plane_bytes(target, 1));
    const uint64_t bits =
        capture::capture_bits(capture::view_planes(target, true, 1, planes.data()));
    for (size_t bit = 0; bit < planes.size() * 8; ++bit) {
        planes[bit / 8] ^= static_cast<std::byte>(1U << (bit % 8));
        EXPECT_NE(capture::capture_bits(capture::view_planes(target, true, 1, planes.data())), bits)
            << bit;
        planes[bit / 8] ^= static_cast<std::byte>(1U << (bit % 8));
    }
}

}  // namespace
}  // namespace run
