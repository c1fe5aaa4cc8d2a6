// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Every fault needs a process of its own, as the layer reads its name once. A chunk of cases is
// drawn without a fault first; then each fault's process draws it, and judges what has other bits
// until a case fails as it did not. The processes are forked, so that the cases need not travel.
#include <dlfcn.h>
#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <set>
#include <span>
#include <sstream>

#include "capture/checksum.hpp"
#include "cases/base/checksum.hpp"
#include "cli/prepare/loop_config.hpp"
#include "fuzz/cause.hpp"
#include "fuzz/entry.hpp"
#include "hunt/hunt.hpp"
#include "hunt/sequence.hpp"
#include "run/judge.hpp"
#include "run/worker/derived.hpp"
#include "run/worker/message.hpp"

namespace hunt {

namespace {

namespace fs = std::filesystem;

constexpr size_t kPosesOfChunk = 8;
constexpr size_t kBatch = 32;
constexpr unsigned kLongestSeconds = 300;  // of a process, which a fault may hang
// They end the device or the process (tests/breaking_layer/broken.py).
constexpr std::array<std::string_view, 4> kDeadly = {"lost-", "hang-", "crash-",
                                                     "pipeline-refused"};

// What the driver drew of a case without a fault.
struct Base {
    uint64_t bits = 0;
    std::set<std::string> symptoms;
};
using Bases = std::map<uint64_t, Base>;

[[noreturn]] void give_up(const std::string& sentence) {
    fmt::print(stderr, "hunt: error: {}\n", sentence);
    std::fflush(nullptr);
    ::_exit(2);
}

// One line to the parent, at once.
void answer(int fd, const std::string& text) {
    const std::string line = text + '\n';
    if (::write(fd, line.data(), line.size()) != static_cast<ssize_t>(line.size())) {
        ::_exit(2);
    }
}

// Draws the chunk with a fault ("": none), and calls see(case, result) for each until it is false.
template <class See>
void draw(std::span<const Numbered> chunk, const std::string& fault, const fs::path& count,
          const See& see) {
    ::alarm(kLongestSeconds);
    ::setenv("EDGECASE_BREAK", fault.c_str(), 1);
    ::setenv("EDGECASE_BREAK_COUNT", count.c_str(), 1);
    run::WorkerOptions options;
    options.vulkan.device = "llvmpipe";
    auto backend = run::make_backend(options);
    if (!backend) {
        give_up(backend.error().message);
    }
    run::LoopConfig config;
    cli::set_limits(config, (*backend)->device());
    for (size_t begin = 0; begin < chunk.size(); begin += kBatch) {
        std::vector<cases::Case> batch;
        for (size_t k = begin; k < std::min(begin + kBatch, chunk.size()); ++k) {
            batch.push_back(chunk[k].data);
        }
        std::vector<run::RenderedCase> drawn =
            run::render_with_derived(**backend, batch, [](std::string_view) {}, {});
        for (size_t k = 0; k < drawn.size(); ++k) {
            if (!see(chunk[begin + k], drawn[k], config.limits)) {
                return;
            }
        }
    }
}

uint64_t bits_of(const run::RenderedCase& drawn) {
    run::CaseResult result;
    result.rendered.status = drawn.rendered.status;
    result.rendered.reason = drawn.rendered.reason;
    result.rendered.stray_writes = drawn.rendered.stray_writes;
    result.consistency = drawn.consistency;
    const std::string findings = run::encode_findings(result) + drawn.rendered.reason;
    return drawn.rendered.status == vk_harness::Rendered::Status::drawn
               ? cases::checksum(capture::capture_bits(run::view_of(drawn.rendered)), findings)
               : cases::checksum(0, findings);
}

std::set<std::string> symptoms_of(const Numbered& one, const run::RenderedCase& drawn,
                                  const ref::Limits& limits) {
    std::set<std::string> texts;
    if (drawn.rendered.status != vk_harness::Rendered::Status::drawn) {
        return texts;  // not supported, or an error of the harness: no picture was judged
    }
    report::CaseRecord record = run::make_record(one.data);
    run::judge(record, one.data, run::view_of(drawn.rendered),
               {drawn.consistency, drawn.rendered.stray_writes}, limits, cases::Profile::direct3d,
               run::KeepPictures::none);
    for (const fuzz::Symptom& symptom : fuzz::symptoms_of(record)) {
        texts.insert(fuzz::to_text(symptom));
    }
    return texts;
}

// A forked process and the end of its pipe.
struct Child {
    pid_t pid = -1;
    int fd = -1;
    std::string fault;
    fs::path count;
};

template <class Work>
Child fork_child(const Work& work) {
    std::array<int, 2> ends{};
    if (::pipe(ends.data()) != 0) {
        give_up("no pipe");
    }
    std::fflush(nullptr);
    Child child;
    child.pid = ::fork();
    if (child.pid < 0) {
        give_up("no process");
    }
    if (child.pid == 0) {
        ::close(ends[0]);
        work(ends[1]);
        std::fflush(nullptr);
        ::_exit(0);
    }
    ::close(ends[1]);
    child.fd = ends[0];
    return child;
}

// All that a child says until it ends, and how it ended.
std::pair<std::string, int> finish(const Child& child) {
    std::string text;
    std::array<char, 4096> part{};
    for (ssize_t n = 0; (n = ::read(child.fd, part.data(), part.size())) > 0;) {
        text.append(part.data(), static_cast<size_t>(n));
    }
    ::close(child.fd);
    int status = 0;
    ::waitpid(child.pid, &status, 0);
    return {text, status};
}

Bases draw_bases(std::span<const Numbered> chunk) {
    const Child child = fork_child([&](int fd) {
        draw(chunk, "", "/dev/null", [&](const Numbered& one, const auto& drawn, const auto& limits) {
            std::string line = fmt::format("{}\t{}", one.number, bits_of(drawn));
            for (const std::string& symptom : symptoms_of(one, drawn, limits)) {
                line += '\t' + symptom;
            }
            answer(fd, line);
            return true;
        });
    });
    const auto [text, status] = finish(child);
    if (status != 0) {
        give_up("the driver without a fault could not draw a chunk");
    }
    Bases bases;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        std::istringstream fields(line);
        std::string number, bits, symptom;
        std::getline(fields, number, '\t');
        std::getline(fields, bits, '\t');
        Base& base = bases[std::stoull(number)];
        base.bits = std::stoull(bits);
        while (std::getline(fields, symptom, '\t')) {
            base.symptoms.insert(symptom);
        }
    }
    return bases;
}

// Says "NUMBER<tab>SYMPTOM" of the first case that fails otherwise than without the fault.
void hunt_one(int fd, std::span<const Numbered> chunk, const Bases& bases,
              const std::string& fault, const fs::path& count) {
    draw(chunk, fault, count, [&](const Numbered& one, const auto& drawn, const auto& limits) {
        const Base& base = bases.at(one.number);
        if (bits_of(drawn) == base.bits) {
            return true;
        }
        for (const std::string& symptom : symptoms_of(one, drawn, limits)) {
            if (!base.symptoms.contains(symptom)) {
                answer(fd, fmt::format("{}\t{}", one.number, symptom));
                return false;
            }
        }
        return true;
    });
}

void take_answer(const Child& child, uint64_t first_case, Find& find) {
    const auto [text, status] = finish(child);
    const size_t tab = text.find('\t');
    if (tab != std::string::npos) {
        find.number = std::stoull(text.substr(0, tab));
        find.symptom = text.substr(tab + 1, text.find('\n') - tab - 1);
    } else if (WIFSIGNALED(status)) {
        find.number = first_case;  // or a later one of the chunk
        find.symptom = fmt::format("ended by signal {}", WTERMSIG(status));
    } else if (status != 0) {
        give_up("the driver could not draw with the fault " + find.fault);
    }
    std::error_code none;
    find.alterations += fs::file_size(child.count, none);
    fs::remove(child.count, none);
}

}  // namespace

