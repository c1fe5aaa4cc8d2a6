// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "vk_harness/device/device.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <iostream>

#include "hand_case.hpp"

namespace vk_harness::testing {
namespace {

TEST(Stages, NamesAreTheEnumerators) {
    EXPECT_EQ(to_string(Stage::loader), "loader");
    EXPECT_EQ(to_string(Stage::instance), "instance");
    EXPECT_EQ(to_string(Stage::device), "device");
    EXPECT_EQ(to_string(Stage::shader), "shader");
    EXPECT_EQ(to_string(Stage::pipeline), "pipeline");
    EXPECT_EQ(to_string(Stage::memory), "memory");
    EXPECT_EQ(to_string(Stage::submit), "submit");
    EXPECT_EQ(to_string(Stage::readback), "readback");
}

TEST(Devices, AreDescribed) {
    const auto devices = list_devices({});
    ASSERT_TRUE(devices) << devices.error().message;
    ASSERT_FALSE(devices->empty());
    for (const DeviceInfo& info : *devices) {
        EXPECT_FALSE(info.name.empty());
        EXPECT_EQ(info.uuid.size(), 32U);
        EXPECT_GE(info.subpixel_bits, 4U);  // the least that Vulkan allows
    }
    const DeviceInfo& used = renderer().device();
    EXPECT_THAT(used.missing, ::testing::IsEmpty());
    EXPECT_GE(used.max_color_attachments, 4U);
    EXPECT_GE(used.max_target_size, 4096U);
}

TEST(Devices, AreChosenByIndexNameAndUuid) {
    const DeviceInfo& used = renderer().device();
    std::string name = used.name.substr(1, 6);
    std::transform(name.begin(), name.end(), name.begin(),
                   [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
    std::string dashed = used.uuid;
    dashed.insert(8, 1, '-');
    for (const std::string& wanted : {std::to_string(used.index), name, used.uuid, dashed}) {
        Options options;
        options.device = wanted;
        const auto chosen = make_renderer(options);
        ASSERT_TRUE(chosen) << wanted << ": " << chosen.error().message;
        EXPECT_EQ((*chosen)->device().uuid, used.uuid) << wanted;
    }
}

// Later workers get what the first one found, whatever is enumerated first then.
TEST(Devices, ARunIsPinnedToItsDeviceAndDriver) {
    const DeviceInfo& used = renderer().device();
    Options options;
    EXPECT_TRUE(is_pinned(options, used));
    EXPECT_EQ(used.key, used.uuid + ":" + std::to_string(used.driver_id));
    options.pinned = used.key;
    EXPECT_TRUE(is_pinned(options, used));
    EXPECT_TRUE(make_renderer(options));
    DeviceInfo other = used;
    other.key =
        used.uuid + ":" + std::to_string(used.driver_id + 1);  // another driver of the same device
    EXPECT_FALSE(is_pinned(options, other));
    options.pinned.front() = options.pinned.front() == '0' ? '1' : '0';
    const auto chosen = make_renderer(options);
    ASSERT_FALSE(chosen);
    EXPECT_THAT(chosen.error().message,
                ::testing::HasSubstr("the device that the run began with (UUID " +
                                     options.pinned.substr(0, used.uuid.size()) +
                                     ") is not there any more"));
}

TEST(Devices, EveryRejectionHasAReason) {
    Options options;
    options.device = "no such device";
    const auto chosen = make_renderer(options);
    ASSERT_FALSE(chosen);
    EXPECT_EQ(chosen.error().stage, Stage::device);
    EXPECT_EQ(
        chosen.error().message,
        "no usable Vulkan device is called 'no such device'; give an index, a part of the name, "
        "or a UUID");
    const auto devices = list_devices({});
    ASSERT_TRUE(devices);
    ASSERT_EQ(chosen.error().reasons.size(), devices->size());
    EXPECT_EQ(chosen.error().reasons[0],
              "device 0 (" + (*devices)[0].name + "): not the device that was asked for");
}

TEST(DevicesDeathTest, AMissingDriverFileIsSaid) {
    // In a process of its own: the environment of this one stays.
    GTEST_FLAG_SET(death_test_style, "threadsafe");
    EXPECT_EXIT(
        {
            Options options;
            options.icd = "/no/such/driver.json";
            const auto made = make_renderer(options);
            if (!made) {
                std::cerr << to_string(made.error().stage) << ": " << made.error().message << '\n';
            }
            std::exit(made ? 1 : 0);
        },
        ::testing::ExitedWithCode(0),
        "the loader could not use the driver that was chosen, '/no/such/driver.json'");
}

TEST(Devices, SeveralRenderersAtATime) {
    auto first = make_renderer({});
    auto second = make_renderer({});
    ASSERT_TRUE(first && second);
    const std::vector<cases::Case> batch = {make_case({32, 32, 1}, half_square())};
    for (capture::Renderer* each : {first->get(), second->get(), first->get()}) {
        const auto results = each->render(batch);
        ASSERT_EQ(results[0].status, Rendered::Status::drawn);
        EXPECT_EQ(count(results[0].capture).back, 136U);
    }
}

}  // namespace
}  // namespace vk_harness::testing
