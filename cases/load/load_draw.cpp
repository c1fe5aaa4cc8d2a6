// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "cases/generate/generate.hpp"
#include "cases/generate/vertices.hpp"
#include "cases/load/attributes.hpp"
#include "cases/load/color.hpp"
#include "cases/load/depth.hpp"
#include "cases/load/distances.hpp"
#include "cases/load/parts.hpp"
#include "cases/load/transform.hpp"
#include "cases/model/instances.hpp"
#include "cases/model/matrix.hpp"
#include "cases/model/sample.hpp"
#include "cases/model/words.hpp"

namespace cases {

namespace {

using Kind = TomlValue::Kind;

constexpr float kViewportLow = -32768;  // pixels; what common devices take
constexpr float kViewportHigh = 32767;

class DrawLoader {
  public:
    DrawLoader(LeafContext& context, const TomlValue& table, const Target& target)
        : context_(context), table_(table), target_(target) {}

    // Once: what is loaded is moved out.
    Draw load(const std::string& name, std::vector<std::string>& notes) {
        context_.known_keys(table_, kDrawKeys);
        if (const TomlValue* clear = table_.find("clear")) {
            return load_clear(context_, table_, *clear, target_);
        }
        draw_.where = table_.where;
        context_.read_all(table_, kDrawKeys, draw_);
        context_.read(table_, kDrawKeys, "space", space_);
        if (const TomlValue* by = table_.find("discard_by");
            by != nullptr && draw_.discard == Discard::none) {
            context_.error(by->where, "discard_by without discard means nothing; leave it out");
        }
        if (draw_.early_tests && draw_.multisample.shader_mask) {
            context_.error(table_.find("early_tests")->where,
                           "a shader with early tests writes no gl_SampleMask here; leave out "
                           "early_tests or shader_mask");
        }
        check_query();
        check_extra();
        read_fragment_size(context_, table_, draw_);
        read_viewport();
        read_scissor();
        check_layer();
        if (const TomlValue* depth = table_.find("depth")) {
            draw_.depth = read_depth_state(context_, *depth);
        }
        if (const TomlValue* written = table_.find("frag_depth")) {
            draw_.frag_depth = read_frag_depth(context_, *written);
        }
        if (const TomlValue* stencil = table_.find("stencil")) {
            draw_.stencil = read_stencil_state(context_, *stencil, target_);
        }
        if (!context_.errors().empty() || !read_shape()) {
            return std::move(draw_);
        }
        check_count(name, notes);
        check_space(name, notes);
        if (!draw_.positions.empty()) {
            refuse_with_surface();
            read_discard_attribute();
            check_shader();
            check_written_depth();
            check_fragment_size(context_, table_, draw_, target_);
            return std::move(draw_);
        }
        move_vertices(context_, table_, space_, target_, vertices_);
        const std::optional<std::vector<uint32_t>> order = vertex_order(
            context_, table_, draw_.topology, draw_.indices.has_value(), vertices_.size());
        const AttributeSource source{
            vertices_, space_, draw_.viewport, draw_.topology, draw_.indices.has_value(),
            target_,   draw_};
        if (const TomlValue* value = table_.find("attribute")) {
            draw_.attributes = read_attributes(context_, *value, source);
        }
        read_discard_attribute();
        check_shader();
        read_color();
        if (!context_.errors().empty()) {
            return std::move(draw_);
        }
        std::optional<std::vector<glm::vec4>> positions =
            to_clip(context_, vertices_, space_, draw_.viewport, table_.where, name, notes,
                    table_.find("vertices"));
        if (!positions || !order) {
            return std::move(draw_);
        }
        read_clipping(source, *positions, *order);
        check_conservative();
        check_fragment_size(context_, table_, draw_, target_);
        draw_.positions = ordered(std::move(*positions), *order);
        check_matrix();
        check_written_depth();
        for (Attribute& attribute : draw_.attributes) {
            if (attribute.source == Source::vertex && !attribute.divisor) {
                attribute.values = ordered(std::move(attribute.values), *order);
            }
        }
        read_instances();
        return std::move(draw_);
    }

