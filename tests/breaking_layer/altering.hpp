// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <utility>

#include "driver.hpp"
#include "fault_table.hpp"

namespace breaking {

// What the layer's commands share: asking the chosen fault, and the tables of commands.
inline const Hooks& hooks() {
    return chosen_fault()->hooks;
}

// Asks the fault, if it has this hook, and counts what it altered; whether it did.
template <typename... Parameters, typename... Arguments>
bool alter(bool (*hook)(Parameters...), Arguments&&... arguments) {
    const bool altered = hook != nullptr && hook(std::forward<Arguments>(arguments)...);
    if (altered) {
        count_alteration();
    }
    return altered;
}

#define BREAKING_OWN(name, function) VULKAN_LAYER_OWN(name, function)

using vulkan_layer::find_command;
using vulkan_layer::OwnCommand;

// Commands that set dynamic state and bindings.
std::span<const OwnCommand> state_commands();
// Commands that make command buffers of others, or clear.
std::span<const OwnCommand> recording_commands();
// Queries, and what is read of them.
std::span<const OwnCommand> query_commands();
// Indirect draws, and several draws in a command.
std::span<const OwnCommand> indirect_commands();

// Draws directly, as the chosen fault alters it.
void draw_call(VkCommandBuffer commands, DrawCall call, uint32_t instances);

}  // namespace breaking
