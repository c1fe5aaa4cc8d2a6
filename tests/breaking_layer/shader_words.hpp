// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "pipeline_facts.hpp"

namespace breaking {

// Numbers of the SPIR-V specification (section 3) that faults use.
enum Decoration : uint32_t {
    kNoPerspective = 13,
    kFlat = 14,
    kCentroid = 16,
    kSample = 17,
};
enum BuiltIn : uint32_t { kClipDistance = 3, kCullDistance = 4 };

// A SPIR-V module as words, with the changes that faults make. A module that is not what the
// functions expect (a compute shader, say) is left alone.
class ShaderWords {
  public:
    explicit ShaderWords(std::span<const uint32_t> words) : words_(words.begin(), words.end()) {}
    const std::vector<uint32_t>& words() const { return words_; }

    // What a fragment shader reads, and whether the shader multiplies by a matrix.
    ShaderFacts facts() const;
    // Matrices that are multiplied by vectors are transposed.
    bool transpose_matrices();
    // The decoration, of inputs of a fragment shader whose type is a vector of floats (integers
    // must stay flat); whether any had it. `to` takes its place: nothing if 0.
    bool replace_input_decoration(uint32_t from, uint32_t to);
    // Decorates the inputs that have none of Flat, NoPerspective, Centroid, Sample.
    bool decorate_plain_inputs(uint32_t decoration);
    // What is stored to the last element of gl_ClipDistance or gl_CullDistance: the constant 1
    // instead.
    bool replace_last_distance(BuiltIn which);
    // The same, negated, for all elements.
    bool negate_distances(BuiltIn which);
    // Makes one array of distances the other, if the module has that one alone.
    bool rename_distances(BuiltIn from, BuiltIn to);
    // What a fragment shader discards is drawn.
    bool discard_nothing();
    bool demote_nothing();
    bool terminate_nothing();
    // The comparison of two numbers by which a fragment shader discards, a < b, is a <= b or a > b.
    bool discard_equal();
    bool discard_greater();
    // A fragment shader loses the execution mode EarlyFragmentTests, or one that discards gets it.
    bool lose_early_tests();
    bool test_discards_early();
    // A fragment shader that writes a depth gets it.
    bool test_depths_early();

  private:
    bool test_early();
    bool compare_by(uint32_t op);
    struct Instruction {
        size_t at = 0;  // word
        uint32_t op = 0;
        std::span<const uint32_t> words;
    };
    struct Store {
        size_t at = 0;  // word of the instruction OpStore
        uint32_t element = 0;
        uint32_t value = 0;  // id
    };
    std::vector<Instruction> instructions() const;
    bool is_stage(uint32_t execution_model) const;
    std::vector<uint32_t> float_inputs() const;
    std::vector<Store> stores_to(BuiltIn which) const;
    uint32_t float_type() const;
    uint32_t new_id() { return words_[3]++; }
    void insert(size_t at, std::initializer_list<uint32_t> words);
    void require(uint32_t capability);

    std::vector<uint32_t> words_;
};

}  // namespace breaking
