// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>

namespace cli {

// Does `work` for 0 .. count - 1 on all cores, in no order, with a line of progress on a
// terminal; the work does not throw.
void for_each_on_threads(size_t count, const std::function<void(size_t)>& work);

}  // namespace cli
