// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The command lines of a case, as reports show them.
#pragma once

#include <string>
#include <string_view>

#include "report/record/run.hpp"
#include "report/text/causes.hpp"

namespace report {

// The settings in front of a command line, each with the space after it: "VK_DRIVER_FILES=a.json "
// of "VK_DRIVER_FILES=a.json edgecase run x". A value may be quoted as a shell does by ' and \.
// Empty without any; a view of `command`.
std::string_view settings_of(std::string_view command);

// The command line of a cause's smallest case, through the cause's door or one of its rule, if it
// has any: that of the record is of its leading finding.
std::string rerun_of(const Cause& cause);

// The command line that runs a case that crashed or hung under a debugger; empty of any other.
std::string debug_line(const CaseRecord& record);

}  // namespace report
