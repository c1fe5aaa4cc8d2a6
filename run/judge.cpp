// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "run/judge.hpp"

#include <algorithm>
#include <exception>
#include <span>

#include "capture/checksum.hpp"
#include "cases/base/checksum.hpp"
#include "cases/base/limits.hpp"
#include "cases/model/way.hpp"
#include "cases/wire/case_bytes.hpp"
#include "diff/blit.hpp"
#include "diff/color.hpp"
#include "diff/verdict.hpp"
#include "diff/whole_case.hpp"
#include "ref/expectation/expectation.hpp"
#include "ref/position/viewport_grid.hpp"
#include "run/evidence.hpp"

namespace run {

using report::CaseRecord;
using report::Status;

namespace {

// What a verdict says of a case, into its record; whether pictures are to be kept, too.
bool keep_verdict(CaseRecord& record, const diff::Verdict& verdict, KeepPictures pictures) {
    record.status = !verdict.error.empty() ? Status::error
                    : verdict.ok()         ? Status::pass
                                           : Status::fail;
    record.reason = verdict.error;
    record.error_kind =
        verdict.shows_nothing ? report::ErrorKind::shows_nothing : report::ErrorKind::other;
    // A case is its author's, and has to show something; a way may show nothing of one.
    if (verdict.shows_nothing && !cases::split_way(record.id).way.empty()) {
        record.status = Status::unsupported;
        record.reason = "drawn so, the case shows nothing: a black picture would pass";
    }
    record.outcome = diff::Outcome(verdict);
    record.outcome.wrong_samples = verdict.count_wrong_samples();
    return pictures == KeepPictures::all ||
           (pictures == KeepPictures::failed && record.status != Status::pass);
}

diff::Wanted wanted_for(KeepPictures pictures) {
    return pictures == KeepPictures::symptoms ? diff::Wanted::symptoms
           : pictures == KeepPictures::brief  ? diff::Wanted::brief
                                              : diff::Wanted::all;
}

// The marks of the plain picture, where those of its doors have joined them.
void keep_plain_marks(CaseRecord& record, const std::vector<diff::SampleMark>& plain,
                      const std::vector<diff::SampleMark>& marks) {
    report::Pictures& pictures = record.evidence.pictures;
    if (plain != marks && pictures.marks.size() == plain.size()) {
        for (const diff::SampleMark mark : plain) {
            pictures.plain_marks.push_back(static_cast<uint8_t>(mark));
        }
    }
}

// Through which doors the case was drawn, and which the device lacks.
void note_doors(CaseRecord& record, std::span<const cases::Derivation> derivations,
                std::span<const diff::Consistency> found) {
    for (size_t k = 0; k < found.size() && k < derivations.size(); ++k) {
        if (derivations[k].kind != cases::RelationKind::door) {
            continue;
        }
        const std::string word(cases::row_of(derivations[k].variation.door).word);
        if (found[k].closed.empty()) {
            record.drawn.doors.push_back(word);
        } else {
            record.drawn.closed_doors.emplace_back(word, found[k].closed);
        }
    }
}

// Why a case that claims rules of doors alone has shown nothing of them: the device has none of the
// doors that its file names. Empty if that is not so.
std::string lacking_doors(const cases::Case& c, std::span<const cases::Derivation> derivations,
                          std::span<const diff::Consistency> found) {
    std::string reason;
    for (size_t k = 0; k < found.size() && k < derivations.size(); ++k) {
        const cases::Door door = derivations[k].variation.door;
        const bool is_own = derivations[k].kind == cases::RelationKind::door &&
                            std::any_of(c.relations.begin(), c.relations.end(),
                                        [&](const cases::Relation& r) { return r.door == door; });
        if (is_own && found[k].closed.empty()) {
            return {};
        }
        reason = is_own && reason.empty() ? found[k].closed : reason;
    }
    return cases::claims_doors_alone(c) ? reason : std::string();
}

// A device may keep viewports to its own grid: what is wrong with the viewports as they are is
// right if it is so with all of them kept in one way.
void try_viewport_grid(const cases::Case& c, const ref::Limits& limits,
                       const capture::CaptureView& capture, ref::Expectation& expectation,
                       diff::Verdict& verdict) {
    if (verdict.ok() || !verdict.error.empty() || c.blit) {
        return;
    }
    for (const cases::Case& kept : ref::on_viewport_grids(c, limits)) {
        ref::Expectation other = ref::expect(kept, limits, verdict.profile);
        if (diff::compare(kept, other, capture, diff::Wanted::first_finding).ok()) {
            verdict = diff::compare(kept, other, capture);
            expectation = std::move(other);
            return;
        }
    }
}

}  // namespace

report::PlannedCase planned_case(const cases::Case& c) {
    report::PlannedCase planned;
    planned.id = c.id;
    planned.file = c.claim.where.file;
    planned.line = c.claim.where.line;
    planned.description = c.claim.description;
    planned.rules = c.claim.rules;
    planned.links = c.claim.links;
    planned.catches = c.claim.catches;
    // What a run asks for besides makes no other case of it.
    cases::Case own;
    if (!c.doors.empty()) {
        own = c;
        own.doors.clear();
    }
    planned.content = cases::hex(cases::stable_hash(cases::to_bytes(c.doors.empty() ? c : own), 0));
    for (const cases::Door door : c.doors) {
        planned.doors.emplace_back(cases::row_of(door).word);
    }
    return planned;
}

void judge(CaseRecord& record, const cases::Case& filed, const capture::CaptureView& drawn,
           const WorkerFindings& found, const ref::Limits& limits, cases::Profile profile,
           KeepPictures pictures) {
    try {
        const std::optional<cases::Case> placed = ref::as_drawn(filed, limits);
        const cases::Case& c = placed ? *placed : filed;
        capture::CaptureView capture = drawn;
        if (placed) {
            capture.target = c.target;
        }
        ref::Expectation expectation =
            c.blit ? ref::Expectation{} : ref::expect(c, limits, profile);
        diff::Verdict verdict = c.blit
                                    ? diff::compare_blit(c, profile, capture)
                                    : diff::compare(c, expectation, capture, wanted_for(pictures));
        try_viewport_grid(c, limits, capture, expectation, verdict);
        if (verdict.ok() && !c.blit && !c.target.has_instruments &&
            diff::may_stay_clear(c, expectation)) {
            verdict.shows_nothing = true;
            verdict.error =
                "every sample may hold what it was cleared to, so that a black picture would pass; "
                "choose another colour, depth or clear value";
        }
        std::string lacking;
        std::vector<diff::SampleMark> plain_marks;
        if (verdict.error.empty()) {
            const std::vector<cases::Derivation> derivations = cases::derivations(c);
            lacking = lacking_doors(c, derivations, found.consistency);
            note_doors(record, derivations, found.consistency);
            plain_marks = verdict.marks;
            diff::add_differences(c, derivations, found.consistency, verdict);
            diff::add_stray_writes(c, found.stray_writes, verdict);
        }
        if (!capture.hits.empty()) {
            record.drawn.hit_bits = cases::hex(capture::hit_bits(capture));
        }
        if (keep_verdict(record, verdict, pictures)) {
            keep_evidence(record, c, verdict, expectation, capture, limits);
            keep_plain_marks(record, plain_marks, verdict.marks);
        } else if (pictures > KeepPictures::none) {
            keep_reference(record, c, verdict, expectation, limits);
        }
        if (record.status == Status::pass && !lacking.empty()) {
            record.status = Status::unsupported;
            record.reason = lacking;
        }
    } catch (const std::exception& e) {
        record.status = Status::error;
        record.reason = std::string("the comparison failed: ") + cases::reason_of(e);
    }
}

void judge_delivered(CaseRecord& record, const cases::Case& filed, const capture::Delivered& planes,
                     const ref::Limits& limits, cases::Profile profile, KeepPictures pictures) {
    record.drawn.is_delivered = true;
    try {
        const std::optional<cases::Case> placed = ref::as_drawn(filed, limits);
        const cases::Case& c = placed ? *placed : filed;
        diff::Verdict verdict;
        ref::Expectation expectation;
        capture::Capture capture;
        capture.target = c.target;
        capture.color = planes.color;
        if (c.blit) {
            verdict = diff::compare_blit(c, profile, capture);
        } else {
            expectation = ref::expect(c, limits, profile);
            verdict = diff::compare_delivered(c, expectation, planes);
        }
        if (keep_verdict(record, verdict, pictures)) {
            keep_evidence(record, c, verdict, expectation, capture, limits);
        }
    } catch (const std::exception& e) {
        record.status = Status::error;
        record.reason = std::string("the reference failed: ") + cases::reason_of(e);
    }
}

void require_support(CaseRecord& record) {
    if (record.status == Status::unsupported) {
        record.known.actual = record.status;
        record.status = Status::fail;
        record.reason = "unsupported, where --require-support asks for support: " + record.reason;
    }
}

std::string check_before_running(const cases::Case& c) {
    try {
        const auto wrong = diff::check_expected_hits(c);
        return wrong ? cases::to_string(*wrong) : "";
    } catch (const std::exception& e) {
        return std::string("the reference failed: ") + cases::reason_of(e);
    }
}

}  // namespace run
