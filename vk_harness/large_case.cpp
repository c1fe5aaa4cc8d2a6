// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// A case whose attachments are large: read back piece by piece, so that it takes the memory of its
// images or of its capture, not of both and a copy.
#include <malloc.h>

#include <algorithm>
#include <utility>

#include "vk_harness/renderer.hpp"

namespace vk_harness {

namespace {

constexpr VkDeviceSize kLargeBytes = VkDeviceSize{32} << 20;  // of all attachments
constexpr VkDeviceSize kBandBytes = VkDeviceSize{4} << 20;    // read back at once

// The end of the attachments that are decoded together with the one at `first`.
size_t end_of_group(const std::vector<Attachment>& attachments, size_t first) {
    const size_t next = first + 1;
    const auto is_next = [&](Role role) {
        return next < attachments.size() && attachments[next].role == role;
    };
    const Role role = attachments[first].role;
    const bool is_pair = (role == Role::writer && is_next(Role::hits)) ||
                         (role == Role::frag_xy && is_next(Role::frag_zw)) ||
                         (role == Role::attribute && is_next(Role::attribute_zw));
    return is_pair ? next + 1 : next;
}

// The planes' entries of these rows, of a target of one sample a pixel and one layer. Of the
// attributes the one with this number comes first.
capture::PlaneSpans rows_of(const capture::PlaneSpans& planes, const Rows& rows, size_t attribute) {
    capture::PlaneSpans out;
    out.target = planes.target;
    out.target.height = rows.count;
    out.has_primitive = planes.has_primitive;
    out.attribute_count = planes.attribute_count;
    const size_t first = size_t{rows.first} * planes.target.width;
    const size_t count = size_t{rows.count} * planes.target.width;
    capture::for_each_plane(
        [&](const capture::Plane&, const auto& all, auto& some) {
            some = all.empty() ? all : all.subspan(first, count);
        },
        planes, planes, out);
    std::swap(out.attributes[0], out.attributes.at(attribute));
    return out;
}

}  // namespace

bool BatchRenderer::is_large(std::span<const CasePlan> plans) {
    if (plans.size() != 1 || plans.front().blit != nullptr) {
        return false;
    }
    const cases::Target& target = plans.front().test->target;
    return target.samples == 1 && target.layers == 1 &&
           attachment_bytes(target, plans.front().attachments) > kLargeBytes;
}

Result<void> BatchRenderer::read_rows(const CasePlan& plan, size_t first, size_t end,
                                      const capture::PlaneSpans& to) {
    const cases::Target& target = plan.test->target;
    const auto begin = plan.attachments.begin();
    const std::vector<Attachment> group(begin + static_cast<std::ptrdiff_t>(first),
                                        begin + static_cast<std::ptrdiff_t>(end));
    const auto attribute = static_cast<size_t>(
        std::count_if(begin, begin + static_cast<std::ptrdiff_t>(first),
                      [](const Attachment& a) { return a.role == Role::attribute; }));
    VkDeviceSize row_bytes = 0;
    for (const Attachment& attachment : group) {
        row_bytes += VkDeviceSize{target.width} * attachment.copied_bytes(1);
    }
    const auto most = static_cast<uint32_t>(std::max(VkDeviceSize{1}, kBandBytes / row_bytes));
    for (Rows rows; rows.first < target.height; rows.first += rows.count) {
        rows.count = std::min(most, target.height - rows.first);
        cases::Target band = target;
        band.height = rows.count;
        const ReadbackLayout layout = make_layout(band, group, 0, alignment());
        auto buffer = submission_.readback(layout.end);
        if (!buffer) {
            return fail(buffer.error());
        }
        poison((*buffer)->bytes().first(layout.end));
        if (auto flushed = (*buffer)->flush(); !flushed) {
            return flushed;
        }
        auto commands = submission_.begin();
        if (!commands) {
            return fail(commands.error());
        }
        for (size_t k = first; k < end; ++k) {
            record_copy(*device_, *commands, plan, k, rows, (*buffer)->get(),
                        layout.offset[k - first]);
        }
        if (auto done = submission_.run(); !done) {
            return done;
        }
        if (auto visible = (*buffer)->invalidate(); !visible) {
            return visible;
        }
        read_planes(group, layout, (*buffer)->bytes(),
                    rows_of(to, rows, std::min(attribute, cases::kMaxAttributes - size_t{1})));
    }
    return {};
}

Result<void> BatchRenderer::draw_large(CasePlan& plan, Rendered& result,
                                       const std::function<void(std::string_view)>& step,
                                       const PlaneStore& store, std::vector<GuardDamage>& damage) {
    step("record");
    GuardCheck guards(*device_);
    for (const auto& [guard, name] : guards_of(plan)) {
        guards.add(guard);
    }
    const VkDeviceSize vertex_bytes = place_vertices(plan, 0);
    auto vertices = submission_.vertices(vertex_bytes);
    if (!vertices) {
        return fail(vertices.error());
    }
    write_vertices(plan, (*vertices)->bytes());
    if (auto made = make_door_buffers(*device_, pipelines_, plan, (*vertices)->bytes()); !made) {
        return made;
    }
    if (auto flushed = (*vertices)->flush(); !flushed) {
        return flushed;
    }
    const VkDeviceSize guard_bytes = guards.place(0);
    auto readback = submission_.readback(guard_bytes);
    if (!readback) {
        return fail(readback.error());
    }
    poison((*readback)->bytes().first(guard_bytes));
    if (auto flushed = (*readback)->flush(); !flushed) {
        return flushed;
    }
    auto commands = submission_.begin();
    if (!commands) {
        return fail(commands.error());
    }
    textures_.record_transitions(*commands);
    guards.record_fills(*commands);
    if (auto recorded = record(*commands, plan, (*vertices)->get(), true); !recorded) {
        return recorded;
    }
    guards.record_copies(*commands, (*readback)->get());
    const std::vector<std::string> messages = instance_.messages().take();
    result.messages.insert(result.messages.end(), messages.begin(), messages.end());
    step("submit");
    if (auto done = submission_.run(); !done) {
        return done;
    }
    if (auto visible = (*readback)->invalidate(); !visible) {
        return visible;
    }
    auto found = guards.read((*readback)->bytes());
    if (!found) {
        return fail(found.error());
    }
    damage = std::move(*found);
    const capture::PlaneSpans planes = place_planes(plan, result, store);
    if (auto read = read_queries(plan, result); !read) {
        return read;
    }
    for (size_t first = 0; first < plan.attachments.size();) {
        step("readback");
        const size_t end = end_of_group(plan.attachments, first);
        if (auto read = read_rows(plan, first, end, planes); !read) {
            return read;
        }
        // Damage is told by the images' guards; a stencil lies in the depth's image.
        const bool is_shared = end < plan.images.size() && plan.images[end] == plan.images[first];
        for (size_t k = first; k < end && damage.empty() && !is_shared; ++k) {
            targets_.release(plan.images[k]);
        }
        // A driver on the CPU has its images from this process's heap, which keeps megabytes for
        // the next case.
        ::malloc_trim(0);
        first = end;
    }
    move_back(plan, planes);
    result.status = Rendered::Status::drawn;
    return {};
}

}  // namespace vk_harness
