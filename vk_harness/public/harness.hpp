// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Headless Vulkan 1.3: draws cases on a real driver and reads every sample back. Used only in
// child processes (workers, and the bare drawing of `bench`); nothing else in the program loads the
// Vulkan loader (through volk, at run time).
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "capture/renderer.hpp"

namespace vk_harness {

using capture::DeviceInfo;
using capture::Failure;
using capture::PlaneStore;
using capture::Rendered;
using capture::Result;
using capture::Stage;
using capture::WrongLimit;
using Options = capture::RendererOptions;

// All devices of the machine; for doctor and for error texts.
Result<std::vector<DeviceInfo>> list_devices(const Options& options);

class Renderer {
  public:
    static Result<Renderer> create(const Options& options);
    ~Renderer();
    Renderer(Renderer&&) noexcept;

    const DeviceInfo& device() const;

    // Why a case must not be drawn on the device, one sentence; empty if it may be.
    std::string lacking(const cases::Case& c) const;

    // Draws the cases in one submission and reads each back. Results in the order of the cases.
    // `step` is called with the name of each stage before it starts: "pipeline", "record",
    // "submit", "readback"; again for each part if the batch needs more memory than one submission
    // may take. `store`, if any, says where the planes go.
    std::vector<Rendered> render(std::span<const cases::Case> batch,
                                 const std::function<void(std::string_view)>& step,
                                 const PlaneStore& store = {});

    // As render, without read-back and without capture memory traffic: the bare cost of drawing,
    // for benchmarks. Returns how many cases were drawn (those that the device does not support are
    // left out), or why one that it supports could not be drawn.
    Result<size_t> render_bare(std::span<const cases::Case> batch);

  private:
    struct Impl;
    explicit Renderer(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> impl_;
};

}  // namespace vk_harness
