// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "scene.hpp"

namespace histories {

// The case file of a scene, in the words of docs/cases.md.
std::string text_of(const Scene& scene);

}  // namespace histories
