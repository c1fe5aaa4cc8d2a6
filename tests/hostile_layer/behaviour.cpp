// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "behaviour.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>

namespace hostile {

namespace {

constexpr const char* kPoints[] = {"instance", "properties", "device", "pipeline",
                                   "allocate", "map",        "submit", "wait"};
static_assert(std::size(kPoints) == static_cast<size_t>(Point::count));

std::string variable(const char* name) {
    const char* value = std::getenv(name);
    return value != nullptr ? value : "";
}

// Adds a line; how many there are now, each of 2 bytes.
off_t add_line(const char* file) {
    const std::string path = variable("EDGECASE_HOSTILE_FOLDER") + "/" + file;
    const int fd = ::open(path.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
    struct stat status {};
    if (fd < 0 || ::write(fd, ".\n", 2) != 2 || ::fstat(fd, &status) != 0) {
        std::fprintf(stderr, "hostile layer: error: no line in %s\n", path.c_str());
        ::_exit(99);
    }
    ::close(fd);
    return status.st_size / 2;
}

struct Chosen {
    const Behaviour* behaviour = nullptr;
    Point point = Point::instance;
    unsigned long call = 1;
};

// The behaviour of this process; nothing if it is not hostile.
Chosen choose() {
    std::string words = variable("EDGECASE_HOSTILE");
    if (words.empty()) {
        return {};
    }
    Chosen chosen;
    if (const size_t colon = words.find(':'); colon != std::string::npos) {
        chosen.call = std::strtoul(words.c_str() + colon + 1, nullptr, 10);
        words.resize(colon);
    }
    std::string point;
    if (const size_t at = words.find('@'); at != std::string::npos) {
        point = words.substr(at + 1);
        words.resize(at);
    }
    for (const auto table : {process_behaviours(), descriptor_behaviours(), answer_behaviours()}) {
        for (const Behaviour& behaviour : table) {
            if (words == behaviour.name) {
                chosen.behaviour = &behaviour;
                chosen.point = behaviour.point;
            }
        }
    }
    bool is_known = point.empty();
    for (size_t k = 0; k < std::size(kPoints); ++k) {
        if (point == kPoints[k]) {
            chosen.point = static_cast<Point>(k);
            is_known = true;
        }
    }
    if (chosen.behaviour == nullptr || !is_known || chosen.call == 0) {
        std::fprintf(stderr, "hostile layer: error: EDGECASE_HOSTILE is no behaviour\n");
        ::_exit(99);
    }
    const auto start = static_cast<unsigned long>(add_line("starts"));
    const std::string starts = variable("EDGECASE_HOSTILE_STARTS");
    const std::string chance = variable("EDGECASE_HOSTILE_CHANCE");
    // A number that looks like any other of the seed and the start: splitmix64.
    uint64_t mixed = std::strtoull(variable("EDGECASE_HOSTILE_SEED").c_str(), nullptr, 10) +
                     start * 0x9e3779b97f4a7c15U;
    mixed = (mixed ^ (mixed >> 30)) * 0xbf58476d1ce4e5b9U;
    mixed = (mixed ^ (mixed >> 27)) * 0x94d049bb133111ebU;
    mixed ^= mixed >> 31;
    if ((!starts.empty() && start > std::strtoul(starts.c_str(), nullptr, 10)) ||
        (!chance.empty() && mixed % 100 >= std::strtoul(chance.c_str(), nullptr, 10))) {
        return {};
    }
    return chosen;
}

const Chosen& chosen() {
    static const Chosen kChosen = choose();
    return kChosen;
}

std::array<std::atomic<unsigned long>, static_cast<size_t>(Point::count)> calls;
std::atomic<bool> has_come = false;

}  // namespace

VkResult reach(Point point) {
    const Chosen& c = chosen();
    const unsigned long call = ++calls[static_cast<size_t>(point)];
    if (c.behaviour == nullptr || point != c.point || call < c.call) {
        return VK_SUCCESS;
    }
    if (call == c.call) {
        add_line("acts");
        has_come = true;
        if (c.behaviour->act != nullptr) {
            c.behaviour->act();
        }
    }
    return c.behaviour->result;
}

bool is_on(std::string_view name) {
    return has_come && name == chosen().behaviour->name;
}

}  // namespace hostile
