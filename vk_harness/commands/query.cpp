// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "vk_harness/commands/query.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <thread>

#include "capture/capture.hpp"
#include "cases/model/sample.hpp"

namespace vk_harness {

using cases::Query;

namespace {

// When the submission has ended, its queries are available: waiting is for a device that is late,
// and not VK_QUERY_RESULT_WAIT_BIT, so that one that never is, is no hang.
constexpr std::chrono::milliseconds kLongestWait{500};

// What the query gives, or kNotCounted if it does not until `end`.
uint64_t read_one(const Device& device, VkQueryPool pool, uint32_t query,
                  std::chrono::steady_clock::time_point end) {
    for (;;) {
        std::array<uint64_t, 2> result{};  // the number, and whether it is there
        const VkResult read = device.vk().vkGetQueryPoolResults(
            device.get(), pool, query, 1, sizeof result, result.data(), sizeof result,
            VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WITH_AVAILABILITY_BIT);
        if (read != VK_SUCCESS && read != VK_NOT_READY) {
            fail(call_failure(Stage::readback, read, "vkGetQueryPoolResults"));
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

// The bit of a statistic; of the kinds of pools 0 is that of occlusion queries.
VkQueryPipelineStatisticFlags statistic_of(Query query) {
    static const std::map<Query, VkQueryPipelineStatisticFlagBits> kStatistics = {
        {Query::input_vertices, VK_QUERY_PIPELINE_STATISTIC_INPUT_ASSEMBLY_VERTICES_BIT},
        {Query::input_primitives, VK_QUERY_PIPELINE_STATISTIC_INPUT_ASSEMBLY_PRIMITIVES_BIT},
        {Query::vertex_invocations, VK_QUERY_PIPELINE_STATISTIC_VERTEX_SHADER_INVOCATIONS_BIT},
        {Query::clipping_invocations, VK_QUERY_PIPELINE_STATISTIC_CLIPPING_INVOCATIONS_BIT},
        {Query::clipping_primitives, VK_QUERY_PIPELINE_STATISTIC_CLIPPING_PRIMITIVES_BIT},
        {Query::fragment_invocations, VK_QUERY_PIPELINE_STATISTIC_FRAGMENT_SHADER_INVOCATIONS_BIT}};
    const auto found = kStatistics.find(query);
    return found != kStatistics.end() ? VkQueryPipelineStatisticFlags{found->second} : 0;
}

}  // namespace

// A pool has one kind of queries, and all that a case asks are as long as it has draws: those of
// other draws are not used.
Queries::Queries(const Device& device, const cases::Case& c) : device_(&device), case_(&c) {
    for (const cases::Draw& draw : c.draws) {
        if (!is_asked(draw.query) || pools_.contains(statistic_of(draw.query))) {
            continue;
        }
        VkQueryPoolCreateInfo info = Typed{VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO};
        info.pipelineStatistics = statistic_of(draw.query);
        info.queryType = info.pipelineStatistics == 0 ? VK_QUERY_TYPE_OCCLUSION
                                                      : VK_QUERY_TYPE_PIPELINE_STATISTICS;
        info.queryCount = static_cast<uint32_t>(c.draws.size());
        pools_[info.pipelineStatistics] =
            make(device, Stage::memory, "vkCreateQueryPool", device.vk().vkCreateQueryPool,
                 device.vk().vkDestroyQueryPool, info);
    }
}

bool Queries::is_asked(Query query) const {
    return query != Query::none &&
           (!cases::is_statistic(query) || case_->variation == cases::Variation{});
}

VkQueryPool Queries::pool_of(Query query) const {
    return pools_.at(statistic_of(query)).get();
}

void Queries::reset(VkCommandBuffer commands) const {
    for (const auto& [statistic, pool] : pools_) {
        device_->vk().vkCmdResetQueryPool(commands, pool.get(), 0,
                                          static_cast<uint32_t>(case_->draws.size()));
    }
}

void Queries::begin(VkCommandBuffer commands, uint32_t draw) const {
    const Query query = case_->draws[draw].query;
    if (is_asked(query)) {
        device_->vk().vkCmdBeginQuery(commands, pool_of(query), draw,
                                      query == Query::occlusion_precise
                                          ? VkQueryControlFlags{VK_QUERY_CONTROL_PRECISE_BIT}
                                          : VkQueryControlFlags{0});
    }
}

void Queries::end(VkCommandBuffer commands, uint32_t draw) const {
    if (const Query query = case_->draws[draw].query; is_asked(query)) {
        device_->vk().vkCmdEndQuery(commands, pool_of(query), draw);
    }
}

std::vector<uint64_t> Queries::read() const {
    std::vector<uint64_t> counted(case_->draws.size(), 0);
    const auto end = std::chrono::steady_clock::now() + kLongestWait;  // of all of them
    for (uint32_t k = 0; k < counted.size(); ++k) {
        const Query query = case_->draws[k].query;
        if (!is_asked(query)) {
            counted[k] = query == Query::none ? 0 : capture::kNotAsked;
            continue;
        }
        auto result = read_one(*device_, pool_of(query), k, end);
        const bool is_any = query == Query::occlusion && result != capture::kNotCounted;
        counted[k] = is_any ? std::min(result, uint64_t{1}) : result;
    }
    return counted;
}

}  // namespace vk_harness
