// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "capture/exchange/plane_files.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <bit>
#include <cmath>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>

#include "capture/exchange/export_case.hpp"
#include "capture/image/image.hpp"

namespace {

namespace fs = std::filesystem;

cases::Case plain_case(uint32_t samples) {
    cases::Case c;
    c.id = "a/b:k=1/2";
    c.claim.rules = {"cover.inside"};
    c.target = {2, 1, samples};
    cases::Draw draw;
    draw.positions = {{-1, -1, 0.5F, 1}, {1, -1, 0.5F, 1}, {-1, 1, 0.5F, 1}};
    draw.viewport = {0, 0, 2, 1, 0, 1};
    draw.scissor = {0, 0, 2, 1};
    c.draws.push_back(draw);
    return c;
}

class PlaneFiles : public testing::Test {
  protected:
    void SetUp() override {
        folder_ = fs::temp_directory_path() /
                  ("edgecase-planes-" + std::to_string(::getpid()) + "-" +
                   testing::UnitTest::GetInstance()->current_test_info()->name());
        fs::remove_all(folder_);
        fs::create_directories(folder_);
    }
    void TearDown() override { fs::remove_all(folder_); }
    void write(const std::string& name, const std::string& bytes) const {
        std::ofstream(folder_ / name, std::ios::binary) << bytes;
    }
    fs::path folder_;
};

TEST(FolderOf, IdsHaveDifferentFolders) {
    EXPECT_EQ(capture::folder_of("ties/diagonal"), "ties/diagonal");
    EXPECT_EQ(capture::folder_of("ties/diagonal:k=1,zoom=0.5"), "ties/diagonal@k=1,zoom=0.5");
    EXPECT_EQ(capture::folder_of("a:k=1/2"), "a@k=1%2F2");
    EXPECT_EQ(capture::folder_of("a:k=../x"), "a@k=..%2Fx");
    EXPECT_EQ(capture::folder_of("a@k"), "a%40k");
    EXPECT_EQ(capture::folder_of("a%40k"), "a%2540k");
    EXPECT_EQ(capture::folder_of("a:b:c"), "a@b%3Ac");
}

TEST_F(PlaneFiles, SamplesOfAFileLieSampleBySample) {
    write("coverage.u8", std::string("\0\0\0\1", 4));  // samples 0 of both pixels, then samples 1
    const auto read = capture::read_planes(folder_, plain_case(2));
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(read->planes.detail, capture::HitDetail::coverage);
    EXPECT_THAT(read->planes.front, testing::ElementsAre(0, 0, 0, 1));
    write("coverage.u8", std::string("\0\1\0\0", 4));
    EXPECT_THAT(capture::read_planes(folder_, plain_case(2))->planes.front,
                testing::ElementsAre(0, 0, 1, 0));
}

TEST_F(PlaneFiles, RowsOfLayersLieLayerByLayerWithinASample) {
    cases::Case c = plain_case(2);
    c.target.layers = 2;
    // Sample 0: pixels of layer 0, of layer 1; then sample 1.
    write("coverage.u8", std::string("\0\0\1\0\0\1\0\0", 8));
    const auto read = capture::read_planes(folder_, c);
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_THAT(read->planes.front, testing::ElementsAre(0, 0, 0, 1, 1, 0, 0, 0));
    write("coverage.u8", std::string("\0\0\0\1", 4));
    EXPECT_EQ(capture::read_planes(folder_, c).error().message,
              "'" + (folder_ / "coverage.u8").string() +
                  "' has 4 bytes; 2 x 1 pixels, 2 layers, 2 samples take 8 bytes (1 channel of 1 "
                  "byte)");
    write("coverage.u8", std::string("\0\0\0\0\0\0\0\7", 8));
    EXPECT_EQ(capture::read_planes(folder_, c).error().message,
              "'" + (folder_ / "coverage.u8").string() +
                  "' holds 7 at sample 1 of layer 1, pixel (1, 0); a mask holds 0 and the largest "
                  "number of its format only");
}

TEST_F(PlaneFiles, NumbersAreLittleEndian) {
    write("writer.u32", std::string("\1\2\0\0\3\0\0\0\xff\xff\xff\xff\xff\xff\xff\xff", 16));
    const auto read = capture::read_planes(folder_, plain_case(1));
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_THAT(read->planes.draws, testing::ElementsAre(0x201, capture::kClearId));
    EXPECT_THAT(read->planes.primitives, testing::ElementsAre(3, capture::kClearId));
}

TEST_F(PlaneFiles, FloatImagesKeepTheirBits) {
    const capture::Image image{2, 1, {"Y"}, {0x1.23456p-3F, -0x1p-149F}};
    for (const char* name : {"depth.exr", "depth.tif"}) {
        ASSERT_TRUE(capture::write_image(folder_ / name, image)) << name;
        const auto read = capture::read_planes(folder_, plain_case(1));
        ASSERT_TRUE(read) << read.error().message;
        EXPECT_THAT(read->planes.depth, testing::ElementsAreArray(image.pixels)) << name;
        fs::remove(folder_ / name);
    }
}

TEST_F(PlaneFiles, ChannelsOfImagesGoByName) {
    // OpenEXR sorts channels by name: "back" stands before "front".
    ASSERT_TRUE(
        capture::write_image(folder_ / "hits.exr", {2, 1, {"front", "back"}, {1, 0, 0, 2}}));
    const auto read = capture::read_planes(folder_, plain_case(1));
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_THAT(read->planes.front, testing::ElementsAre(1, 0));
    EXPECT_THAT(read->planes.back, testing::ElementsAre(0, 2));
}

TEST_F(PlaneFiles, AnImageWithTooManyChannelsIsRefused) {
    ASSERT_TRUE(
        capture::write_image(folder_ / "depth.exr", {2, 1, {"R", "G", "B"}, {0, 0, 0, 0, 0, 0}}));
    const auto read = capture::read_planes(folder_, plain_case(1));
    ASSERT_FALSE(read);
    EXPECT_EQ(read.error().message, "'" + (folder_ / "depth.exr").string() +
                                        "' has 3 channels; the plane depth has 1 (z)");
}

TEST_F(PlaneFiles, AColouredMaskIsRefused) {
    ASSERT_TRUE(capture::write_image(folder_ / "coverage.png",
                                     {2, 1, {"R", "G", "B"}, {1, 0, 0, 0, 0, 0}}));
    EXPECT_FALSE(capture::read_planes(folder_, plain_case(1)));
}

TEST_F(PlaneFiles, UnormDepthIsACode) {
    cases::Case c = plain_case(1);
    c.target.depth_format = cases::DepthFormat::d16_unorm;
    const float near_code = static_cast<float>(1000.1 / 65535.0);
    write("depth.f32",
          std::string(reinterpret_cast<const char*>(&near_code), 4) + std::string(4, '\0'));
    EXPECT_EQ(capture::read_planes(folder_, c)->planes.depth[0],
              cases::depth_of_code(1000, cases::DepthFormat::d16_unorm));
}

TEST_F(PlaneFiles, AnEmptyFolderHoldsNothing) {
    const auto read = capture::read_planes(folder_, plain_case(1));
    ASSERT_TRUE(read);
    EXPECT_TRUE(read->planes.is_empty());
    EXPECT_TRUE(capture::read_planes(folder_ / "nowhere", plain_case(1))->planes.is_empty());
}

TEST_F(PlaneFiles, APipeIsNoPlaneThatWasLeftOut) {
    const fs::path pipe = folder_ / "depth.f32";
    ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
    write("coverage.u8", std::string("\0\1", 2));
    EXPECT_EQ(capture::read_planes(folder_, plain_case(1)).error().message,
              "'" + pipe.string() + "' is a pipe or a device; write the plane into a file");
}

TEST(ExportCase, NeedsNameWhatIsNotPlain) {
    cases::Case c = plain_case(1);
    EXPECT_THAT(capture::needs_of(c), testing::IsEmpty());
    c.draws[0].positions[0].w = 2;
    EXPECT_THAT(capture::needs_of(c), testing::ElementsAre("perspective"));
    c.draws[0].positions[0].w = -1;
    EXPECT_THAT(capture::needs_of(c), testing::Contains("clip"));
    c = plain_case(4);
    c.draws[0].positions[0].x = -3;
    c.draws[0].viewport.width = 1;
    c.draws[0].depth.compare = cases::CompareOp::less;
    EXPECT_THAT(capture::needs_of(c),
                testing::ElementsAre("samples", "beyond-viewport", "viewport", "depth-test"));
}

TEST(ExportCase, NumbersComeBackBitForBit) {
    cases::Case c = plain_case(1);
    c.draws[0].positions = {{0.1F, -0.0F, 0x1p-149F, 0x1.fffffep127F},
                            {std::nextafter(1.0F, 2.0F), 1e-38F, 16777217.0F, 3.0F},
                            {std::numeric_limits<float>::infinity(), -1.0F / 3.0F, 0, 1}};
    const auto json = nlohmann::json::parse(capture::export_case(c));
    for (size_t v = 0; v < 3; ++v) {
        for (size_t k = 0; k < 4; ++k) {
            const float want = c.draws[0].positions[v][static_cast<glm::vec4::length_type>(k)];
            const auto& got = json["draws"][0]["positions"][v][k];
            if (std::isinf(want)) {
                EXPECT_EQ(got, "inf");
            } else {
                EXPECT_EQ(std::bit_cast<uint32_t>(got.get<float>()), std::bit_cast<uint32_t>(want));
            }
            const std::string bits = json["draws"][0]["position_bits"][v];
            EXPECT_EQ(std::stoul(bits.substr(9 * k, 8), nullptr, 16),
                      std::bit_cast<uint32_t>(want));
        }
    }
}

}  // namespace
