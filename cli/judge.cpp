// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/judge.hpp"

#include <poll.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <exception>
#include <span>

#include "cli/frame.hpp"
#include "diff/blit.hpp"
#include "diff/verdict.hpp"
#include "ref/expectation.hpp"

namespace cli {

using report::CaseRecord;
using report::Status;

namespace {

constexpr uint32_t kPictureSide = 128;  // pixels of a kept picture, each way

// Where a window of at most kPictureSide pixels begins that shows the middle of [lo, hi] of `size`
// pixels.
uint32_t window_begin(uint32_t lo, uint32_t hi, uint32_t size) {
    if (size <= kPictureSide) {
        return 0;
    }
    const uint32_t middle = lo + (hi - lo) / 2;
    const uint32_t begin = middle > kPictureSide / 2 ? middle - kPictureSide / 2 : 0;
    return std::min(begin, size - kPictureSide);
}

report::Pictures cut_pictures(const diff::Verdict& verdict, const cases::Target& target) {
    report::Pictures p;
    p.width = std::min(target.width, kPictureSide);
    p.height = std::min(target.height, kPictureSide);
    p.left = window_begin(verdict.min_x, verdict.max_x, target.width);
    p.top = window_begin(verdict.min_y, verdict.max_y, target.height);
    const size_t row = size_t{p.width} * target.samples;
    const auto add_row = [&](std::vector<uint8_t>& to, const auto& from, size_t begin) {
        for (size_t k = begin; k < begin + row && k < from.size(); ++k) {
            to.push_back(static_cast<uint8_t>(from[k]));
        }
    };
    for (uint32_t j = 0; j < p.height; ++j) {
        const size_t begin = (size_t{p.top + j} * target.width + p.left) * target.samples;
        add_row(p.expected_hits, verdict.expected_hits, begin);
        add_row(p.device_hits, verdict.device_hits, begin);
        add_row(p.marks, verdict.marks, begin);
    }
    return p;
}

template <class T>
std::string_view raw(std::span<const T> v) {
    return {reinterpret_cast<const char*>(v.data()), v.size_bytes()};
}

}  // namespace

std::string hex(uint64_t number) {
    std::array<char, 20> text{};
    std::snprintf(text.data(), text.size(), "%016llx", static_cast<unsigned long long>(number));
    return text.data();
}

CaseRecord make_record(const cases::Case& c) {
    CaseRecord record;
    record.id = c.id;
    record.file = c.where.file;
    record.line = c.where.line;
    record.description = c.description;
    record.rules = c.rules;
    record.links = c.links;
    return record;
}

void judge(CaseRecord& record, const cases::Case& c, const diff::CaptureView& capture,
           std::span<const diff::Consistency> consistency, const ref::Limits& limits,
           cases::Profile profile, KeepPictures pictures) {
    try {
        diff::Verdict verdict = c.blit ? diff::compare_blit(c, profile, capture)
                                       : diff::compare(c, ref::expect(c, limits, profile), capture);
        if (verdict.error.empty()) {
            diff::add_differences(c, cases::derivations(c), consistency, verdict);
        }
        record.status = !verdict.error.empty() ? Status::error
                        : verdict.ok()         ? Status::pass
                                               : Status::fail;
        record.reason = verdict.error;
        if (!capture.hits.empty()) {
            record.hit_bits = hex(checksum(FrameType::result, raw(capture.hits)));
        }
        record.findings = verdict.findings;
        record.counts = verdict.counts;
        record.level = verdict.level;
        record.min_x = verdict.min_x;
        record.min_y = verdict.min_y;
        record.max_x = verdict.max_x;
        record.max_y = verdict.max_y;
        record.must_samples = verdict.must_samples;
        record.either_samples = verdict.either_samples;
        record.compared_samples = verdict.compared_samples;
        record.compared_values = verdict.compared_values;
        record.worst_ratio = verdict.worst_ratio;
        record.worst_quantity = verdict.worst_quantity;
        if (pictures == KeepPictures::all ||
            (pictures == KeepPictures::failed && record.status != Status::pass)) {
            record.pictures = cut_pictures(verdict, c.target);
        }
    } catch (const std::exception& e) {
        record.status = Status::error;
        record.reason = std::string("the comparison failed: ") + e.what();
    }
}

std::string check_before_running(const cases::Case& c) {
    try {
        return diff::check_expected_hits(c);
    } catch (const std::exception& e) {
        return std::string("the reference failed: ") + e.what();
    }
}

uint64_t capture_bits(const diff::CaptureView& capture) {
    uint64_t sum = 0;
    const auto add = [&](std::string_view bytes) {
        sum = sum * 0x9e3779b97f4a7c15U + checksum(FrameType::result, bytes);
    };
    add(raw(capture.hits));
    add(raw(capture.writers));
    add(raw(capture.frag_coord));
    add(raw(capture.depth));
    for (const std::span<const glm::vec4> attribute : capture.attributes) {
        add(raw(attribute));
    }
    add(raw(capture.color));
    add(raw(capture.stencil));
    add(raw(capture.resolved_color));
    add(raw(capture.resolved_depth));
    return sum;
}

uint64_t capture_bytes(const cases::Case& c) {
    size_t attributes = 0;
    for (const cases::Draw& draw : c.draws) {
        attributes = std::max(attributes, draw.attributes.size());
    }
    return diff::plane_bytes(c.target, static_cast<uint32_t>(attributes));
}

Pool::Pool(unsigned threads) : event_(::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)) {
    for (unsigned k = 0; k < std::max(threads, 1U); ++k) {
        threads_.emplace_back([this] { run(); });
    }
}

Pool::~Pool() {
    {
        const std::lock_guard lock(mutex_);
        stop_ = true;
        waiting_.clear();
    }
    changed_.notify_all();
    for (std::thread& thread : threads_) {
        thread.join();
    }
}

void Pool::submit(std::function<void()> work, std::function<void()> finish) {
    ++outstanding_;
    {
        const std::lock_guard lock(mutex_);
        waiting_.push_back({std::move(work), std::move(finish)});
    }
    changed_.notify_one();
}

void Pool::run() {
    for (;;) {
        Task task;
        {
            std::unique_lock lock(mutex_);
            changed_.wait(lock, [this] { return stop_ || !waiting_.empty(); });
            if (stop_) {
                return;
            }
            task = std::move(waiting_.front());
            waiting_.pop_front();
        }
        task.work();
        {
            const std::lock_guard lock(mutex_);
            done_.push_back(std::move(task));
        }
        ::eventfd_write(event_.get(), 1);
    }
}

void Pool::collect() {
    eventfd_t ignored = 0;
    ::eventfd_read(event_.get(), &ignored);
    std::deque<Task> done;
    {
        const std::lock_guard lock(mutex_);
        done.swap(done_);
    }
    for (Task& task : done) {
        --outstanding_;
        task.finish();
    }
}

void Pool::wait() const {
    pollfd fd{event_.get(), POLLIN, 0};
    ::poll(&fd, 1, -1);
}

}  // namespace cli
