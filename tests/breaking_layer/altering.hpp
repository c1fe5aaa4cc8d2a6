// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string_view>
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

// The types are those of the headers: a signature that is not the command's does not compile.
#define BREAKING_OWN(name, function) \
    { "vk" #name, reinterpret_cast<PFN_vkVoidFunction>(static_cast<PFN_vk##name>(function)) }

using OwnCommand = std::pair<const char*, PFN_vkVoidFunction>;

inline PFN_vkVoidFunction find_command(std::span<const OwnCommand> commands,
                                       std::string_view name) {
    for (const auto& [own_name, command] : commands) {
        if (name == own_name) {
            return command;
        }
    }
    return nullptr;
}

// Commands that set dynamic state and bindings.
std::span<const OwnCommand> state_commands();

}  // namespace breaking
