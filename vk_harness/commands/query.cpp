// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "vk_harness/commands/query.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <thread>

#include "capture/capture.hpp"

namespace vk_harness {

using cases::Query;

namespace {

// When the submission has ended, its queries are available: waiting is for a device that is late,
// and not VK_QUERY_RESULT_WAIT_BIT, so that one that never is, is no hang.
constexpr std::chrono::milliseconds kLongestWait{500};

// What the query gives, or kNotCounted if it does not until `end`.
Result<uint64_t> read_one(const Device& device, VkQueryPool pool, uint32_t query,
                          std::chrono::steady_clock::time_point end) {
    for (;;) {
        std::array<uint64_t, 2> result{};  // the number, and whether it is there
        const VkResult read = device.vk().vkGetQueryPoolResults(
            device.get(), pool, query, 1, sizeof result, result.data(), sizeof result,
            VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WITH_AVAILABILITY_BIT);
        if (read != VK_SUCCESS && read != VK_NOT_READY) {
            return fail(call_failure(Stage::readback, read, "vkGetQueryPoolResults"));
        }
        if (read == VK_SUCCESS && result[1] != 0) {
            return result[0];
        }
        if (std::chrono::steady_clock::now() > end) {
            return capture::kNotCounted;
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
}

}  // namespace

Result<Queries> Queries::create(const Device& device, const cases::Case& c) {
    Queries queries(device, c);
    VkQueryPoolCreateInfo info = Typed{VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO};
    info.queryType = VK_QUERY_TYPE_OCCLUSION;
    info.queryCount = static_cast<uint32_t>(c.draws.size());
    if (auto made = put(queries.pool_,
                        make(device, Stage::memory, "vkCreateQueryPool",
                             device.vk().vkCreateQueryPool, device.vk().vkDestroyQueryPool, info));
        !made) {
        return fail(made.error());
    }
    return queries;
}

void Queries::reset(VkCommandBuffer commands) const {
    device_->vk().vkCmdResetQueryPool(commands, pool_.get(), 0,
                                      static_cast<uint32_t>(case_->draws.size()));
}

void Queries::begin(VkCommandBuffer commands, uint32_t draw) const {
    const Query query = case_->draws[draw].query;
    if (query != Query::none) {
        device_->vk().vkCmdBeginQuery(commands, pool_.get(), draw,
                                      query == Query::occlusion_precise
                                          ? VkQueryControlFlags{VK_QUERY_CONTROL_PRECISE_BIT}
                                          : VkQueryControlFlags{0});
    }
}

void Queries::end(VkCommandBuffer commands, uint32_t draw) const {
    if (case_->draws[draw].query != Query::none) {
        device_->vk().vkCmdEndQuery(commands, pool_.get(), draw);
    }
}

Result<std::vector<uint64_t>> Queries::read() const {
    std::vector<uint64_t> counted(case_->draws.size(), 0);
    const auto end = std::chrono::steady_clock::now() + kLongestWait;  // of all of them
    for (uint32_t k = 0; k < counted.size(); ++k) {
        const Query query = case_->draws[k].query;
        if (query == Query::none) {
            continue;
        }
        auto result = read_one(*device_, pool_.get(), k, end);
        if (!result) {
            return fail(result.error());
        }
        const bool is_any = query == Query::occlusion && *result != capture::kNotCounted;
        counted[k] = is_any ? std::min(*result, uint64_t{1}) : *result;
    }
    return counted;
}

}  // namespace vk_harness
