// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "shader_words.hpp"

#include <algorithm>
#include <bit>
#include <map>
#include <optional>

namespace breaking {

namespace {

// SPIR-V specification, sections 2.3, 3.
constexpr size_t kHeaderWords = 5;
enum Op : uint32_t {
    kOpEntryPoint = 15,
    kOpExecutionMode = 16,
    kOpCapability = 17,
    kOpTypeFloat = 22,
    kOpTypeVector = 23,
    kOpTypeSampledImage = 27,
    kOpTypePointer = 32,
    kOpConstant = 43,
    kOpFunction = 54,
    kOpVariable = 59,
    kOpStore = 62,
    kOpAccessChain = 65,
    kOpDecorate = 71,
    kOpMemberDecorate = 72,
    kOpFNegate = 127,
    kOpVectorTimesMatrix = 144,
    kOpMatrixTimesVector = 145,
    kOpFOrdLessThan = 184,
    kOpFOrdGreaterThan = 186,
    kOpFOrdLessThanEqual = 188,
    kOpKill = 252,
    kOpReturn = 253,
    kOpTerminateInvocation = 4416,
    kOpDemoteToHelperInvocation = 5380,
};
constexpr uint32_t kEarlyFragmentTests = 9, kDepthReplacing = 12;  // execution modes
constexpr uint32_t kVertexModel = 0;
constexpr uint32_t kFragmentModel = 4;
constexpr uint32_t kStorageInput = 1, kUniform = 2, kPushConstant = 9, kStorageBuffer = 12;
constexpr uint32_t kDecorationBuiltIn = 11;
constexpr uint32_t kCapabilityClipDistance = 32;
constexpr uint32_t kCapabilityCullDistance = 33;
constexpr uint32_t kCapabilitySampleRateShading = 35;

constexpr uint32_t first_word(uint32_t op, uint32_t count) {
    return count << 16U | op;
}

constexpr bool is_interpolation(uint32_t decoration) {
    return decoration == kFlat || decoration == kNoPerspective || decoration == kCentroid ||
           decoration == kSample;
}

}  // namespace

std::vector<ShaderWords::Instruction> ShaderWords::instructions() const {
    std::vector<Instruction> out;
    const std::span<const uint32_t> all(words_);
    for (size_t at = kHeaderWords; at < all.size();) {
        const size_t count = std::clamp<size_t>(all[at] >> 16U, 1, all.size() - at);
        out.push_back({at, all[at] & 0xffffU, all.subspan(at, count)});
        at += count;
    }
    return out;
}

bool ShaderWords::is_stage(uint32_t execution_model) const {
    const auto code = instructions();
    return std::any_of(code.begin(), code.end(), [&](const Instruction& i) {
        return i.op == kOpEntryPoint && i.words[1] == execution_model;
    });
}

std::vector<uint32_t> ShaderWords::float_inputs() const {
    if (!is_stage(kFragmentModel)) {
        return {};
    }
    std::map<uint32_t, bool> is_float;     // by id of a type
    std::map<uint32_t, uint32_t> pointee;  // by id of a pointer type
    std::vector<uint32_t> built_ins, out;
    for (const Instruction& i : instructions()) {
        if (i.op == kOpDecorate && i.words[2] == kDecorationBuiltIn) {
            built_ins.push_back(i.words[1]);
        } else if (i.op == kOpTypeFloat) {
            is_float[i.words[1]] = true;
        } else if (i.op == kOpTypeVector) {
            is_float[i.words[1]] = is_float[i.words[2]];
        } else if (i.op == kOpTypePointer) {
            pointee[i.words[1]] = i.words[3];
        } else if (i.op == kOpVariable && i.words[3] == kStorageInput &&
                   is_float[pointee[i.words[1]]] &&
                   std::find(built_ins.begin(), built_ins.end(), i.words[2]) == built_ins.end()) {
            out.push_back(i.words[2]);
        }
    }
    return out;
}

void ShaderWords::insert(size_t at, std::initializer_list<uint32_t> words) {
    words_.insert(words_.begin() + static_cast<ptrdiff_t>(at), words);
}

void ShaderWords::require(uint32_t capability) {
    for (const Instruction& i : instructions()) {
        if (i.op == kOpCapability && i.words[1] == capability) {
            return;
        }
    }
    insert(kHeaderWords, {first_word(kOpCapability, 2), capability});
}

ShaderFacts ShaderWords::facts() const {
    ShaderFacts out;
    const std::vector<uint32_t> inputs = float_inputs();
    size_t flat = 0;
    for (const Instruction& i : instructions()) {
        out.multiplies = out.multiplies || i.op == kOpMatrixTimesVector;
        out.reads_textures = out.reads_textures || i.op == kOpTypeSampledImage;
        if (i.op == kOpVariable) {
            out.reads_pushed = out.reads_pushed || i.words[3] == kPushConstant;
            out.reads_uniforms = out.reads_uniforms || i.words[3] == kUniform;
            out.reads_storage = out.reads_storage || i.words[3] == kStorageBuffer;
        }
        const bool is_flat = i.op == kOpDecorate && i.words[2] == kFlat &&
                             std::find(inputs.begin(), inputs.end(), i.words[1]) != inputs.end();
        flat += is_flat ? 1 : 0;
    }
    out.has_flat = flat > 0;
    out.has_smooth = flat < inputs.size();
    return out;
}

bool ShaderWords::transpose_matrices() {
    bool altered = false;
    for (const Instruction& i : instructions()) {
        if (i.op == kOpMatrixTimesVector) {
            words_[i.at] = first_word(kOpVectorTimesMatrix, 5);
            std::swap(words_[i.at + 3], words_[i.at + 4]);
            altered = true;
        }
    }
    return altered;
}

bool ShaderWords::replace_input_decoration(uint32_t from, uint32_t to) {
    bool altered = false;
    for (const uint32_t input : float_inputs()) {
        for (const Instruction& i : instructions()) {
            if (i.op != kOpDecorate || i.words[1] != input || i.words[2] != from) {
                continue;
            }
            altered = true;
            if (to != 0) {
                words_[i.at + 2] = to;
            } else {
                const auto begin = words_.begin() + static_cast<ptrdiff_t>(i.at);
                words_.erase(begin, begin + static_cast<ptrdiff_t>(i.words.size()));
            }
            break;  // the positions have changed; an input has a decoration once
        }
    }
    if (altered && to == kSample) {
        require(kCapabilitySampleRateShading);
    }
    return altered;
}

bool ShaderWords::decorate_plain_inputs(uint32_t decoration) {
    bool altered = false;
    for (const uint32_t input : float_inputs()) {
        const auto code = instructions();
        const bool plain = std::none_of(code.begin(), code.end(), [&](const Instruction& i) {
            return i.op == kOpDecorate && i.words[1] == input && is_interpolation(i.words[2]);
        });
        const auto at = std::find_if(code.begin(), code.end(),
                                     [](const auto& i) { return i.op == kOpDecorate; });
        if (plain && at != code.end()) {
            insert(at->at, {first_word(kOpDecorate, 3), input, decoration});
            altered = true;
        }
    }
    if (altered && decoration == kSample) {
        require(kCapabilitySampleRateShading);
    }
    return altered;
}

uint32_t ShaderWords::float_type() const {
    for (const Instruction& i : instructions()) {
        if (i.op == kOpTypeFloat && i.words[2] == 32) {
            return i.words[1];
        }
    }
    return 0;
}

std::vector<ShaderWords::Store> ShaderWords::stores_to(BuiltIn which) const {
    if (!is_stage(kVertexModel)) {
        return {};
    }
    std::map<uint32_t, uint32_t> constants;  // by id
    std::map<uint32_t, uint32_t> elements;   // by id of an access chain into the array
    std::optional<uint32_t> member;
    std::vector<Store> out;
    for (const Instruction& i : instructions()) {
        if (i.op == kOpMemberDecorate && i.words.size() == 5 && i.words[3] == kDecorationBuiltIn &&
            i.words[4] == which) {
            member = i.words[2];
        } else if (i.op == kOpConstant) {
            constants[i.words[2]] = i.words[3];
        } else if (i.op == kOpAccessChain && i.words.size() == 6 && member &&
                   constants[i.words[4]] == *member) {
            elements[i.words[2]] = constants[i.words[5]];
        } else if (i.op == kOpStore && elements.contains(i.words[1])) {
            out.push_back({i.at, elements[i.words[1]], i.words[2]});
        }
    }
    return out;
}

bool ShaderWords::replace_last_distance(BuiltIn which) {
    const auto stores = stores_to(which);
    if (stores.empty()) {
        return false;
    }
    const auto last =
        std::max_element(stores.begin(), stores.end(),
                         [](const Store& a, const Store& b) { return a.element < b.element; });
    const uint32_t one = new_id();
    words_[last->at + 2] = one;
    const auto code = instructions();
    const auto function =
        std::find_if(code.begin(), code.end(), [](const auto& i) { return i.op == kOpFunction; });
    insert(function->at,
           {first_word(kOpConstant, 4), float_type(), one, std::bit_cast<uint32_t>(1.0F)});
    return true;
}

bool ShaderWords::negate_distances(BuiltIn which) {
    const auto stores = stores_to(which);
    // From the back: what is inserted does not move the stores before it.
    for (auto store = stores.rbegin(); store != stores.rend(); ++store) {
        const uint32_t negated = new_id();
        words_[store->at + 2] = negated;
        insert(store->at, {first_word(kOpFNegate, 4), float_type(), negated, store->value});
    }
    return !stores.empty();
}

bool ShaderWords::rename_distances(BuiltIn from, BuiltIn to) {
    if (stores_to(from).empty() || !stores_to(to).empty()) {
        return false;
    }
    for (const Instruction& i : instructions()) {
        if (i.op == kOpMemberDecorate && i.words.size() == 5 && i.words[3] == kDecorationBuiltIn &&
            i.words[4] == from) {
            words_[i.at + 4] = to;
        }
    }
    require(to == kClipDistance ? kCapabilityClipDistance : kCapabilityCullDistance);
    return true;
}

bool ShaderWords::discard_nothing() {
    bool is_changed = false;
    for (const Instruction& i : instructions()) {
        if (i.op == kOpKill) {
            words_[i.at] = first_word(kOpReturn, 1);
            is_changed = true;
        }
    }
    return is_changed;
}

bool ShaderWords::demote_nothing() {
    for (const Instruction& i : instructions()) {
        if (i.op == kOpDemoteToHelperInvocation) {
            words_.erase(words_.begin() + static_cast<std::ptrdiff_t>(i.at));
            return true;
        }
    }
    return false;
}

bool ShaderWords::terminate_nothing() {
    for (const Instruction& i : instructions()) {
        if (i.op == kOpTerminateInvocation) {
            words_[i.at] = first_word(kOpReturn, 1);
            return true;
        }
    }
    return false;
}

bool ShaderWords::lose_early_tests() {
    for (const Instruction& i : instructions()) {
        if (i.op == kOpExecutionMode && i.words[2] == kEarlyFragmentTests) {
            const auto first = words_.begin() + static_cast<std::ptrdiff_t>(i.at);
            words_.erase(first, first + static_cast<std::ptrdiff_t>(i.words.size()));
            return true;
        }
    }
    return false;
}

bool ShaderWords::compare_by(uint32_t op) {
    const auto code = instructions();
    if (std::none_of(code.begin(), code.end(),
                     [](const Instruction& i) { return i.op == kOpKill; })) {
        return false;
    }
    bool is_changed = false;
    for (const Instruction& i : code) {
        if (i.op == kOpFOrdLessThan) {
            words_[i.at] = first_word(op, static_cast<uint32_t>(i.words.size()));
            is_changed = true;
        }
    }
    return is_changed;
}

bool ShaderWords::discard_equal() {
    return compare_by(kOpFOrdLessThanEqual);
}

bool ShaderWords::discard_greater() {
    return compare_by(kOpFOrdGreaterThan);
}

bool ShaderWords::test_early() {
    const auto code = instructions();
    const auto is_early = [](const Instruction& i) {
        return i.op == kOpExecutionMode && i.words[2] == kEarlyFragmentTests;
    };
    const auto mode = std::find_if(code.begin(), code.end(),
                                   [](const Instruction& i) { return i.op == kOpExecutionMode; });
    if (mode == code.end() || std::any_of(code.begin(), code.end(), is_early)) {
        return false;
    }
    insert(mode->at, {first_word(kOpExecutionMode, 3), mode->words[1], kEarlyFragmentTests});
    return true;
}

bool ShaderWords::test_discards_early() {
    const auto code = instructions();
    return std::any_of(code.begin(), code.end(),
                       [](const Instruction& i) { return i.op == kOpKill; }) &&
           test_early();
}

bool ShaderWords::test_depths_early() {
    const auto code = instructions();
    return std::any_of(code.begin(), code.end(),
                       [](const Instruction& i) {
                           return i.op == kOpExecutionMode && i.words[2] == kDepthReplacing;
                       }) &&
           test_early();
}

}  // namespace breaking
