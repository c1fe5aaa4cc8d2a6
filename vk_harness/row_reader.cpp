// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "vk_harness/row_reader.hpp"

#include <malloc.h>

#include <algorithm>
#include <utility>

#include "vk_harness/commands/record.hpp"

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

// Reads attachments back that are decoded together, from `first` up to `end`.
void read_rows(const Device& device, Submission& submission, const CasePlan& plan, size_t first,
               size_t end, VkDeviceSize alignment, const capture::PlaneSpans& to) {
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
        const ReadbackLayout layout = make_layout(band, group, 0, alignment);
        Buffer& buffer = submission.readback(layout.end);
        poison(buffer.bytes().first(layout.end));
        buffer.flush();
        const VkCommandBuffer commands = submission.begin();
        for (size_t k = first; k < end; ++k) {
            record_copy(device, commands, plan, k, rows, buffer.get(), layout.offset[k - first]);
        }
        submission.run();
        buffer.invalidate();
        read_planes(group, layout, buffer.bytes(),
                    rows_of(to, rows, std::min(attribute, cases::kMaxAttributes - size_t{1})));
    }
}

}  // namespace

bool is_large(const CasePlan& plan) {
    const cases::Target& target = plan.test->target;
    return plan.blit == nullptr && !target.is_read_by_shader() && target.layers == 1 &&
           attachment_bytes(target, plan.attachments) > kLargeBytes;
}

void read_by_rows(const Device& device, Submission& submission, TargetCache& targets,
                  const CasePlan& plan, VkDeviceSize alignment, bool keeps_images,
                  const std::function<void(std::string_view)>& step,
                  const capture::PlaneSpans& planes) {
    for (size_t first = 0; first < plan.attachments.size();) {
        step("readback");
        const size_t end = end_of_group(plan.attachments, first);
        read_rows(device, submission, plan, first, end, alignment, planes);
        // Damage is told by the images' guards; a stencil lies in the depth's image.
        const bool is_shared = end < plan.images.size() && plan.images[end] == plan.images[first];
        for (size_t k = first; k < end && !keeps_images && !is_shared; ++k) {
            targets.release(plan.images[k]);
        }
        // A driver on the CPU has its images from this process's heap, which keeps megabytes for
        // the next case.
        ::malloc_trim(0);
        first = end;
    }
}

}  // namespace vk_harness
