// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// How the program was started: what its own path is and how it starts itself again as a worker.
#pragma once

#include <string>
#include <vector>

#include "cases/base/error.hpp"
#include "run/process/process.hpp"

namespace cli {

// The program's version, as project() of CMakeLists.txt has it.
extern const char* const kVersion;

struct Program {
    std::vector<std::string> arguments;  // argv
    std::string path;                    // absolute path of the program
    std::string called;  // in lines to copy: "edgecase" if PATH finds it so, else as it was called
};

// argv[0] resolved by the working directory or PATH. /proc/self/exe would be wrong: under a
// driver's own C library it names that library's ld.so.
Program make_program(int argc, const char* const* argv);

// What starts a worker: the words of EDGECASE_SELF_PREFIX, the program, "worker".
run::Command worker_command(const Program& program);

// The same under a debugger that keeps the terminal: "gdb" and "lldb" are started so that they run
// the worker at once; other words stand before it as they are ("valgrind --quiet"). Error: no such
// program.
cases::Expected<run::Command> debugged_worker_command(const Program& program,
                                                      const std::string& debugger);

// One word for a POSIX shell: as it is if it is harmless, else in single quotes.
std::string shell_quote(const std::string& word);

}  // namespace cli
