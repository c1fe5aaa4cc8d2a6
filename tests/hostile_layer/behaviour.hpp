// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What a hostile driver does, chosen by variables of the environment:
//   EDGECASE_HOSTILE=NAME[@POINT][:N]  the behaviour, the command of Vulkan's that it hides in
//                                      (else the table's), and at which call of it (else the first)
//   EDGECASE_HOSTILE_FOLDER=DIR        where it counts: a line in `starts` for each process, one in
//                                      `acts` for each time that something was done
//   EDGECASE_HOSTILE_STARTS=N          only the first N processes are hostile
//   EDGECASE_HOSTILE_CHANCE=P          each of them is with a chance of P percent
//   EDGECASE_HOSTILE_SEED=N            which of them
#pragma once

#include <vulkan/vulkan.h>

#include <span>
#include <string_view>

namespace hostile {

// A command, or one of several, of Vulkan's.
enum class Point { instance, properties, device, pipeline, allocate, map, submit, wait, count };

struct Behaviour {
    const char* name;
    Point point;                   // where it is by default
    void (*act)() = nullptr;       // done once, at the chosen call
    VkResult result = VK_SUCCESS;  // answered from the chosen call on, without asking the driver
};

// Ends, hangs and changes the process, or starts others.
std::span<const Behaviour> process_behaviours();
// Writes to, takes from and closes what the process inherited.
std::span<const Behaviour> descriptor_behaviours();
// Answers what the driver did not.
std::span<const Behaviour> answer_behaviours();

// A call of such a command begins: acts if it is time, and says what to answer instead of the
// driver's answer; VK_SUCCESS to ask the driver.
VkResult reach(Point point);
// Whether answers are to be altered, of properties: the behaviour `name` is on and its call came.
bool is_on(std::string_view name);

}  // namespace hostile
