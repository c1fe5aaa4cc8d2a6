// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// A device that is lost, hangs, crashes, or fails every now and then. N is the parameter of
// EDGECASE_BREAK.
#include <array>

#include "fault.hpp"

namespace breaking {

namespace {

template <Answer answer>
Answer nth(uint64_t number) {
    return number == parameter() ? answer : Answer::as_asked;
}
template <Answer answer>
Answer every_nth(uint64_t number) {
    return number % parameter() == 0 ? answer : Answer::as_asked;
}

constexpr std::array kDeviceFaults = {
    Fault{
        "nothing-every-nth",
        "Every N-th rendering draws nothing.",
        {.draw = [](DrawCall& d) { return d.rendering % parameter() == 0 && change(d.times, 0); }}},
    Fault{"lost-at-submit",
          "The N-th submission of a process loses the device.",
          {.submit = nth<Answer::device_lost>}},
    Fault{"lost-every-nth-submit",
          "Every N-th submission loses the device.",
          {.submit = every_nth<Answer::device_lost>}},
    Fault{"lost-at-wait",
          "The device is lost while the N-th submission is waited for.",
          {.wait = nth<Answer::device_lost>}},
    Fault{"hang-at-wait", "The N-th wait of a process never ends.", {.wait = nth<Answer::hang>}},
    Fault{"crash-at-submit",
          "The N-th submission of a process is a segmentation fault.",
          {.submit = nth<Answer::crash>}},
    Fault{"crash-at-pipeline",
          "The N-th pipeline of a process is a segmentation fault.",
          {.make_pipeline = nth<Answer::crash>}},
    Fault{"pipeline-refused",
          "The N-th pipeline of a process cannot be made.",
          {.make_pipeline = nth<Answer::unknown_error>}},
    Fault{"refused-every-nth-pipeline",
          "Every N-th pipeline cannot be made.",
          {.make_pipeline = every_nth<Answer::unknown_error>}},
    Fault{"refused-every-nth-allocation",
          "Every N-th allocation of memory fails.",
          {.allocate = every_nth<Answer::no_memory>}},
    Fault{"refused-every-nth-image",
          "Every N-th image cannot be made.",
          {.make_image = every_nth<Answer::no_memory>}},
    Fault{"refused-every-nth-map",
          "Every N-th mapping of memory fails.",
          {.map = every_nth<Answer::no_memory>}},
    Fault{"refused-every-nth-submit",
          "Every N-th submission fails for lack of memory.",
          {.submit = every_nth<Answer::no_memory>}},
};

}  // namespace

std::span<const Fault> device_faults() {
    return kDeviceFaults;
}

}  // namespace breaking
