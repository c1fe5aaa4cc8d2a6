// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Case files on disk.

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>
#include <set>
#include <system_error>

#include "cases/base/limits.hpp"
#include "cases/base/parallel.hpp"
#include "cases/load/loader.hpp"
#include "cases/toml/toml_reader.hpp"

namespace cases {

namespace {

namespace fs = std::filesystem;

Expected<std::string> read_file(const fs::path& file) {
    const SourceLocation where{file.string(), 0, 0};
    std::error_code error;
    if (!fs::exists(file, error)) {
        return tl::unexpected(Error{where, "no such file"});
    }
    if (!fs::is_regular_file(file, error)) {
        return tl::unexpected(Error{where, "this is not a file; name a case file"});
    }
    errno = 0;
    std::ifstream stream(file, std::ios::binary);
    std::string text;
    // Pieces: most files are small. One byte more than is allowed is enough to say that the file is
    // too large.
    std::array<char, 16384> piece;
    while (stream && text.size() <= kMaxFileSize) {
        stream.read(piece.data(), piece.size());
        text.append(piece.data(), static_cast<size_t>(stream.gcount()));
    }
    if (stream.bad() || !(stream.eof() || stream.good())) {
        const int reason = errno;
        throw_if_limit(reason);
        return tl::unexpected(
            Error{where, std::string("the file cannot be read: ") + std::strerror(reason)});
    }
    text.resize(std::min(text.size(), kMaxFileSize + 1));
    return text;
}

// The path below the root without ".toml", or the stem of a file outside of it.
std::string case_id(const fs::path& file, const fs::path& root) {
    std::error_code error;
    const fs::path relative =
        fs::relative(fs::weakly_canonical(file, error), fs::weakly_canonical(root, error), error);
    if (error || relative.empty() || *relative.begin() == "..") {
        return file.stem().string();
    }
    return fs::path(relative).replace_extension().generic_string();
}

bool is_plain_id(const std::string& id) {
    return std::ranges::all_of(id, [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
               c == '_' || c == '-' || c == '.' || c == '/';
    });
}

bool is_hidden(const fs::path& path) {
    return path.filename().string().rfind('.', 0) == 0;
}

ExpectedAll<std::vector<Case>> load_as(const fs::path& file, const std::string& id,
                                       Contents contents) {
    const Expected<std::string> text = read_file(file);
    if (!text) {
        return tl::unexpected(Errors{text.error()});
    }
    if (!is_plain_id(id)) {
        return tl::unexpected(Errors{
            {{file.string(), 0, 0},
             "the file's name cannot be an id; use letters, digits, '_', '-' and '.' only"}});
    }
    ExpectedAll<std::vector<Case>> cases = load_text(*text, file.string(), id, contents);
    if (!cases) {  // leaves of a matrix repeat what is wrong with all of them
        std::set<std::string> told;
        std::erase_if(cases.error(),
                      [&](const Error& error) { return !told.insert(to_string(error)).second; });
    }
    return cases;
}

// Adds the case files of a folder and of those below it. `above`: where the folders truly are that
// lead to it.
Expected<void> add_case_files(const fs::path& folder, std::vector<fs::path>& above,
                              std::vector<fs::path>& files) {
    std::error_code error;
    const fs::path place = fs::canonical(folder, error);
    if (!error && std::ranges::find(above, place) != above.end()) {
        return tl::unexpected(Error{
            {folder.string(), 0, 0},
            "the link leads to '" + place.string() + "', a folder that holds it; remove the link"});
    }
    std::vector<fs::path> folders;
    for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
        if (is_hidden(it->path())) {
            continue;
        }
        std::error_code unknown;  // of a link that leads nowhere: reading the file will tell
        if (it->is_directory(unknown)) {
            folders.push_back(it->path());
        } else if (it->path().extension() == ".toml") {
            files.push_back(it->path());
        }
    }
    if (error) {
        const fs::path& root = above.empty() ? folder : above.front();
        return tl::unexpected(Error{{root.string(), 0, 0},
                                    "the suite cannot be read, since a folder in it cannot: '" +
                                        folder.string() + "': " + error.message() +
                                        "; a suite is a folder of case files"});
    }
    above.push_back(place);
    for (const fs::path& below : folders) {
        if (auto added = add_case_files(below, above, files); !added) {
            return added;
        }
    }
    above.pop_back();
    return {};
}

// Each file's cases, in the order of the files. Files do not depend on each other, so several
// threads read them.
std::vector<ExpectedAll<std::vector<Case>>> load_all(const std::vector<fs::path>& files,
                                                     const fs::path& root, Contents contents) {
    std::vector<ExpectedAll<std::vector<Case>>> loaded(files.size());
    for_each_index(files.size(), [&](size_t k) {
        fs::path below = files[k].lexically_relative(root);
        loaded[k] = load_as(files[k], below.replace_extension().generic_string(), contents);
    });
    return loaded;
}

}  // namespace

ExpectedAll<std::vector<Case>> load_file(const fs::path& file, const fs::path& suite_root) {
    return load_as(file, case_id(file, suite_root), Contents::all);
}

Expected<std::vector<fs::path>> case_files(const fs::path& root) {
    std::vector<fs::path> above, files;
    if (auto added = add_case_files(root, above, files); !added) {
        return tl::unexpected(added.error());
    }
    std::ranges::sort(files);
    return files;
}

Suite load_suite(const fs::path& root, Contents contents) {
    Suite suite;
    std::error_code error;
    if (!fs::is_directory(root, error)) {
        suite.errors.push_back({{root.string(), 0, 0}, "no such folder of case files"});
        return suite;
    }
    const Expected<std::vector<fs::path>> found = case_files(root);
    if (!found) {
        suite.errors.push_back(found.error());
        return suite;
    }
    const std::vector<fs::path>& files = *found;
    if (files.empty()) {
        suite.errors.push_back({{root.string(), 0, 0}, "the folder has no case file (*.toml)"});
        return suite;
    }
    for (ExpectedAll<std::vector<Case>>& loaded : load_all(files, root, contents)) {
        if (!loaded) {
            suite.errors.insert(suite.errors.end(), loaded.error().begin(), loaded.error().end());
            continue;
        }
        std::move(loaded->begin(), loaded->end(), std::back_inserter(suite.cases));
    }
    return suite;
}

}  // namespace cases