std::vector<std::string> layer_faults() {
    const fs::path file = fs::path(EDGECASE_BREAKING_LAYER) / "libbreaking_layer.so";
    void* library = ::dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
    void* symbol = library != nullptr ? ::dlsym(library, "edgecase_breaking_faults") : nullptr;
    if (symbol == nullptr) {
        give_up("the layer is not at " + file.string() + "; build the target breaking_layer");
    }
    std::vector<std::string> names;
    std::istringstream lines(reinterpret_cast<const char* (*)()>(symbol)());
    for (std::string line; std::getline(lines, line);) {
        const std::string name = line.substr(0, line.find('\t'));
        if (std::none_of(kDeadly.begin(), kDeadly.end(),
                         [&](std::string_view word) { return name.starts_with(word); })) {
            names.push_back(name);
        }
    }
    return names;
}

void hunt_layer(const Plan& plan, const OnFind& tell) {
    ::setenv("VK_LAYER_PATH", EDGECASE_BREAKING_LAYER, 1);
    ::setenv("VK_INSTANCE_LAYERS", "VK_LAYER_EDGECASE_breaking", 1);
    std::vector<Find> open;
    for (const std::string& fault : plan.faults) {
        open.push_back({fault, {}, {}, 0});
    }
    Sequence sequence(plan.seed);
    while (sequence.next_case() < plan.cases && !open.empty()) {
        const uint64_t first_case = sequence.next_case();
        std::vector<Numbered> chunk = sequence.next(kPosesOfChunk);
        std::erase_if(chunk, [&](const Numbered& one) { return one.number >= plan.cases; });
        const Bases bases = draw_bases(chunk);
        for (size_t begin = 0; begin < open.size(); begin += plan.jobs) {
            std::vector<Child> children;
            for (size_t k = begin; k < std::min<size_t>(begin + plan.jobs, open.size()); ++k) {
                const fs::path count =
                    fs::temp_directory_path() / fmt::format("hunt-{}-{}", ::getpid(), k);
                children.push_back(fork_child([&](int fd) {
                    hunt_one(fd, chunk, bases, open[k].fault, count);
                }));
                children.back().count = count;
            }
            for (size_t k = 0; k < children.size(); ++k) {
                take_answer(children[k], first_case, open[begin + k]);
            }
        }
        std::erase_if(open, [&](const Find& find) {
            if (find.number) {
                tell(find);
            }
            return find.number.has_value();
        });
    }
    for (const Find& find : open) {
        tell(find);
    }
}

}  // namespace hunt
