// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// A run with a case of every status, made by hand; and bytes that no report may trip over.
#pragma once

#include <initializer_list>
#include <string>

#include "report/record/run.hpp"

namespace report::test {

// ESC, NUL, bytes that are not UTF-8, an overlong form, a surrogate, U+2028, U+FFFE, and the ends
// of CDATA, script and comment.
inline const std::string kHostile = std::string("\x1b[31mred\0nul", 12) +
                                    "\xff\xfe \xc0\xaf \xed\xa0\x80 \xe2\x80\xa8 \xef\xbf\xbe " +
                                    "]]> </script><script>alert(1)</script> <!-- --> & \" ' "
                                    "\r\n\t \x7f \xc2\x9b \xf0\x9f\x98\x80";

inline Run run_of(std::initializer_list<Status> statuses) {
    Run run;
    for (const Status status : statuses) {
        run.cases.emplace_back().status = status;
    }
    return run;
}

Run sample_run();
// As sample_run, every text replaced by hostile bytes (ids stay distinct).
Run hostile_run();

}  // namespace report::test
