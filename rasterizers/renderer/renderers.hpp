// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Renderers that need no driver. They draw case by case, and have no doors.
#pragma once

#include "capture/renderer.hpp"

namespace rasterizers {

using Made = capture::Result<std::unique_ptr<capture::Renderer>>;

// What the reference expects: a perfect device of 8 subpixel bits.
Made reference_renderer(const capture::RendererOptions& options);
// The algorithm that options.renderer names.
Made algorithm_renderer(const capture::RendererOptions& options);
// The software device with the choices that options.renderer has behind its ':',
// "software:ties=up".
Made software_renderer(const capture::RendererOptions& options);
// What is wrong with such choices, one sentence; empty: nothing.
std::string wrong_choices(std::string_view choices);

}  // namespace rasterizers
