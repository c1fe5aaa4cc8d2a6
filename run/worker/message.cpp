// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "run/worker/message.hpp"

#include <algorithm>

#include "cases/model/words.hpp"
#include "cases/wire/case_bytes.hpp"

namespace run {

using capture::Rendered;
using cases::wire::Reader;
using cases::wire::Writer;

std::string encode_request(uint32_t attempt, const Room& room,
                           const std::vector<const cases::Case*>& cases) {
    Writer out;
    out.put(attempt);
    out.put(room);
    out.put(uint64_t{cases.size()});
    for (const cases::Case* c : cases) {
        out.put(cases::to_bytes(*c));
    }
    return out.take();
}

std::optional<RenderRequest> decode_request(std::string_view bytes) {
    Reader in(bytes);
    RenderRequest request;
    in.get(request.attempt);
    in.get(request.room);
    for (const std::string& raw : in.get<std::vector<std::string>>()) {
        cases::Expected<cases::Case> c = cases::from_bytes(raw);
        if (!c) {
            return std::nullopt;
        }
        request.cases.push_back(std::move(*c));
    }
    return in.good() && in.at_end() ? std::optional(std::move(request)) : std::nullopt;
}

namespace {

constexpr size_t kMaxDerivations = 256;
// Two sides of every attachment, in the case's rendering and in each derived one.
constexpr size_t kMaxStrayWrites = 4096;

// False if these cannot be the findings in a capture of that many samples, resolved pixels and
// counts.
bool is_possible(const diff::Consistency& found, uint64_t samples, uint64_t resolved,
                 uint64_t counts) {
    return found.compared <= samples + resolved + counts && found.different <= found.compared &&
           found.differences.size() == std::min<uint64_t>(found.different, diff::kMaxDifferences) &&
           std::all_of(found.differences.begin(), found.differences.end(),
                       [samples, counts](const diff::Difference& d) {
                           const bool is_word = d.plane < diff::kPlanes && d.word < 4;
                           const bool is_count = d.plane == diff::kCounts && d.word < counts;
                           return d.sample < samples && (is_word || is_count) &&
                                  d.expected != d.got;
                       });
}

bool is_possible(const CaseResult& result) {
    const Rendered& r = result.rendered;
    const capture::Capture& c = r.capture;
    return c.attribute_count <= cases::kMaxAttributes &&
           result.consistency.size() <= kMaxDerivations &&
           r.stray_writes.size() <= kMaxStrayWrites &&
           std::all_of(result.consistency.begin(), result.consistency.end(),
                       [&c](const auto& found) {
                           const uint64_t samples = c.sample_count();
                           return is_possible(found, samples,
                                              capture::resolves(c.target)
                                                  ? samples / std::max(c.target.samples, 1U)
                                                  : 0,
                                              c.counted.size());
                       }) &&
           (r.status != Rendered::Status::drawn || result.is_shared || capture::has_all_planes(c));
}

}  // namespace

std::string encode_findings(const CaseResult& result) {
    Writer out;
    out.put(result.consistency);
    out.put(result.rendered.stray_writes);
    return out.take();
}

std::string encode_result(const CaseResult& result) {
    const capture::CaptureView planes(result.rendered.capture);
    Writer out;
    size_t bytes = 256;
    const auto count = [&bytes](const auto&, const auto& plane) { bytes += plane.size_bytes(); };
    capture::for_each_plane(count, planes, planes);
    out.reserve(bytes);
    out.put(result);
    if (!result.is_shared) {
        capture::for_each_plane([&out](const auto&, const auto& plane) { out.list(plane); }, planes,
                                planes);
    }
    return out.take();
}

std::optional<CaseResult> decode_result(std::string_view bytes) {
    Reader in(bytes);
    CaseResult result = in.get<CaseResult>();
    capture::Capture& c = result.rendered.capture;
    if (!result.is_shared) {
        capture::for_each_plane([&in](const auto&, auto& plane) { in.get(plane); }, c, c);
    }
    return in.good() && in.at_end() && is_possible(result) ? std::optional(std::move(result))
                                                           : std::nullopt;
}

}  // namespace run
