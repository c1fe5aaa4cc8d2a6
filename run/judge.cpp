// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "run/judge.hpp"

#include <poll.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <exception>
#include <span>

#include "diff/blit.hpp"
#include "diff/stray_write.hpp"
#include "diff/verdict.hpp"
#include "ref/expectation/expectation.hpp"
#include "run/evidence.hpp"
#include "run/process/frame.hpp"

namespace cli {

using report::CaseRecord;
using report::Status;

namespace {

// What a verdict says of a case, into its record; whether pictures are to be kept, too.
bool keep_verdict(CaseRecord& record, const diff::Verdict& verdict, KeepPictures pictures) {
    record.status = !verdict.error.empty() ? Status::error
                    : verdict.ok()         ? Status::pass
                                           : Status::fail;
    record.reason = verdict.error;
    record.findings = verdict.findings;
    record.counts = verdict.counts;
    record.wrong_samples = verdict.wrong_samples();
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
    return pictures == KeepPictures::all ||
           (pictures == KeepPictures::failed && record.status != Status::pass);
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
    record.catches = c.catches;
    return record;
}

void judge(CaseRecord& record, const cases::Case& c, const diff::CaptureView& capture,
           const WorkerFindings& found, const ref::Limits& limits, cases::Profile profile,
           KeepPictures pictures) {
    try {
        const ref::Expectation expectation =
            c.blit ? ref::Expectation{} : ref::expect(c, limits, profile);
        diff::Verdict verdict = c.blit ? diff::compare_blit(c, profile, capture)
                                       : diff::compare(c, expectation, capture);
        if (verdict.error.empty()) {
            diff::add_differences(c, cases::derivations(c), found.consistency, verdict);
            diff::add_stray_writes(c, found.stray_writes, verdict);
        }
        if (!capture.hits.empty()) {
            record.hit_bits = hex(checksum(FrameType::result, raw(capture.hits)));
        }
        if (keep_verdict(record, verdict, pictures)) {
            keep_evidence(record, c, verdict, expectation, capture, limits);
        }
    } catch (const std::exception& e) {
        record.status = Status::error;
        record.reason = std::string("the comparison failed: ") + e.what();
    }
}

void judge_delivered(CaseRecord& record, const cases::Case& c, const diff::Delivered& planes,
                     const ref::Limits& limits, cases::Profile profile, KeepPictures pictures) {
    try {
        diff::Verdict verdict;
        ref::Expectation expectation;
        diff::Capture capture;
        capture.target = c.target;
        capture.color = planes.color;
        if (c.blit) {
            verdict = diff::compare_blit(c, profile, capture);
        } else {
            expectation = ref::expect(c, limits, profile);
            verdict = diff::compare_delivered(c, expectation, planes);
        }
        if (keep_verdict(record, verdict, pictures)) {
            keep_pictures(record, c, verdict, expectation, capture, limits);
        }
    } catch (const std::exception& e) {
        record.status = Status::error;
        record.reason = std::string("the reference failed: ") + e.what();
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
