// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "device_class.hpp"

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <sstream>

namespace device_classes {

namespace {

// One line a fact: a word, then what it says.
bool read_line(const std::string& line, DeviceClass& out) {
    std::istringstream in(line);
    std::string word;
    in >> word;
    if (word == "name") {
        std::getline(in >> std::ws, out.name);
    } else if (word == "api") {
        uint32_t major = 0;
        uint32_t minor = 0;
        in >> major >> minor;
        out.api_version = VK_MAKE_API_VERSION(0, major, minor, 0);
    } else if (word == "feature" || word == "extension" || word == "trap") {
        std::string name;
        in >> name;
        (word == "feature" ? out.features
         : word == "trap"  ? out.traps
                           : out.extensions)
            .insert(name);
    } else if (word == "limit") {
        std::string name;
        in >> name >> out.limits[name];
    } else if (word == "lacks") {
        int format = 0;
        VkFormatFeatureFlags features = 0;
        in >> format >> features;
        out.lacks[static_cast<VkFormat>(format)] = features;
    } else if (word == "samples") {
        in >> out.samples;
    } else {
        return false;
    }
    return !in.fail();
}

const DeviceClass* read_class() {
    static DeviceClass read;
    const char* path = std::getenv("EDGECASE_DEVICE_CLASS");
    std::ifstream file(path != nullptr ? path : "");
    bool is_good = file.good();
    for (std::string line; is_good && std::getline(file, line);) {
        is_good = read_line(line, read);
    }
    if (!is_good || read.name.empty()) {
        std::fprintf(stderr,
                     "device class layer: error: EDGECASE_DEVICE_CLASS names no file that "
                     "device_classes.py has written: '%s'\n",
                     path != nullptr ? path : "");
        return nullptr;
    }
    return &read;
}

}  // namespace

const DeviceClass* shown_class() {
    static const DeviceClass* const kClass = read_class();
    return kClass;
}

void complain(const std::string& used) {
    std::fprintf(stderr,
                 "device class layer: error: %s is used, which a device of the class '%s' does not "
                 "advertise\n",
                 used.c_str(), shown_class()->name.c_str());
    std::abort();
}

}  // namespace device_classes
