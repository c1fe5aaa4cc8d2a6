// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "capture/renderer.hpp"

#include <algorithm>
#include <array>

namespace capture {

std::string_view to_string(Stage stage) {
    static constexpr std::array<std::string_view, 8> kNames = {
        "loader", "instance", "device", "shader", "pipeline", "memory", "submit", "readback"};
    return kNames.at(static_cast<size_t>(stage));
}

CaptureView view_of(const Rendered& rendered) {
    const Capture& c = rendered.capture;
    if (rendered.placed.empty()) {
        return c;
    }
    CaptureView view =
        view_planes(c.target, c.has_primitive, c.attribute_count, rendered.placed.data());
    view.counted = c.counted;
    return view;
}

const RendererKind* find_renderer(RendererKinds kinds, std::string_view name) {
    const std::string_view word = name.substr(0, name.find(':'));
    const auto found = std::ranges::find(kinds, word, &RendererKind::name);
    return word.empty() ? &kinds.front() : found == kinds.end() ? nullptr : &*found;
}

}  // namespace capture
