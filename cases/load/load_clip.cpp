// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <string_view>

#include "cases/load/parts.hpp"

namespace cases {

namespace {

constexpr size_t kMaxPlanes = 4;

// One distance: a number for each vertex.
class DistanceReader {
  public:
    DistanceReader(LeafContext& context, const TomlValue& table, std::string name,
                   const AttributeSource& source, const std::vector<glm::vec4>& positions)
        : context_(context),
          table_(table),
          name_(std::move(name)),
          source_(source),
          positions_(positions) {}

    bool read(std::vector<float>& out) {
        const size_t before = context_.errors().size();
        context_.known_keys(table_, kDistanceKeys, "[[draw." + name_ + "]]");
        bool is_negated = false;
        context_.read(table_, kDistanceKeys, "negate", is_negated);
        const TomlValue* found = nullptr;
        for (const char* key : {"values", "constant", "plane", "half_space"}) {
            const TomlValue* value = table_.find(key);
            if (value != nullptr && found != nullptr) {
                context_.error(value->where,
                               name_ +
                                   " says twice where its values come from; keep one of "
                                   "values, constant, plane and half_space");
                return false;
            }
            found = value != nullptr ? value : found;
        }
        if (found == nullptr) {
            context_.error(table_.where,
                           name_ + " has no values; write values, constant, plane or half_space");
            return false;
        }
        out.assign(source_.vertices.size(), 0.0F);
        const bool is_read = found == table_.find("values")     ? values(*found, out)
                             : found == table_.find("constant") ? constant(*found, out)
                             : found == table_.find("plane")    ? plane(*found, out)
                                                                : half_space(*found, out);
        if (is_negated) {
            std::transform(out.begin(), out.end(), out.begin(), [](float d) { return -d; });
        }
        return is_read && context_.errors().size() == before;
    }

  private:
    bool store(const Number& n, const SourceLocation& where, float& out) {
        out = round_to_binary32(n).value;
        const float size = std::fabs(out);
        if (size > 0 && !(size >= kMinDistance && size <= kMaxDistance)) {
            context_.error(where, fmt::format("a {} is {:g}; write 0 or a number of magnitude "
                                              "2^-60 to 2^60",
                                              name_, out));
            return false;
        }
        return true;
    }

    bool values(const TomlValue& value, std::vector<float>& out) {
        if (!context_.array(value, "values")) {
            return false;
        }
        if (value.array.size() != out.size()) {
            context_.error(value.where, fmt::format("values has {} entries for {} vertices",
                                                    value.array.size(), out.size()));
            return false;
        }
        for (size_t v = 0; v < out.size(); ++v) {
            const std::optional<Number> n = context_.number(value.array[v], "a " + name_);
            if (!n || !store(*n, value.array[v].where, out[v])) {
                return false;
            }
        }
        return true;
    }

    bool constant(const TomlValue& value, std::vector<float>& out) {
        const std::optional<Number> n = context_.number(value, "a " + name_);
        float distance = 0;
        if (!n || !store(*n, value.where, distance)) {
            return false;
        }
        std::fill(out.begin(), out.end(), distance);
        return true;
    }

    bool plane(const TomlValue& value, std::vector<float>& out) {
        if (!check_plane_keys(context_, value.where)) {
            return false;
        }
        for (size_t v = 0; v < out.size(); ++v) {
            const ExactVertex& vertex = source_.vertices[v];
            const std::optional<PixelPosition> at =
                pixel_position(vertex, source_.space, source_.viewport);
            if (!at) {
                context_.error(value.where,
                               fmt::format("plane has no x and y at vertex {}, whose w is 0; "
                                           "write half_space",
                                           v));
                return false;
            }
            const Names names = plane_names(context_, vertex, *at);
            const std::optional<Number> n = context_.number(value, "plane", names);
            if (!n || !store(*n, value.where, out[v])) {
                return false;
            }
        }
        return true;
    }

    // a x + b y + c z + d w of the clip-space position, exact, then rounded once.
    bool half_space(const TomlValue& value, std::vector<float>& out) {
        const std::optional<std::vector<Number>> k = context_.numbers(value, "half_space", 4);
        if (!k) {
            return false;
        }
        for (size_t v = 0; v < out.size(); ++v) {
            Number sum;
            for (size_t c = 0; c < 4; ++c) {
                const float p = positions_[v][static_cast<glm::vec4::length_type>(c)];
                if (!std::isfinite(p)) {
                    context_.error(value.where,
                                   fmt::format("half_space has no value at vertex {}, whose "
                                               "position is not finite",
                                               v));
                    return false;
                }
                sum.value += (*k)[c].value * mpq_class(static_cast<double>(p));
            }
            if (!store(sum, value.where, out[v])) {
                return false;
            }
        }
        return true;
    }

    LeafContext& context_;
    const TomlValue& table_;
    std::string name_;
    const AttributeSource& source_;
    const std::vector<glm::vec4>& positions_;
};

// Reads the tables of one kind; returns how many there are.
uint32_t read_kind(LeafContext& context, const TomlValue& draw, const std::string& name,
                   const AttributeSource& source, const std::vector<glm::vec4>& positions,
                   std::vector<glm::vec4>& out) {
    const TomlValue* tables = draw.find(name);
    if (tables == nullptr || !context.array(*tables, name)) {
        return 0;
    }
    if (tables->array.empty() || tables->array.size() > kMaxPlanes) {
        context.error(tables->where, fmt::format("a draw has 1 to {} of {}, not {}", kMaxPlanes,
                                                 name, tables->array.size()));
        return 0;
    }
    out.assign(source.vertices.size(), glm::vec4(0.0F));
    for (size_t k = 0; k < tables->array.size(); ++k) {
        std::vector<float> one;
        if (!context.table(tables->array[k], name) ||
            !DistanceReader(context, tables->array[k], name, source, positions).read(one)) {
            return 0;
        }
        for (size_t v = 0; v < one.size(); ++v) {
            out[v][static_cast<glm::vec4::length_type>(k)] = one[v];
        }
    }
    return static_cast<uint32_t>(tables->array.size());
}

}  // namespace

ClipDistances read_distances(LeafContext& context, const TomlValue& draw,
                             const AttributeSource& source,
                             const std::vector<glm::vec4>& positions) {
    ClipDistances out;
    out.clip_count = read_kind(context, draw, "clip_distance", source, positions, out.clip);
    out.cull_count = read_kind(context, draw, "cull_distance", source, positions, out.cull);
    return out;
}

}  // namespace cases
