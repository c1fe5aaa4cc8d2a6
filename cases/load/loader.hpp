// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Case files: strict TOML (docs/cases.md). Every mistake is an Error with file, line and column,
// one sentence and the nearest valid name; a file with any error yields no case.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "cases/model/case.hpp"

namespace cases {

struct TomlValue;

// How much of a case is read.
enum class Contents : uint8_t {
    all,
    ids  // id, where and parameters; the file has to be TOML with a right matrix, no more
};

// All matrix leaves of one case file, in file order. `id_base` is the id without the matrix part
// ("coverage/half-square"); `file_name` is what error locations say.
ExpectedAll<std::vector<Case>> load_text(std::string_view toml, const std::string& file_name,
                                         const std::string& id_base,
                                         Contents contents = Contents::all);

// The cases of a document that has been read or made.
ExpectedAll<std::vector<Case>> load_tree(const TomlValue& root, const std::string& id_base,
                                         Contents contents = Contents::all);

// All leaves of a file. The id is the path below `suite_root` without ".toml"; a file outside
// the root has its stem as id.
ExpectedAll<std::vector<Case>> load_file(const std::filesystem::path& file,
                                         const std::filesystem::path& suite_root);

// Every *.toml below root but those whose names, or whose folders' names, begin with a dot; sorted.
// Links are followed. Errors: what cannot be read, and a link to a folder that it stands below.
Expected<std::vector<std::filesystem::path>> case_files(const std::filesystem::path& root);

struct Suite {
    std::vector<Case> cases;  // sorted by file path, leaves in file order
    Errors errors;            // of all files; ids are unique over the suite
};
// Loads case_files(). A missing or empty root is an error.
Suite load_suite(const std::filesystem::path& root, Contents contents = Contents::all);

}  // namespace cases
