// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "fuzz/generate/generator.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <string_view>
#include <utility>
#include <vector>

#include "cases/load/loader.hpp"
#include "fuzz/generate/color.hpp"
#include "fuzz/generate/dice.hpp"
#include "fuzz/generate/fragment.hpp"
#include "fuzz/generate/geometry.hpp"
#include "fuzz/generate/stencil.hpp"

namespace fuzz {

namespace {

// Each cast of the dice is a statement or an item of a braced list: C++ leaves the order in which
// the arguments of a call are evaluated to the compiler.

// Streams of the dice (dice.hpp): poses take 1.
constexpr uint64_t kStateStream = 2, kGeometryStream = 3;

std::string joined(const std::vector<std::string>& words) {
    return fmt::format("[{}]", fmt::join(words, ", "));
}

// Multiples of 1/parts from low to high, in these units.
double fraction(Dice& dice, int64_t low, int64_t high, int64_t parts) {
    return static_cast<double>(dice.between(low, high)) / static_cast<double>(parts);
}

class CaseWriter {
  public:
    CaseWriter(const Pose& pose, const Dice& state, const Dice& geometry)
        : pose_(pose), state_(state), dice_(geometry) {
        static constexpr std::array<std::pair<std::string_view, std::array<uint32_t, 2>>, 6>
            kSizes = {{{"16", {16, 16}},
                       {"odd", {13, 9}},
                       {"wide", {70, 5}},
                       {"high", {3, 40}},
                       {"64", {64, 64}},
                       {"tiny", {4, 4}}}};
        for (const auto& [name, size] : kSizes) {
            if (pose.is("size", name)) {
                width_ = size[0];
                height_ = size[1];
            }
        }
        samples_ = static_cast<uint32_t>(std::stoul(std::string(pose.value("samples"))));
        layers_ = static_cast<uint32_t>(std::stoul(std::string(pose.value("layers"))));
        draws_ = std::stoul(std::string(pose.value("draws")));
        is_integer_ = pose.is("color", "r32-uint") || pose.is("color", "rgba8-uint");
    }

    std::string write() {
        line("format = 1");
        line("description = \"Made by edgecase fuzz.\"");
        line("rules = [\"cover.inside\"]");
        if (pose_.is("relation", "scissor-tiles")) {
            const int64_t height = state_.between(1, 9), width = state_.between(1, 9);
            line("relations = [{{ scissor-tiles = [{}, {}] }}]", width, height);
        } else if (!pose_.is_default("relation")) {
            line("relations = [\"{}\"]", pose_.value("relation"));
        }
        write_target();
        for (size_t k = 0; k < draws_; ++k) {
            write_draw(k);
        }
        return std::move(text_);
    }

  private:
    template <class... Args>
    void line(fmt::format_string<Args...> format, Args&&... args) {
        text_ += fmt::format(format, std::forward<Args>(args)...) + '\n';
    }
    // A key whose word is the feature's value.
    void word(std::string_view key, std::string_view feature) {
        if (!pose_.is_default(feature)) {
            line("{} = \"{}\"", key, pose_.value(feature));
        }
    }

    void write_target() {
        line("\n[target]");
        line("size = [{}, {}]", width_, height_);
        if (samples_ > 1) {
            line("samples = {}", samples_);
        }
        if (layers_ > 1) {
            line("layers = {}", layers_);
        }
        word("depth", "depth");
        if (!pose_.is_default("compare") || !pose_.is_default("depth-bounds")) {
            const double clear = fraction(state_, 0, 8, 8);
            line("depth_clear = {}", clear);
            stored_ = StoredDepths(pose_, clear);
        }
        if (!pose_.is_default("sample-locations")) {
            std::vector<std::string> places;
            for (uint32_t s = 0; s < samples_; ++s) {
                const uint64_t y = state_.below(16), x = state_.below(16);
                places.push_back(fmt::format("[{}, {}]", x, y));
            }
            line("sample_locations = {}", joined(places));
        }
        word("resolve", "resolve");
        word("depth_resolve", "depth-resolve");
        if (!pose_.is_default("stencil")) {
            line("stencil = true");
            stencil_clear_ = stencil_clear_of(pose_, state_);
            if (stencil_clear_ != 0) {
                line("stencil_clear = {}", stencil_clear_);
            }
        }
        word("attachments", "attachments");
        if (!pose_.is_default("color")) {
            line("[target.color]\nformat = \"{}\"", pose_.value("color"));
            if (state_.one_in(2)) {
                line("clear = {}", color_of(pose_, state_));
            }
        }
    }

