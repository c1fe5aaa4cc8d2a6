// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "cases/load/attributes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "cases/generate/generate.hpp"
#include "cases/load/attribute_probe.hpp"

namespace cases {

namespace {

class AttributeReader {
  public:
    AttributeReader(LeafContext& context, const TomlValue& table, const AttributeSource& source,
                    size_t number)
        : context_(context), table_(table), source_(source) {
        attribute_.name = fmt::format("attribute{}", number);
    }

    std::optional<Attribute> read() {
        context_.known_keys(table_, kAttributeKeys);
        if (const TomlValue* value = table_.find("name")) {
            attribute_.name = context_.text(*value, "name").value_or(attribute_.name);
            if (attribute_.name.empty()) {
                context_.error(value->where, "name is empty; leave it out or write a word");
            }
        }
        const size_t errors = context_.errors().size();
        context_.read_all(table_, kAttributeKeys, attribute_);
        if (context_.errors().size() > errors ||
            !read_source(context_, table_, source_.target, attribute_) ||
            (attribute_.source == Source::vertex && !read_vertex_values()) ||
            !read_probe(context_, table_, source_.target.samples, attribute_)) {
            return std::nullopt;
        }
        return std::move(attribute_);
    }

  private:
    bool read_vertex_values() {
        size_t sources = 0;
        for (const std::string_view key : {"values", "constant", "plane", "from"}) {
            sources += table_.find(key) != nullptr ? 1U : 0U;
        }
        if (sources != 1) {
            context_.error(table_.where,
                           fmt::format("[[draw.attribute]] has {} of the keys values, constant, "
                                       "plane and from; write exactly one",
                                       sources));
            return false;
        }
        const TomlValue* from = table_.find("from");
        uint32_t kind = 0;  // of the words of from; behind them without it
        if (!context_.read(table_, kAttributeKeys, "from", kind)) {
            return false;
        }
        kind = from == nullptr ? UINT32_MAX : kind;
        if (const TomlValue* seed = table_.find("seed"); seed != nullptr && kind != 1) {
            context_.error(seed->where, "seed goes with from = \"random\" only");
            return false;
        }
        if (const TomlValue* count = table_.find("components");
            count != nullptr && from == nullptr) {
            context_.error(count->where,
                           "components goes with from = \"random\" or \"barycentric\" only");
            return false;
        }
        attribute_.values.assign(source_.vertices.size(), glm::vec4(0.0F));
        if (const TomlValue* value = table_.find("values")) {
            return read_values(*value);
        }
        if (const TomlValue* value = table_.find("constant")) {
            return read_constant(*value);
        }
        if (const TomlValue* value = table_.find("plane")) {
            return read_plane(*value);
        }
        return kind == 0 ? barycentric(*from) : random();
    }

    // Components of one vertex: a number or an array of 1 to 4.
    size_t count_components(const TomlValue& value) {
        if (!value.is(TomlValue::Kind::array)) {
            return 1;
        }
        if (value.array.empty() || value.array.size() > 4) {
            context_.error(value.where, fmt::format("{} components are given; write 1 to 4",
                                                    value.array.size()));
            return 0;
        }
        return value.array.size();
    }

    static const TomlValue& component(const TomlValue& value, size_t i) {
        return value.is(TomlValue::Kind::array) ? value.array[i] : value;
    }

    bool store(size_t vertex, size_t i, const Number& n, const SourceLocation& where) {
        const float value = round_to_binary32(n).value;
        if (!n.non_finite && std::fabs(value) > kMaxAttributeMagnitude) {
            context_.error(where, "an attribute is larger than 2^126; write a smaller number");
            return false;
        }
        attribute_.values[vertex][static_cast<glm::vec4::length_type>(i)] = value;
        return true;
    }

    bool read_one(const TomlValue& value, size_t vertex) {
        for (size_t i = 0; i < attribute_.components; ++i) {
            const TomlValue& element = component(value, i);
            const std::optional<Number> n = context_.any_binary32(element, "an attribute");
            if (!n || !store(vertex, i, *n, element.where)) {
                return false;
            }
        }
        return true;
    }

    bool read_values(const TomlValue& value) {
        if (!context_.array(value, "values")) {
            return false;
        }
        if (value.array.size() != source_.vertices.size()) {
            context_.error(value.where, fmt::format("values has {} entries for {} vertices",
                                                    value.array.size(), source_.vertices.size()));
            return false;
        }
        for (size_t v = 0; v < value.array.size(); ++v) {
            const size_t components = count_components(value.array[v]);
            if (components == 0) {
                return false;
            }
            if (v == 0) {
                attribute_.components = static_cast<uint32_t>(components);
            } else if (components != attribute_.components) {
                context_.error(value.array[v].where,
                               fmt::format("entry {} of values has {} components, the first has "
                                           "{}; write the same number everywhere",
                                           v, components, attribute_.components));
                return false;
            }
            if (!read_one(value.array[v], v)) {
                return false;
            }
        }
        return true;
    }