  private:
    // By the value of which attribute the shader discards: by default of the first one.
    void read_discard_attribute() {
        const TomlValue* value = table_.find("discard_attribute");
        if (!discards_by_value(draw_)) {
            if (value != nullptr) {
                context_.error(value->where,
                               "discard_attribute needs discard = \"negative\"; leave it out");
            }
            return;
        }
        if (!context_.errors().empty()) {
            return;
        }
        if (draw_.attributes.empty()) {
            context_.error(table_.find("discard")->where,
                           "discard = \"negative\" needs an attribute whose values it tests; write "
                           "[[draw.attribute]]");
            return;
        }
        if (value != nullptr) {
            std::vector<std::string_view> names;
            for (const Attribute& attribute : draw_.attributes) {
                names.emplace_back(attribute.name);
            }
            draw_.discard_attribute = static_cast<uint32_t>(
                context_.word(*value, "discard_attribute", names).value_or(0));
        }
    }

    // Every fragment that is counted must show, or "some implementations may kill" it ("Occlusion
    // Queries"): it adds to the hits. With early tests the sample mask "should" be tested before
    // samples are counted, "but may instead be performed after" ("Fragment Operations").
    void check_query() {
        if (draw_.query == Query::none) {
            return;
        }
        if (!target_.has_instruments) {
            context_.error(table_.find("query")->where,
                           "a query needs the attachments that count hits; leave attachments "
                           "out of [target]");
        } else if (draw_.early_tests && draw_.multisample.sample_mask != 0xffffffffU &&
                   !is_statistic(draw_.query)) {
            context_.error(table_.find("query")->where,
                           "with early tests a device may count what the sample mask takes away; "
                           "leave out query, early_tests or sample_mask");
        }
    }

    void check_extra() {
        const TomlValue* extra = table_.find("conservative_extra");
        if (extra == nullptr) {
            return;
        }
        if (!(draw_.conservative_extra >= 0 && draw_.conservative_extra <= kMaxConservativeExtra)) {
            context_.error(extra->where,
                           "conservative_extra is outside 0..4; write by how many pixels the "
                           "triangles are enlarged");
        } else if (draw_.conservative != Conservative::overestimate) {
            context_.error(extra->where,
                           "conservative_extra enlarges what is overestimated; write conservative "
                           "= \"overestimate\", or leave it out");
        }
    }
    // What Vulkan says of it is certain without these: a clip distance is tested somewhere in the
    // pixel, and where the bounds of an enlarged primitive are, in which a centroid lies, is not
    // said.
    void check_conservative() {
        if (draw_.conservative == Conservative::none) {
            return;
        }
        const auto refuse = [&](std::string_view with) {
            context_.error(
                table_.find("conservative")->where,
                fmt::format("conservative does not go with {}; leave out one of them", with));
        };
        if (draw_.distances.clip_count > 0 || draw_.distances.cull_count > 0) {
            refuse("clip and cull distances");
        }
        if (std::ranges::any_of(draw_.attributes, [](const Attribute& a) {
                return a.auxiliary == Auxiliary::centroid || a.probe != Probe::value;
            })) {
            refuse("centroid inputs and probes");
        }
    }

    // No shader is built that discards or writes depth and has these (cmake/Shaders.cmake).
    void check_shader() {
        const bool has_other = std::ranges::any_of(draw_.attributes, [](const Attribute& a) {
            return a.source != Source::vertex || a.probe != Probe::value;
        });
        if (!has_other && !draw_.multisample.shader_mask) {
            return;
        }
        const auto refuse = [&](const char* key, std::string_view does) {
            context_.error(table_.find(key)->where,
                           fmt::format("a shader that {} has plain values and writes no "
                                       "gl_SampleMask here; leave out {}, or every source, probe "
                                       "and shader_mask",
                                       does, key));
        };
        if (draw_.discard != Discard::none) {
            refuse("discard", "discards");
        }
        if (draw_.frag_depth) {
            refuse("frag_depth", "writes depth");
        }
    }

