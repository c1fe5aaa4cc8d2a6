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
#include "fuzz/generate/bare.hpp"
#include "fuzz/generate/beside.hpp"
#include "fuzz/generate/blit.hpp"
#include "fuzz/generate/color.hpp"
#include "fuzz/generate/dice.hpp"
#include "fuzz/generate/doors.hpp"
#include "fuzz/generate/fragment.hpp"
#include "fuzz/generate/geometry.hpp"
#include "fuzz/generate/inputs.hpp"
#include "fuzz/generate/stencil.hpp"

namespace fuzz {

namespace {

// Each cast of the dice is a statement or an item of a braced list: C++ leaves the order in which
// the arguments of a call are evaluated to the compiler.

// Streams of the dice (dice.hpp): poses take 1, 11 and 13.
constexpr uint64_t kStateStream = 2, kGeometryStream = 3, kTurnStream = 7, kDoorStream = 8,
                   kBesideStream = 9, kControlStream = 10, kWayStream = 12;
// State with many words, as the factors of blending, has several turns in a pose, one for so many
// geometries.
constexpr uint64_t kGeometriesOfTurn = 16;

std::string joined(const std::vector<std::string>& words) {
    return fmt::format("[{}]", fmt::join(words, ", "));
}

class CaseWriter {
  public:
    CaseWriter(const Pose& pose, const Dice& state, const Dice& turn, const Dice& geometry,
               const Dice& control)
        : pose_(pose), state_(state), turn_(turn), dice_(geometry), control_(control) {
        constexpr std::array<uint32_t, 2> kLarge = {264, 260};  // more than 2^16 samples
        struct Size {
            std::string_view word;
            std::array<uint32_t, 2> sides;
            uint64_t cases;  // one of so many is so large: many samples take long to judge
        };
        static constexpr std::array<Size, 6> kSizes = {{{"odd", {13, 9}, 1},
                                                        {"wide", {70, 5}, 1},
                                                        {"high", {3, 40}, 1},
                                                        {"64", {64, 64}, 4},
                                                        {"tiny", {4, 4}, 1},
                                                        {"large", kLarge, 16}}};
        for (const auto& [word, sides, cases] : kSizes) {
            if (pose.is("size", word) && dice_.one_in(cases)) {
                width_ = sides[0];
                height_ = sides[1];
            }
        }
        // A query that counts in too few bits shows it there alone.
        if (!pose.is_default("query") && pose.is_default("size") && dice_.one_in(16)) {
            width_ = kLarge[0];
            height_ = kLarge[1];
        }
        samples_ = static_cast<uint32_t>(std::stoul(std::string(pose.value("samples"))));
        layers_ = static_cast<uint32_t>(std::stoul(std::string(pose.value("layers"))));
        draws_ = std::stoul(std::string(pose.value("draws")));
        // What a device lacks without this test is drawn by the others of the pose.
        has_bounds_ = !pose.is_default("depth-bounds") && dice_.one_in(2);
    }

    std::string write() {
        line("format = 1");
        line("description = \"Made by edgecase fuzz.\"");
        if (!pose_.is_default("blit")) {
            line("rules = [\"blit.{}\"]", pose_.value("blit"));
            line("\n[target]\nsize = [{}, {}]", width_, height_);
            return text_ + blit_of(pose_, width_, height_, dice_);
        }
        line("rules = [\"cover.inside\"]");
        if (pose_.is("relation", "scissor-tiles")) {
            const int64_t height = state_.between(1, 9), width = state_.between(1, 9);
            line("relations = [{{ scissor-tiles = [{}, {}] }}]", width, height);
        } else if (!pose_.is_default("relation")) {
            line("relations = [\"{}\"]", pose_.value("relation"));
        }
        write_target();
        // What lies beside the target shows nothing, but a case has to show something.
        if (pose_.is("viewport-place", "beside") || pose_.is("scissor-place", "beside")) {
            line("\n[[draw]]\nvertices = [[0, 0], [{}, 0], [0, {}]]", width_, height_);
        }
        const bool is_complement = !pose_.is_default("complement");
        for (size_t k = 0; k < draws_; ++k) {
            if (is_complement && k + 2 == draws_) {
                continue;  // in its place the last one is drawn twice
            }
            const size_t begin = text_.size();
            write_draw(k);
            if (is_complement && k + 1 == draws_) {
                text_ += complement_of(text_.substr(begin));
            }
        }
        return std::move(text_);
    }

