// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Datasheets of the software rasterizer.
#pragma once

#include <algorithm>
#include <string_view>
#include <vector>

#include "probe/probe.hpp"
#include "rasterizers/software/choice/device.hpp"
#include "rasterizers/strength/strength.hpp"

namespace probe {

inline Draw draws_as(const software::Device& device) {
    return [device](std::vector<cases::Case> cases) {
        std::vector<Drawn> out;
        for (const cases::Case& c : cases) {
            out.push_back({software::captured(c, device), {}});
        }
        return out;
    };
}

inline Promises promises_of(const software::Device& device) {
    Promises promises;
    promises.limits.subpixel_bits = device.subpixel_bits;
    promises.limits.mipmap_bits = 8;
    promises.has_primitive_id = true;
    return promises;
}

// Only these experiments, or all without any.
inline Datasheet sheet_of(const software::Device& device,
                          const std::vector<std::string_view>& only = {}) {
    return measure(draws_as(device), promises_of(device), [&](std::string_view name) {
        return only.empty() || std::find(only.begin(), only.end(), name) != only.end();
    });
}

}  // namespace probe
