// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Where a draw's vertices are in the target, as its table says it.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "fuzz/document/document.hpp"

namespace fuzz {

// Four numbers, or nothing.
std::optional<std::array<double, 4>> rectangle(const Document* value);

// Width and height of the target in pixels.
std::optional<std::array<double, 2>> size_of(const Document& document);

// "pixels", "ndc" or "clip".
std::string space_of(const Document& draw);

// The array of a draw's viewport, or nullptr.
Document* viewport_of(Document& draw);

// The viewport, or the whole target of that size.
std::array<double, 4> viewport_or(Document& draw, const std::array<double, 2>& size);

}  // namespace fuzz
