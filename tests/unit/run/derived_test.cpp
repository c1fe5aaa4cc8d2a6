// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What other bits of a picture through a door amount to, by what its promise is and what of the two
// pictures is wrong.
#include "run/worker/derived.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "cases/load/loader.hpp"
#include "rasterizers/renderer/renderers.hpp"

namespace run {
namespace {

using capture::Rendered;
using Alter = std::function<void(capture::Capture&)>;

// A device that draws rightly, after which one picture is altered.
class Altered : public capture::Renderer {
  public:
    Altered(Alter plain, Alter door) : plain_(std::move(plain)), door_(std::move(door)) {
        capture::RendererOptions options;
        options.renderer = "software";
        inner_ = std::move(*rasterizers::software_renderer(options));
    }
    const capture::DeviceInfo& device() const override { return inner_->device(); }
    std::string lacking(const cases::Case&) const override { return ""; }
    std::vector<Rendered> render(std::span<const cases::Case> batch, capture::PlaneSet planes,
                                 const capture::Step& step,
                                 const capture::PlaneStore& /*store*/) override {
        std::vector<cases::Case> plain(batch.begin(), batch.end());
        for (cases::Case& c : plain) {
            c.variation = {};
        }
        std::vector<Rendered> out = inner_->render(plain, planes, step, {});
        for (size_t k = 0; k < out.size(); ++k) {
            const Alter& alter = batch[k].variation.door == cases::Door::none ? plain_ : door_;
            if (alter) {
                alter(out[k].capture);
            }
        }
        return out;
    }

  private:
    Alter plain_, door_;
    std::unique_ptr<capture::Renderer> inner_;
};

constexpr size_t kSample = 8 + 1;  // pixel (1, 1) of 8 x 4, inside

void spoil_value(capture::Capture& c) {
    c.attributes[0][kSample].x += 0.5F;
}
void step_value(capture::Capture& c) {
    float& value = c.attributes[0][kSample].x;
    value = std::nextafter(value, 2.0F);
}

constexpr const char* kPlain =
    "size = [8, 4]\n[[draw]]\nvertices = [[0,0],[8,0],[0,4]]\n[[draw.attribute]]\n"
    "values = [0, 1, \"1/3\"]\n";

diff::Consistency judged(const std::string& door, Alter plain, Alter through_door,
                         const std::string& target = kPlain) {
    const auto loaded = cases::load_text(
        "format = 1\ndescription = \"d\"\nrules = [\"cover.inside\"]\n"
        "relations = [{ doors = [\"" +
            door + "\"] }]\n[target]\n" + target,
        "f", "id");
    EXPECT_TRUE(loaded) << to_string(loaded.error().front());
    Altered device(std::move(plain), std::move(through_door));
    const auto drawn = render_with_derived(device, *loaded, [](std::string_view) {}, {});
    EXPECT_EQ(drawn[0].rendered.status, Rendered::Status::drawn) << drawn[0].rendered.reason;
    return drawn[0].consistency.at(0);
}

// Draws nothing, and remembers what it was asked for.
class Asked : public capture::Renderer {
  public:
    const capture::DeviceInfo& device() const override { return device_; }
    std::string lacking(const cases::Case&) const override { return ""; }
    std::vector<Rendered> render(std::span<const cases::Case> batch, capture::PlaneSet /*planes*/,
                                 const capture::Step& /*step*/,
                                 const capture::PlaneStore& /*store*/) override {
        for (const cases::Case& c : batch) {
            doors.push_back(c.variation.door != cases::Door::none);
        }
        return std::vector<Rendered>(batch.size());
    }
    std::vector<bool> doors;  // whether each picture is one through a door