    // The state of each draw comes from the pose, so that all its cases share pipelines; what is
    // dynamic in every driver (viewport, scissor, vertices) is each case's own.
    void write_draw(size_t number) {
        line("\n[[draw]]");
        word("topology", "topology");
        word("cull", "cull");
        word("front_face", "front-face");
        word("provoking", "provoking");
        word("depth_volume", "depth-volume");
        if (layers_ > 1) {
            line("layer = {}", dice_.below(layers_));
        }
        if (!pose_.is_default("viewport-index")) {
            line("viewport_index = {}", number);
        }
        if (!pose_.is_default("sample-mask")) {
            line("sample_mask = {}", state_.between(1, (int64_t{1} << samples_) - 1));
        }
        if (!pose_.is_default("shader-mask")) {
            line("shader_mask = {}", state_.between(1, (int64_t{1} << samples_) - 1));
        }
        if (!pose_.is_default("sample-shading")) {
            line("min_sample_shading = {}", pose_.is("sample-shading", "half")   ? 0.5
                                            : pose_.is("sample-shading", "full") ? 1.0
                                                                                 : 0.0);
        }
        const bool is_last = number + 1 == draws_;
        if (is_last || !state_.one_in(3)) {
            word("discard", "discard");
        }
        if (number == 0 && !pose_.is_default("rasterizer-discard")) {
            line("rasterizer_discard = true");
        }
        if (!pose_.is_default("early-tests")) {
            line("early_tests = true");
        }
        if (const std::string query = query_of(pose_, number, draws_, state_); !query.empty()) {
            line("query = \"{}\"", query);
        }
        write_viewport();
        write_depth(number);
        if (const std::string stencil = stencil_of(pose_, number, stencil_clear_, state_);
            !stencil.empty()) {
            line("stencil = {}", stencil);
        }
        write_scissor();
        write_color(number);
        const size_t vertices = write_vertices();
        write_distances(vertices);
        write_attributes(vertices);
    }

    void write_depth(size_t number) {
        std::vector<std::string> keys;
        const auto key = [&](std::string text) { keys.push_back(std::move(text)); };
        // What a later draw is compared with has been written by an earlier one.
        if (!pose_.is_default("compare") && (number > 0 || pose_.is("draws", "1"))) {
            key(fmt::format("compare = \"{}\"", pose_.value("compare")));
        }
        if (!pose_.is_default("depth-write") && (number > 0 || pose_.is("draws", "1"))) {
            key("write = false");
        }
        if (!pose_.is_default("bias")) {
            const std::string_view bias = pose_.value("bias");
            std::vector<std::string> parts;
            if (bias != "slope") {
                parts.push_back(fmt::format("constant = {}", state_.between(-9, 9)));
            }
            if (bias != "constant") {
                parts.push_back(fmt::format("slope = {}", fraction(state_, -8, 8, 4)));
            }
            if (bias == "clamped") {
                parts.push_back(fmt::format("clamp = {}", fraction(state_, -8, 8, 64)));
            }
            key(fmt::format("bias = {{ {} }}", fmt::join(parts, ", ")));
        }
        if (!pose_.is_default("depth-clamp")) {
            key("clamp = true");
        }
        if (!pose_.is_default("depth-clip")) {
            key(fmt::format("clip = {}", pose_.value("depth-clip")));
        }
        const std::string written =
            frag_depth_of(pose_, number, draws_, depths_, stored_, state_, dice_);
        if (!written.empty()) {
            line("frag_depth = {}", written);
        }
        if (const std::string bounds = bounds_of(pose_, number, draws_, stored_, dice_);
            !bounds.empty()) {
            key("bounds = " + bounds);
        }
        if (!keys.empty()) {
            line("depth = {{ {} }}", fmt::join(keys, ", "));
        }
    }

    void write_viewport() {
        const int64_t w = width_, h = height_;
        const std::string_view viewport = pose_.value("viewport");
        if (viewport == "inner") {
            const int64_t x = dice_.between(0, w - 1), y = dice_.between(0, h - 1);
            const int64_t height = dice_.between(1, h - y), width = dice_.between(1, w - x);
            line("viewport = [{}, {}, {}, {}]", x, y, width, height);
        } else if (viewport == "beyond") {
            const int64_t height = dice_.between(1, 3 * h), width = dice_.between(1, 3 * w);
            const int64_t y = dice_.between(-h, h), x = dice_.between(-w, w);
            line("viewport = [{}, {}, {}, {}]", x, y, width, height);
        } else if (viewport == "flipped") {
            line("viewport = [0, {}, {}, {}]", h, w, -h);
        } else if (viewport == "fractional") {
            const double height = static_cast<double>(h) + fraction(dice_, 0, 16, 8);
            const double width = static_cast<double>(w) + fraction(dice_, 0, 16, 8);
            const double y = fraction(dice_, -8, 8, 4), x = fraction(dice_, -8, 8, 4);
            line("viewport = [{}, {}, {}, {}]", x, y, width, height);
        } else if (viewport == "depth") {
            const double far = fraction(dice_, 0, 8, 8), near = fraction(dice_, 0, 8, 8);
            line("viewport = {{ depth = [{}, {}] }}", near, far);
            depths_ = {near, far};
        }
    }

