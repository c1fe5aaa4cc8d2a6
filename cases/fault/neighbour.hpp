// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// A case with several colour targets as a device has it that takes something of another target for
// that of the judged one.
#pragma once

#include <cstdint>

#include "cases/model/case.hpp"

namespace cases {

enum class Taken : uint8_t {
    state,  // blending and write mask
    color,  // what the shader writes
    clear,  // the clear colour
    all,    // the two targets have changed places
};

// Whether that changes the case; not for colours of another class, which mean nothing to the format
// of the judged one. `location`: of the other target.
bool take_from(Case& c, uint32_t location, Taken taken);

}  // namespace cases
