// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/prepare/ci.hpp"

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <string>

#include "cli/prepare/outputs.hpp"
#include "report/files/ci.hpp"

namespace cli {

namespace fs = std::filesystem;

namespace {

std::string value_of(const char* variable) {
    const char* value = std::getenv(variable);
    return value != nullptr ? value : "";
}

// The root of the checkout, or the current folder.
fs::path base_of(const char* variable) {
    std::error_code ignored;
    const std::string value = value_of(variable);
    return value.empty() ? fs::current_path(ignored) : fs::path(value);
}

}  // namespace

Ci chosen_ci(Ci option) {
    if (option != Ci::automatic) {
        return option;
    }
    return value_of("GITHUB_ACTIONS") == "true" ? Ci::github
           : value_of("GITLAB_CI") == "true"    ? Ci::gitlab
                                                : Ci::none;
}

bool is_ci() {
    const std::string value = value_of("CI");
    return !value.empty() && value != "false" && value != "0";
}

cases::Errors write_ci(const report::Run& run, Ci ci, const fs::path& folder, std::FILE* console) {
    cases::Errors errors;
    if (ci == Ci::github) {
        const std::string text = report::to_github_annotations(run, base_of("GITHUB_WORKSPACE"));
        std::fputs(text.c_str(), console);
        std::fflush(console);
        if (const std::string file = value_of("GITHUB_STEP_SUMMARY"); !file.empty()) {
            std::ofstream out(file, std::ios::binary | std::ios::app);
            if (!(out << report::to_github_summary(run) << std::flush)) {
                errors.push_back(
                    {{},
                     "the step summary '" + file + "' cannot be written: " + std::strerror(errno)});
            }
        }
    } else if (ci == Ci::gitlab) {
        const std::string text = report::to_gitlab(run, base_of("CI_PROJECT_DIR"));
        if (auto written = replace_text(folder / "gl-code-quality.json", text); !written) {
            errors.push_back(written.error());
        }
    }
    return errors;
}

}  // namespace cli
