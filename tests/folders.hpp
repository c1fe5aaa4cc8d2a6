// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Where tests find what the source and build trees hold. One file alone is compiled with these
// names, so that a compiler cache serves every checkout.
#pragma once

#include <string>

namespace test_support {

std::string source_dir();
std::string binary_dir();

}  // namespace test_support
