// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "vk_harness/commands/case_plan.hpp"

namespace vk_harness {

std::vector<std::pair<Guard*, std::string>> guards_of(const CasePlan& plan) {
    std::vector<std::pair<Guard*, std::string>> out;
    if (plan.blit != nullptr) {
        out.emplace_back(plan.blit->guard(), "color");
    }
    for (size_t k = 0; k < plan.images.size(); ++k) {
        if (!plan.attachments[k].is_beside_depth) {
            out.emplace_back(plan.images[k]->guard(), attachment_name(plan.attachments, k));
        }
    }
    return out;
}

std::vector<capture::StrayWrite> stray_writes(const CasePlan& plan,
                                              std::span<const GuardDamage> damage,
                                              size_t renderings) {
    std::vector<capture::StrayWrite> out;
    for (const auto& [guard, name] : guards_of(plan)) {
        for (const GuardDamage& found : damage) {
            if (found.guard == guard) {
                out.push_back({name, found.is_before, found.distance, kGuardWord, found.got,
                               found.words, static_cast<uint32_t>(renderings)});
            }
        }
    }
    return out;
}

}  // namespace vk_harness
