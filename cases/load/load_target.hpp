// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The table [target] of a case file, and the multisample state of a draw.
#pragma once

#include "cases/model/case.hpp"
#include "cases/toml/field_reader.hpp"
#include "cases/toml/toml_reader.hpp"

namespace cases {

// Mistakes end up in the context; the target then has no width.
Target load_target(LeafContext& context, const TomlValue& table);

// sample_mask, shader_mask and min_sample_shading of a [[draw]].
Multisample load_multisample(LeafContext& context, const TomlValue& draw);

}  // namespace cases
