// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/options/value_checks.hpp"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <system_error>

#include "report/record/run.hpp"

namespace cli {

namespace fs = std::filesystem;

namespace {

// Options that take a value.
bool takes_value(const CLI::Option& option) {
    return option.get_items_expected_max() > 0 && !option.get_positional();
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

}  // namespace

Stop usage_error(const std::string& sentence, const std::string& command) {
    const std::string help = "edgecase " + command + (command.empty() ? "" : " ") + "--help";
    return {report::kExitUsage,
            {sentence + (sentence.ends_with('?') ? " See '" : "; see '") + help + "'"}};
}

bool is_given(const CLI::Option& option, const std::vector<std::string>& words) {
    const auto names_it = [&](const std::string& word) {
        const bool is_long = word.starts_with("--");
        const std::vector<std::string>& names = is_long ? option.get_lnames() : option.get_snames();
        return word.starts_with('-') &&
               std::any_of(names.begin(), names.end(), [&](const std::string& name) {
                   return is_long ? word == "--" + name || word.starts_with("--" + name + "=")
                                  : word.starts_with("-" + name);
               });
    };
    const auto end = std::find(words.begin(), words.end(), "--");
    return std::any_of(words.begin(), end, names_it);
}

bool is_given(const CLI::App& command, const std::string& name,
              const std::vector<std::string>& words) {
    const CLI::Option* option = command.get_option_no_throw(name);
    return option != nullptr && is_given(*option, words);
}

OrStop<std::monostate> check_empty_values(const CLI::App& command,
                                          const std::vector<std::string>& words) {
    const auto refuse = [&](const std::string& name, const std::string& how) {
        return tl::unexpected(
            usage_error(name + ": the value is empty; " + how, command.get_name()));
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
        if (std::find(values.begin(), values.end(), "") == values.end()) {
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
    return std::monostate{};
}

OrStop<std::monostate> check_alternatives(const CLI::App& command) {
    struct Alternative {
        const char* command;
        const char* one;
        std::vector<const char*> others;
    };
    static const std::vector<Alternative> kAlternatives = {
        {"list", "--long", {"--ids", "--json"}},
        {"list", "--ids", {"--json"}},
        {"fuzz", "--print", {"--cases", "--time", "--shard", "--known", "--resume", "--output"}},
    };
    for (const Alternative& a : kAlternatives) {
        for (const char* other : a.others) {
            if (command.get_name() == a.command && has_value(command, a.one) &&
                has_value(command, other)) {
                return tl::unexpected(usage_error(std::string(a.one) + " and " + other +
                                                      " exclude each other; leave out one of the "
                                                      "two",
                                                  a.command));
            }
        }
    }
    return std::monostate{};
}

OrStop<std::monostate> check_files(const CLI::App& command) {
    std::string taken;
    for (const char* name : {"--json", "--junit", "--html"}) {
        const CLI::Option* option = command.get_option_no_throw(name);
        if (option == nullptr || !takes_value(*option) || option->results().empty()) {
            continue;
        }
        const std::string& file = option->results().back();
        if (file != "-") {
            if (const std::string why = unwritable(file, folder_to_be(command)); !why.empty()) {
                return tl::unexpected(
                    usage_error(std::string(name) + ": " + why, command.get_name()));
            }
            continue;
        }
        if (!taken.empty()) {
            return tl::unexpected(usage_error(taken + " and " + name +
                                                  " cannot both go to standard output; give one a "
                                                  "file",
                                              command.get_name()));
        }
        taken = name;
    }
    return std::monostate{};
}

}  // namespace cli
