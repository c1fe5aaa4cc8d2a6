// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What the help of each command ends with, and the groups in which they are listed.
#pragma once

namespace cli {

// What the help of a command ends with.
struct Examples {
    const char* command;
    const char* text;
};
inline constexpr Examples kExamples[] = {
    {"list",
     "  edgecase list --long 'ties/**'            one family with descriptions and rules\n"
     "  edgecase list --ids '@rule:tie.*'         the cases of some rules\n"},
    {"lint", "  edgecase lint my-case.toml                is a file of your own well formed\n"},
    {"explain",
     "  edgecase explain 'ties/diagonal-edge:rotation=0' --pixel 3,4\n"
     "  edgecase explain --rule tie.top-left      what a rule demands\n"},
    {"render", "  edgecase render my-case.toml -o reference.png\n"},
    {"doctor", "  edgecase doctor --icd my_icd.json         is my driver found and usable\n"},
    {"report",
     "  edgecase report out/mine                  write the reports of a run again\n"
     "  edgecase report --merge out/shard-* -o out/all\n"},
    {"expect",
     "  edgecase expect cases/expectations/llvmpipe.txt\n"
     "  edgecase expect --update out/mine my-driver.txt --bug mesa#1234\n"},
    {"compare",
     "  edgecase compare out/before out/after     regressions and fixes\n"
     "  edgecase compare out/lavapipe out/swiftshader -v --json differences.json\n"},
    {"bench", "  edgecase bench 'coverage/**' --runs 5\n"},
    {"completion",
     "  source <(edgecase completion bash)\n"
     "  edgecase completion fish > ~/.config/fish/completions/edgecase.fish\n"},
    {"man", "  edgecase man | man -l -\n"},
};

// Commands in the groups of 'edgecase --help'.
struct Group {
    const char* command;
    const char* name;
};
inline constexpr Group kGroups[] = {
    {"run", "Checking a device"},
    {"report", "Checking a device"},
    {"compare", "Checking a device"},
    {"expect", "Checking a device"},
    {"list", "Cases"},
    {"lint", "Cases"},
    {"explain", "Cases"},
    {"render", "Cases"},
};

}  // namespace cli
