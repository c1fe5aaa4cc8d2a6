// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Every fault needs a process of its own, as the layer reads its name once. A chunk of cases is
// drawn without a fault first; then each fault's process draws it, and judges what has other bits
// until a case fails. Whether it failed without the fault, too, is asked of one process more. The
// processes are forked, so that the cases need not travel.
//
// Of a pose whose first cases do not reach the fault the others are not drawn: a find may be later
// in the table than in truth, never earlier.
#include <dlfcn.h>
#include <fmt/format.h>
#include <sys/resource.h>
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
#include "fuzz/generate/generator.hpp"
#include "hunt/hunt.hpp"
#include "hunt/sequence.hpp"
#include "run/judge.hpp"
#include "run/worker/derived.hpp"
#include "vk_harness/public/harness.hpp"

namespace hunt {

namespace {

namespace fs = std::filesystem;

constexpr size_t kPosesOfFirstChunk = 8, kPosesOfChunk = 32;
constexpr size_t kFirstCases = 8, kBatch = 32;
constexpr unsigned kLongestSeconds = 300;  // of a process, which a fault may hang
// They end the device or the process (tests/breaking_layer/broken.py).
constexpr std::array<std::string_view, 4> kDeadly = {"lost-", "hang-", "crash-",
                                                     "pipeline-refused"};

// By number, a hash of what the driver drew without a fault.
using Bits = std::map<uint64_t, uint64_t>;

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

uint64_t size_of(const fs::path& file) {
    std::error_code none;
    const uintmax_t size = fs::file_size(file, none);
    return none ? 0 : size;
}

// Draws the chunk with a fault ("": none), and calls see(case, result, limits) for each case until
// it is false. `count`: of the layer; if it is empty all cases of each pose are drawn.
template <class See>
void draw(std::span<const Numbered> chunk, const std::string& fault, const fs::path& count,
          const See& see) {
    ::alarm(kLongestSeconds);
    ::setenv("EDGECASE_BREAK", fault.c_str(), 1);
    ::setenv("EDGECASE_BREAK_COUNT", count.empty() ? "/dev/null" : count.c_str(), 1);
    capture::RendererOptions options;
    options.device = "llvmpipe";
    auto renderer = vk_harness::make_renderer(options);
    if (!renderer) {
        give_up(renderer.error().message);
    }
    run::LoopConfig config;
    config.judging.limits = run::limits_of((*renderer)->device());
    const auto pose_of = [](const Numbered& one) { return one.number / fuzz::kGeometries; };
    for (size_t begin = 0; begin < chunk.size();) {
        const bool is_first = begin == 0 || pose_of(chunk[begin]) != pose_of(chunk[begin - 1]);
        const size_t most = is_first ? kFirstCases : kBatch;
        const uint64_t reached = size_of(count);
        size_t end = begin;
        std::vector<cases::Case> batch;
        while (end < chunk.size() && end < begin + most &&
               pose_of(chunk[end]) == pose_of(chunk[begin])) {
            batch.push_back(chunk[end++].data);
        }
        std::vector<run::RenderedCase> drawn =
            run::render_with_derived(**renderer, batch, [](std::string_view) {}, {});
        for (size_t k = 0; k < drawn.size(); ++k) {
            if (!see(chunk[begin + k], drawn[k], config.judging.limits)) {
                return;
            }
        }
        if (is_first && !count.empty() && size_of(count) == reached) {
            while (end < chunk.size() && pose_of(chunk[end]) == pose_of(chunk[begin])) {
                ++end;
            }
        }
        begin = end;
    }
}

uint64_t bits_of(const run::RenderedCase& drawn) {
    run::CaseResult result;
    result.rendered.status = drawn.rendered.status;
    result.rendered.reason = drawn.rendered.reason;
    result.rendered.stray_writes = drawn.rendered.stray_writes;
    result.consistency = drawn.consistency;
    const std::string findings = run::encode_findings(result) + drawn.rendered.reason;
    return drawn.rendered.status == capture::Rendered::Status::drawn
               ? cases::checksum(capture::capture_bits(capture::view_of(drawn.rendered)), findings)
               : cases::checksum(0, findings);
}

report::CaseRecord judged(const Numbered& one, const run::RenderedCase& drawn,
                          const ref::Limits& limits) {
    report::CaseRecord record = run::planned_case(one.data);
    run::judge(record, one.data, capture::view_of(drawn.rendered),
               {drawn.consistency, drawn.rendered.stray_writes}, limits, cases::Profile::direct3d,
               run::KeepPictures::none);
    return record;
}

std::set<std::string> symptoms_of(const Numbered& one, const run::RenderedCase& drawn,
                                  const ref::Limits& limits) {
    std::set<std::string> texts;
    if (drawn.rendered.status == capture::Rendered::Status::error) {
        // A call that fails: a hunt tells it as a case that is not judged. What the call was given
        // may be another number without the fault, and is nothing that shows it.
        const std::string& reason = drawn.rendered.reason;
        return {"not judged: " + reason.substr(0, reason.find(" for "))};
    }
    if (drawn.rendered.status != capture::Rendered::Status::drawn) {
        return texts;
    }
    const report::CaseRecord record = judged(one, drawn, limits);
    if (record.status == report::Status::error &&
        record.reason.find("was not copied from the device") != std::string::npos) {
        texts.insert("no picture came back");  // a hunt tells it as a case that is not judged
    }
    for (const fuzz::Symptom& symptom : fuzz::symptoms_of(record)) {
        texts.insert(fuzz::to_text(symptom));
    }
    return texts;
}

double seconds_of_children() {
    rusage usage{};
    ::getrusage(RUSAGE_CHILDREN, &usage);
    const auto seconds = [](const timeval& t) {
        return static_cast<double>(t.tv_sec) + static_cast<double>(t.tv_usec) * 1e-6;
    };
    return seconds(usage.ru_utime) + seconds(usage.ru_stime);
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

Bits bits_of_once(std::span<const Numbered> chunk) {
    const Child child = fork_child([&](int fd) {
        draw(chunk, "", {}, [&](const Numbered& one, const auto& drawn, const auto&) {
            answer(fd, fmt::format("{} {}", one.number, bits_of(drawn)));
            return true;
        });
    });
    const auto [text, status] = finish(child);
    if (status != 0) {
        give_up("the driver without a fault could not draw a chunk");
    }
    Bits bits;
    std::istringstream numbers(text);
    for (uint64_t number = 0, hash = 0; numbers >> number >> hash;) {
        bits[number] = hash;
    }
    return bits;
}

// Takes from the chunk what the driver without a fault does not draw alike each time: with a fault
// it would be drawn otherwise, too, and seem to be found.
Bits bits_without_fault(std::vector<Numbered>& chunk) {
    constexpr int kTimes = 3;
    const Bits bits = bits_of_once(chunk);
    for (int k = 1; k < kTimes; ++k) {
        const Bits again = bits_of_once(chunk);
        std::erase_if(chunk, [&](const Numbered& one) {
            return bits.at(one.number) != again.at(one.number);
        });
    }
    return bits;
}

// lavapipe 22.3 dies of a query that begins before any pipeline is bound
// (docs/findings/lavapipe-query-before-pipeline.md), and what it draws after a count that a buffer
// held hangs on what became of that buffer's memory (docs/findings/lavapipe-indirect.md).
void leave_out_broken_doors(std::vector<Numbered>& chunk) {
    std::erase_if(chunk, [](const Numbered& one) {
        return std::ranges::any_of(one.data.relations, [](const cases::Relation& relation) {
            return relation.kind == cases::RelationKind::door &&
                   (relation.door == cases::Door::query_first ||
                    relation.door == cases::Door::indirect_after_count);
        });
    });
}

std::set<std::string> lines_of(const std::string& text) {
    std::set<std::string> all;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        all.insert(line);
    }
    return all;
}

// What is wrong with a case without a fault: most cases are never asked about.
class Defects {
  public:
    explicit Defects(std::span<const Numbered> chunk) : chunk_(chunk) {}
    const std::set<std::string>& of(uint64_t number) {
        const auto [at, is_new] = known_.try_emplace(number);
        if (is_new) {
            const auto one = std::find_if(chunk_.begin(), chunk_.end(), [&](const Numbered& other) {
                return other.number == number;
            });
            const Child child = fork_child([&](int fd) {
                draw(std::span(&*one, 1), "", {},
                     [&](const Numbered& c, const auto& drawn, const auto& limits) {
                         for (const std::string& symptom : symptoms_of(c, drawn, limits)) {
                             answer(fd, symptom);
                         }
                         return true;
                     });
            });
            at->second = lines_of(finish(child).first);
        }
        return at->second;
    }

