// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The software device (rasterizers/software) and what judges it (rasterizers/strength) by their
// names alone.
#pragma once

#include "cases/fault/fault.hpp"
#include "rasterizers/software/choice/device.hpp"

namespace software {}

namespace mutants {
using namespace software;
using cases::FaultRow;
}  // namespace mutants
