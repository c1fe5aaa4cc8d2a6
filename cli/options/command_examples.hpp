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
    {"gtest",
     "  edgecase gtest --gtest_list_tests\n"
     "  edgecase gtest --gtest_filter='edgecase.ties/apex-up'\n"},
    {"fuzz",
     "  edgecase fuzz --cases 1024 -o out/hunt         what does my driver get wrong\n"
     "  edgecase fuzz --cases 1024 --known out/hunt --seed 2\n"
     "  edgecase fuzz 'depth-bias/**' --cases 1024 --known out/hunt   cases, changed a little\n"
     "  edgecase fuzz my-case.toml --cases 1024 --known out/hunt      or what its [fuzz] says\n"},
    {"reduce",
     "  edgecase reduce multisample/scissor-tiled:samples=4 -o smaller.toml\n"
     "  edgecase reduce ties/apex-up --captures-command 'my-renderer %in %out'\n"},
    {"diagnose",
     "  edgecase diagnose out/mine                what does the device do wrong\n"
     "  edgecase diagnose out/mine --known        what do its expected failures come of\n"},
    {"probe",
     "  edgecase probe --json before.json               what does my driver do\n"
     "  edgecase probe --json after.json                and the next version of it\n"
     "  edgecase probe --compare before.json after.json\n"
     "  edgecase probe --renderer software:ties=top-right\n"},
    {"list",
     "  edgecase list --long 'ties/**'            one family with descriptions and rules\n"
     "  edgecase list --ids '@rule:tie.*'         the cases of some rules\n"},
    {"doors", "  edgecase doors                            what each of them does, and takes\n"},
    {"lint",
     "  edgecase lint my-case.toml                is a file of your own well formed\n"
     "  edgecase lint --strength my-case.toml     which known faults does it catch\n"},
    {"explain",
     "  edgecase explain 'ties/diagonal-edge:rotation=0' --pixel 3,3\n"
     "  edgecase explain --rule tie.top-left      what a rule demands\n"},
    {"render",
     "  edgecase render ties/apex-up -o picture.png                    what is allowed\n"
     "  edgecase render ties/apex-up -o picture.png --renderer tiles   what an algorithm draws\n"
     "  edgecase render blit/mirrored:sx=1,sy=0,dx=0,dy=0 -o blit.png  what a blit must leave\n"},
    {"export",
     "  edgecase export 'ties/**' -o cases               what a renderer elsewhere has to draw\n"
     "  my-renderer cases captures                       yours: draws them, writes planes\n"
     "  edgecase diff 'ties/**' --captures captures      judges what it has drawn\n"
     "  edgecase export --reproducer ties/apex-up -o bug.c   for a bug report: one C file\n"
     "\n"
     "docs/bug-reports.md tells what a reproducer draws and how it is compiled;\n"
     "docs/other-renderers.md tells it step by step; docs/schema/case-1.json is the format.\n"},
    {"diff",
     "  edgecase diff --captures captures                      what was drawn, whatever it is\n"
     "  edgecase diff --captures captures --exported cases     all that was exported to cases\n"
     "  edgecase diff 'ties/**' --captures captures -o out/me  one family, reports in out/me\n"
     "  edgecase diff --captures captures --subpixel-bits 4    of a renderer that snaps to 1/16\n"
     "\n"
     "A case whose folder holds no plane is 'not run' (exit 7); with a file unsupported.txt, "
     "whose\n"
     "first line says why, it is 'unsupported'. Planes that are missing are not judged.\n"},
    {"doctor", "  edgecase doctor --icd my_icd.json         is my driver found and usable\n"},
    {"report",
     "  edgecase report out/mine                  write the reports of a run again\n"
     "  edgecase report --merge out/shard-* -o out/all\n"},
    {"expect",
     "  edgecase expect cases/expectations/llvmpipe.txt\n"
     "  edgecase expect --update out/mine my-driver.txt --bug mesa#1234\n"},
    {"compare",
     "  edgecase compare out/before out/after     regressions and fixes\n"
     "  edgecase compare out/lavapipe out/swiftshader -v --json differences.json\n"
     "  edgecase compare out/lavapipe out/swiftshader --html differences.html\n"},
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
    {"gtest", "Checking a device"},
    {"fuzz", "Checking a device"},
    {"reduce", "Checking a device"},
    {"diagnose", "Checking a device"},
    {"probe", "Checking a device"},
    {"report", "Checking a device"},
    {"compare", "Checking a device"},
    {"expect", "Checking a device"},
    {"list", "Cases"},
    {"lint", "Cases"},
    {"explain", "Cases"},
    {"render", "Cases"},
    {"export", "Renderers elsewhere"},
    {"diff", "Renderers elsewhere"},
};

}  // namespace cli
