// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Answers of commands that are not the driver's; hostile.cpp has those that alter an answer.
#include "behaviour.hpp"

namespace hostile {

std::span<const Behaviour> answer_behaviours() {
    static constexpr Behaviour kBehaviours[] = {
        {"no-instance", Point::instance, nullptr, VK_ERROR_INITIALIZATION_FAILED},
        {"no-device", Point::device, nullptr, VK_ERROR_INITIALIZATION_FAILED},
        {"no-host-memory", Point::allocate, nullptr, VK_ERROR_OUT_OF_HOST_MEMORY},
        {"no-device-memory", Point::allocate, nullptr, VK_ERROR_OUT_OF_DEVICE_MEMORY},
        {"no-pipeline", Point::pipeline, nullptr, VK_ERROR_OUT_OF_DEVICE_MEMORY},
        {"no-map", Point::map, nullptr, VK_ERROR_MEMORY_MAP_FAILED},
        {"map-nowhere", Point::map},
        {"submit-nothing", Point::submit},
        {"submit-lost", Point::submit, nullptr, VK_ERROR_DEVICE_LOST},
        {"submit-unknown", Point::submit, nullptr, VK_ERROR_UNKNOWN},
        {"wait-lost", Point::wait, nullptr, VK_ERROR_DEVICE_LOST},
        {"wait-for-ever", Point::wait, nullptr, VK_TIMEOUT},
        {"other-name", Point::properties},
        {"other-version", Point::properties},
        {"other-uuid", Point::properties},
        {"changing-limits", Point::properties},
        {"no-limits", Point::properties},
    };
    return kBehaviours;
}

}  // namespace hostile
