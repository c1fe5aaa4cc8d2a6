// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "ref/value/fragment/fragment.hpp"

namespace ref {

std::string to_text(const QuantityId& id) {
    const std::string component = {'.', "xyzw"[id.component]};
    switch (id.of) {
        case QuantityId::Of::attribute:
            return "attribute " + std::to_string(id.attribute) + component;
        case QuantityId::Of::frag_coord:
            return "frag_coord" + component;
        case QuantityId::Of::depth:
            break;
    }
    return "depth";
}

float& number_of(FragmentValues& values, const QuantityId& id) {
    const auto component = static_cast<glm::vec4::length_type>(id.component);
    switch (id.of) {
        case QuantityId::Of::attribute:
            return values.attributes.at(id.attribute)[component];
        case QuantityId::Of::frag_coord:
            return values.frag_coord[component];
        case QuantityId::Of::depth:
            break;
    }
    return values.depth;
}

float number_of(const FragmentValues& values, const QuantityId& id) {
    return number_of(const_cast<FragmentValues&>(values), id);
}

}  // namespace ref
