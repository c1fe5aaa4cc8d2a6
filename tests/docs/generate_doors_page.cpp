// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Prints docs/doors.md: the table of doors, what each of them drew on the drivers at hand
// (docs/doors.json, written by scripts/record-doors), and how many cases of each family can take
// it.
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>

#include "cases/load/loader.hpp"
#include "cases/model/door.hpp"
#include "tests/docs/wrapped.hpp"
#include "vk_harness/public/harness.hpp"

namespace {

using Json = nlohmann::ordered_json;

std::string_view held_to(cases::DoorPromise promise) {
    switch (promise) {
        case cases::DoorPromise::same_bits:
            return "bits";
        case cases::DoorPromise::right_picture:
            return "picture";
        case cases::DoorPromise::right_alone:
            break;
    }
    return "rules";
}

void print_doors() {
    fmt::print(
        "\n## The doors\n\n"
        "*Bits*: other bits are a finding at `vulkan`, since the same vertices reach the same "
        "pipeline.\n*Picture*: at `vulkan` the picture has to be right, and only from `practice` "
        "on "
        "the same.\n*Rules*: at every profile the picture has to be right by the rules of "
        "`vulkan`.\n\n"
        "| door | group | what it does | needs | takes | rule | held to |\n"
        "| --- | --- | --- | --- | --- | --- | --- |\n");
    for (const cases::DoorRow& row : cases::all_doors()) {
        const std::string_view needs = vk_harness::needs_of(row.door);
        fmt::print("| `{}` | {} | {} | {} | {} | `{}` | {} |\n", row.word, to_string(row.group),
                   row.does, needs.empty() ? "-" : needs, row.takes, row.rule,
                   held_to(row.promise));
    }
}

void print_drivers(const Json& drivers) {
    fmt::print("\n## What ran\n\n{}\n",
               wrapped("Pictures that `edgecase run` of the whole suite drew and compared with "
                       "`--doors all` or the door's name, by driver; a dash is a door that the "
                       "driver lacks, and a door that is newer than the "
                       "numbers was not run. `scripts/record-doors` writes the numbers."));
    std::string head = "| door |", line = "| --- |";
    for (const Json& driver : drivers) {
        head += fmt::format(" {} |", driver.at("name").get<std::string>());
        line += " --- |";
    }
    fmt::print("{}\n{}\n", head, line);
    for (const cases::DoorRow& row : cases::all_doors()) {
        fmt::print("| `{}` |", row.word);
        for (const Json& driver : drivers) {
            const auto found = driver.at("pictures").find(std::string(row.word));
            const bool is_known = found != driver.at("pictures").end();
            const uint64_t pictures = is_known ? found->get<uint64_t>() : 0;
            fmt::print(" {} |", !is_known       ? "not run"
                                : pictures == 0 ? "-"
                                                : std::to_string(pictures));
        }
        fmt::print("\n");
    }
}

void print_families(const cases::Suite& suite) {
    std::map<std::string, std::map<cases::Door, size_t>> families;
    for (const cases::Case& c : suite.cases) {
        auto& counts = families[c.id.substr(0, c.id.find('/'))];
        for (const cases::DoorRow& row : cases::all_doors()) {
            counts[row.door] += cases::can_take(row.door, c) ? 1U : 0U;
        }
    }
    fmt::print("\n## Cases by family that can take a door\n\n");
    std::string head = "| family |", line = "| --- |";
    for (const cases::DoorRow& row : cases::all_doors()) {
        head += fmt::format(" {} |", row.word);
        line += " --- |";
    }
    fmt::print("{}\n{}\n", head, line);
    for (const auto& [family, counts] : families) {
        fmt::print("| {} |", family);
        for (const cases::DoorRow& row : cases::all_doors()) {
            const size_t count = counts.at(row.door);
            fmt::print(" {} |", count == 0 ? "-" : std::to_string(count));
        }
        fmt::print("\n");
    }
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 3) {
        std::fputs("usage: generate_doors_page SUITE DOORS.JSON\n", stderr);
        return 2;
    }
    const cases::Suite suite = cases::load_suite(argv[1]);
    std::ifstream in(argv[2]);
    const Json drivers = Json::parse(in, nullptr, false);
    if (!suite.errors.empty() || !drivers.is_array()) {
        std::fputs("error: the suite or the numbers of the drivers cannot be read\n", stderr);
        return 3;
    }
    fmt::print(
        "# Doors\n\n"
        "Generated from `cases/model/door.cpp`, the suite and `docs/doors.json` by "
        "`scripts/generate-docs`; do not edit.\n\n{}\n",
        wrapped(
            "A triangle can reach the rasterizer in many ways of the API, and drivers break one "
            "at a time. A door is one of them: the case is drawn as usual and through the door, "
            "and every sample of every attachment is compared bit for bit. gl_VertexIndex is "
            "compared after what the door adds to it; where a command has several draws, "
            "gl_PrimitiveID may begin again with each of them. `edgecase run --doors all` draws "
            "every case through every door that it can take, `--doors default` each door with "
            "the cheapest case of each family, both without a door that is named behind them "
            "(`--doors all,-indirect-after-count`) or that an expectation file knows to be broken "
            "on the device (`door=NAME skip`), and `relations = [{ doors = [...] }]` in a file its "
            "own. The run tells how many pictures went through doors, which doors drew "
            "none, and why."));
    print_doors();
    print_drivers(drivers);
    print_families(suite);
    return 0;
}