  private:
    template <class... Args>
    void line(fmt::format_string<Args...> format, Args&&... args) {
        text_ += fmt::format(format, std::forward<Args>(args)...) + '\n';
    }
    // A key that is a feature: its word is the feature's value, or it is true.
    void word(std::string_view key) {
        const std::string_view value = pose_.value(key);
        if (!pose_.is_default(key)) {
            const std::string_view quote = value == "true" ? "" : "\"";
            line("{} = {}{}{}", key, quote, value, quote);
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
        word("depth");
        if (!pose_.is_default("compare") || !pose_.is_default("depth-bounds")) {
            const double clear = dice_.fraction(0, 8, 8);
            line("depth_clear = {}", clear);
            stored_ = StoredDepths(pose_, clear);
        }
        if (!pose_.is_default("sample_locations")) {
            std::vector<std::string> places;
            for (uint32_t s = 0; s < samples_; ++s) {
                const uint64_t y = state_.below(16), x = state_.below(16);
                places.push_back(fmt::format("[{}, {}]", x, y));
            }
            line("sample_locations = {}", joined(places));
        }
        word("resolve");
        word("depth_resolve");
        word("stencil");
        if (!pose_.is_default("stencil")) {
            stencil_clear_ = stencil_clear_of(pose_, dice_);
            if (stencil_clear_ != 0) {
                line("stencil_clear = {}", stencil_clear_);
            }
        }
        word("attachments");
        if (!pose_.is_default("color")) {
            line("[target.color]\nformat = \"{}\"", pose_.value("color"));
            if (dice_.one_in(2)) {
                line("clear = {}", color_of(pose_, dice_));
            }
        }
    }

    // The state of each draw comes from the pose, so that all its cases share pipelines; what is
    // dynamic in every driver (viewport, scissor, vertices) is each case's own.
    void write_draw(size_t number) {
        line("\n[[draw]]");
        word("topology");
        word("cull");
        word("front_face");
        word("provoking");
        word("depth_volume");
        if (layers_ > 1) {
            line("layer = {}", dice_.below(layers_));
        }
        if (!pose_.is_default("viewport_index")) {
            line("viewport_index = {}", number);
        }
        if (!pose_.is_default("sample_mask")) {
            line("sample_mask = {}", turn_.between(1, (int64_t{1} << samples_) - 1));
        }
        if (!pose_.is_default("shader_mask")) {
            line("shader_mask = {}", dice_.between(1, (int64_t{1} << samples_) - 1));
        }
        if (!pose_.is_default("sample-shading")) {
            line("min_sample_shading = {}", pose_.is("sample-shading", "half")   ? 0.5
                                            : pose_.is("sample-shading", "full") ? 1.0
                                                                                 : 0.0);
        }
        // Of several draws one is as all others are.
        if (!pose_.is_default("conservative") && (draws_ == 1 || number != 1)) {
            const bool is_extra = pose_.is("conservative", "extra");
            line("conservative = \"{}\"",
                 is_extra ? std::string_view("overestimate") : pose_.value("conservative"));
            if (is_extra) {
                line("conservative_extra = {}", number == 0 ? 0.25 : 0.75);
            }
        }
        if (!pose_.is_default("fragment_size") && (draws_ == 1 || number != 1)) {
            const std::string_view size = pose_.value("fragment_size");
            line("fragment_size = [{}, {}]", size.front(), size.back());
        }
        const bool is_last = number + 1 == draws_;
        const std::string discard =
            is_last || !state_.one_in(3) ? discard_of(pose_, state_) : std::string();
        text_ += discard;
        if (number == 0 && !pose_.is_default("rasterizer_discard")) {
            line("rasterizer_discard = true");
        }
        word("early_tests");
        if (const std::string query = query_of(pose_, number, draws_, turn_); !query.empty()) {
            line("query = \"{}\"", query);
        }
        write_viewport();
        write_depth(number);
        if (const std::string stencil = stencil_of(pose_, number, stencil_clear_, turn_, dice_);
            !stencil.empty()) {
            line("stencil = {}", stencil);
        }
        write_scissor();
        write_color(number);
        const size_t vertices = write_vertices();
        text_ += distances_of(pose_, vertices, dice_);
        const bool has_sign = discard.starts_with("discard = \"negative\"");
        text_ += attributes_of(pose_, vertices, has_sign, state_, dice_);
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
            key("bias = " + bias_of(pose_, turn_, control_));
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
        if (const std::string bounds =
                has_bounds_ ? bounds_of(pose_, number, draws_, stored_, dice_) : std::string();
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
            const double height = static_cast<double>(h) + dice_.fraction(0, 16, 8);
            const double width = static_cast<double>(w) + dice_.fraction(0, 16, 8);
            const double y = dice_.fraction(-8, 8, 4), x = dice_.fraction(-8, 8, 4);
            line("viewport = [{}, {}, {}, {}]", x, y, width, height);
        } else if (viewport == "depth") {
            const double far = dice_.fraction(0, 8, 8), near = dice_.fraction(0, 8, 8);
            line("viewport = {{ depth = [{}, {}] }}", near, far);
            depths_ = {near, far};
        }
        if (!pose_.is_default("viewport-place")) {
            frame_ = placed(pose_.value("viewport-place"), width_, height_, dice_);
            line("viewport = [{}, {}, {}, {}]", frame_.x, frame_.y, frame_.width, frame_.height);
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
        const std::string_view place = pose_.value("scissor-place");
        if (place == "beside") {
            const bool is_right = dice_.one_in(2);
            line("scissor = [{}, {}, {}, {}]", is_right ? w + dice_.between(0, 1) : 0,
                 is_right ? 0 : h + dice_.between(0, 1), 1 + dice_.below(2 * width_), h);
        } else if (place == "far") {
            const int64_t reach = int64_t{1} << dice_.between(7, 30);
            const int64_t y = dice_.between(0, h / 2), x = dice_.between(0, w / 2);
            line("scissor = [{}, {}, {}, {}]", x, y, reach, dice_.one_in(2) ? reach : h);
        }
    }

    void write_color(size_t number) {
        if (pose_.is_default("color")) {
            return;
        }
        const std::string source = pose_.is_default("color-from")
                                       ? fmt::format("value = {}", color_of(pose_, dice_))
                                       : "attribute = \"c\"";
        line("color = {}", color_keys_of(pose_, number, draws_, source, turn_, dice_));
    }

    // The number of vertices written.
    size_t write_vertices() {
        const Connection connection = pose_.is("topology", "triangle-list")    ? Connection::list
                                      : pose_.is("topology", "triangle-strip") ? Connection::strip
                                                                               : Connection::fan;
        const bool with_restart = pose_.is("indices", "restart");
        const bool with_indices = !pose_.is_default("indices");
        const Shape shape =
            pose_.is_default("way")
                ? make_shape(dice_, connection, with_indices, with_restart, width_, height_)
                : make_bare_shape(dice_, connection, with_indices, width_, height_, frame_);
        const bool in_clip = pose_.is("space", "clip") || pose_.is("w", "behind");
        if (in_clip) {
            line("space = \"clip\"");
        }
        const double common = dice_.fraction(1, 64, 16);
        const auto [near, far] = vertex_depths(pose_);
        std::vector<std::string> vertices;
        for (const Position& p : shape.vertices) {
            const double w = w_of(common);
            const double z = dice_.fraction(std::llround(near * 64), std::llround(far * 64), 64);
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
            return dice_.fraction(1, 15, 4);
        }
        if (w == "steep") {
            return std::ldexp(1.0, static_cast<int>(dice_.between(-6, 6)));
        }
        if (w == "behind") {
            const double magnitude = dice_.fraction(1, 15, 4);
            return dice_.one_in(4) ? -magnitude : magnitude;
        }
        return 1;
    }

    const Pose& pose_;
    Dice state_, turn_, dice_;  // of the pose, of a turn, of the case
    Dice control_;              // of the case: what a bias is made of
    std::string text_;
    size_t draws_ = 1;
    uint32_t width_ = 16, height_ = 16, samples_ = 1, layers_ = 1, stencil_clear_ = 0;
    std::array<double, 2> depths_ = {0, 1};  // of the viewport of the draw that is written
    Frame frame_{0, 0, width_, height_};     // its viewport, if that is placed
    StoredDepths stored_{pose_, static_cast<double>(cases::kDepthClear)};
    bool has_bounds_ = false;
};

}  // namespace

std::string case_text(uint64_t seed, const Pose& pose, uint64_t pose_number, uint64_t number) {
    // Each kind of poses has a sequence of its own.
    number = number_of_kind(pose_number) * kGeometries + number % kGeometries;
    pose_number = number / kGeometries;
    const uint64_t turn = number / kGeometriesOfTurn;
    std::string text =
        CaseWriter(pose, Dice(seed, kStateStream, pose_number), Dice(seed, kTurnStream, turn),
                   Dice(seed, kGeometryStream, number), Dice(seed, kControlStream, number))
            .write();
    if (!pose.is_default("way")) {
        Dice dice(seed, kWayStream, number);
        return by_way_of(pose, text, dice);
    }
    Dice beside(seed, kBesideStream, turn);
    // These are of one target alone.
    const bool is_alone = !pose.is_default("second") || !pose.is_default("alpha_to_one") ||
                          !pose.is_default("alpha_to_coverage");
    if (pose.is_default("blit") && !is_alone && beside.one_in(4)) {
        text = beside_others(std::move(text), beside);
    }
    Dice doors(seed, kDoorStream, turn);
    const bool has_doors =
        pose.is_default("relation") && pose.is_default("blit") && doors.one_in(4);
    return has_doors ? through_doors(std::move(text), doors) : text;
}

bool is_case(uint64_t seed, const Pose& pose, uint64_t pose_number) {
    // No fragment shader is built for these (cmake/Shaders.cmake).
    const bool has_source = !pose.is_default("source"), has_probe = !pose.is_default("probe");
    if ((!pose.is_default("color") && (has_source || has_probe)) ||
        (!pose.is_default("shader_mask") &&
         (pose.is("source", "barycentric") || pose.is("probe", "query-lod")))) {
        return false;
    }
    // What the state allows shows in some of its geometries, of each turn.
    for (uint64_t k = 0; k < kGeometries; k += kGeometries / 8) {
        const uint64_t number = pose_number * kGeometries + k;
        if (!cases::load_text(case_text(seed, pose, pose_number, number), "fuzz", "fuzz")) {
            return false;
        }
    }
    return true;
}

}  // namespace fuzz
