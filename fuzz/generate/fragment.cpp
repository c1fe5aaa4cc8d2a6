// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "fuzz/generate/fragment.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "cases/format/depth_format.hpp"
#include "cases/model/words.hpp"

namespace fuzz {

namespace {

// Neither bounds nor what a shader writes are denormal, which a device may take for 0.
double normal(float depth) {
    return std::fpclassify(depth) == FP_SUBNORMAL
               ? static_cast<double>(std::numeric_limits<float>::min())
               : static_cast<double>(depth);
}

// The depths of fragments from a vertex's: as viewport and volume map it.
double mapped(const Pose& pose, std::array<double, 2> viewport, double z) {
    const auto [near, far] = viewport;
    return pose.is_default("depth_volume") ? near + (far - near) * z
                                           : (far + near) / 2 + (far - near) / 2 * z;
}

// Which layout the draw's numbers can keep: beyond all depths of its triangles by more than the
// loader asks for (cases/load/depth.cpp).
constexpr double kMargin = 0x1p-12;

}  // namespace

StoredDepths::StoredDepths(const Pose& pose, double clear) : depths_{clear} {
    for (const cases::DepthFormatRow& row : cases::kDepthFormats) {
        if (pose.is("depth", row.word) && row.steps > 0) {
            step_ = 1 / row.steps;
        }
    }
}

double StoredDepths::any(Dice& dice) const {
    return depths_[dice.below(depths_.size())];
}

double StoredDepths::beside(double depth, Dice& dice) const {
    const bool is_up = dice.one_in(2);
    if (step_ > 0 && dice.one_in(2)) {
        // On a number of the format, where it rounds to, or beside it.
        const double code =
            std::round(depth / step_) + static_cast<double>(dice.below(2)) * (is_up ? 1.0 : -1.0);
        return code * step_;
    }
    return static_cast<double>(std::nextafter(static_cast<float>(depth), is_up ? 2.0F : -1.0F));
}

double StoredDepths::near(Dice& dice) const {
    double depth = any(dice);
    const uint64_t kind = dice.below(4);
    if (kind == 0) {
        depth = dice.fraction(0, 16, 16);
    } else if (kind == 1) {
        depth = beside(depth, dice);
    }
    return normal(static_cast<float>(std::clamp(depth, 0.0, 1.0)));
}

std::string bias_of(const Pose& pose, Dice& turn, Dice& control) {
    std::vector<std::string> parts;
    const bool has_constant = !pose.is("bias", "slope");
    if (has_constant) {
        // Few steps are lost in what interpolated depths may differ by.
        const int64_t scale = int64_t{1} << (turn.one_in(2) ? 0 : turn.below(17));
        parts.push_back(fmt::format("constant = {}", turn.between(-9, 9) * scale));
    }
    if (!pose.is("bias", "constant")) {
        parts.push_back(fmt::format("slope = {}", turn.fraction(-8, 8, 4)));
    }
    if (pose.is("bias", "clamped")) {
        parts.push_back(fmt::format("clamp = {}", turn.fraction(-8, 8, 64)));
    }
    if (has_constant && control.one_in(4)) {
        const std::string_view representation =
            control.of(cases::kWords<cases::DepthBiasRepresentation>);
        if (representation != "format") {
            parts.push_back(fmt::format("representation = \"{}\"", representation));
        }
        if (representation == "format" || control.one_in(2)) {
            parts.emplace_back("exact = true");
        }
    }
    return fmt::format("{{ {} }}", fmt::join(parts, ", "));
}

std::string bounds_of(const Pose& pose, size_t number, size_t draws, const StoredDepths& stored,
                      Dice& dice) {
    // Early draws mostly store what later ones test.
    if (pose.is_default("depth-bounds") || (number + 1 < draws && !dice.one_in(4))) {
        return {};
    }
    double min = 0, max = 1;
    if (pose.is("depth-bounds", "ends")) {
        min = stored.near(dice);
        max = stored.near(dice);
        if (min > max) {
            std::swap(min, max);
        }
    } else if (pose.is("depth-bounds", "below")) {
        max = stored.near(dice);
    } else if (pose.is("depth-bounds", "above")) {
        min = stored.near(dice);
    } else if (pose.is("depth-bounds", "one-depth")) {
        min = max = stored.near(dice);
    }
    return fmt::format("[{}, {}]", min, max);
}

std::array<double, 2> vertex_depths(const Pose& pose) {
    if (pose.is("z", "plane")) {
        const bool is_promised =
            pose.is("depth-layout", "greater") || pose.is("depth-layout", "less");
        return is_promised ? std::array{0.25, 0.75} : std::array{0.0, 1.0};
    }
    return pose.is("z", "beyond") ? std::array{-0.5, 1.5} : std::array{0.5, 0.5};
}

std::string frag_depth_of(const Pose& pose, size_t number, size_t draws,
                          std::array<double, 2> viewport, StoredDepths& stored, Dice& state,
                          Dice& dice) {
    const bool is_coord = pose.is("frag_depth", "frag-coord");
    // An early draw may store its triangles' own depths.
    const bool is_own = pose.is_default("frag_depth") || (number + 1 < draws && state.one_in(3));
    if ((is_own || is_coord) && pose.is("z", "half")) {
        stored.add(mapped(pose, viewport, 0.5));
    }
    if (is_own) {
        return {};
    }
    const std::string_view layout = pose.value("depth-layout");
    if (is_coord) {
        return layout == "any"
                   ? "{ from = \"frag-coord\" }"
                   : fmt::format("{{ from = \"frag-coord\", layout = \"{}\" }}", layout);
    }
    const bool is_clamped = !pose.is_default("depth-clamp");
    const auto [least, most] = std::minmax(viewport[0], viewport[1]);
    // Without depth clamp it must lie within the viewport's depths; with it, it is moved there.
    double low = is_clamped ? -1 : least, high = is_clamped ? 2 : most;
    const std::array<double, 2> own = vertex_depths(pose);
    const std::array<double, 2> ends = {mapped(pose, viewport, own[0]),
                                        mapped(pose, viewport, own[1])};
    // Nothing is promised of triangles behind the eye.
    bool is_kept = layout != "any" && !pose.is("w", "behind");
    if (is_kept && layout == "greater") {
        is_kept = std::max(ends[0], ends[1]) + kMargin <= high;
        low = is_kept ? std::max(ends[0], ends[1]) + kMargin : low;
    } else if (is_kept) {
        is_kept = std::min(ends[0], ends[1]) - kMargin >= low;
        high = is_kept ? std::min(ends[0], ends[1]) - kMargin : high;
    }
    const auto depth = [&] {
        const bool is_beyond = is_clamped && dice.one_in(3);
        const double z = is_beyond ? dice.fraction(-4, 8, 4) : stored.near(dice);
        return normal(static_cast<float>(std::clamp(z, low, high)));
    };
    const double value = depth();
    std::string keys = fmt::format("value = {}", value);
    if (!pose.is("frag_depth", "value")) {
        const double other = depth();
        keys += fmt::format(", other = {}, where = \"{}\"", other, pose.value("frag_depth"));
        stored.add(std::clamp(other, least, most));
    }
    stored.add(std::clamp(value, least, most));
    if (is_kept) {
        keys += fmt::format(", layout = \"{}\"", layout);
    }
    return fmt::format("{{ {} }}", keys);
}

std::string query_of(const Pose& pose, size_t number, size_t draws, Dice& dice) {
    if (pose.is_default("query") || (number + 1 < draws && dice.one_in(3))) {
        return {};
    }
    const bool is_other = number + 1 < draws && dice.one_in(4);
    const bool is_precise = pose.is("query", "occlusion") == is_other;
    if (pose.is("query", "statistics") || (!is_precise && dice.one_in(2))) {
        const auto& words = cases::kWords<cases::Query>;
        constexpr auto kFirst = static_cast<size_t>(cases::Query::input_vertices);
        return std::string(words.at(kFirst + dice.below(words.size() - kFirst)));
    }
    return is_precise ? "occlusion-precise" : "occlusion";
}

std::string discard_of(const Pose& pose, Dice& dice) {
    if (pose.is_default("discard")) {
        return {};
    }
    const std::string by = pose.is_default("discard_by")
                               ? ""
                               : fmt::format("discard_by = \"{}\"\n", pose.value("discard_by"));
    const bool has_values = !pose.is_default("attributes") && pose.is_default("source") &&
                            pose.is_default("probe") && pose.is_default("shader_mask") &&
                            !pose.value("relation").ends_with("-attributes");
    if (!has_values || !dice.one_in(3)) {
        return fmt::format("discard = \"{}\"\n{}", pose.value("discard"), by);
    }
    // Behind the one that is a colour.
    const bool has_color = !pose.is_default("color-from") && !pose.is_default("color");
    const size_t count = pose.is("attributes", "one") ? 1 : pose.is("attributes", "two") ? 2 : 3;
    return fmt::format("discard = \"negative\"\ndiscard_attribute = \"attribute{}\"\n{}",
                       dice.below(count) + (has_color ? 1 : 0), by);
}

}  // namespace fuzz
