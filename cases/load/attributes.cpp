// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "cases/load/attributes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "cases/generate/generate.hpp"
#include "cases/load/attribute_probe.hpp"
#include "cases/model/instances.hpp"

namespace cases {

namespace {

class AttributeReader {
  public:
    AttributeReader(LeafContext& context, const TomlValue& table, const AttributeSource& source,
                    size_t number)
        : context_(context),
          table_(table),
          source_(source),
          values_(context, source,
                  {"an attribute", false, "", [](const Number& n, float value) {
                       return n.non_finite || !(std::fabs(value) > kMaxAttributeMagnitude)
                                  ? std::string()
                                  : "an attribute is larger than 2^126; write a smaller number";
                   }}) {
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
        if (attribute_.divisor && attribute_.source != Source::vertex) {
            context_.error(table_.find("divisor")->where,
                           "a divisor is of values that are read; leave it or source out");
        }
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
        if (attribute_.divisor && !take_elements()) {
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
        const TomlValue* values = table_.find("values");
        const TomlValue* constant = table_.find("constant");
        const TomlValue* plane = table_.find("plane");
        const bool is_read = values != nullptr     ? values_.read_values(*values, false)
                             : constant != nullptr ? values_.read_values(*constant, true)
                             : plane != nullptr    ? values_.read_plane(*plane)
                             : kind == 0           ? barycentric(*from)
                                                   : random();
        attribute_.values = std::move(values_.all);
        attribute_.components = values_.components;
        return is_read;
    }

    // With a divisor there is a value for each element that an instance reads.
    bool take_elements() {
        for (const std::string_view key : {"plane", "from"}) {
            if (const TomlValue* of_vertex = table_.find(key)) {
                context_.error(of_vertex->where,
                               fmt::format("{} is of vertices, and the attribute has a divisor; "
                                           "write values or constant",
                                           key));
                return false;
            }
        }
        values_.all.resize(elements_of(source_.draw, attribute_.divisor, 0));
        values_.entries = "elements, which the instances read";
        return true;
    }

    bool barycentric(const TomlValue& from) {
        if (source_.topology != Topology::triangle_list || source_.indexed) {
            context_.error(from.where,
                           "from = \"barycentric\" needs a triangle list without indices");
            return false;
        }
        values_.components = 3;
        if (!context_.read(table_, kAttributeKeys, "components", values_.components, 3)) {
            return false;
        }
        for (size_t v = 0; v < source_.vertices.size(); ++v) {
            if (const size_t corner = v % 3; corner < values_.components) {
                values_.all[v][static_cast<glm::vec4::length_type>(corner)] = 1.0F;
            }
        }
        return true;
    }

    bool random() {
        uint64_t seed = 1;
        const bool has_seed = context_.read(table_, kAttributeKeys, "seed", seed);
        if (!context_.read(table_, kAttributeKeys, "components", values_.components) || !has_seed) {
            return false;
        }
        Random draw(seed);
        for (glm::vec4& value : values_.all) {
            for (uint32_t i = 0; i < values_.components; ++i) {
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
    VertexValues values_;
};

}  // namespace

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
