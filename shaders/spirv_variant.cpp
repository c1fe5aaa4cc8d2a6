// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "shaders/spirv_variant.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <string_view>
#include <utility>

namespace shaders {

namespace {

// SPIR-V specification, sections 2.3 and 3.
constexpr uint32_t kMagic = 0x07230203;
constexpr uint32_t kHeaderWords = 5;
enum Op : uint32_t {
    kOpExtension = 10,
    kOpEntryPoint = 15,
    kOpExecutionMode = 16,
    kOpCapability = 17,
    kOpTypeVoid = 19,
    kOpTypeFloat = 22,
    kOpTypeVector = 23,
    kOpTypePointer = 32,
    kOpTypeFunction = 33,
    kOpConstant = 43,
    kOpConstantComposite = 44,
    kOpFunction = 54,
    kOpStore = 62,
    kOpLabel = 248,
    kOpVariable = 59,
    kOpDecorate = 71,
    kOpDecorationGroup = 73,
    kOpGroupDecorate = 74,
    kOpKill = 252,
    kOpReturn = 253,
    kOpTerminateInvocation = 4416,
    kOpDemoteToHelperInvocation = 5380,
};
enum Decoration : uint32_t {
    kBuiltIn = 11,
    kNoPerspective = 13,
    kFlat = 14,
    kCentroid = 16,
    kSample = 17,
    kLocation = 30,
    kInputAttachmentIndex = 43,
};
enum Capability : uint32_t {
    kGeometry = 2,
    kSampleRateShading = 35,
    kDemoteToHelperInvocation = 5379
};
constexpr uint32_t kStorageInput = 1, kStorageOutput = 3, kStoragePrivate = 6;
constexpr uint32_t kBuiltInPrimitiveId = 7;

constexpr uint32_t first_word(uint32_t op, uint32_t words) {
    return words << 16U | op;
}

struct Instruction {
    uint32_t op = 0;
    std::span<const uint32_t> words;  // the first one included
};

using Error = tl::unexpected<std::string>;

tl::expected<std::vector<Instruction>, std::string> split(std::span<const uint32_t> module) {
    if (module.size() < kHeaderWords || module[0] != kMagic) {
        return Error("the module does not begin as SPIR-V of this machine's byte order");
    }
    const uint32_t version = module[1];
    if ((version & 0xff0000ffU) != 0 || version >> 16U != 1 || (version >> 8U & 0xffU) > 6) {
        return Error(fmt::format("the module's version 0x{:08x} is not 1.0 to 1.6", version));
    }
    if (module[4] != 0) {
        return Error("the module's schema is not 0");
    }
    std::vector<Instruction> out;
    size_t at = kHeaderWords;
    while (at < module.size()) {
        const uint32_t count = module[at] >> 16U;
        const uint32_t op = module[at] & 0xffffU;
        if (count == 0 || count > module.size() - at) {
            return Error(fmt::format("the instruction at word {} runs over the module's end", at));
        }
        const uint32_t least = op == kOpVariable || op == kOpTypePointer ? 4
                               : op == kOpDecorate                       ? 3
                                                                         : 1;
        if (count < least || (op == kOpCapability && count != 2)) {
            return Error(fmt::format("the instruction at word {} is too short", at));
        }
        if (op == kOpDecorationGroup || op == kOpGroupDecorate) {
            return Error("the module has decoration groups");
        }
        out.push_back({op, module.subspan(at, count)});
        at += count;
    }
    return out;
}

bool is_variable(std::span<const Instruction> code, uint32_t id, uint32_t storage) {
    return std::ranges::any_of(code, [&](const Instruction& i) {
        return i.op == kOpVariable && i.words[2] == id && i.words[3] == storage;
    });
}

// The instruction that decorates the Input variable with the number, its Location or BuiltIn.
tl::expected<const Instruction*, std::string> find_input(std::span<const Instruction> code,
                                                         const InputChange& change) {
    const uint32_t decoration = change.by == InputBy::location ? kLocation : kBuiltIn;
    const char* word = change.by == InputBy::location ? "location" : "built-in";
    const Instruction* found = nullptr;
    for (const Instruction& i : code) {
        if (i.op != kOpDecorate || i.words[2] != decoration || i.words.size() != 4 ||
            i.words[3] != change.number) {
            continue;
        }
        if (!is_variable(code, i.words[1], kStorageInput)) {
            continue;
        }
        if (found != nullptr) {
            return Error(fmt::format("two inputs of the module have {} {}", word, change.number));
        }
        found = &i;
    }
    if (found == nullptr) {
        return Error(fmt::format("no input of the module has {} {}", word, change.number));
    }
    return found;
}

bool is_decorated(std::span<const Instruction> code, uint32_t id, uint32_t decoration) {
    return std::ranges::any_of(code, [&](const Instruction& i) {
        return i.op == kOpDecorate && i.words[1] == id && i.words[2] == decoration;
    });
}

// What a change adds behind, or puts in place of, the instruction that names the input.
struct Edit {
    const Instruction* at = nullptr;
    uint32_t id = 0;
    std::vector<uint32_t> decorations;
    bool becomes_primitive_id = false;
};

tl::expected<Edit, std::string> plan_edit(std::span<const Instruction> code,
                                          const InputChange& change) {
    auto found = find_input(code, change);
    if (!found) {
        return Error(found.error());
    }
    if (change.becomes_primitive_id && change.by != InputBy::location) {
        return Error("only an input with a location can become PrimitiveId");
    }
    Edit edit{*found, (*found)->words[1], {}, change.becomes_primitive_id};
    for (const auto& [wanted, decoration] :
         {std::pair{change.flat, kFlat}, std::pair{change.no_perspective, kNoPerspective},
          std::pair{change.centroid, kCentroid}, std::pair{change.sample, kSample}}) {
        if (wanted) {
            edit.decorations.push_back(decoration);
        }
    }
    // Flat excludes the other three, Centroid and Sample exclude each other.
    const auto has = [&](uint32_t decoration) {
        return is_decorated(code, edit.id, decoration) ||
               std::count(edit.decorations.begin(), edit.decorations.end(), decoration) != 0;
    };
    const bool is_placed = has(kCentroid) || has(kSample);
    if ((has(kFlat) && (has(kNoPerspective) || is_placed)) || (has(kCentroid) && has(kSample))) {
        return Error(
            fmt::format("the decorations of input {} contradict each other", change.number));
    }
    for (const uint32_t decoration : edit.decorations) {
        if (is_decorated(code, edit.id, decoration)) {
            return Error(
                fmt::format("input {} has decoration {} already", change.number, decoration));
        }
    }
    return edit;
}

}  // namespace

Changed change_inputs(std::span<const uint32_t> module, std::span<const InputChange> changes) {
    auto code = split(module);
    if (!code) {
        return Error(code.error());
    }
    std::vector<Edit> edits;
    std::set<uint32_t> capabilities;
    for (const InputChange& change : changes) {
        auto edit = plan_edit(*code, change);
        if (!edit) {
            return Error(edit.error());
        }
        const bool is_second =
            std::ranges::any_of(edits, [&](const Edit& other) { return other.id == edit->id; });
        if (is_second) {
            return Error(fmt::format("input {} is changed twice", change.number));
        }
        if (change.sample) {
            capabilities.insert(kSampleRateShading);
        }
        if (change.becomes_primitive_id) {
            capabilities.insert(kGeometry);
        }
        edits.push_back(*std::move(edit));
    }
    for (const Instruction& i : *code) {
        if (i.op == kOpCapability) {
            capabilities.erase(i.words[1]);
        }
    }

    std::vector<uint32_t> out(module.begin(), module.begin() + kHeaderWords);
    // Capabilities come first of all.
    for (const uint32_t capability : capabilities) {
        out.insert(out.end(), {first_word(kOpCapability, 2), capability});
    }
    for (const Instruction& i : *code) {
        const auto edit = std::ranges::find_if(edits, [&](const Edit& e) { return e.at == &i; });
        if (edit == edits.end()) {
            out.insert(out.end(), i.words.begin(), i.words.end());
            continue;
        }
        if (edit->becomes_primitive_id) {
            out.insert(out.end(),
                       {first_word(kOpDecorate, 4), edit->id, kBuiltIn, kBuiltInPrimitiveId});
        } else {
            out.insert(out.end(), i.words.begin(), i.words.end());
        }
        for (const uint32_t decoration : edit->decorations) {
            out.insert(out.end(), {first_word(kOpDecorate, 3), edit->id, decoration});
        }
    }
    return out;
}

Changed with_modes(std::span<const uint32_t> module, std::span<const uint32_t> modes) {
    auto code = split(module);
    if (!code) {
        return Error(code.error());
    }
    const auto is = [](uint32_t op) { return [op](const Instruction& i) { return i.op == op; }; };
    const auto entry = std::ranges::find_if(*code, is(kOpEntryPoint));
    const auto mode = std::ranges::find_if(*code, is(kOpExecutionMode));
    if (entry == code->end() || mode == code->end()) {
        return Error("the module has no entry point of a fragment shader");
    }
    std::vector<uint32_t> out(module.begin(), module.begin() + kHeaderWords);
    for (auto i = code->begin(); i != code->end(); ++i) {
        for (const uint32_t added : modes) {
            if (i == mode) {
                out.insert(out.end(), {first_word(kOpExecutionMode, 3), entry->words[2], added});
            }
        }
        out.insert(out.end(), i->words.begin(), i->words.end());
    }
    return out;
}

Changed with_ending(std::span<const uint32_t> module, Ending ending) {
    auto code = split(module);
    if (!code) {
        return Error(code.error());
    }
    const auto is = [](uint32_t op) { return [op](const Instruction& i) { return i.op == op; }; };
    if (std::ranges::none_of(*code, is(kOpKill))) {
        return Error("the module discards nothing");
    }
    if (ending == Ending::kill) {
        return std::vector<uint32_t>(module.begin(), module.end());
    }
    const bool is_demoted = ending == Ending::demote;
    std::vector<uint32_t> out(module.begin(), module.begin() + kHeaderWords);
    if (is_demoted) {
        out.insert(out.end(), {first_word(kOpCapability, 2), kDemoteToHelperInvocation});
    }
    const auto behind = std::ranges::find_if_not(*code, is(kOpCapability));
    for (auto i = code->begin(); i != code->end(); ++i) {
        if (i == behind) {
            const std::string_view name =
                is_demoted ? "SPV_EXT_demote_to_helper_invocation" : "SPV_KHR_terminate_invocation";
            std::vector<uint32_t> letters(name.size() / 4 + 1);  // ends with a zero
            for (size_t k = 0; k < name.size(); ++k) {
                letters[k / 4] |= static_cast<uint32_t>(name[k]) << (8 * (k % 4));
            }
            out.push_back(first_word(kOpExtension, static_cast<uint32_t>(letters.size()) + 1));
            out.insert(out.end(), letters.begin(), letters.end());
        }
        if (i->op != kOpKill) {
            out.insert(out.end(), i->words.begin(), i->words.end());
        } else if (is_demoted) {
            out.insert(out.end(),
                       {first_word(kOpDemoteToHelperInvocation, 1), first_word(kOpReturn, 1)});
        } else {
            out.push_back(first_word(kOpTerminateInvocation, 1));
        }
    }
    return out;
}

namespace {

// The Output variables of a module by their locations.
std::map<uint32_t, uint32_t> outputs_by_location(std::span<const Instruction> code) {
    std::map<uint32_t, uint32_t> out;
    for (const Instruction& i : code) {
        if (i.op != kOpDecorate || i.words[2] != kLocation || i.words.size() != 4) {
            continue;
        }
        if (is_variable(code, i.words[1], kStorageOutput)) {
            out[i.words[3]] = i.words[1];
        }
    }
    return out;
}

// An entry point without some of the variables of its interface, which follow its name.
std::vector<uint32_t> without(const Instruction& entry, const std::set<uint32_t>& gone) {
    std::vector<uint32_t> out(entry.words.begin(), entry.words.begin() + 3);
    size_t at = 3;
    for (bool ends = false; !ends && at < entry.words.size(); ++at) {
        out.push_back(entry.words[at]);
        ends = entry.words[at] >> 24U == 0;  // the zero that ends the name
    }
    for (; at < entry.words.size(); ++at) {
        if (!gone.contains(entry.words[at])) {
            out.push_back(entry.words[at]);
        }
    }
    out[0] = first_word(kOpEntryPoint, static_cast<uint32_t>(out.size()));
    return out;
}

}  // namespace

Changed with_outputs(std::span<const uint32_t> module, const OutputChange& change) {
    if (change.kept.empty()) {
        return std::vector<uint32_t>(module.begin(), module.end());
    }
    auto code = split(module);
    if (!code) {
        return Error(code.error());
    }
    const std::map<uint32_t, uint32_t> outputs = outputs_by_location(*code);
    std::map<uint32_t, uint32_t> kept;  // variables with their locations
    for (uint32_t k = 0; k < change.kept.size(); ++k) {
        const uint32_t location =
            change.first_location + 3 * k + static_cast<uint32_t>(change.kept[k]);
        const auto found = outputs.find(location);
        if (found == outputs.end()) {
            return Error(fmt::format("no output of the module has location {}", location));
        }
        kept[found->second] = change.first_location + k;
    }
    std::set<uint32_t> gone;
    for (const auto& [location, variable] : outputs) {
        if (location >= change.first_location && !kept.contains(variable)) {
            gone.insert(variable);
        }
    }
    // A Private variable has a type of its own: each gets a pointer to what its own points to.
    std::map<uint32_t, uint32_t> pointees;
    for (const Instruction& i : *code) {
        if (i.op == kOpTypePointer) {
            pointees[i.words[1]] = i.words[3];
        }
    }
    std::vector<uint32_t> out(module.begin(), module.begin() + kHeaderWords);
    uint32_t& bound = out[3];  // above all ids
    std::map<uint32_t, uint32_t> privates;
    std::vector<uint32_t> tail;
    for (const Instruction& i : *code) {
        if (i.op == kOpEntryPoint && i.words.size() > 3) {
            const std::vector<uint32_t> entry = without(i, gone);
            tail.insert(tail.end(), entry.begin(), entry.end());
            continue;
        }
        if (i.op == kOpDecorate && gone.contains(i.words[1])) {
            continue;
        }
        if (i.op == kOpDecorate && i.words[2] == kLocation && kept.contains(i.words[1])) {
            tail.insert(tail.end(), {i.words[0], i.words[1], kLocation, kept[i.words[1]]});
            continue;
        }
        if (i.op == kOpVariable && gone.contains(i.words[2])) {
            const uint32_t pointee = pointees[i.words[1]];
            if (!privates.contains(pointee)) {
                privates[pointee] = bound++;
                tail.insert(tail.end(), {first_word(kOpTypePointer, 4), privates[pointee],
                                         kStoragePrivate, pointee});
            }
            tail.insert(tail.end(), {i.words[0], privates[pointee], i.words[2], kStoragePrivate});
            continue;
        }
        tail.insert(tail.end(), i.words.begin(), i.words.end());
    }
    out.insert(out.end(), tail.begin(), tail.end());
    return out;
}

namespace {

// The entry point with one more variable in its interface.
std::vector<uint32_t> with_variable(const Instruction& entry, uint32_t variable) {
    std::vector<uint32_t> out(entry.words.begin(), entry.words.end());
    out.push_back(variable);
    out[0] = first_word(kOpEntryPoint, static_cast<uint32_t>(out.size()));
    return out;
}

}  // namespace

Changed with_unused_output(std::span<const uint32_t> module, uint32_t location) {
    constexpr uint32_t kValue = 0x3f400000;  // 0.75
    auto code = split(module);
    if (!code) {
        return Error(code.error());
    }
    if (outputs_by_location(*code).contains(location)) {
        return Error(fmt::format("the module has an output at location {}", location));
    }
    const auto find = [&](uint32_t op, auto holds) {
        return std::ranges::find_if(
            *code, [&](const Instruction& i) { return i.op == op && holds(i.words); });
    };
    const auto entry = find(kOpEntryPoint, [](auto words) { return words.size() > 3; });
    const auto number =
        find(kOpTypeFloat, [](auto words) { return words.size() > 2 && words[2] == 32; });
    const auto function = find(kOpFunction, [](auto) { return true; });
    if (entry == code->end() || number == code->end() || function == code->end()) {
        return Error("the module has no entry point, no function or no type of binary32");
    }
    // A type stands once in a module, but for pointers.
    const auto vector = find(kOpTypeVector, [&](auto words) {
        return words.size() == 4 && words[2] == number->words[1] && words[3] == 4;
    });
    std::vector<uint32_t> out(module.begin(), module.begin() + kHeaderWords);
    uint32_t& bound = out[3];
    const uint32_t vector_type = vector == code->end() ? bound++ : vector->words[1];
    const uint32_t pointer = bound++, component = bound++, value = bound++, variable = bound++;
    std::vector<uint32_t> tail;
    const auto add = [&tail](std::initializer_list<uint32_t> words) {
        tail.insert(tail.end(), words);
    };
    bool is_decorated = false, is_in_main = false, is_written = false;
    for (auto i = code->begin(); i != code->end(); ++i) {
        if (i->op == kOpEntryPoint) {
            const std::vector<uint32_t> own = with_variable(*i, variable);
            tail.insert(tail.end(), own.begin(), own.end());
            continue;
        }
        // Decorations stand before all types.
        if (!is_decorated && i->op >= kOpTypeVoid && i->op <= kOpTypeFunction) {
            add({first_word(kOpDecorate, 4), variable, kLocation, location});
            is_decorated = true;
        }
        if (i == function) {
            if (vector == code->end()) {
                add({first_word(kOpTypeVector, 4), vector_type, number->words[1], 4});
            }
            add({first_word(kOpTypePointer, 4), pointer, kStorageOutput, vector_type});
            add({first_word(kOpConstant, 4), number->words[1], component, kValue});
            add({first_word(kOpConstantComposite, 7), vector_type, value, component, component,
                 component, component});
            add({first_word(kOpVariable, 4), pointer, variable, kStorageOutput});
        }
        is_in_main = is_in_main || (i->op == kOpFunction && i->words[2] == entry->words[2]);
        // Variables of a function stand before all else in its first block.
        if (is_in_main && !is_written && i->op != kOpFunction && i->op != kOpLabel &&
            i->op != kOpVariable) {
            add({first_word(kOpStore, 3), variable, value});
            is_written = true;
        }
        tail.insert(tail.end(), i->words.begin(), i->words.end());
    }
    out.insert(out.end(), tail.begin(), tail.end());
    return out;
}

Changed with_input_index(std::span<const uint32_t> module, uint32_t index) {
    auto code = split(module);
    if (!code) {
        return Error(code.error());
    }
    std::vector<uint32_t> out(module.begin(), module.begin() + kHeaderWords);
    uint32_t inputs = 0;
    for (const Instruction& i : *code) {
        const bool is_index =
            i.op == kOpDecorate && i.words.size() == 4 && i.words[2] == kInputAttachmentIndex;
        if (is_index) {
            ++inputs;
            out.insert(out.end(), {i.words[0], i.words[1], i.words[2], index});
        } else {
            out.insert(out.end(), i.words.begin(), i.words.end());
        }
    }
    if (inputs != 1) {
        return Error(fmt::format("the module has {} subpass inputs", inputs));
    }
    return out;
}

}  // namespace shaders