    void check_written_depth() {
        if (draw_.frag_depth) {
            check_frag_depth(context_, *table_.find("frag_depth"), draw_);
        }
    }

    // A matrix is pushed where other shaders have their colour, and by a vertex shader of its own.
    void check_matrix() {
        if (!draw_.matrix) {
            return;
        }
        const SourceLocation& where = table_.find("matrix")->where;
        if (draw_.color.from == ColorFrom::push_constant || draw_.attributes.size() > 1 ||
            draw_.layer > 0 || draw_.viewport_index > 0 || draw_.distances.clip_count > 0 ||
            draw_.distances.cull_count > 0) {
            context_.error(where,
                           "matrix needs a colour from elsewhere than a push constant, and goes "
                           "with one attribute at most, and with no layer, viewport_index and clip "
                           "and cull distances");
        } else if (!takes_matrix(draw_.positions)) {
            context_.error(where,
                           "matrix needs positions that a product with 8 or 1/4 keeps: numbers "
                           "between 2^-100 and 2^100, and 0");
        }
    }

    // Offsets, and what the vertices of all instances have.
    void read_instances() {
        const TomlValue* offsets = table_.find("offsets");
        if (offsets != nullptr && context_.array(*offsets, "offsets")) {
            read_offsets(*offsets);
        }
        if (!context_.errors().empty() || !is_instanced(draw_)) {
            return;
        }
        if (draw_.matrix || (draw_.distances.clip_count > 0 && draw_.distances.cull_count > 0)) {
            context_.error(table_.where,
                           "a draw of instances goes with no matrix, and with clip or cull "
                           "distances, but not with both");
            return;
        }
        const size_t vertices = draw_.positions.size();
        const auto spread = [&](std::vector<glm::vec4>& values, std::optional<uint32_t> divisor) {
            if (!values.empty()) {
                values = for_all_instances(draw_, values, divisor, vertices);
            }
        };
        spread(draw_.positions, std::nullopt);
        for (size_t v = 0; v < draw_.positions.size(); ++v) {
            const glm::vec4 by = draw_.offsets.empty() ? glm::vec4(0) : draw_.offsets[v / vertices];
            const std::optional<glm::vec4> sum = offset_by(draw_.positions[v], by);
            if (!sum) {
                context_.error(offsets != nullptr ? offsets->where : table_.where,
                               fmt::format("of instance {} no binary32 is the sum of a vertex and "
                                           "its offset, or one of the three is denormal; write "
                                           "rounder numbers",
                                           v / vertices));
                return;
            }
            draw_.positions[v] = *sum;
        }
        for (Attribute& attribute : draw_.attributes) {
            spread(attribute.values, attribute.divisor);
        }
        spread(draw_.distances.clip, std::nullopt);
        spread(draw_.distances.cull, std::nullopt);
    }

    void read_offsets(const TomlValue& value) {
        if (value.array.size() != draw_.instances) {
            context_.error(value.where, fmt::format("offsets has {} entries for {} instances",
                                                    value.array.size(), draw_.instances));
            return;
        }
        for (const TomlValue& one : value.array) {
            const std::optional<std::vector<Number>> numbers = context_.numbers(one, "offsets", 4);
            glm::vec4& offset = draw_.offsets.emplace_back(0);
            for (size_t k = 0; numbers && k < 4; ++k) {
                // 0 has no sign here, so that no sum has one that depends on it.
                offset[static_cast<glm::vec4::length_type>(k)] =
                    context_.binary32((*numbers)[k], one.array[k].where, "offsets").value_or(0) +
                    0.0F;
            }
        }
    }

