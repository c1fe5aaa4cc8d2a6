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
#include <tl/expected.hpp>
#include <vector>

#include "capture/capture.hpp"
#include "cases/model/case.hpp"
#include "cases/model/sample.hpp"

namespace vk_harness {

// A limit that is not as Vulkan requires it, as texts: "maxViewports", "at least 16", "8", "of a
// device with the feature multiViewport".
struct WrongLimit {
    std::string name, required, claimed, of;
    static void fields(auto&& visit, auto&... w) {
        visit("name", w.name...);
        visit("required", w.required...);
        visit("claimed", w.claimed...);
        visit("of", w.of...);
    }
};

// What a report has to say about a device.
struct DeviceInfo {
    uint32_t index = 0;
    std::string name, driver_name, driver_info, uuid;  // uuid: 32 hex digits
    uint32_t vendor_id = 0, device_id = 0, api_version = 0, driver_version = 0, driver_id = 0;
    std::string device_type;  // "cpu", "discrete-gpu", ...
    uint32_t subpixel_bits = 0, viewport_subpixel_bits = 0, max_color_attachments = 0,
             max_target_size = 0;
    uint32_t interpolation_offset_bits = 0, mipmap_bits = 0;  // of interpolateAtOffset, of a LOD
    bool has_primitive_id = false;                            // the feature geometryShader
    bool has_first_strip_order = false;   // triStripVertexOrderIndependentOfProvokingVertex
    bool has_conservative = false;        // VK_EXT_conservative_rasterization, with
    bool has_underestimation = false;     // primitiveUnderestimation,
    bool rasterizes_degenerates = false;  // degenerateTrianglesRasterized,
    // primitiveOverestimationSize, extraPrimitiveOverestimationSizeGranularity and
    // maxExtraPrimitiveOverestimationSize, pixels.
    float overestimation = 0, overestimation_step = 0, most_overestimation = 0;
    // Without standardSampleLocations: where it says by gl_SamplePosition that its samples are, one
    // list a sample count. Of an opened device (Renderer::device()) alone.
    std::vector<cases::SampleLocations> sample_locations = {};
    std::string sample_locations_error;  // why it could not be asked, though it promises to answer
    std::string hit_counting = "binary32";  // the numbers in which hits are added up, or binary16
    // The depth that stands beside a stencil where a case names no format: of D32S8, or of D24S8.
    std::string depth_beside_stencil = "d32-float";
    // Without the first, cases are rendered by render pass objects; without the second, pipelines
    // hold the state that Vulkan 1.0 does not set between draws.
    bool has_dynamic_rendering = true, has_dynamic_state = true;
    std::vector<WrongLimit> wrong_limits;
    std::vector<std::string> missing;  // features without which no case can run, one sentence each
    static void fields(auto&& visit, auto&... d) {
        visit("index", d.index...);
        visit("name", d.name...);
        visit("driver_name", d.driver_name...);
        visit("driver_info", d.driver_info...);
        visit("uuid", d.uuid...);
        visit("device_type", d.device_type...);
        visit("vendor_id", d.vendor_id...);
        visit("device_id", d.device_id...);
        visit("api_version", d.api_version...);
        visit("driver_version", d.driver_version...);
        visit("driver_id", d.driver_id...);
        visit("subpixel_bits", d.subpixel_bits...);
        visit("viewport_subpixel_bits", d.viewport_subpixel_bits...);
        visit("max_color_attachments", d.max_color_attachments...);
        visit("max_target_size", d.max_target_size...);
        visit("interpolation_offset_bits", d.interpolation_offset_bits...);
        visit("mipmap_bits", d.mipmap_bits...);
        visit("has_primitive_id", d.has_primitive_id...);
        visit("has_first_strip_order", d.has_first_strip_order...);
        visit("has_conservative", d.has_conservative...);
        visit("has_underestimation", d.has_underestimation...);
        visit("rasterizes_degenerates", d.rasterizes_degenerates...);
        visit("overestimation", d.overestimation...);
        visit("overestimation_step", d.overestimation_step...);
        visit("most_overestimation", d.most_overestimation...);
        visit("sample_locations", d.sample_locations...);
        visit("sample_locations_error", d.sample_locations_error...);
        visit("hit_counting", d.hit_counting...);
        visit("depth_beside_stencil", d.depth_beside_stencil...);
        visit("has_dynamic_rendering", d.has_dynamic_rendering...);
        visit("has_dynamic_state", d.has_dynamic_state...);
        visit("wrong_limits", d.wrong_limits...);
        visit("missing", d.missing...);
    }
};

enum class Stage { loader, instance, device, shader, pipeline, memory, submit, readback };
std::string_view to_string(Stage stage);

// What went wrong in Vulkan.
struct Failure {
    Stage stage = Stage::loader;
    int vk_result = 0;                 // VkResult, 0 if none
    std::string message;               // one sentence: what, and what to do
    std::vector<std::string> reasons;  // one a rejected device
    static void fields(auto&& visit, auto&... f) {
        visit("stage", f.stage...);
        visit("vk_result", f.vk_result...);
        visit("message", f.message...);
        visit("reasons", f.reasons...);
    }
};
template <class T>
using Result = tl::expected<T, Failure>;

struct Options {
    std::string device;    // "" = first usable; an index, a part of the name, or a UUID
    std::string icd_file;  // not empty: VK_DRIVER_FILES / VK_ICD_FILENAMES are set to it
    bool validation =
        false;  // the Khronos validation layer; its messages end up in Rendered::messages
    // The device that a run began with, so that a later worker finds the same among several that
    // have the name, in whatever order they are enumerated then. Empty: any.
    std::string pinned_uuid;
    uint32_t pinned_driver =
        0;  // its DeviceInfo::driver_id: two drivers of one device share a UUID
    uint64_t longest_wait_ms = 0;  // for what was submitted; 0: without end
    static void fields(auto&& visit, auto&... o) {
        visit("device", o.device...);
        visit("icd_file", o.icd_file...);
        visit("validation", o.validation...);
        visit("pinned_uuid", o.pinned_uuid...);
        visit("pinned_driver", o.pinned_driver...);
        visit("longest_wait_ms", o.longest_wait_ms...);
    }
};

// All devices of the machine; for doctor and for error texts.
Result<std::vector<DeviceInfo>> list_devices(const Options& options);

// The outcome for one case.
struct Rendered {
    // not_built: an error of its own kind; no shader was built for the combination of features.
    enum class Status { drawn, unsupported, device_lost, not_built, error } status = Status::error;
    std::string reason;                 // of all but drawn
    capture::Capture capture;           // if drawn
    std::span<std::byte> placed;        // if not empty: the capture's planes, which are not in it
    std::vector<std::string> messages;  // of the validation layer
    std::vector<capture::StrayWrite> stray_writes;  // if drawn: one a side of an attachment at most
    static void fields(auto&& visit, auto&... r) {
        visit("status", r.status...);
        visit("reason", r.reason...);
        visit("capture", r.capture...);
        visit({"placed", cases::kNotOnWire}, r.placed...);  // an address
        visit("messages", r.messages...);
        visit("stray_writes", r.stray_writes...);
    }
};

// Memory for the planes of case `slot` of the batch, capture::plane_bytes() long and aligned to 16;
// empty if they shall lie in Rendered::capture.
using PlaneStore = std::function<std::span<std::byte>(size_t slot, uint64_t bytes)>;

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

template <>
inline constexpr size_t cases::kValueCount<vk_harness::Stage> = 8;
template <>
inline constexpr size_t cases::kValueCount<vk_harness::Rendered::Status> = 5;
