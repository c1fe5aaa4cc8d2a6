// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Whether what a hypothesis draws of a failed case fails as the device did.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string_view>

#include "capture/capture.hpp"
#include "cases/model/case.hpp"
#include "diff/verdict.hpp"
#include "ref/expectation/expectation.hpp"
#include "report/record/run.hpp"

namespace diagnosis {

// How two ways to fail one case agree. Counts are of samples but for the values.
struct Match {
    uint64_t wrong = 0;   // in the device's picture
    uint64_t same = 0;    // of them: wrong in the same way in both
    uint64_t beyond = 0;  // wrong in the hypothesis's picture alone
    uint64_t values = 0;  // findings that the device's record tells: numbers, hits, writers
    uint64_t same_values = 0;

    // All samples but a sixteenth agree. The rest is room for those at the border of what is
    // accepted, which the arithmetic of two devices may decide differently. Of what is told half is
    // enough: an error may reach more numbers in one device than in another, as a bias does that
    // FragCoord.z may or may not have.
    bool explains() const {
        return covers() && 16 * beyond <= wrong && 2 * (values - same_values) <= values;
    }
    // Whether the wrong samples are, whatever is wrong beyond. Of the values nothing is asked:
    // which are told depends on what is wrong beyond.
    bool covers() const { return same > 0 && 16 * (wrong - same) <= wrong; }
};

// A case ready to be compared with: what may be drawn of it, and what a right device draws.
struct Subject {
    const cases::Case* data = nullptr;
    // What `data` is if it is not the case of the file: with the planes that were delivered, which
    // a driver would not draw, or with the device's own sample locations.
    std::shared_ptr<const cases::Case> altered;
    const report::CaseRecord* record = nullptr;  // of the device
    ref::Expectation expectation;
    capture::Capture right;
};

// Prepares a case; nothing if the software device without a fault has a finding itself there.
std::optional<Subject> make_subject(const cases::Case& c, const report::CaseRecord& record,
                                    const ref::Limits& limits, cases::Profile profile);

// The verdict on another picture of the case, on what was judged of the device's alone: a renderer
// elsewhere need not deliver all planes.
diff::Verdict verdict_of(const Subject& subject, const capture::Capture& picture);

// True if the record has what match() needs: the picture of the whole target, a finding of it, and
// none that comes of several renderings or of memory beside the attachments. Pictures through doors
// that differ say nothing.
bool can_match(const cases::Case& c, const report::CaseRecord& record);

// The marks of the plain picture of a record: only that one is drawn again.
const std::vector<uint8_t>& marks_of(const report::CaseRecord& record);

// Whether a sample with this mark (diff::SampleMark) of a picture is wrong.
bool is_wrong_mark(uint8_t mark);

// The number of a sample that a finding's quantity names: "depth", "frag_coord.z", "attribute 1.x";
// nothing for any other.
std::optional<double> number_at(const capture::Capture& capture, size_t index,
                                std::string_view quantity);

// True if the picture has the device's hits and numbers where the device is wrong, but for as many
// as a match may lack: match() cannot explain the device otherwise, and costs much more.
bool may_match(const Subject& subject, const capture::Capture& drawn);

// Compares the device's record with the verdict on another picture of the same case.
Match match(const report::CaseRecord& device, const diff::Verdict& other);

// The numbers of two texts of a finding ("0.75 (0x3f400000)", "r 223, g 16") are the same but for a
// sixteenth of the device's error, or for one step of a whole number; all other words are equal.
// What stands in parentheses is not looked at.
bool is_same_value(std::string_view expected, std::string_view device, std::string_view other);

}  // namespace diagnosis
