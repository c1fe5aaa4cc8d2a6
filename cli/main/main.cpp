// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <exception>
#include <string>

#include "cases/base/limits.hpp"
#include "cli/commands.hpp"
#include "report/record/run.hpp"

namespace {

// Where a standard stream is closed the next file that is opened would have its number, and what
// is said would be written into that file: a journal. Writing to standard output stays an error.
void hold_standard_streams() {
    for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
        if (::fcntl(stream, F_GETFD) < 0 && errno == EBADF) {
            // The lowest free number is the stream's.
            (void)::open("/dev/null", stream == STDERR_FILENO ? O_WRONLY : O_RDONLY);
        }
    }
}

}  // namespace

int main(int argc, char** argv) {
    hold_standard_streams();
    ::signal(SIGXFSZ, SIG_IGN);  // a file that may not grow is an error of the write, and told
    try {
        return cli::edgecase_main(argc, argv);
    } catch (const std::exception& e) {
        const std::string why = cases::reason_of(e);
        std::fprintf(stderr,
                     cases::is_limit(e) ? "edgecase: %s\n"
                                        : "edgecase: internal error: %s; please report it\n",
                     why.c_str());
        return report::kExitInternal;
    }
}
