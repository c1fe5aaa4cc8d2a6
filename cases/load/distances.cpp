// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "cases/load/distances.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

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
          positions_(positions),
          values_(context, source,
                  {"a " + name_, true, "; write half_space",
                   [this](const Number&, float value) { return refusal(value); }}) {}

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
        const bool is_constant = found == table_.find("constant");
        const bool is_read = is_constant || found == table_.find("values")
                                 ? values_.read_values(*found, is_constant)
                             : found == table_.find("plane") ? values_.read_plane(*found)
                                                             : half_space(*found);
        for (const glm::vec4& value : values_.all) {
            out.push_back(is_negated ? -value.x : value.x);
        }
        return is_read && context_.errors().size() == before;
    }

  private:
    std::string refusal(float value) const {
        const float size = std::fabs(value);
        return size > 0 && !(size >= kMinDistance && size <= kMaxDistance)
                   ? fmt::format("a {} is {:g}; write 0 or a number of magnitude 2^-60 to 2^60",
                                 name_, value)
                   : std::string();
    }

    // a x + b y + c z + d w of the clip-space position, exact, then rounded once.
    bool half_space(const TomlValue& value) {
        const std::optional<std::vector<Number>> k = context_.numbers(value, "half_space", 4);
        if (!k) {
            return false;
        }
        for (size_t v = 0; v < values_.all.size(); ++v) {
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
            if (!values_.store(v, 0, sum, value.where)) {
                return false;
            }
        }
        return true;
    }

    LeafContext& context_;
    const TomlValue& table_;
    std::string name_;
    const std::vector<glm::vec4>& positions_;
    VertexValues values_;
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
