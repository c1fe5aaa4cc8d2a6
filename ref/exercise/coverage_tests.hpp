// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What the triangles cover, or not.
#pragma once

#include "ref/exercise/tests.hpp"

namespace ref {

bool is_surely_covered(const View& view, std::string_view rule);
bool is_outside_one(const View& view, std::string_view rule);
bool is_in_set(const View& view, std::string_view rule);
bool is_settled(const View& view, std::string_view rule);
bool is_settled_by_snapping(const View& view, std::string_view rule);
bool is_overestimated(const View& view, std::string_view rule);
bool has_reason_of_area(const View& view, std::string_view rule);
bool is_kept_away(const View& view, std::string_view rule);
bool is_beside_bad_number(const View& view, std::string_view rule);
bool crosses_border(const View& view, std::string_view rule);
bool reaches_volume(const View& view, std::string_view rule);

// With instruments, which count front and back faces apart.
bool shows_face(const View& view, std::string_view rule);

// Of an instance that reads what no vertex has.
bool is_of_instance(const View& view, std::string_view rule);

}  // namespace ref
