// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "run/judging.hpp"

#include <utility>

#include "capture/checksum.hpp"
#include "cases/base/checksum.hpp"
#include "cases/base/heap.hpp"
#include "cases/base/parallel.hpp"

namespace run {

namespace {

constexpr uint64_t kMostBytes = uint64_t{128} << 20;

}  // namespace

Judging::Judging(const JudgingOptions& options) : options_(options), pool_(cases::cores()) {}

bool Judging::is_full() const {
    return bytes_ > kMostBytes;
}

void Judging::submit(std::shared_ptr<const cases::Case> c, CaseResult&& result,
                     report::CaseRecord planned, std::function<void(report::CaseRecord)> finish,
                     std::optional<KeepPictures> pictures) {
    const uint64_t bytes = capture::capture_bytes(*c);
    bytes_ += bytes;
    auto record = std::make_shared<report::CaseRecord>(std::move(planned));
    record->drawn.messages = result.rendered.messages;
    record->drawn.bits = cases::hex(result.bits);
    const auto keep = result.keep;
    pool_.submit(
        [c = std::move(c), result = std::make_shared<CaseResult>(std::move(result)), record,
         judge = options_.judge, limits = options_.limits, profile = options_.profile,
         pictures = pictures.value_or(options_.pictures)] {
            const WorkerFindings found{result->consistency, result->rendered.stray_writes};
            if (judge) {
                judge(*record, *c, result->view, found);
            } else {
                run::judge(*record, *c, result->view, found, limits, profile, pictures);
            }
            cases::give_back_memory();
        },
        [this, bytes, record, keep, finish = std::move(finish)] {
            bytes_ -= bytes;
            finish(std::move(*record));
        });
}

}  // namespace run
