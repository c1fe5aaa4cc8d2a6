// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// A renderer: what it is, what it lacks for a case, and drawing a batch of cases. Its kinds are the
// rows of a table (cli/renderers/renderers.hpp).
#pragma once

#include <bitset>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <tl/expected.hpp>
#include <vector>

#include "capture/capture.hpp"
#include "cases/model/case.hpp"
#include "cases/model/door.hpp"

namespace capture {

// Planes by their numbers (capture.hpp).
using PlaneSet = std::bitset<kPlaneNumbers>;
inline const PlaneSet kEveryPlane = PlaneSet().set();

// A limit that is not as the renderer's API requires it, as texts: "maxViewports", "at least 16",
// "8", "of a device with the feature multiViewport".
struct WrongLimit {
    std::string name, required, claimed, of;
    static void fields(auto&& visit, auto&... w) {
        visit("name", w.name...);
        visit("claimed", w.claimed...);
        visit("required", w.required...);
        visit("of", w.of...);
    }
};

// What a renderer says of its device. Numbers that its API has no word for are 0.
struct DeviceInfo {
    std::string name, driver_name, driver_info, uuid;  // uuid: 32 hex digits
    std::string type;                                  // "cpu", "discrete-gpu", ...
    std::string api_version;  // of Vulkan, "1.3.230"; empty: it draws by no Vulkan
    uint32_t vendor_id = 0, device_id = 0, driver_version = 0, driver_id = 0;
    uint32_t subpixel_bits = 0, viewport_subpixel_bits = 0;
    bool has_primitive_id = false;  // gl_PrimitiveID
    // Its own, as cases::to_text has them, where it promises no standard ones; of an opened device
    // (Renderer::device()) alone.
    std::string sample_locations;
    // The depth beside a stencil where a case names no format: of D32S8, or of D24S8.
    std::string depth_beside_stencil = "d32-float";

    // Of the same device a later worker has the same key, in whatever order devices are found then.
    std::string key;
    uint32_t index = 0;
    uint32_t max_color_attachments = 0, max_target_size = 0;
    uint32_t interpolation_offset_bits = 0, mipmap_bits = 0;  // of interpolateAtOffset, of a LOD
    bool has_first_strip_order = false;  // a strip's order is that of a first provoking vertex
    // Of conservative rasterization: triangles without area drawn; overestimation and the step in
    // which it grows, pixels.
    bool rasterizes_degenerates = false;
    float overestimation = 0, overestimation_step = 0;
    std::string sample_locations_error;  // why it could not be asked, though it promises to answer
    std::string hit_counting = "binary32";  // the numbers in which hits are added up, or binary16
    // Without the first, cases are rendered by render pass objects; without the second, pipelines
    // hold the state that Vulkan 1.0 does not set between draws.
    bool has_dynamic_rendering = true, has_dynamic_state = true;
    std::vector<WrongLimit> wrong_limits;
    std::vector<std::string> missing;  // features without which no case can run, one sentence each
    static void fields(auto&& visit, auto&... d) {
        visit("name", d.name...);
        visit("driver_name", d.driver_name...);
        visit("driver_info", d.driver_info...);
        visit("uuid", d.uuid...);
        visit("type", d.type...);
        visit("api_version", d.api_version...);
        visit("vendor_id", d.vendor_id...);
        visit("device_id", d.device_id...);
        visit("driver_version", d.driver_version...);
        visit("driver_id", d.driver_id...);
        visit("subpixel_bits", d.subpixel_bits...);
        visit("viewport_subpixel_bits", d.viewport_subpixel_bits...);
        visit("has_primitive_id", d.has_primitive_id...);
        visit("sample_locations", d.sample_locations...);
        visit("depth_beside_stencil", d.depth_beside_stencil...);
        visit({"key", cases::kNotReported}, d.key...);
        visit({"index", cases::kNotReported}, d.index...);
        visit({"max_color_attachments", cases::kNotReported}, d.max_color_attachments...);
        visit({"max_target_size", cases::kNotReported}, d.max_target_size...);
        visit({"interpolation_offset_bits", cases::kNotReported}, d.interpolation_offset_bits...);
        visit({"mipmap_bits", cases::kNotReported}, d.mipmap_bits...);
        visit({"has_first_strip_order", cases::kNotReported}, d.has_first_strip_order...);
        visit({"rasterizes_degenerates", cases::kNotReported}, d.rasterizes_degenerates...);
        visit({"overestimation", cases::kNotReported}, d.overestimation...);
        visit({"overestimation_step", cases::kNotReported}, d.overestimation_step...);
        visit({"sample_locations_error", cases::kNotReported}, d.sample_locations_error...);
        visit({"hit_counting", cases::kNotReported}, d.hit_counting...);
        visit({"has_dynamic_rendering", cases::kNotReported}, d.has_dynamic_rendering...);
        visit({"has_dynamic_state", cases::kNotReported}, d.has_dynamic_state...);
        visit({"wrong_limits", cases::kNotReported}, d.wrong_limits...);
        visit({"missing", cases::kNotReported}, d.missing...);
    }
};

enum class Stage { loader, instance, device, shader, pipeline, memory, submit, readback };
std::string_view to_string(Stage stage);

// Why a renderer cannot draw, or not any more.
struct Failure {
    Stage stage = Stage::loader;
    std::string message;               // one sentence: what, and what to do
    std::vector<std::string> reasons;  // one a rejected device
    std::string code;                  // "VkResult -4", of the call that failed, if one did
    bool is_lost = false;              // the device draws nothing any more
    static void fields(auto&& visit, auto&... f) {
        visit("stage", f.stage...);
        visit("message", f.message...);
        visit("reasons", f.reasons...);
        visit("code", f.code...);
        visit("is_lost", f.is_lost...);
    }
};
template <class T>
using Result = tl::expected<T, Failure>;

// Which renderer, and which of its devices.
struct RendererOptions {
    std::string renderer;            // a row of the table, with choices behind a ':'; "": the first
    std::string device;              // "" = first usable; an index, a part of the name, or a UUID
    std::string icd;                 // not empty: the manifest of the driver, and no other
    std::string icd_from = "--icd";  // the option or the variable that chose it
    bool validation = false;         // what a layer says of the calls ends up in Rendered::messages
    std::string pinned;  // DeviceInfo::key of the device that the run began with; empty: any
    uint64_t longest_wait_ms = 0;  // for what was submitted; 0: without end
    static void fields(auto&& visit, auto&... o) {
        visit("renderer", o.renderer...);
        visit("device", o.device...);
        visit("icd", o.icd...);
        visit("icd_from", o.icd_from...);
        visit("validation", o.validation...);
        visit("pinned", o.pinned...);
        visit("longest_wait_ms", o.longest_wait_ms...);
    }
};

// The outcome for one case.
struct Rendered {
    // not_built: an error of its own kind; no shader was built for the combination of features.
    enum class Status { drawn, unsupported, device_lost, not_built, error } status = Status::error;
    std::string reason;                 // of unsupported, device_lost, error
    Capture capture;                    // if drawn
    std::span<std::byte> placed;        // if not empty: the capture's planes, which are not in it
    std::vector<std::string> messages;  // of a validation layer
    std::vector<StrayWrite> stray_writes;  // if drawn: one a side of an attachment at most
    static void fields(auto&& visit, auto&... r) {
        visit("status", r.status...);
        visit("reason", r.reason...);
        visit("capture", r.capture...);
        visit({"placed", cases::kNotOnWire}, r.placed...);  // an address
        visit("messages", r.messages...);
        visit("stray_writes", r.stray_writes...);
    }
};
// What came of one case: a picture, or one sentence that says why there is none.
struct Drawn {
    std::optional<Capture> picture;
    std::string why_not;
};
// Draws cases with a renderer, wherever that is.
using Draw = std::function<std::vector<Drawn>(std::vector<cases::Case>)>;

// The capture of a drawn case, wherever its planes lie.
CaptureView view_of(const Rendered& rendered);

// Memory for the planes of case `slot` of the batch, plane_bytes() long and aligned to 16; empty if
// they shall lie in Rendered::capture.
using PlaneStore = std::function<std::span<std::byte>(size_t slot, uint64_t bytes)>;

// Hears the name of each stage of drawing before it starts: "pipeline", "record", "submit",
// "readback"; again for each part of a batch that is drawn in several.
using Step = std::function<void(std::string_view)>;

class Renderer {
  public:
    Renderer() = default;
    Renderer(const Renderer&) = delete;
    Renderer& operator=(const Renderer&) = delete;
    virtual ~Renderer() = default;