    bool read_constant(const TomlValue& value) {
        attribute_.components = static_cast<uint32_t>(count_components(value));
        if (attribute_.components == 0) {
            return false;
        }
        for (size_t v = 0; v < source_.vertices.size(); ++v) {
            if (!read_one(value, v)) {
                return false;
            }
        }
        return true;
    }

    bool read_plane(const TomlValue& value) {
        attribute_.components = static_cast<uint32_t>(count_components(value));
        if (attribute_.components == 0) {
            return false;
        }
        if (!check_plane_keys(context_, value.where)) {
            return false;
        }
        for (size_t v = 0; v < source_.vertices.size(); ++v) {
            const ExactVertex& vertex = source_.vertices[v];
            const std::optional<PixelPosition> at =
                pixel_position(vertex, source_.space, source_.viewport);
            if (!at) {
                context_.error(
                    value.where,
                    fmt::format("plane has no x and y at vertex {}, whose {}", v,
                                is_finite(vertex) ? "w is 0" : "position is not finite"));
                return false;
            }
            const Names names = plane_names(context_, vertex, *at);
            for (size_t i = 0; i < attribute_.components; ++i) {
                const TomlValue& element = component(value, i);
                const std::optional<Number> n = context_.number(element, "plane", names);
                if (!n || !store(v, i, *n, element.where)) {
                    return false;
                }
            }
        }
        return true;
    }

    bool barycentric(const TomlValue& from) {
        if (source_.topology != Topology::triangle_list || source_.indexed) {
            context_.error(from.where,
                           "from = \"barycentric\" needs a triangle list without indices");
            return false;
        }
        attribute_.components = 3;
        if (!context_.read(table_, kAttributeKeys, "components", attribute_.components, 3)) {
            return false;
        }
        for (size_t v = 0; v < source_.vertices.size(); ++v) {
            if (const size_t corner = v % 3; corner < attribute_.components) {
                attribute_.values[v][static_cast<glm::vec4::length_type>(corner)] = 1.0F;
            }
        }
        return true;
    }

    bool random() {
        uint64_t seed = 1;
        const bool has_seed = context_.read(table_, kAttributeKeys, "seed", seed);
        if (!context_.read(table_, kAttributeKeys, "components", attribute_.components) ||
            !has_seed) {
            return false;
        }
        Random draw(seed);
        for (glm::vec4& value : attribute_.values) {
            for (uint32_t i = 0; i < attribute_.components; ++i) {
                // A multiple of 2^-24 below 1 is a binary32.
                value[static_cast<glm::vec4::length_type>(i)] =
                    static_cast<float>(draw.between(0, (1 << 24) - 1)) * 0x1p-24F;
            }
        }
        return true;
    }

    LeafContext& context_;
    const TomlValue& table_;
    const AttributeSource& source_;
    Attribute attribute_;
};

}  // namespace

bool check_plane_keys(LeafContext& context, const SourceLocation& where) {
    for (const auto& [key, parameter] : context.parameters()) {
        if (key == "x" || key == "y" || key == "z" || key == "w") {
            context.error(where,
                          fmt::format("plane cannot tell the matrix key {} from the vertex's "
                                      "own {}; rename the key",
                                      key, key));
            return false;
        }
    }
    return true;
}

Names plane_names(LeafContext& context, const ExactVertex& vertex, const PixelPosition& at) {
    return context.names(
        {{"x", {at.x, false}}, {"y", {at.y, false}}, {"z", vertex.xyzw[2]}, {"w", vertex.xyzw[3]}});
}

std::vector<Attribute> read_attributes(LeafContext& context, const TomlValue& value,
                                       const AttributeSource& source) {
    std::vector<Attribute> attributes;
    if (!context.array(value, "attribute")) {
        return attributes;
    }
    if (value.array.size() > kMaxAttributes) {
        context.error(value.where, fmt::format("{} attributes are too many; a draw has at most {}",
                                               value.array.size(), kMaxAttributes));
        return attributes;
    }
    std::vector<SourceLocation> where;
    for (const TomlValue& table : value.array) {
        if (!context.table(table, "attribute")) {
            continue;
        }
        AttributeReader reader(context, table, source, attributes.size());
        if (std::optional<Attribute> attribute = reader.read()) {
            attributes.push_back(std::move(*attribute));
            where.push_back(table.where);
        }
    }
    check_shared_inputs(context, attributes, where);
    for (size_t i = 0; i < attributes.size(); ++i) {
        for (size_t k = 0; k < i; ++k) {
            if (attributes[i].name == attributes[k].name) {
                context.error(
                    value.array[i].where,
                    fmt::format("two attributes are called {}; rename one", attributes[i].name));
            }
        }
    }
    return attributes;
}

}  // namespace cases