    void write_scissor() {
        const int64_t w = width_, h = height_;
        const std::string_view scissor = pose_.value("scissor");
        if (scissor == "inner") {
            const int64_t x = dice_.between(0, w - 1), y = dice_.between(0, h - 1);
            const int64_t height = dice_.between(1, h - y), width = dice_.between(1, w - x);
            line("scissor = [{}, {}, {}, {}]", x, y, width, height);
        } else if (scissor == "beyond") {
            const int64_t height = dice_.one_in(2) ? 3 * h : int64_t{1} << 30;
            const int64_t y = dice_.between(0, h / 2), x = dice_.between(0, w / 2);
            line("scissor = [{}, {}, {}, {}]", x, y, 3 * w, height);
        } else if (scissor == "thin") {
            const int width = dice_.one_in(2) ? 1 : 2;
            line("scissor = [{}, 0, {}, {}]", dice_.between(0, w - 1), width, h);
        }
    }

    void write_color(size_t number) {
        if (pose_.is_default("color")) {
            return;
        }
        const std::string source = pose_.is_default("color-from")
                                       ? fmt::format("value = {}", color_of(pose_, state_))
                                       : "attribute = \"c\"";
        line("color = {}", color_keys_of(pose_, number, draws_, source, state_));
    }

    // The number of vertices written.
    size_t write_vertices() {
        const Connection connection = pose_.is("topology", "triangle-list")    ? Connection::list
                                      : pose_.is("topology", "triangle-strip") ? Connection::strip
                                                                               : Connection::fan;
        const bool with_restart = pose_.is("indices", "restart");
        const Shape shape = make_shape(dice_, connection, !pose_.is_default("indices"),
                                       with_restart, width_, height_);
        const bool in_clip = pose_.is("space", "clip") || pose_.is("w", "behind");
        if (in_clip) {
            line("space = \"clip\"");
        }
        const double common = fraction(dice_, 1, 64, 16);
        const auto [near, far] = vertex_depths(pose_);
        std::vector<std::string> vertices;
        for (const Position& p : shape.vertices) {
            const double w = w_of(common);
            const double z = fraction(dice_, std::llround(near * 64), std::llround(far * 64), 64);
            if (in_clip) {
                const auto along = [w](double v, uint32_t side) {
                    return static_cast<double>(static_cast<float>((v * 2 / side - 1) * w));
                };
                vertices.push_back(fmt::format("[{}, {}, {}, {}]", along(p.x, width_),
                                               along(p.y, height_),
                                               static_cast<double>(static_cast<float>(z * w)), w));
            } else if (!pose_.is_default("w")) {
                vertices.push_back(fmt::format("[{}, {}, {}, {}]", p.x, p.y, z, w));
            } else if (!pose_.is_default("z")) {
                vertices.push_back(fmt::format("[{}, {}, {}]", p.x, p.y, z));
            } else {
                vertices.push_back(fmt::format("[{}, {}]", p.x, p.y));
            }
        }
        line("vertices = {}", joined(vertices));
        if (!shape.indices.empty()) {
            std::vector<std::string> indices;
            for (const int64_t k : shape.indices) {
                indices.push_back(k < 0 ? "\"restart\"" : std::to_string(k));
            }
            line("indices = {}", joined(indices));
        }
        return shape.vertices.size();
    }

    // Exact in binary32: four significant bits.
    double w_of(double common) {
        const std::string_view w = pose_.value("w");
        if (w == "equal") {
            return common;
        }
        if (w == "unequal") {
            return fraction(dice_, 1, 15, 4);
        }
        if (w == "steep") {
            return std::ldexp(1.0, static_cast<int>(dice_.between(-6, 6)));
        }
        if (w == "behind") {
            const double magnitude = fraction(dice_, 1, 15, 4);
            return dice_.one_in(4) ? -magnitude : magnitude;
        }
        return 1;
    }

