// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What the frames between the parent and a worker carry. Every decode_* returns nothing for bytes
// that its encode_* could not have written.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "capture/checksum.hpp"
#include "capture/renderer.hpp"
#include "cases/model/case.hpp"
#include "cases/wire/bytes.hpp"
#include "diff/consistency.hpp"

namespace run {

// A message that is one value, as bytes: WorkerOptions, a device or a list of them, a failure.
template <class T>
std::string encode(const T& value) {
    cases::wire::Writer out;
    out.put(value);
    return out.take();
}
// Nothing if the bytes are no such value, or hold more than it.
template <class T>
std::optional<T> decode(std::string_view bytes) {
    cases::wire::Reader in(bytes);
    T value = in.get<T>();
    return in.good() && in.at_end() ? std::optional(std::move(value)) : std::nullopt;
}

// How a worker is to render.
struct WorkerOptions {
    capture::RendererOptions device;
    // Batches are not drawn: each case is answered with what the device lacks for it (unsupported,
    // and why), or as an error without a reason where it lacks nothing.
    bool only_asks = false;
    static void fields(auto&& visit, auto&... o) {
        visit("device", o.device...);
        visit("only_asks", o.only_asks...);
    }
};

// Where in the shared memory a batch may write its captures; with size 0 it may do so nowhere.
struct Room {
    uint64_t offset = 0, size = 0;
};
// A batch of cases that a worker is to draw; `attempt` counts from 1.
struct RenderRequest {
    uint32_t attempt = 1;
    Room room;
    std::vector<cases::Case> cases;
};
std::string encode_request(uint32_t attempt, const Room& room,
                           const std::vector<const cases::Case*>& cases);
std::optional<RenderRequest> decode_request(std::string_view bytes);

// One case of a batch. The capture's planes travel as raw bytes; decoding refuses planes whose
// sizes do not fit the target.
struct CaseResult {
    uint32_t index = 0;  // in the batch
    capture::Rendered rendered;
    // Set if the planes lie in shared memory: where, and capture::capture_bits() of them when they
    // were written. The message is worth nothing if the bits are others when it arrives.
    bool is_shared = false;
    uint64_t offset = 0;
    uint64_t bits = 0;
    // What comparing the case's derived renderings with it has found, one a derivation.
    std::vector<diff::Consistency> consistency;
    // In the parent: the capture, wherever it lies, and what keeps it there.
    capture::CaptureView view;
    std::shared_ptr<const void> keep;
    // Of a message; the planes follow it unless they are shared.
    static void fields(auto&& visit, auto&... r) {
        visit("index", r.index...);
        visit("rendered", r.rendered...);
        visit("consistency", r.consistency...);
        visit("is_shared", r.is_shared...);
        visit("offset", r.offset...);
        visit("bits", r.bits...);
    }
};
// The findings of the worker itself as bytes, for the checksum by which two renderings are
// compared; they are not sent.
std::string encode_findings(const CaseResult& result);
std::string encode_result(const CaseResult& result);
std::optional<CaseResult> decode_result(std::string_view bytes);

}  // namespace run
