// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Bodies of faults that change a whole picture, after a case is drawn as the device takes it.
#pragma once

#include "capture/capture.hpp"
#include "cases/fault/row.hpp"

namespace software {

// True if the fault has such a body.
bool has_picture(cases::Fault fault);
// Changes the picture, if the fault has such a body.
void spoil(cases::Fault fault, capture::Capture& picture);

}  // namespace software
