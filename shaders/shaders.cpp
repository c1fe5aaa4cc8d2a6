// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "shaders/shaders.hpp"

#include <algorithm>
#include <cstddef>
#include <iterator>

namespace shaders {

namespace {

template <class Variant>
struct Module {
    Variant variant;
    std::span<const uint32_t> code;
};

#include "modules.inc"

template <class Variant, size_t kCount>
std::span<const uint32_t> find(const Module<Variant> (&modules)[kCount], const Variant& variant) {
    const auto found =
        std::find_if(std::begin(modules), std::end(modules),
                     [&](const Module<Variant>& module) { return module.variant == variant; });
    return found == std::end(modules) ? std::span<const uint32_t>() : found->code;
}

}  // namespace

std::span<const uint32_t> capture_vertex(const VertexVariant& variant) {
    return find(kVertex, variant);
}

std::span<const uint32_t> matrix_vertex(uint32_t attributes) {
    return attributes < std::size(kMatrix) ? kMatrix[attributes] : std::span<const uint32_t>();
}

std::span<const uint32_t> capture_geometry(const VertexVariant& variant) {
    return find(kGeometry, variant);
}

std::span<const uint32_t> capture_mesh(const VertexVariant& variant) {
    return find(kMesh, variant);
}

std::span<const uint32_t> read_input(bool is_integer, bool has_samples) {
    return kInput[(is_integer ? 2U : 0U) + (has_samples ? 1U : 0U)];
}

std::span<const uint32_t> capture_control(uint32_t attributes) {
    return kControl[attributes];
}

std::span<const uint32_t> capture_evaluation(uint32_t attributes) {
    return kEvaluation[attributes];
}

std::span<const uint32_t> capture_fragment(const FragmentVariant& variant) {
    return find(kFragment, variant);
}

std::span<const uint32_t> bare_fragment(uint32_t from) {
    return kBare[from - 1];
}

std::span<const uint32_t> feedback_vertex(uint32_t attributes) {
    return kFeedback[attributes];
}

std::span<const uint32_t> clear_vertex() {
    return kClearVertex;
}

std::span<const uint32_t> clear_color(uint32_t location, Output output) {
    return location >= kClearLocations ? std::span<const uint32_t>()
                                       : kClear[3 * location + static_cast<uint32_t>(output)];
}

std::span<const uint32_t> clear_depth() {
    return kClearDepth;
}

std::span<const uint32_t> copy_samples(bool depth, uint32_t words) {
    return kCopy[depth ? 0U : words == 4 ? 3U : words];
}

std::span<const uint32_t> copy_codes_of_color() {
    return copy_unorm;
}

std::span<const uint32_t> copy_codes_of_depth() {
    return copy_codes;
}

std::span<const uint32_t> any_module(size_t i) {
    if (i < std::size(kVertex)) {
        return kVertex[i].code;
    }
    i -= std::size(kVertex);
    if (i < std::size(kFragment)) {
        return kFragment[i].code;
    }
    i -= std::size(kFragment);
    if (i < std::size(kCopy)) {
        return kCopy[i];
    }
    i -= std::size(kCopy);
    if (i < std::size(kGeometry)) {
        return kGeometry[i].code;
    }
    i -= std::size(kGeometry);
    if (i < std::size(kMesh)) {
        return kMesh[i].code;
    }
    i -= std::size(kMesh);
    if (i < std::size(kInput)) {
        return kInput[i];
    }
    i -= std::size(kInput);
    if (i < std::size(kControl)) {
        return kControl[i];
    }
    i -= std::size(kControl);
    if (i < std::size(kEvaluation)) {
        return kEvaluation[i];
    }
    i -= std::size(kEvaluation);
    if (i < std::size(kFeedback)) {
        return kFeedback[i];
    }
    i -= std::size(kFeedback);
    if (i < std::size(kBare)) {
        return kBare[i];
    }
    i -= std::size(kBare);
    if (i < std::size(kMatrix)) {
        return kMatrix[i];
    }
    i -= std::size(kMatrix);
    if (i < 2) {
        return i == 0 ? clear_vertex() : clear_depth();
    }
    i -= 2;
    return i < std::size(kClear) ? kClear[i] : std::span<const uint32_t>();
}

}  // namespace shaders