    void write_distances(size_t vertices) {
        for (const auto& [feature, key] :
             {std::pair{"clip-distances", "clip_distance"}, {"cull-distances", "cull_distance"}}) {
            const auto count = std::stoul(std::string(pose_.value(feature)));
            for (size_t k = 0; k < count; ++k) {
                line("[[draw.{}]]", key);
                if (dice_.one_in(2)) {
                    const double d = fraction(dice_, -8, 8, 8);
                    const int64_t c = dice_.between(-1, 1);
                    const int64_t b = dice_.between(-3, 3), a = dice_.between(-3, 3);
                    line("half_space = [{}, {}, {}, {}]", a, b, c, d);
                    continue;
                }
                std::vector<std::string> values;
                for (size_t v = 0; v < vertices; ++v) {
                    values.push_back(fmt::format("{}", fraction(dice_, -8, 8, 4)));
                }
                line("values = {}", joined(values));
            }
        }
    }

    void write_values(size_t vertices, size_t components) {
        std::vector<std::string> values;
        for (size_t v = 0; v < vertices; ++v) {
            std::vector<std::string> one;
            for (size_t c = 0; c < components; ++c) {
                one.push_back(fmt::format("{}", fraction(dice_, 0, 32, 32)));
            }
            values.push_back(joined(one));
        }
        line("values = {}", joined(values));
    }

    void write_attributes(size_t vertices) {
        if (!pose_.is_default("color-from") && !pose_.is_default("color")) {
            line("[[draw.attribute]]\nname = \"c\"");
            if (is_integer_) {
                line("interpolation = \"flat\"");
            } else {
                write_interpolation(0);
            }
            std::vector<std::string> colors;
            for (size_t v = 0; v < vertices; ++v) {
                colors.push_back(color_of(pose_, dice_));
            }
            line("values = {}", joined(colors));
        }
        const std::string_view count = pose_.value("attributes");
        const size_t attributes = count == "none"  ? 0U
                                  : count == "one" ? 1U
                                  : count == "two" ? 2U
                                                   : 3U;
        for (size_t a = 0; a < attributes; ++a) {
            line("[[draw.attribute]]");
            write_interpolation(a);
            word("auxiliary", "auxiliary");
            // One of them is a plain input, if there are several.
            if (a == 0 && !pose_.is_default("source")) {
                line("source = \"{}\"", pose_.value("source"));
                continue;
            }
            const std::string_view probe = pose_.value("probe");
            size_t components = 1 + state_.below(4);
            if (a == 0 && probe != "value") {
                line("probe = \"{}\"", probe);
                if (probe == "at-sample") {
                    line("sample = {}", state_.below(samples_));
                } else if (probe == "at-offset") {
                    const double y = fraction(state_, -8, 7, 16), x = fraction(state_, -8, 7, 16);
                    line("offset = [{}, {}]", x, y);
                } else if (probe == "query-lod") {
                    const uint32_t height = 1U << state_.below(9), width = 1U << state_.below(9);
                    line("texture = [{}, {}]", width, height);
                    components = 2;
                }
            }
            write_values(vertices, components);
        }
    }

    void write_interpolation(size_t attribute) {
        static constexpr std::array<std::string_view, 3> kModes = {"smooth", "noperspective",
                                                                   "flat"};
        const std::string_view mode = pose_.is("interpolation", "mixed")
                                          ? kModes.at(attribute % 3)
                                          : pose_.value("interpolation");
        if (mode != "smooth") {
            line("interpolation = \"{}\"", mode);
        }
    }

    const Pose& pose_;
    Dice state_, dice_;
    std::string text_;
    size_t draws_ = 1;
    uint32_t width_ = 16, height_ = 16, samples_ = 1, layers_ = 1, stencil_clear_ = 0;
    std::array<double, 2> depths_ = {0, 1};  // of the viewport of the draw that is written
    StoredDepths stored_{pose_, static_cast<double>(cases::kDepthClear)};
    bool is_integer_ = false;
};

}  // namespace

std::string case_text(uint64_t seed, const Pose& pose, uint64_t pose_number, uint64_t number) {
    return CaseWriter(pose, Dice(seed, kStateStream, pose_number),
                      Dice(seed, kGeometryStream, number))
        .write();
}

bool is_case(uint64_t seed, const Pose& pose, uint64_t pose_number) {
    // No fragment shader is built for these (cmake/Shaders.cmake).
    const bool has_source = !pose.is_default("source"), has_probe = !pose.is_default("probe");
    if ((!pose.is_default("color") && (has_source || has_probe)) ||
        (!pose.is_default("shader-mask") &&
         (pose.is("source", "barycentric") || pose.is("probe", "query-lod")))) {
        return false;
    }
    // What the state allows shows in any geometry, but for the layer, which is the geometry's.
    constexpr uint64_t kTries = 8;
    for (uint64_t number = 0; number < kTries; ++number) {
        if (!cases::load_text(case_text(seed, pose, pose_number, number), "fuzz", "fuzz")) {
            return false;
        }
    }
    return true;
}

}  // namespace fuzz