    static std::vector<glm::vec4> ordered(std::vector<glm::vec4> values,
                                          const std::vector<uint32_t>& order) {
        if (values.empty() || std::ranges::is_sorted(order)) {
            return values;  // none, or a permutation, so the identity
        }
        std::vector<glm::vec4> result;
        result.reserve(order.size());
        for (const uint32_t i : order) {
            result.push_back(values[i]);
        }
        return result;
    }

    void read_color() {
        const TomlValue* value = table_.find("color");
        if (value != nullptr && target_.color) {
            read_color_outputs(context_, *value, target_, draw_);
            if (draw_.color.alpha_to_coverage && draw_.early_tests) {
                context_.error(value->where,
                               "early tests come before alpha takes samples away, which is not "
                               "judged here; leave out early_tests or alpha_to_coverage");
            }
            const bool is_mask = draw_.color.from == ColorFrom::mask;
            if (is_mask && (draw_.discard != Discard::negative || draw_.discard_attribute != 0)) {
                context_.error(value->where,
                               "of a mask that is discarded where the first attribute is below 0; "
                               "write discard = \"negative\" in [[draw]]");
            }
            if (draw_.color.from != ColorFrom::push_constant &&
                ((draw_.discard != Discard::none && !is_mask) || draw_.frag_depth ||
                 draw_.multisample.shader_mask)) {
                context_.error(value->where,
                               "a shader with its colour from elsewhere than a push constant does "
                               "nothing else; leave out discard, frag_depth and shader_mask, or "
                               "from");
            }
        } else if (value != nullptr) {
            context_.error(value->where, "the target has no colour; write [target.color]");
        } else if (target_.color) {
            context_.error(table_.where,
                           "[[draw]] has no color, but the target has; write color = { value = "
                           "[r, g, b, a] }");
        }
    }

    // What a draw says of clipping and of its provoking vertices.
    void read_clipping(const AttributeSource& source, const std::vector<glm::vec4>& positions,
                       const std::vector<uint32_t>& order) {
        context_.read(table_, kDrawKeys, "depth_volume", draw_.depth.negative_one_to_one);
        draw_.distances = read_distances(context_, table_, source, positions);
        draw_.distances.clip = ordered(std::move(draw_.distances.clip), order);
        draw_.distances.cull = ordered(std::move(draw_.distances.cull), order);
    }

    void read_viewport() {
        draw_.viewport = {
            0, 0, static_cast<float>(target_.width), static_cast<float>(target_.height), 0, 1};
        const TomlValue* value = table_.find("viewport");
        if (value == nullptr) {
            return;
        }
        const TomlValue* rect = value;
        if (value->is(Kind::table)) {
            context_.known_keys(*value, kViewportKeys);
            rect = value->find("rect");
            if (const TomlValue* depth = value->find("depth")) {
                read_depth(*depth);
            }
            if (rect == nullptr) {
                return;
            }
        }
        const std::optional<std::vector<Number>> numbers = context_.numbers(*rect, "viewport", 4);
        if (!numbers) {
            return;
        }
        const std::array<float*, 4> members = {&draw_.viewport.x, &draw_.viewport.y,
                                               &draw_.viewport.width, &draw_.viewport.height};
        for (size_t i = 0; i < 4; ++i) {
            *members.at(i) =
                context_.binary32((*numbers)[i], rect->array[i].where, "viewport").value_or(1.0F);
        }
        check_viewport(*rect);
    }

    // "If the Layer value is ... greater than or equal to the number of layers in the framebuffer,
    // then ... the framebuffer values for all layers are undefined" (Vulkan specification,
    // "Built-In Variables", Layer).
    void check_layer() {
        if (draw_.layer >= target_.layers) {
            context_.error(table_.find("layer")->where,
                           target_.layers == 1
                               ? std::string("the target has one layer; write layers = N in "
                                             "[target]")
                               : fmt::format("the target has {} layers, 0 to {}", target_.layers,
                                             target_.layers - 1));
        }
    }

