// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What draws in a worker: a Vulkan driver, or for the tests of the runner the reference itself.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "rasterizers/captures.hpp"
#include "run/worker/message.hpp"
#include "vk_harness/public/harness.hpp"

namespace run {

class Backend {
  public:
    virtual ~Backend() = default;
    virtual const capture::DeviceInfo& device() const = 0;
    // Why a case cannot be drawn, one sentence; empty if it can.
    virtual std::string lacking(const cases::Case& c) const = 0;
    virtual std::vector<capture::Rendered> render(const std::vector<cases::Case>& batch,
                                                  const std::function<void(std::string_view)>& step,
                                                  const capture::PlaneStore& store) = 0;
};

// The renderer "software" is the software rasterizer; choices of it may follow:
// "software:ties=top-right,fused=yes".
inline constexpr std::string_view kSoftware = "software";

capture::Result<std::unique_ptr<Backend>> make_backend(const WorkerOptions& options);

}  // namespace run
