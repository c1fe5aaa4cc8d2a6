// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "vk_harness/public/harness.hpp"

namespace vk_harness {

// Why a case must not be drawn: the device lacks something, or the case is invalid.
struct Rejection {
    Rendered::Status status = Rendered::Status::unsupported;
    std::string reason;
};

}  // namespace vk_harness
