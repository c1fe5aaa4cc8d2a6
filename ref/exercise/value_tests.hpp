// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Values and what is stored of them.
#pragma once

#include "ref/exercise/tests.hpp"

namespace ref {

bool has_value(const View& view, std::string_view rule);
bool has_sample_number(const View& view, std::string_view rule);
bool has_interpolated(const View& view, std::string_view rule);
bool has_barycentric(const View& view, std::string_view rule);
bool has_rate_of_several(const View& view, std::string_view rule);
bool is_of_shared_fragment(const View& view, std::string_view rule);
bool is_at_sample(const View& view, std::string_view rule);
bool is_sample_shaded(const View& view, std::string_view rule);
bool is_written(const View& view, std::string_view rule);
bool is_passed_by_logic(const View& view, std::string_view rule);

}  // namespace ref
