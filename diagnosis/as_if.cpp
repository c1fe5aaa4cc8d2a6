// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/as_if.hpp"

#include <utility>

namespace diagnosis {

std::vector<Hypothesis> as_if_hypotheses() {
    std::vector<Hypothesis> out;
    for (const auto rows :
         {as_if::geometry_rows(), as_if::input_rows(), as_if::depth_rows(), as_if::target_rows()}) {
        for (const as_if::Row& row : rows) {
            Hypothesis h{std::string(row.name), std::string(row.what)};
            h.change = row.change;
            h.after = row.after;
            out.push_back(std::move(h));
        }
    }
    return out;
}

}  // namespace diagnosis
