// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "capture/image/image.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <bit>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>

namespace capture {

namespace fs = std::filesystem;

namespace {

class ImageTest : public testing::Test {
  protected:
    ImageTest() {
        std::string name = (fs::temp_directory_path() / "edgecase-image-XXXXXX").string();
        dir_ = ::mkdtemp(name.data());
    }
    ~ImageTest() override {
        ::unsetenv("EDGECASE_IMAGE_IO");
        fs::remove_all(dir_);
    }
    fs::path dir_;
};

constexpr float kInfinity = std::numeric_limits<float>::infinity();
const Image kSpecial = {
    3,
    2,
    {"R", "G"},
    {0.0F, -0.0F, 1.0F, kInfinity, -kInfinity, std::numeric_limits<float>::quiet_NaN(), 0x1p-149F,
     0x1.fffffep127F, 0.1F, -2.5F, 1e-30F, 16777217.0F}};

TEST_F(ImageTest, exr_and_tiff_keep_every_bit) {
    for (const char* name : {"a.exr", "a.tif"}) {
        const auto written = write_image(dir_ / name, kSpecial);
        ASSERT_TRUE(written) << written.error().message;
        const auto back = read_image(dir_ / name, 3, 2);
        ASSERT_TRUE(back) << back.error().message;
        EXPECT_EQ(back->width, 3U);
        EXPECT_EQ(back->height, 2U);
        ASSERT_EQ(back->pixels.size(), kSpecial.pixels.size());
        for (size_t k = 0; k < kSpecial.pixels.size(); ++k) {
            if (std::isnan(kSpecial.pixels[k])) {
                EXPECT_TRUE(std::isnan(back->pixels[k])) << name;
            } else {
                EXPECT_EQ(std::bit_cast<uint32_t>(back->pixels[k]),
                          std::bit_cast<uint32_t>(kSpecial.pixels[k]))
                    << name << " " << k;
            }
        }
    }
    EXPECT_EQ(read_image(dir_ / "a.exr", 3, 2)->channels, kSpecial.channels);
}

TEST_F(ImageTest, an_image_of_another_size_is_not_decoded) {
    for (const char* name : {"a.exr", "a.tif", "a.png"}) {
        const Image image = {2, 2, {"Y"}, {0, 1, 1, 0}};
        ASSERT_TRUE(write_image(dir_ / name, image));
        const auto other = read_image(dir_ / name, 2, 3);
        ASSERT_TRUE(other) << other.error().message;
        EXPECT_EQ(other->width, 2U);
        EXPECT_EQ(other->height, 2U);
        EXPECT_TRUE(other->pixels.empty()) << name;
        EXPECT_EQ(read_image(dir_ / name, 2, 2)->pixels.size(), 4U) << name;
    }
}

TEST_F(ImageTest, png_clamps_and_rounds) {
    const Image image = {
        4,
        2,
        {"Y"},
        {-1, 0, 0.5F, 1, 2, kInfinity, std::numeric_limits<float>::quiet_NaN(), 0.25F}};
    ASSERT_TRUE(write_image(dir_ / "a.png", image));
    const auto back = read_image(dir_ / "a.png", 4, 2);
    ASSERT_TRUE(back) << back.error().message;
    const float expected[] = {0, 0, 128.0F / 255, 1, 1, 1, 0, 64.0F / 255};
    for (size_t k = 0; k < 8; ++k) {
        EXPECT_EQ(std::lround(back->pixels.at(k) * 255), std::lround(expected[k] * 255)) << k;
    }
}

TEST_F(ImageTest, errors_are_sentences) {
    const auto message = [](const auto& result) {
        return result ? std::string("no error") : result.error().message;
    };
    EXPECT_NE(message(write_image(dir_ / "a.bmp", kSpecial)).find("use .exr, .png or .tif"),
              std::string::npos);
    EXPECT_NE(message(write_image(dir_ / "none" / "a.exr", kSpecial)).find("cannot write"),
              std::string::npos);
    Image short_one = kSpecial;
    short_one.pixels.pop_back();
    EXPECT_NE(message(write_image(dir_ / "a.exr", short_one)).find("cannot have 11 values"),
              std::string::npos);
    std::ofstream(dir_ / "b.exr") << "not an image";
    EXPECT_NE(message(read_image(dir_ / "b.exr", 3, 2)).find("cannot read"), std::string::npos);
    EXPECT_NE(message(read_image(dir_ / "c.exr", 3, 2)).find("cannot read"), std::string::npos);
    Image wide = {1, 1, {"a", "b", "c", "d", "e"}, {0, 0, 0, 0, 0}};
    EXPECT_NE(message(write_image(dir_ / "a.png", wide)).find("at most 4"), std::string::npos);
    ::setenv("EDGECASE_IMAGE_IO", "/nonexistent.so", 1);
    EXPECT_NE(message(write_image(dir_ / "a.exr", kSpecial)).find("cannot load /nonexistent.so"),
              std::string::npos);
    ::setenv("EDGECASE_IMAGE_IO", "libm.so.6", 1);
    EXPECT_NE(message(write_image(dir_ / "a.exr", kSpecial)).find("not the image module"),
              std::string::npos);
}

}  // namespace

}  // namespace capture
