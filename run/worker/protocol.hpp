// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What a worker may say to its parent, and when. Whatever else comes, while it is expected to be
// silent or to say something else, is the worker's death: a driver that writes to descriptors that
// are not its own has done more than that.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "run/process/frame.hpp"

namespace run {

enum class WorkerState : uint8_t {
    asked_device,  // started, and asked for its device
    asked_list,    // started, and asked for all devices
    answered,      // has said all that it will ever say
    idle,          // its device is ready
    busy,          // has a batch
    dead,
};

// A frame that is legal in a state, and the state behind it.
struct LegalFrame {
    WorkerState in;
    FrameType type;
    WorkerState then;
};
inline constexpr std::array kLegalFrames = {
    LegalFrame{WorkerState::asked_device, FrameType::step, WorkerState::asked_device},
    LegalFrame{WorkerState::asked_device, FrameType::hello, WorkerState::idle},
    LegalFrame{WorkerState::asked_device, FrameType::no_device, WorkerState::answered},
    LegalFrame{WorkerState::asked_list, FrameType::step, WorkerState::asked_list},
    LegalFrame{WorkerState::asked_list, FrameType::devices, WorkerState::answered},
    LegalFrame{WorkerState::asked_list, FrameType::no_device, WorkerState::answered},
    LegalFrame{WorkerState::busy, FrameType::step, WorkerState::busy},
    LegalFrame{WorkerState::busy, FrameType::result, WorkerState::busy},
    LegalFrame{WorkerState::busy, FrameType::batch_done, WorkerState::idle},
};

// The state behind a frame; nothing if it is not legal.
constexpr std::optional<WorkerState> after(WorkerState state, FrameType type) {
    for (const LegalFrame& legal : kLegalFrames) {
        if (legal.in == state && legal.type == type) {
            return legal.then;
        }
    }
    return std::nullopt;
}

// Whether anything is to come, which a time limit waits for.
constexpr bool is_expected_to_speak(WorkerState state) {
    return state == WorkerState::asked_device || state == WorkerState::asked_list ||
           state == WorkerState::busy;
}

// Bytes of a frame's payload at most, but for the planes of a result: texts, numbers, what was
// found of 256 derived renderings (64 differences of 40 bytes each) and messages of a layer.
constexpr uint64_t payload_bound(FrameType type) {
    constexpr uint64_t kStep = 256;
    constexpr uint64_t kAnswer = uint64_t{4} << 20;
    constexpr uint64_t kBesidePlanes = uint64_t{64} << 20;
    return type == FrameType::step         ? kStep
           : type == FrameType::batch_done ? 0
           : type == FrameType::result     ? kBesidePlanes
                                           : kAnswer;
}

// Steps that a worker announces, of a batch of so many cases, at most. Each renews the time limit;
// a case is drawn in some hundred ways at most, each in a few parts of four steps.
constexpr uint64_t step_bound(uint64_t cases) {
    constexpr uint64_t kOfCase = 4096;
    return kOfCase * (cases + 1);
}

}  // namespace run