    void read_depth(const TomlValue& depth) {
        if (const auto ends = context_.depths(depth, "depth", "depth")) {
            draw_.viewport.min_depth = ends->front();
            draw_.viewport.max_depth = ends->back();
        }
    }

    void check_viewport(const TomlValue& rect) {
        const Viewport& v = draw_.viewport;
        constexpr auto kMaxSize = static_cast<float>(kMaxTargetSize);
        if (!(v.width > 0)) {
            context_.error(rect.array[2].where, "the viewport's width is not larger than 0");
        } else if (v.width > kMaxSize || std::fabs(v.height) > kMaxSize) {
            context_.error(rect.where,
                           fmt::format("the viewport is larger than {} pixels", kMaxTargetSize));
        } else if (std::fpclassify(v.height) == FP_ZERO) {
            context_.error(rect.array[3].where,
                           "the viewport's height is 0; write another, negative ones flip");
        } else if (std::min({v.x, v.y, v.y + v.height}) < kViewportLow ||
                   std::max({v.x + v.width, v.y, v.y + v.height}) > kViewportHigh) {
            context_.error(rect.where, "the viewport reaches beyond -32768..32767 pixels");
        }
    }

    void read_scissor() {
        draw_.scissor = {0, 0, target_.width, target_.height};
        const TomlValue* value = table_.find("scissor");
        if (value == nullptr) {
            return;
        }
        if (!context_.numbers(*value, "scissor", 4)) {
            return;
        }
        std::array<int64_t, 4> n{};
        for (size_t i = 0; i < 4; ++i) {
            const std::optional<int64_t> number =
                context_.integer(value->array[i], "scissor", 0, INT32_MAX);
            if (!number) {
                return;
            }
            n.at(i) = *number;
        }
        if (n[0] + n[2] > INT32_MAX || n[1] + n[3] > INT32_MAX) {
            context_.error(value->where, "the scissor rectangle reaches beyond 2^31 - 1 pixels");
            return;
        }
        draw_.scissor = {static_cast<int32_t>(n[0]), static_cast<int32_t>(n[1]),
                         static_cast<uint32_t>(n[2]), static_cast<uint32_t>(n[3])};
    }

    // vertices or generate, and indices.
    bool read_shape() {
        const TomlValue* listed = table_.find("vertices");
        const TomlValue* rule = table_.find("generate");
        const TomlValue* indices = table_.find("indices");
        if ((listed != nullptr) == (rule != nullptr)) {
            context_.error(table_.where,
                           listed != nullptr
                               ? "[[draw]] has both vertices and generate; keep one"
                               : "[[draw]] has no vertices; write vertices or generate");
            return false;
        }
        if (rule != nullptr) {
            return read_generated(*rule, indices);
        }
        std::optional<std::vector<ExactVertex>> vertices = read_vertices(context_, *listed, space_);
        if (!vertices) {
            return false;
        }
        vertices_ = std::move(*vertices);
        return indices == nullptr || read_indices(*indices);
    }

    bool read_generated(const TomlValue& rule, const TomlValue* indices) {
        if (indices != nullptr) {
            context_.error(indices->where, "indices do not go with generate; leave them out");
            return false;
        }
        if (space_ != Space::pixels) {
            context_.error(table_.find("space")->where,
                           "generate works in pixels; leave space out");
            return false;
        }
        std::optional<Generated> generated = generate(context_, rule, target_);
        if (!generated) {
            return false;
        }
        if (table_.find("topology") != nullptr && draw_.topology != generated->topology) {
            context_.error(table_.find("topology")->where,
                           fmt::format("this generator makes a \"{}\"; leave topology out",
                                       word_of(generated->topology)));
            return false;
        }
        draw_.topology = generated->topology;
        draw_.indices = std::move(generated->indices);
        vertices_ = std::move(generated->vertices);
        draw_.positions = std::move(generated->clip);
        return true;
    }

