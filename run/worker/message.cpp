// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "run/worker/message.hpp"

#include <algorithm>

#include "cases/wire/case_bytes.hpp"
#include "run/worker/bytes.hpp"

namespace run {

using vk_harness::DeviceInfo;
using vk_harness::Failure;
using vk_harness::Rendered;

std::string encode_options(const WorkerOptions& options) {
    ByteWriter out;
    out.text(options.vulkan.device);
    out.text(options.vulkan.icd_file);
    out.value(options.vulkan.validation);
    out.text(options.renderer);
    return out.take();
}

std::optional<WorkerOptions> decode_options(std::string_view bytes) {
    ByteReader in(bytes);
    WorkerOptions options;
    uint8_t validation = 0;
    in.text(options.vulkan.device);
    in.text(options.vulkan.icd_file);
    in.value(validation);
    in.text(options.renderer);
    options.vulkan.validation = validation != 0;
    return in.finished() ? std::optional(options) : std::nullopt;
}

std::string encode_request(uint32_t attempt, const Room& room,
                           const std::vector<const cases::Case*>& cases) {
    ByteWriter out;
    out.value(attempt);
    out.value(room);
    out.value(uint64_t{cases.size()});
    for (const cases::Case* c : cases) {
        out.text(cases::to_bytes(*c));
    }
    return out.take();
}

std::optional<RenderRequest> decode_request(std::string_view bytes) {
    ByteReader in(bytes);
    RenderRequest request;
    uint64_t count = 0;
    in.value(request.attempt);
    in.value(request.room);
    in.value(count);
    for (uint64_t k = 0; k < count; ++k) {
        std::string raw;
        if (!in.text(raw)) {
            return std::nullopt;
        }
        cases::Expected<cases::Case> c = cases::from_bytes(raw);
        if (!c) {
            return std::nullopt;
        }
        request.cases.push_back(std::move(*c));
    }
    return in.finished() ? std::optional(std::move(request)) : std::nullopt;
}

namespace {

void put(ByteWriter& out, const DeviceInfo& d) {
    out.value(d.index);
    out.text(d.name);
    out.text(d.driver_name);
    out.text(d.driver_info);
    out.text(d.uuid);
    out.text(d.device_type);
    for (const uint32_t v : {d.vendor_id, d.device_id, d.api_version, d.driver_version, d.driver_id,
                             d.subpixel_bits, d.viewport_subpixel_bits, d.max_color_attachments,
                             d.max_target_size, d.interpolation_offset_bits, d.mipmap_bits}) {
        out.value(v);
    }
    out.value(uint8_t{d.has_primitive_id});
    out.texts(d.missing);
}

void get(ByteReader& in, DeviceInfo& d) {
    in.value(d.index);
    in.text(d.name);
    in.text(d.driver_name);
    in.text(d.driver_info);
    in.text(d.uuid);
    in.text(d.device_type);
    for (uint32_t* v : {&d.vendor_id, &d.device_id, &d.api_version, &d.driver_version, &d.driver_id,
                        &d.subpixel_bits, &d.viewport_subpixel_bits, &d.max_color_attachments,
                        &d.max_target_size, &d.interpolation_offset_bits, &d.mipmap_bits}) {
        in.value(*v);
    }
    uint8_t has_primitive_id = 0;
    in.value(has_primitive_id);
    d.has_primitive_id = has_primitive_id != 0;
    in.texts(d.missing);
}

}  // namespace

std::string encode_device(const DeviceInfo& device) {
    ByteWriter out;
    put(out, device);
    return out.take();
}

std::optional<DeviceInfo> decode_device(std::string_view bytes) {
    ByteReader in(bytes);
    DeviceInfo device;
    get(in, device);
    return in.finished() ? std::optional(std::move(device)) : std::nullopt;
}

std::string encode_devices(const std::vector<DeviceInfo>& devices) {
    ByteWriter out;
    out.value(uint64_t{devices.size()});
    for (const DeviceInfo& d : devices) {
        put(out, d);
    }
    return out.take();
}

std::optional<std::vector<DeviceInfo>> decode_devices(std::string_view bytes) {
    ByteReader in(bytes);
    uint64_t count = 0;
    if (!in.value(count) || count > bytes.size()) {
        return std::nullopt;
    }
    std::vector<DeviceInfo> devices(count);
    for (DeviceInfo& d : devices) {
        get(in, d);
    }
    return in.finished() ? std::optional(std::move(devices)) : std::nullopt;
}

std::string encode_failure(const Failure& failure) {
    ByteWriter out;
    out.value(static_cast<uint32_t>(failure.stage));
    out.value(int32_t{failure.vk_result});
    out.text(failure.message);
    out.texts(failure.reasons);
    return out.take();
}

std::optional<Failure> decode_failure(std::string_view bytes) {
    ByteReader in(bytes);
    Failure failure;
    uint32_t stage = 0;
    int32_t vk_result = 0;
    in.value(stage);
    in.value(vk_result);
    in.text(failure.message);
    in.texts(failure.reasons);
    if (!in.finished() || stage > static_cast<uint32_t>(vk_harness::Stage::readback)) {
        return std::nullopt;
    }
    failure.stage = static_cast<vk_harness::Stage>(stage);
    failure.vk_result = vk_result;
    return failure;
}

namespace {

constexpr size_t kMaxDerivations = 64;

void put(ByteWriter& out, const std::vector<diff::Consistency>& consistency) {
    out.value(uint64_t{consistency.size()});
    for (const diff::Consistency& found : consistency) {
        out.value(found.compared);
        out.value(found.different);
        out.plane(found.differences);
    }
}

// False if these cannot be the findings in a capture of that many samples.
bool get(ByteReader& in, std::vector<diff::Consistency>& consistency) {
    uint64_t count = 0;
    if (!in.value(count) || count > kMaxDerivations) {
        return false;
    }
    consistency.resize(count);
    for (diff::Consistency& found : consistency) {
        in.value(found.compared);
        in.value(found.different);
        in.plane(found.differences);
    }
    return true;
}

// Two sides of every attachment, in the case's rendering and in each derived one.
constexpr size_t kMaxStrayWrites = 4096;

void put(ByteWriter& out, const std::vector<capture::StrayWrite>& writes) {
    out.value(uint64_t{writes.size()});
    for (const capture::StrayWrite& w : writes) {
        out.text(w.attachment);
        out.value(uint8_t{w.is_before});
        out.value(w.distance);
        out.value(w.expected);
        out.value(w.got);
        out.value(w.words);
        out.value(w.renderings);
    }
}

bool get(ByteReader& in, std::vector<capture::StrayWrite>& writes) {
    uint64_t count = 0;
    if (!in.value(count) || count > kMaxStrayWrites) {
        return false;
    }
    writes.resize(count);
    for (capture::StrayWrite& w : writes) {
        uint8_t is_before = 0;
        in.text(w.attachment);
        in.value(is_before);
        in.value(w.distance);
        in.value(w.expected);
        in.value(w.got);
        in.value(w.words);
        in.value(w.renderings);
        w.is_before = is_before != 0;
    }
    return true;
}

bool is_possible(const diff::Consistency& found, uint64_t samples) {
    return found.compared <= samples && found.different <= found.compared &&
           found.differences.size() == std::min<uint64_t>(found.different, diff::kMaxDifferences) &&
           std::all_of(found.differences.begin(), found.differences.end(),
                       [samples](const diff::Difference& d) {
                           return d.sample < samples && d.plane < diff::kPlanes && d.word < 4 &&
                                  d.expected != d.got;
                       });
}

}  // namespace

std::string encode_findings(const CaseResult& result) {
    ByteWriter out;
    put(out, result.consistency);
    put(out, result.rendered.stray_writes);
    return out.take();
}

std::string encode_result(const CaseResult& result) {
    const Rendered& r = result.rendered;
    const capture::Capture& c = r.capture;
    ByteWriter out;
    out.reserve(256 + (c.hits.empty() && c.color.empty()
                           ? 0
                           : capture::plane_bytes(c.target, c.attribute_count)));
    out.value(result.index);
    out.value(static_cast<uint32_t>(r.status));
    out.text(r.reason);
    out.texts(r.messages);
    out.text(cases::target_to_bytes(c.target));
    out.value(uint8_t{c.has_primitive});
    out.value(c.attribute_count);
    put(out, result.consistency);
    put(out, r.stray_writes);
    out.value(uint8_t{result.is_shared});
    if (result.is_shared) {
        out.value(result.offset);
        out.value(result.bits);
        return out.take();
    }
    out.plane(c.hits);
    out.plane(c.writers);
    out.plane(c.frag_coord);
    out.plane(c.depth);
    for (const std::vector<glm::vec4>& attribute : c.attributes) {
        out.plane(attribute);
    }
    out.plane(c.color);
    out.plane(c.stencil);
    out.plane(c.resolved_color);
    out.plane(c.resolved_depth);
    return out.take();
}

std::optional<CaseResult> decode_result(std::string_view bytes) {
    ByteReader in(bytes);
    CaseResult result;
    Rendered& r = result.rendered;
    capture::Capture& c = r.capture;
    uint32_t status = 0;
    uint8_t has_primitive = 0;
    uint8_t is_shared = 0;
    in.value(result.index);
    in.value(status);
    in.text(r.reason);
    in.texts(r.messages);
    std::string target;
    in.text(target);
    in.value(has_primitive);
    in.value(c.attribute_count);
    if (!get(in, result.consistency) || !get(in, r.stray_writes)) {
        return std::nullopt;
    }
    in.value(is_shared);
    if (is_shared != 0) {
        in.value(result.offset);
        in.value(result.bits);
    } else {
        in.plane(c.hits);
        in.plane(c.writers);
        in.plane(c.frag_coord);
        in.plane(c.depth);
        for (std::vector<glm::vec4>& attribute : c.attributes) {
            in.plane(attribute);
        }
        in.plane(c.color);
        in.plane(c.stencil);
        in.plane(c.resolved_color);
        in.plane(c.resolved_depth);
    }
    if (!in.finished() || status > static_cast<uint32_t>(Rendered::Status::error) ||
        c.attribute_count > cases::kMaxAttributes) {
        return std::nullopt;
    }
    cases::Expected<cases::Target> decoded = cases::target_from_bytes(target);
    if (!decoded) {
        return std::nullopt;
    }
    c.target = std::move(*decoded);
    r.status = static_cast<Rendered::Status>(status);
    c.has_primitive = has_primitive != 0;
    result.is_shared = is_shared != 0;
    for (const diff::Consistency& found : result.consistency) {
        if (!is_possible(found, c.sample_count())) {
            return std::nullopt;
        }
    }
    if (r.status == Rendered::Status::drawn && !result.is_shared) {
        if (!capture::has_all_planes(c)) {
            return std::nullopt;
        }
    }
    return result;
}

}  // namespace run
