// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <functional>

#include "cases/load/color.hpp"
#include "cases/load/parts.hpp"
#include "cases/model/blit_source.hpp"

namespace cases {

namespace {

constexpr int64_t kMaxSide = 1024;  // texels of a source
constexpr int64_t kFar = 4096;      // how far outside its image a region to be clipped may reach

class BlitLoader {
  public:
    BlitLoader(LeafContext& context, const TomlValue& table, const Target& target)
        : context_(context), table_(table), target_(target) {}

    std::optional<Blit> load() {
        context_.known_keys(table_, kBlitKeys);
        read_formats();
        read_size();
        check_filter();
        if (context_.errors().empty()) {
            read_regions();
        }
        return context_.errors().empty() ? std::optional(blit_) : std::nullopt;
    }

  private:
    void read_formats() {
        if (!target_.color) {
            context_.error(table_.where,
                           "a blit writes to the colour target; write [target.color]");
            return;
        }
        if (!target_.other_colors.empty()) {
            context_.error(table_.where,
                           "a blit writes to one colour target; write a table [target.color]");
        }
        blit_.source_format = target_.color->format;
        context_.read_all(table_, kBlitKeys, blit_);
        for (const ColorFormat format : {blit_.source_format, target_.color->format}) {
            if (!can_be_blitted(format) || bytes_of(format) == 1) {
                context_.error(table_.where,
                               fmt::format("a blit is not judged from or to {}, which has signed "
                                           "codes, floats without a sign or one byte; write "
                                           "another format",
                                           name_of(format)));
                return;
            }
        }
        if (is_integer(blit_.source_format) != is_integer(target_.color->format)) {
            context_.error(
                table_.where,
                fmt::format("a blit does not convert between {} and {}; integers go to "
                            "integers only",
                            name_of(blit_.source_format), name_of(target_.color->format)));
        }
        for (uint32_t k = 0; k < 4; ++k) {
            const ComponentKind kind = component_of(target_.color->format, k).kind;
            const float clear = target_.color->clear[static_cast<int>(k)];
            const bool is_exact = std::equal_to<>()(clear, 0.0F) || std::equal_to<>()(clear, 1.0F);
            if ((kind == ComponentKind::unorm || kind == ComponentKind::srgb) && !is_exact) {
                context_.error(table_.where,
                               "a blit's target is cleared to 0 or 1, which have exact codes");
                return;
            }
        }
    }

    void read_size() {
        if (const auto size = context_.read_size(table_, "[blit]", "the source", kMaxSide)) {
            blit_.source_width = size->front();
            blit_.source_height = size->back();
        }
    }

    void check_filter() {
        if (blit_.filter == BlitFilter::linear && target_.color &&
            is_integer(blit_.source_format)) {
            context_.error(table_.find("filter")->where,
                           "integers are not filtered; write \"nearest\"");
        }
    }

    Corners read_corners(const char* key, const Corners& otherwise, int64_t low, int64_t right,
                         int64_t bottom) {
        const TomlValue* value = table_.find(key);
        if (value == nullptr ||
            !context_.array_of(*value, key, 4, "two corners, [x0, y0, x1, y1]")) {
            return otherwise;
        }
        const auto coordinate = [&](size_t i, int64_t high) {
            return static_cast<int32_t>(
                context_.integer(value->array[i], fmt::format("a coordinate of {}", key), low, high)
                    .value_or(0));
        };
        const Corners corners = {coordinate(0, right), coordinate(1, bottom), coordinate(2, right),
                                 coordinate(3, bottom)};
        if (context_.errors().empty() && (corners.x0 == corners.x1 || corners.y0 == corners.y1)) {
            context_.error(value->where, fmt::format("{} is an empty region; move a corner", key));
        }
        return corners;
    }

    void read_regions() {
        const auto width = static_cast<int32_t>(blit_.source_width);
        const auto height = static_cast<int32_t>(blit_.source_height);
        const auto right = static_cast<int32_t>(target_.width);
        const auto bottom = static_cast<int32_t>(target_.height);
        bool clip = false;
        context_.read(table_, kBlitKeys, "clip", clip);
        blit_.source = read_corners("from", {0, 0, width, height}, 0, width, height);
        blit_.destination =
            clip ? read_corners("to", {0, 0, right, bottom}, -kFar, right + kFar, bottom + kFar)
                 : read_corners("to", {0, 0, right, bottom}, 0, right, bottom);
        if (!clip || !context_.errors().empty()) {
            return;
        }
        const ClippedBlit clipped =
            clip_to_destination(blit_.source, blit_.destination, target_.width, target_.height);
        if (!clipped.error.empty()) {
            const TomlValue* to = table_.find("to");
            context_.error(to != nullptr ? to->where : table_.where, clipped.error);
            return;
        }
        blit_.source = clipped.source;
        blit_.destination = clipped.destination;
    }

    LeafContext& context_;
    const TomlValue& table_;
    const Target& target_;
    Blit blit_;
};

}  // namespace

std::optional<Blit> load_blit(LeafContext& context, const TomlValue& table, const Target& target) {
    return BlitLoader(context, table, target).load();
}

}  // namespace cases
