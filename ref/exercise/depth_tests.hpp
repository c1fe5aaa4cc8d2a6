// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Order, depth and stencil.
#pragma once

#include "ref/exercise/tests.hpp"

namespace ref {

bool is_overwritten(const View& view, std::string_view rule);
bool is_compared(const View& view, std::string_view rule);
bool is_depth_kept(const View& view, std::string_view rule);
bool is_depth_rounded(const View& view, std::string_view rule);
bool is_clamped(const View& view, std::string_view rule);
bool has_coord_depth(const View& view, std::string_view rule);
bool is_counted_by_stencil(const View& view, std::string_view rule);
bool is_counted_by_query(const View& view, std::string_view rule);
bool is_of_statistics(const View& view, std::string_view rule);

}  // namespace ref
