// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "rasterizers/software/choice/fault.hpp"

#include <algorithm>
#include <vector>

namespace software {

std::span<const FaultInfo> all_faults() {
    static const std::vector<FaultInfo> all = [] {
        std::vector<FaultInfo> out;
        for (const auto part : {faults_of_geometry(), faults_of_values(), faults_of_targets(),
                                faults_of_stencils()}) {
            out.insert(out.end(), part.begin(), part.end());
        }
        return out;
    }();
    return all;
}

const FaultInfo& info_of(Fault fault) {
    const auto all = all_faults();
    return *std::find_if(all.begin(), all.end(),
                         [&](const FaultInfo& info) { return info.fault == fault; });
}

std::string_view to_string(Fault fault) {
    return fault == Fault::none ? "none" : info_of(fault).name;
}

}  // namespace software