  private:
    std::span<const Numbered> chunk_;
    std::map<uint64_t, std::set<std::string>> known_;
};

// Says the number of the first case that has other bits than without the fault and fails, and below
// it what is wrong.
void hunt_one(int fd, std::span<const Numbered> chunk, const Bits& bits, const std::string& fault,
              const fs::path& count) {
    draw(chunk, fault, count, [&](const Numbered& one, const auto& drawn, const auto& limits) {
        if (bits_of(drawn) == bits.at(one.number)) {
            return true;
        }
        const std::set<std::string> symptoms = symptoms_of(one, drawn, limits);
        if (symptoms.empty()) {
            return true;
        }
        std::string text = std::to_string(one.number);
        for (const std::string& symptom : symptoms) {
            text += '\n' + symptom;
        }
        answer(fd, text);
        return false;
    });
}

// Where a fault's hunt through a chunk stands.
struct Chase {
    Find* find = nullptr;
    std::span<const Numbered> rest;
    bool is_over = false;
};

void take_answer(const Child& child, Defects& defects, Chase& chase) {
    Find& find = *chase.find;
    const auto [text, status] = finish(child);
    std::error_code none;
    const uint64_t alterations = size_of(child.count);
    find.alterations += alterations;
    fs::remove(child.count, none);
    chase.is_over = true;
    if (text.empty()) {
        if (WIFSIGNALED(status) && alterations > 0) {
            find.number = chase.rest.front().number;  // or a later one of the chunk
            find.symptom = fmt::format("ended by signal {}", WTERMSIG(status));
        } else if (WIFEXITED(status) && status != 0) {
            give_up("the driver could not draw with the fault " + find.fault);
        }
        return;
    }
    const size_t end = text.find('\n');
    const uint64_t number = std::stoull(text.substr(0, end));
    for (const std::string& symptom : lines_of(text.substr(end + 1))) {
        // Where the layer has changed nothing of the chunk, the driver draws now this, now that.
        if (alterations > 0 && !defects.of(number).contains(symptom)) {
            find.number = number;
            find.symptom = symptom;
            return;
        }
    }
    // A defect of the driver itself, drawn otherwise: go on behind it.
    while (!chase.rest.empty() && chase.rest.front().number <= number) {
        chase.rest = chase.rest.subspan(1);
    }
    chase.is_over = chase.rest.empty();
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
        // Hunts draw no ways, which alone show faults of bare pipelines.
        if (!name.starts_with("bare-") &&
            std::none_of(kDeadly.begin(), kDeadly.end(),
                         [&](std::string_view word) { return name.starts_with(word); })) {
            names.push_back(name);
        }
    }
    return names;
}

void count_cases(const Plan& plan, const std::function<void(const PoseCounts&)>& tell) {
    using Status = capture::Rendered::Status;
    Sequence sequence(plan.seed, plan.first, plan.cases);
    while (sequence.next_case() < plan.cases) {
        const std::vector<Numbered> chunk = sequence.next(1);
        if (chunk.empty()) {
            continue;
        }
        const double before = seconds_of_children();
        const Child child = fork_child([&](int fd) {
            draw(chunk, "", {}, [&](const Numbered& one, const auto& drawn, const auto& limits) {
                const Status status = drawn.rendered.status;
                const report::Status verdict = status == Status::drawn
                                                   ? judged(one, drawn, limits).status
                                                   : report::Status::error;
                answer(fd, status == Status::unsupported      ? "u"
                           : status != Status::drawn          ? "w"
                           : verdict == report::Status::error ? "e"
                           : verdict == report::Status::pass  ? "p"
                                                              : "f");
                return true;
            });
        });
        const std::string text = finish(child).first;
        const auto count = [&](char letter) {
            return static_cast<uint64_t>(std::count(text.begin(), text.end(), letter));
        };
        tell({sequence.pose().text(), count('p') + count('f'), count('f'), count('e'), count('u'),
              count('w'), seconds_of_children() - before});
    }
}

void hunt_layer(const Plan& plan, const OnFind& tell) {
    ::setenv("VK_LAYER_PATH", EDGECASE_BREAKING_LAYER, 1);
    ::setenv("VK_INSTANCE_LAYERS", "VK_LAYER_EDGECASE_breaking", 1);
    std::vector<Find> open;
    for (const std::string& fault : plan.faults) {
        open.push_back({fault, {}, {}, 0});
    }
    Sequence sequence(plan.seed, plan.first, plan.cases);
    while (sequence.next_case() < plan.cases && !open.empty()) {
        std::vector<Numbered> chunk =
            sequence.next(sequence.next_case() == 0 ? kPosesOfFirstChunk : kPosesOfChunk);
        leave_out_broken_doors(chunk);
        if (chunk.empty()) {
            continue;
        }
        const Bits bits = bits_without_fault(chunk);
        if (chunk.empty()) {
            continue;
        }
        Defects defects(chunk);
        std::vector<Chase> chases;
        for (Find& find : open) {
            chases.push_back({&find, chunk});
        }
        while (!chases.empty()) {
            const size_t count = std::min<size_t>(plan.jobs, chases.size());
            std::vector<Child> children;
            for (size_t k = 0; k < count; ++k) {
                const fs::path file =
                    fs::temp_directory_path() / fmt::format("hunt-{}-{}", ::getpid(), k);
                children.push_back(fork_child([&](int fd) {
                    hunt_one(fd, chases[k].rest, bits, chases[k].find->fault, file);
                }));
                children.back().count = file;
            }
            for (size_t k = 0; k < count; ++k) {
                take_answer(children[k], defects, chases[k]);
            }
            std::erase_if(chases, [](const Chase& chase) { return chase.is_over; });
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
