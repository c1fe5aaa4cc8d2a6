// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/options/value_checks.hpp"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "report/record/run.hpp"

namespace cli {

namespace fs = std::filesystem;

namespace {

// Options that take a value.
bool takes_value(const CLI::Option& option) {
    return option.get_items_expected_max() > 0 && !option.get_positional();
}

// The folder of -o; empty if none is named.
fs::path named_folder(const CLI::App& command) {
    const CLI::Option* output = command.get_option_no_throw("--output");
    return output == nullptr || output->results().empty() ? fs::path()
                                                          : fs::path(output->results().back());
}

bool has_value(const CLI::App& command, const char* name) {
    const CLI::Option* option = command.get_option_no_throw(name);
    return option != nullptr && option->count() > 0;
}

// The folder that the command makes for its reports, so that a file may go there that has no folder
// yet; empty if it makes none.
fs::path folder_to_be(const CLI::App& command) {
    const CLI::Option* output = command.get_option_no_throw("--output");
    if (output == nullptr) {
        return {};
    }
    return output->results().empty() ? fs::path("out") : fs::path(output->results().back());
}

// Why the file cannot be written, as far as that is known before it is opened; empty if nothing is.
std::string unwritable(const fs::path& file, const fs::path& folder_to_be) {
    std::error_code error;
    if (fs::is_directory(file, error)) {
        return "'" + file.string() + "' is a folder; name a file";
    }
    const fs::path parent = file.has_parent_path() ? file.parent_path() : fs::path(".");
    if (!fs::exists(parent, error)) {
        const fs::path way =
            fs::absolute(folder_to_be, error)
                .lexically_normal()
                .lexically_relative(fs::absolute(parent, error).lexically_normal());
        const bool will_be = !folder_to_be.empty() && !way.empty() && *way.begin() != "..";
        return will_be ? "" : "there is no folder '" + parent.string() + "'; make it first";
    }
    if (!fs::is_directory(parent, error)) {
        return "'" + parent.string() + "' is no folder";
    }
    const fs::path asked = fs::exists(file, error) ? file : parent;
    if (::access(asked.c_str(), W_OK) != 0) {
        return "'" + file.string() + "' cannot be written: " + std::strerror(errno);
    }
    return {};
}

// Where a file is or will be, without links.
fs::path place_of(const fs::path& file) {
    std::error_code error;
    return fs::weakly_canonical(fs::absolute(file, error), error);
}

// How a report begins that an earlier command left. What begins otherwise is somebody's own file.
std::string_view beginning_of(const std::string& option) {
    return option == "--json" ? "{" : option == "--junit" ? "<?xml" : "<!DOCTYPE html>";
}

// Why the report would take another file's place; empty if it does not.
std::string overwritten(const std::string& option, const fs::path& file, const fs::path& folder) {
    constexpr std::array<std::pair<std::string_view, std::string_view>, 4> kOfRun = {
        {{"results.json", "--json"},
         {"junit.xml", "--junit"},
         {"report.html", "--html"},
         {"gl-code-quality.json", ""}}};
    if (file.filename() == "journal.jsonl") {
        return "'" + file.string() + "' is what a run's journal is called; name another file";
    }
    std::error_code error;
    const fs::path place = place_of(file);
    for (const auto& [name, writer] : kOfRun) {
        if (!folder.empty() && writer != option && place == place_of(folder / name)) {
            return "the run itself writes '" + file.string() + "'; name another file";
        }
    }
    if (fs::is_regular_file(file, error) && fs::file_size(file, error) > 0) {
        const std::string_view expected = beginning_of(option);
        std::string begin(expected.size(), '\0');
        std::ifstream(file, std::ios::binary)
            .read(begin.data(), static_cast<std::streamsize>(begin.size()));
        if (begin != expected) {
            return "'" + file.string() +
                   "' holds something else than such a report; remove it, or name another file";
        }
    }
    return {};
}

}  // namespace

Stop usage_error(const std::string& sentence, const std::string& command) {
    const std::string help = "edgecase " + command + (command.empty() ? "" : " ") + "--help";
    return {report::kExitUsage,
            {sentence + (sentence.ends_with('?') ? " See '" : "; see '") + help + "'"}};
}

bool is_given(const CLI::Option& option, const Words& words) {
    const auto names_it = [&](const std::string& word) {
        const bool is_long = word.starts_with("--");
        const std::vector<std::string>& names = is_long ? option.get_lnames() : option.get_snames();
        return word.starts_with('-') && std::ranges::any_of(names, [&](const std::string& name) {
                   return is_long ? word == "--" + name || word.starts_with("--" + name + "=")
                                  : word.starts_with("-" + name);
               });
    };
    const auto end = std::ranges::find(words, "--");
    return std::any_of(words.begin(), end, names_it);
}

bool is_given(const CLI::App& command, const std::string& name, const Words& words) {
    const CLI::Option* option = command.get_option_no_throw(name);
    return option != nullptr && is_given(*option, words);
}

void check_empty_values(const CLI::App& command, const Words& words) {
    const auto refuse = [&](const std::string& name, const std::string& how) {
        throw usage_error(name + ": the value is empty; " + how, command.get_name());
    };
    // CLI11 takes the next word for the value of "--icd=".
    for (auto word = words.begin(); word != words.end() && *word != "--"; ++word) {
        if (!word->starts_with("--") || word->find('=') != word->size() - 1) {
            continue;
        }
        const std::string name = word->substr(0, word->size() - 1);
        const CLI::Option* option = command.get_option_no_throw(name);
        if (option != nullptr && takes_value(*option)) {
            return refuse(name,
                          "write " + name + " " + option->get_type_name() + " or leave it out");
        }
    }
    for (const CLI::Option* option : command.get_options()) {
        const std::vector<std::string>& values = option->results();
        if (std::ranges::find(values, "") == values.end()) {
            continue;
        }
        if (takes_value(*option)) {
            return refuse(option->get_name(), "write " + option->get_name() + " " +
                                                  option->get_type_name() + " or leave it out");
        }
        if (option->get_positional() && option->get_name() != "SELECTOR" &&
            option->get_name() != "CASE") {
            return refuse(option->get_name(), "write a name");
        }
    }
}

void check_alternatives(const CLI::App& command, const char* one,
                        std::initializer_list<const char*> others) {
    for (const char* other : others) {
        if (has_value(command, one) && has_value(command, other)) {
            throw usage_error(std::string(one) + " and " + other +
                                  " exclude each other; leave out one of the two",
                              command.get_name());
        }
    }
}

void check_files(const CLI::App& command) {
    std::string taken;
    std::vector<std::pair<fs::path, std::string>> places;  // of the files, and their options
    for (const char* name : {"--json", "--junit", "--html"}) {
        const CLI::Option* option = command.get_option_no_throw(name);
        if (option == nullptr || !takes_value(*option) || option->results().empty()) {
            continue;
        }
        const std::string& file = option->results().back();
        if (file != "-") {
            std::string why = unwritable(file, folder_to_be(command));
            if (why.empty()) {
                why = overwritten(name, file, named_folder(command));
            }
            std::error_code none;
            const fs::path place = place_of(file);
            for (const auto& [other, its_option] : places) {
                if (why.empty() && place == other && !fs::is_other(place, none)) {
                    why = "the same file as " + its_option + "; give each report a file of its own";
                }
            }
            if (!why.empty()) {
                throw usage_error(std::string(name) + ": " + why, command.get_name());
            }
            places.emplace_back(place, name);
            continue;
        }
        if (!taken.empty()) {
            throw usage_error(taken + " and " + name +
                                  " cannot both go to standard output; give one a "
                                  "file",
                              command.get_name());
        }
        taken = name;
    }
}

}  // namespace cli
