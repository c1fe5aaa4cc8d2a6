// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "run/process/manifest.hpp"

#include <dlfcn.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
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
    if (::pipe2(ends.data(), O_CLOEXEC | O_NONBLOCK) != 0) {
        return {};
    }
    Fd read_end(ends[0]), write_end(ends[1]);
    ChildProcess child;
    child.pid = ::fork();
    if (child.pid == 0) {
        ::setpgid(0, 0);
        if (::dlopen(manifest.path.c_str(), RTLD_NOW | RTLD_LOCAL) == nullptr) {
            const char* why = ::dlerror();
            write_all(write_end.get(), why != nullptr ? why : "dlopen failed");
        }
        ::_exit(0);
    }
    write_end = Fd();
    if (child.pid < 0) {
        return {};
    }
    ::setpgid(child.pid, child.pid);
    // A library may hang while it is loaded, and what it starts may hold the pipe open for ever.
    constexpr int kSeconds = 10, kPollMs = 10;
    for (int waited = 0; waited < kSeconds * 1000 && !has_ended(child); waited += kPollMs) {
        ::poll(nullptr, 0, kPollMs);
    }
    const ExitStatus end = kill_and_reap(child, 0);
    std::string text(size_t{1} << 12, '\0');  // less than the pipe holds
    text.resize(static_cast<size_t>(
        std::max<ssize_t>(::read(read_end.get(), text.data(), text.size()), 0)));
    if (text.empty() && end.signalled) {
        return end.code == SIGKILL ? fmt::format("it had not ended after {} s", kSeconds)
                                   : "it was killed by " + signal_name(end.code);
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
