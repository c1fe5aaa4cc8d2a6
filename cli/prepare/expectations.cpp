// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/prepare/expectations.hpp"

#include <algorithm>
#include <filesystem>
#include <set>
#include <string_view>
#include <utility>
#include <vector>

#include "cases/model/device.hpp"
#include "cli/prepare/doors.hpp"
#include "cli/prepare/suite.hpp"
#include "run/expected/seen_pictures.hpp"

namespace cli {

namespace fs = std::filesystem;

namespace {

// The files of the suite's folder of expectations whose names end so.
std::vector<fs::path> files_beside(const fs::path& suite_root, std::string_view end) {
    std::vector<fs::path> paths;
    std::error_code none;
    for (const fs::directory_entry& entry : fs::directory_iterator(
             fs::absolute(suite_root).lexically_normal().parent_path() / "expectations", none)) {
        if (entry.path().extension() == end) {
            paths.push_back(entry.path());
        }
    }
    std::ranges::sort(paths);
    return paths;
}

// The files of pictures beside the suite, or those that stand beside the files of --expect by the
// same names.
std::vector<run::SeenPictures> find_pictures(const RunOptions& options,
                                             const fs::path& suite_root) {
    std::vector<run::SeenPictures> found;
    std::vector<fs::path> paths;
    for (fs::path path : options.expect) {
        std::error_code none;
        if (path.replace_extension(run::kPicturesEnd); fs::exists(path, none)) {
            paths.push_back(path);
        }
    }
    if (options.expect.empty() && !options.no_expect) {
        paths = files_beside(suite_root, run::kPicturesEnd);
    }
    for (const fs::path& path : paths) {
        found.push_back(must(run::load_pictures(path)));
    }
    return found;
}

// The expectation files of --expect, or those beside the suite that fit the device.
std::vector<run::ExpectationFile> find_expectations(const RunOptions& options,
                                                    const fs::path& suite_root,
                                                    const capture::DeviceInfo& device) {
    std::vector<run::ExpectationFile> found;
    if (options.no_expect) {
        return found;
    }
    std::vector<fs::path> paths(options.expect.begin(), options.expect.end());
    const bool is_explicit = !paths.empty();
    if (!is_explicit) {
        paths = files_beside(suite_root, ".txt");
    }
    for (const fs::path& path : paths) {
        run::ExpectationFile file = must(run::load_expectations(path));
        const std::string why_not = mismatch(file, device, options.profile);
        if (why_not.empty()) {
            found.push_back(std::move(file));
        } else if (is_explicit) {
            throw stop_with(report::kExitDevice, "the expectation file '" + path.string() +
                                                     "' does not fit: " + why_not +
                                                     "; choose another --device or --expect");
        }
    }
    return found;
}

}  // namespace

std::map<std::string, run::ExpectationLine> expectations_of(const RunOptions& options,
                                                            const Selection& selection,
                                                            report::Run& header) {
    const std::vector<run::ExpectationFile> files =
        find_expectations(options, selection.root, header.device);
    std::vector<std::string> ids =
        options.expect.empty() ? selection.suite_ids : selection.known_ids;
    ids.emplace_back(cases::kLimitsCase);
    auto expected = must(run::resolve_expectations(files, ids, selection.whole_suite));
    const auto pictures = find_pictures(options, selection.root);
    const bool is_known = run::tell_pictures(expected, pictures, header.device, options.strict);
    if (options.strict && !is_known && !expected.empty()) {
        throw stop_with(
            report::kExitUsage,
            "--strict asks how known failures look, and no file of pictures for this "
            "device stands beside the expectation files; write one with 'edgecase expect "
            "--update RUN FILE.pictures'");
    }
    header.skipped_doors.clear();
    for (const run::ExpectationFile& file : files) {
        for (const run::ExpectationLine& line : file.doors) {
            if (asks_for_set(doors_of(options)) && !line.is_past) {
                header.skipped_doors.emplace_back(line.glob, line.bug);
            }
        }
    }
    header.expectation_file.clear();
    std::set<std::string> paths;
    for (const run::ExpectationFile& file : files) {
        header.expectation_file +=
            (header.expectation_file.empty() ? "" : ", ") + file.path.string();
        paths.insert(file.path.string());
    }
    for (const run::SeenPictures& file : pictures) {
        paths.insert(file.path.string());
    }
    header.expectation_hash = hash_of_files(paths);
    return expected;
}

}  // namespace cli