    // A surface has its positions already, and nothing that exact vertices are needed for.
    void refuse_with_surface() {
        for (const Key& key : kDrawKeys.keys) {
            const bool is_refused = key.has(Key::kShape) || key.name == "attribute" ||
                                    key.name == "instances" || key.name == "first_instance";
            const TomlValue* value = is_refused ? table_.find(key.name) : nullptr;
            if (value != nullptr && key.name != "generate") {
                context_.error(value->where,
                               fmt::format("{} does not go with the generator \"surface\"; leave "
                                           "it out",
                                           key.name));
            }
        }
    }

    bool read_indices(const TomlValue& value) {
        if (!context_.array(value, "indices")) {
            return false;
        }
        if (value.array.size() > kMaxIndices) {
            context_.error(value.where,
                           fmt::format("{} indices are too many; a draw has at most {}",
                                       value.array.size(), kMaxIndices));
            return false;
        }
        std::vector<uint32_t> indices;
        for (const TomlValue& element : value.array) {
            if (element.is(Kind::string) && element.string == "restart") {
                draw_.primitive_restart = true;
                indices.push_back(kRestartIndex);
                continue;
            }
            const std::optional<int64_t> index = context_.integer(
                element, "an index", 0, std::max<int64_t>(std::ssize(vertices_) - 1, 0));
            if (!index) {
                return false;
            }
            indices.push_back(static_cast<uint32_t>(*index));
        }
        draw_.indices = std::move(indices);
        return true;
    }

    // Who writes clip space without saying so has drawn one pixel.
    void check_space(const std::string& name, std::vector<std::string>& notes) const {
        const bool is_tiny = std::ranges::all_of(
            vertices_, [](const ExactVertex& v) { return abs(v.x()) <= 1 && abs(v.y()) <= 1; });
        if (is_tiny && !vertices_.empty() && table_.find("space") == nullptr) {
            notes.push_back(
                fmt::format("{}: all vertices lie within a pixel of the corner; their "
                            "space is \"pixels\" unless it is said to be \"clip\" or "
                            "\"ndc\"",
                            name));
        }
    }

    // Enough for a triangle; leftovers, which Vulkan discards, are noted.
    void check_count(const std::string& name, std::vector<std::string>& notes) {
        std::vector<size_t> pieces = {0};
        if (draw_.indices) {
            for (const uint32_t index : *draw_.indices) {
                if (draw_.primitive_restart && index == kRestartIndex) {
                    pieces.push_back(0);
                } else {
                    ++pieces.back();
                }
            }
        } else {
            pieces[0] = vertices_.size();
        }
        const TomlValue* where = table_.find("indices");
        where = where != nullptr ? where : table_.find("vertices");
        if (*std::ranges::max_element(pieces) < 3) {
            context_.error(where != nullptr ? where->where : table_.where,
                           fmt::format("{} {} make no triangle; write at least 3",
                                       *std::ranges::max_element(pieces),
                                       draw_.indices ? "indices" : "vertices"));
        }
        for (const size_t piece : pieces) {
            if (draw_.topology == Topology::triangle_list && piece > 3 && piece % 3 != 0) {
                notes.push_back(
                    fmt::format("{}: the last {} of {} {} {}; write {} more or take {} away", name,
                                piece % 3, piece, draw_.indices ? "indices" : "vertices", kLeftOver,
                                3 - piece % 3, piece % 3 == 1 ? "it" : "them"));
            }
        }
    }

    LeafContext& context_;
    const TomlValue& table_;
    const Target& target_;
    Draw draw_;
    Space space_ = Space::pixels;
    std::vector<ExactVertex> vertices_;
};

}  // namespace

Draw load_draw(LeafContext& context, const TomlValue& table, const Target& target, size_t index,
               std::vector<std::string>& notes) {
    DrawLoader loader(context, table, target);
    return loader.load(fmt::format("draw {}", index), notes);
}

}  // namespace cases
