// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The layer's versions of the commands of queries. What they counted is altered where it is read.
#include <cstring>
#include <map>
#include <mutex>

#include "altering.hpp"
#include "recording.hpp"

namespace breaking {

namespace {

struct Begun {
    VkQueryControlFlags flags = 0;
    bool in_secondary = false, before_pipeline = false;
};

std::mutex mutex;
std::map<std::pair<VkQueryPool, uint32_t>, Begun> begun;
std::map<VkQueryPool, uint64_t> counted;  // by the queries of the pool that were read
std::map<VkQueryPool, VkQueryPipelineStatisticFlags> statistics_of;

VKAPI_ATTR VkResult VKAPI_CALL create_query_pool(VkDevice device, const VkQueryPoolCreateInfo* info,
                                                 const VkAllocationCallbacks* allocator,
                                                 VkQueryPool* pool) {
    const VkResult result = driver_of_handle(device).CreateQueryPool(device, info, allocator, pool);
    if (result == VK_SUCCESS) {
        const std::lock_guard lock(mutex);
        statistics_of[*pool] =
            info->queryType == VK_QUERY_TYPE_PIPELINE_STATISTICS ? info->pipelineStatistics : 0;
    }
    return result;
}

VKAPI_ATTR void VKAPI_CALL begin_query(VkCommandBuffer commands, VkQueryPool pool, uint32_t query,
                                       VkQueryControlFlags flags) {
    {
        const std::lock_guard lock(mutex);
        const Recording& recording = recording_of(commands);
        begun[{pool, query}] = {flags, recording.is_secondary, !recording.has_pipeline};
    }
    driver_of_handle(commands).CmdBeginQuery(commands, pool, query, flags);
}

VKAPI_ATTR void VKAPI_CALL reset_query_pool(VkCommandBuffer commands, VkQueryPool pool,
                                            uint32_t first, uint32_t count) {
    {
        const std::lock_guard lock(mutex);
        counted.erase(pool);
    }
    driver_of_handle(commands).CmdResetQueryPool(commands, pool, first, count);
}

VKAPI_ATTR VkResult VKAPI_CALL get_query_pool_results(VkDevice device, VkQueryPool pool,
                                                      uint32_t first, uint32_t count, size_t size,
                                                      void* data, VkDeviceSize stride,
                                                      VkQueryResultFlags flags) {
    const VkResult result = driver_of_handle(device).GetQueryPoolResults(device, pool, first, count,
                                                                         size, data, stride, flags);
    if (result != VK_SUCCESS || (flags & VK_QUERY_RESULT_64_BIT) == 0) {
        return result;
    }
    const std::lock_guard lock(mutex);
    for (uint32_t k = 0; k < count; ++k) {
        auto* at = static_cast<std::byte*>(data) + k * stride;
        QueryResult own;
        std::memcpy(&own.count, at, sizeof own.count);
        const Begun& how = begun[{pool, first + k}];
        own.statistics = statistics_of[pool];
        own.is_precise = (how.flags & VK_QUERY_CONTROL_PRECISE_BIT) != 0;
        own.in_secondary = how.in_secondary;
        own.before_pipeline = how.before_pipeline;
        own.before = counted[pool];
        counted[pool] += own.count;
        alter(hooks().query_result, own);
        std::memcpy(at, &own.count, sizeof own.count);
    }
    return result;
}

const OwnCommand kQueryCommands[] = {
    BREAKING_OWN(CreateQueryPool, create_query_pool),
    BREAKING_OWN(CmdBeginQuery, begin_query),
    BREAKING_OWN(CmdResetQueryPool, reset_query_pool),
    BREAKING_OWN(GetQueryPoolResults, get_query_pool_results),
};

}  // namespace

std::span<const OwnCommand> query_commands() {
    return kQueryCommands;
}

}  // namespace breaking