  private:
    capture::DeviceInfo device_;
};

// A submission has few pictures through doors, and what is drawn twice the same is to be in one.
TEST(Derived, DoorsComeBehindAllOtherPictures) {
    const auto loaded = cases::load_text(
        "format = 1\ndescription = \"d\"\nrules = [\"cover.inside\"]\n"
        "relations = [{ doors = [\"index-16\", \"geometry\"] }, \"same-twice\"]\n"
        "[target]\nsize = [8, 4]\n[[draw]]\nvertices = [[0,0],[8,0],[0,4]]\n",
        "f", "id");
    ASSERT_TRUE(loaded) << to_string(loaded.error().front());
    Asked device;
    render_with_derived(device, {loaded->front(), loaded->front()}, [](std::string_view) {}, {});
    // The two cases, each again, their doors; then each once more in a later submission.
    EXPECT_EQ(device.doors, (std::vector<bool>{false, false, false, false, true, true, true, true,
                                               false, false}));
}

TEST(Derived, TheSameBitsAreNoDifference) {
    for (const char* door : {"index-16", "unoptimized", "geometry"}) {
        const diff::Consistency found = judged(door, {}, {});
        EXPECT_GT(found.compared, 0U) << door;
        EXPECT_EQ(found.different, 0U) << door;
    }
}

TEST(Derived, OtherBitsOfARightPictureCountByThePromise) {
    EXPECT_EQ(judged("index-16", {}, step_value).different, 1U);
    const diff::Consistency of_picture = judged("unoptimized", {}, step_value);
    EXPECT_EQ(of_picture.different, 1U);
    EXPECT_EQ(of_picture.wrong, "");
    EXPECT_EQ(judged("geometry", {}, step_value).different, 0U);
}

TEST(Derived, AWrongPictureIsToldThroughEachDoor) {
    for (const char* door : {"unoptimized", "geometry"}) {
        const diff::Consistency found = judged(door, {}, spoil_value);
        EXPECT_EQ(found.different, 1U) << door;
        EXPECT_TRUE(found.wrong.starts_with("interp.perspective at (1, 1)")) << found.wrong;
    }
}

TEST(Derived, ARightPictureIsNoFaultOfTheDoorWhereThePlainOneIsWrong) {
    EXPECT_EQ(judged("index-16", spoil_value, {}).different, 1U);
    EXPECT_EQ(judged("unoptimized", spoil_value, {}).different, 0U);
    EXPECT_EQ(judged("geometry", spoil_value, {}).different, 0U);
}

// At profile vulkan this sliver need not cover its sample, so that nothing of the picture is wrong
// there. A hunt of lavapipe told such a case of a tessellated draw as not conformant.
TEST(Derived, WhereNothingMustBeCoveredNothingIsWrong) {
    const std::string sliver =
        "size = [1, 1]\nsamples = 4\n[[draw]]\nvertices = [[6.25,9.75],[-2,-3.25],[7,10]]\n"
        "[[draw.attribute]]\nvalues = [0, 0, 1]\n";
    const Alter step = [](capture::Capture& c) {
        float& value = c.attributes[0][3].x;
        ASSERT_NE(value, capture::kClearValue);
        value = std::nextafter(value, 2.0F);
    };
    EXPECT_EQ(judged("tessellation", nullptr, step, sliver).different, 0U);
    const diff::Consistency other = judged("state-static", nullptr, step, sliver);
    EXPECT_EQ(other.different, 1U);
    EXPECT_EQ(other.wrong, "");
}

TEST(Derived, WhatThePlainPictureDoesWrongTooIsNoFaultOfAStage) {
    const Alter both = [](capture::Capture& c) {
        spoil_value(c);
        step_value(c);
    };
    EXPECT_EQ(judged("geometry", spoil_value, both).different, 0U);
}

// Whatever a device claims, the reference gets numbers that it can judge by.
TEST(Limits, AreKeptToWhatTheReferenceKnows) {
    capture::DeviceInfo device;
    const ref::Limits few = limits_of(device);
    EXPECT_EQ(few.subpixel_bits, 4);
    EXPECT_EQ(few.interpolation_offset_bits, 4);
    EXPECT_EQ(few.mipmap_bits, 4);
    EXPECT_EQ(few.viewport_bits, 0);
    device.subpixel_bits = device.interpolation_offset_bits = device.mipmap_bits =
        device.viewport_subpixel_bits = ~0U;
    const ref::Limits many = limits_of(device);
    EXPECT_EQ(many.subpixel_bits, 16);
    EXPECT_EQ(many.interpolation_offset_bits, 64);
    EXPECT_EQ(many.mipmap_bits, 64);
    EXPECT_EQ(many.viewport_bits, 16);
    EXPECT_EQ(ref::limits_of(0, "").subpixel_bits, 4);
}

}  // namespace
}  // namespace run