    virtual const DeviceInfo& device() const = 0;

    // Why the case, through its door, must not be drawn; one sentence, empty if it may be.
    virtual std::string lacking(const cases::Case& c) const = 0;

    // Draws the cases and reads the planes back, these at least; of no planes the pictures are
    // drawn and nothing else. Results in the order of the cases: one may be unsupported for a
    // reason that only drawing tells.
    virtual std::vector<Rendered> render(std::span<const cases::Case> batch, PlaneSet planes,
                                         const Step& step, const PlaneStore& store) = 0;
    std::vector<Rendered> render(std::span<const cases::Case> batch) {
        return render(batch, kEveryPlane, [](std::string_view) {}, {});
    }
};

// A driver on this machine, by its manifest.
struct Driver {
    std::string file, library, problem;  // problem: "cannot be read: ..."; empty if there is none
    std::filesystem::path path;          // of the library, as dlopen takes it
    static void fields(auto&& visit, auto&... d) {
        visit("file", d.file...);
        visit("library", d.library...);
        visit("problem", d.problem...);
    }
};
// What is there before any driver is loaded.
struct Installed {
    std::string chosen_by;  // the option or variable that chose the drivers; empty: none did
    std::vector<Driver> drivers;
    std::string problem;           // one sentence if the chosen file is no manifest
    std::string validation_layer;  // its file; empty: it is missing
};

// A row of the table of renderers.
struct RendererKind {
    std::string_view name;  // for --renderer
    std::string_view help;
    Result<std::unique_ptr<Renderer>> (*make)(const RendererOptions&);
    // The devices of the machine; null: it is the only device of its kind.
    Result<std::vector<DeviceInfo>> (*list)(const RendererOptions&) = nullptr;
    // Null: it needs no driver.
    Installed (*find_drivers)(const RendererOptions&) = nullptr;
    // What a door needs of a device, beyond what every case needs; null: it has no doors.
    std::string_view (*needs)(cases::Door) = nullptr;
    // What is wrong with the choices behind the name and a ':', one sentence, or nothing; null: it
    // takes none.
    std::string (*wrong_choices)(std::string_view choices) = nullptr;
};
using RendererKinds = std::span<const RendererKind>;

// The kind of that name, whatever choices stand behind it; the first one if it is empty. Nullptr:
// there is none.
const RendererKind* find_renderer(RendererKinds kinds, std::string_view name);

}  // namespace capture

template <>
inline constexpr size_t cases::kValueCount<capture::Stage> = 8;
template <>
inline constexpr size_t cases::kValueCount<capture::Rendered::Status> = 5;
