// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "cases/base/printable.hpp"
#include "vk_harness/public/harness.hpp"

namespace vk_harness {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
using Paths = std::vector<fs::path>;

namespace {

std::string value_of(const char* variable, const std::string& otherwise = {}) {
    const char* value = std::getenv(variable);
    return value != nullptr && *value != '\0' ? value : otherwise;
}

void add_list(Paths& places, const std::string& list, const std::string& below = {}) {
    std::istringstream in(list);
    for (std::string item; std::getline(in, item, ':');) {
        if (!item.empty()) {
            places.push_back(below.empty() ? fs::path(item) : fs::path(item) / below);
        }
    }
}

std::string data_folders() {
    return value_of("XDG_DATA_DIRS", "/usr/local/share:/usr/share");
}

capture::Driver read_manifest(const fs::path& file) {
    capture::Driver driver{file.string(), "", "", {}};
    std::error_code ignored;
    if (fs::exists(file, ignored) && !fs::is_regular_file(file, ignored)) {
        driver.problem = fs::is_directory(file, ignored)
                             ? "is a folder; name the JSON file of a driver in it"
                             : "is no regular file";
        return driver;
    }
    std::ifstream in(file);
    if (!in) {
        driver.problem = std::string("cannot be read: ") + std::strerror(errno);
        return driver;
    }
    const Json json = Json::parse(in, nullptr, false);
    const Json::json_pointer where("/ICD/library_path");
    if (json.is_discarded() || !json.contains(where) || !json.at(where).is_string()) {
        driver.problem = "is no driver manifest (no ICD.library_path)";
        return driver;
    }
    driver.library = json.at(where).get<std::string>();
    driver.path = driver.library;
    if (driver.library.find('/') != std::string::npos) {
        if (driver.path.is_relative()) {
            driver.path = fs::absolute(file.parent_path() / driver.path, ignored);
        }
        if (!fs::exists(driver.path, ignored)) {
            driver.problem = "names a library that does not exist, '" +
                             cases::printable(driver.path.string()) + "'";
        }
    }
    return driver;
}

// The files and folders of manifests that the loader looks at, and what chose them.
Paths manifest_places(const capture::RendererOptions& options, std::string& chosen_by) {
    Paths places;
    if (!options.icd.empty()) {
        chosen_by = options.icd_from;
        return {options.icd};
    }
    for (const char* variable : {"VK_DRIVER_FILES", "VK_ICD_FILENAMES"}) {
        if (const std::string list = value_of(variable); !list.empty()) {
            chosen_by = variable;
            add_list(places, list);
            return places;
        }
    }
    const std::string home = value_of("HOME");
    add_list(places, value_of("XDG_CONFIG_HOME", home + "/.config"), "vulkan/icd.d");
    add_list(places, "/etc/xdg:/etc", "vulkan/icd.d");
    add_list(places, home + "/.local/share", "vulkan/icd.d");
    add_list(places, data_folders(), "vulkan/icd.d");
    return places;
}

std::string find_validation_layer() {
    Paths folders;
    add_list(folders, value_of("VK_LAYER_PATH"));
    add_list(folders, data_folders(), "vulkan/explicit_layer.d");
    folders.emplace_back("/etc/vulkan/explicit_layer.d");
    folders.emplace_back(value_of("HOME") + "/.local/share/vulkan/explicit_layer.d");
    std::error_code none;
    for (const fs::path& folder : folders) {
        const fs::path file = folder / "VkLayer_khronos_validation.json";
        if (fs::exists(file, none)) {
            return file.string();
        }
    }
    return {};
}

}  // namespace

capture::Installed find_drivers(const capture::RendererOptions& options) {
    capture::Installed out;
    for (const fs::path& place : manifest_places(options, out.chosen_by)) {
        std::error_code ignored;
        if (!fs::is_directory(place, ignored)) {
            if (!out.chosen_by.empty()) {
                out.drivers.push_back(read_manifest(place));
            }
            continue;
        }
        Paths files;
        for (const fs::directory_entry& entry : fs::directory_iterator(place, ignored)) {
            if (entry.path().extension() == ".json") {
                files.push_back(entry.path());
            }
        }
        std::ranges::sort(files);
        std::ranges::transform(files, std::back_inserter(out.drivers), read_manifest);
    }
    if (const std::string& icd = options.icd; !icd.empty()) {
        if (const capture::Driver driver = read_manifest(icd); !driver.problem.empty()) {
            out.problem = "the driver manifest '" + icd + "' (" + options.icd_from + ") " +
                          driver.problem + "; 'edgecase doctor' lists those installed";
        }
    }
    out.validation_layer = find_validation_layer();
    return out;
}

}  // namespace vk_harness
