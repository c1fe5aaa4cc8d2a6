// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/fuzzing/start_cases.hpp"

#include <algorithm>
#include <filesystem>
#include <map>
#include <memory>
#include <utility>

#include "cases/base/checksum.hpp"
#include "cases/base/input_file.hpp"
#include "cases/toml/toml_reader.hpp"
#include "fuzz/change/changed_source.hpp"

namespace cli {

namespace {

struct File {
    uint64_t hash = 0;
    std::shared_ptr<const fuzz::Document> open;  // the whole of it, if it has a table [fuzz]
};

File read(const std::string& name) {
    const std::string text = cases::read_file(name).value_or("");
    File file{cases::stable_hash(text, 0), {}};
    // Only few files have one, and parsing all of them takes time.
    if (text.find("fuzz") != std::string::npos) {
        if (auto document = cases::read_toml(text, name); document && document->find("fuzz")) {
            file.open = std::make_shared<const fuzz::Document>(std::move(*document));
        }
    }
    return file;
}

// Of the selected cases, by the names of the files.
std::map<std::string, File> read_files(const LoadedSuite& suite) {
    std::map<std::string, File> files;
    for (const size_t k : suite.selected) {
        const std::string& name = suite.cases[k].claim.where.file;
        if (!files.contains(name)) {
            files.emplace(name, read(name));
        }
    }
    return files;
}

cases::Errors check_open_values(const LoadedSuite& suite,
                                const std::map<std::string, File>& files) {
    std::map<std::string, std::vector<fuzz::Start>> open;
    for (const size_t k : suite.selected) {
        const cases::Case& c = suite.cases[k];
        if (const File& file = files.at(c.claim.where.file); file.open) {
            open[c.claim.where.file].push_back({c, file.open});
        }
    }
    cases::Errors errors;
    for (const auto& [file, leaves] : open) {
        const cases::Errors more = fuzz::check_open_values(leaves);
        errors.insert(errors.end(), more.begin(), more.end());
    }
    return errors;
}

}  // namespace

cases::Errors check_open_values(const LoadedSuite& suite) {
    return check_open_values(suite, read_files(suite));
}

StartCases start_cases(const Program& program, const SuiteOptions& options, uint64_t seed) {
    StartCases out;
    if (options.selectors.empty()) {
        out.source = [seed] { return std::make_unique<fuzz::GeneratedSource>(seed); };
        return out;
    }
    if (std::ranges::find(options.selectors, "-") != options.selectors.end()) {
        // A hunt that goes on could not read them again.
        throw stop_with(
            report::kExitUsage,
            "'-' does not go with fuzz; name the cases, or a file or folder of your own");
    }
    LoadedSuite suite = load_selected(program, options);
    if (suite.selected.empty()) {
        throw stop_with(report::kExitNothingSelected, "the selection is empty");
    }
    const std::map<std::string, File> files = read_files(suite);
    if (const cases::Errors errors = check_open_values(suite, files); !errors.empty()) {
        throw invalid_files(errors);
    }
    std::vector<fuzz::Start> starts;
    uint64_t hash = 0;
    for (const size_t k : suite.selected) {
        cases::Case& c = suite.cases[k];
        const File& file = files.at(c.claim.where.file);
        hash = cases::stable_hash(c.id + cases::hex(file.hash), hash);
        starts.push_back({std::move(c), file.open});
    }
    std::error_code none;
    out.suite = std::filesystem::absolute(suite.root, none).lexically_normal().string();
    out.checksum = cases::hex(hash);
    out.count = starts.size();
    out.source = [seed, all = std::make_shared<const std::vector<fuzz::Start>>(std::move(starts))] {
        return std::make_unique<fuzz::ChangedSource>(seed, all);
    };
    return out;
}

}  // namespace cli
