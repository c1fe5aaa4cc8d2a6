// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "run/process/manifest.hpp"

#include <dlfcn.h>
#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>

#include "cases/base/printable.hpp"
#include "run/process/frame.hpp"
#include "run/process/process.hpp"

namespace run {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

Manifest read_manifest(const fs::path& file) {
    Manifest manifest{file.string(), "", "", {}};
    std::error_code ignored;
    if (fs::exists(file, ignored) && !fs::is_regular_file(file, ignored)) {
        manifest.problem = fs::is_directory(file, ignored)
                               ? "is a folder; name the JSON file of a driver in it"
                               : "is no regular file";
        return manifest;
    }
    std::ifstream in(file);
    if (!in) {
        manifest.problem = std::string("cannot be read: ") + std::strerror(errno);
        return manifest;
    }
    const Json json = Json::parse(in, nullptr, false);
    const Json::json_pointer where("/ICD/library_path");
    if (json.is_discarded() || !json.contains(where) || !json.at(where).is_string()) {
        manifest.problem = "is no driver manifest (no ICD.library_path)";
        return manifest;
    }
    manifest.library = json.at(where).get<std::string>();
    manifest.path = manifest.library;
    if (manifest.library.find('/') != std::string::npos) {
        if (manifest.path.is_relative()) {
            manifest.path = fs::absolute(file.parent_path() / manifest.path, ignored);
        }
        if (!fs::exists(manifest.path, ignored)) {
            manifest.problem = "names a library that does not exist, '" +
                               cases::printable(manifest.path.string()) + "'";
        }
    }
    return manifest;
}

std::string load_problem(const Manifest& manifest) {
    if (!manifest.problem.empty() || manifest.path.empty()) {
        return {};
    }
    std::array<int, 2> ends{};
    if (::pipe2(ends.data(), O_CLOEXEC) != 0) {
        return {};
    }
    Fd read_end(ends[0]), write_end(ends[1]);
    const pid_t child = ::fork();
    if (child == 0) {
        constexpr unsigned kSeconds = 10;
        ::alarm(kSeconds);  // a driver may hang while it loads
        if (::dlopen(manifest.path.c_str(), RTLD_NOW | RTLD_LOCAL) == nullptr) {
            const char* why = ::dlerror();
            write_all(write_end.get(), why != nullptr ? why : "dlopen failed");
        }
        ::_exit(0);
    }
    write_end = Fd();
    std::string text;
    std::array<char, 512> part{};
    for (ssize_t n = 0; child > 0 && (n = ::read(read_end.get(), part.data(), part.size())) != 0;) {
        if (n < 0 && errno != EINTR) {
            break;
        }
        text.append(part.data(), static_cast<size_t>(std::max<ssize_t>(n, 0)));
    }
    if (child > 0) {
        ::waitpid(child, nullptr, 0);
    }
    return text;
}

std::string check_manifest(const std::string& file, const std::string& from) {
    const Manifest manifest = read_manifest(file);
    return manifest.problem.empty()
               ? std::string()
               : "the driver manifest '" + file + "' (" + from + ") " + manifest.problem +
                     "; 'edgecase doctor' lists those installed";
}

}  // namespace run
