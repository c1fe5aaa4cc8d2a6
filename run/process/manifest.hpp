// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// A driver's manifest: the JSON file that names its library. Nothing is loaded into this process.
#pragma once

#include <filesystem>
#include <string>

namespace run {

struct Manifest {
    std::string file, library, problem;  // problem: "cannot be read: ..."; empty if there is none
    std::filesystem::path path;          // of the library, as dlopen takes it
};

Manifest read_manifest(const std::filesystem::path& file);

// What dlopen says of a library that does not load, asked in a process of its own; empty if it
// loads or the manifest has a problem already.
std::string load_problem(const Manifest& manifest);

// One sentence if the file that `from` (an option or a variable) chose is no manifest of a driver
// that is there; else empty.
std::string check_manifest(const std::string& file, const std::string& from);

}  // namespace run
