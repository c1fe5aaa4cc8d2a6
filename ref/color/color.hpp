// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What the colour target may hold at a sample: the fragments in drawing order, each written or
// blended (ref/color/blend.hpp), for every path that the expectation has (ref/path/path.hpp).
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "cases/model/case.hpp"
#include "ref/color/blend.hpp"
#include "ref/color/color_memory.hpp"
#include "ref/expectation/expectation.hpp"
#include "ref/value/reference.hpp"

namespace ref {

// What other planes tell of a sample.
struct ColorWitness {
    path::Observed paths;  // which of its paths they allow
    // What the last fragment wrote to each attribute, if that was captured; nothing is concluded
    // from NaN or infinity, which the attribute's own plane has findings for.
    std::array<const glm::vec4*, cases::kMaxAttributes> written{};
    // Whether the number of its fragments and the last of them are known: a wrong colour says
    // nothing of its coverage then.
    bool knows_fragments = false;
};

struct ColorVerdict {
    enum class Kind : uint8_t {
        ok,
        open,     // too many paths, or none that other planes allow: nothing is claimed
        value,    // the right fragments, written wrongly
        order,    // the right fragments in another order
        missing,  // a fragment less
        extra,    // a fragment where there is none
        twice,    // one of the fragments twice
    };
    Kind kind = Kind::ok;
    std::string rule;      // of value: "blend.equation", "store.unorm", ...
    std::string expected;  // the colours that are allowed
    // Some of these lie beyond the largest number of binary16, which a format of 16-bit floats may
    // then store as no number, and reach down to its upper half.
    bool may_overflow = false;
    uint32_t hits = 0;  // of missing, extra, twice: how many fragments the colour tells of
    // Of missing and twice: the triangle of which a fragment is missing or is there once more.
    std::optional<uint32_t> triangle;
};

// One fragment, or the clear before the first, in a sentence.
struct ColorStep {
    std::optional<uint32_t> triangle;
    std::string sentence;  // "writes r 0.8, and does the logical operation and-reverse: ..."
};

// Judges the colours of one case against one expectation. Not thread-safe.
class ColorReference {
  public:
    // Both must outlive this object. The expectation has the fragments of the case's samples.
    ColorReference(const cases::Case& c, const Expectation& expectation);
    ~ColorReference();

    // `index`: of the sample.
    ColorVerdict judge(size_t index, cases::SampleId id, const std::array<uint32_t, 4>& codes,
                       const ColorWitness& witness = {});
    // As judge, but says only whether the fragments of an allowed path explain the codes.
    // `question`: other paths than the sample's own.
    bool explains(size_t index, cases::SampleId id, const std::array<uint32_t, 4>& codes,
                  const ColorWitness& witness = {}, const path::Question* question = nullptr);
    // False only if explains() is, in less time: interpolated colours may be all that lies between
    // bounds of what is accepted.
    bool may_explain(size_t index, cases::SampleId id, const std::array<uint32_t, 4>& codes,
                     const ColorWitness& witness = {});
    // Codes that are allowed: of the first path that the witness allows; of the clear colour if
    // there is none.
    std::array<uint32_t, 4> codes(size_t index, cases::SampleId id,
                                  const ColorWitness& witness = {});
    // The triangles whose fragments show on the first path, the one with the fewest late ones, in
    // drawing order; none if there are too many paths.
    std::vector<uint32_t> drawn(size_t index) const;
    // How the colour of that path comes about.
    std::vector<ColorStep> steps(size_t index, cases::SampleId id);
    // Codes that the fragments of these triangles leave, whether or not they are allowed there.
    std::array<uint32_t, 4> codes_after(std::span<const uint32_t> triangles, cases::SampleId id,
                                        const ColorWitness& witness = {});
    // Whether judge() depends on the sample's expectation, its codes and its witness alone.
    bool is_uniform() const { return is_constant_; }

    // Colours that are remembered at most: some 600 bytes each.
    static constexpr size_t kRemembered = 4096;

  private:
    using Sequence = std::vector<uint32_t>;  // triangles in drawing order
    std::span<const path::Fragment> fragments_at(size_t index) const;
    // What shows on the paths that the witness allows: whole lists, or, not `whole`, what a
    // colour tells of them. None if there are too many paths, or no such one.
    std::vector<Sequence> allowed(size_t index, const ColorWitness& witness, bool whole,
                                  const path::Question* question = nullptr) const;
    bool explains(const std::vector<Sequence>& lists, cases::SampleId id,
                  const std::array<uint32_t, 4>& codes, const ColorWitness& witness);
    const cases::ColorOutput& output_of(uint32_t triangle) const;
    // Whether the fragment writes all components, whatever was there.
    bool replaces(uint32_t triangle, bool masked) const;
    const color::Source& source_of(uint32_t triangle, cases::SampleId id);
    // What the last fragment wrote: what was captured of it, if that was.
    color::Source source_of(uint32_t triangle, cases::SampleId id, const ColorWitness& witness);
    // Whether what it writes is one colour, or one for every triangle.
    bool is_flat(uint32_t triangle) const;
    // What the fragments leave, until the next call; `masked` false: with every write mask full.
    color::ColorMemory::Node& left_by(const Sequence& sequence, cases::SampleId id,
                                      const ColorWitness& witness, bool masked = true);
    const color::Color& color_of(const Sequence& sequence, cases::SampleId id,
                                 const ColorWitness& witness, bool masked = true) {
        return left_by(sequence, id, witness, masked).color;
    }
    // Whether the fragments may leave the codes.
    bool leaves(const Sequence& sequence, cases::SampleId id, const ColorWitness& witness,
                const std::array<uint32_t, 4>& codes);
    // The same where the last fragment replaces what was there, in binary64; nothing where only
    // rationals tell.
    std::optional<bool> may_write(uint32_t triangle, cases::SampleId id,
                                  const ColorWitness& witness,
                                  const std::array<uint32_t, 4>& codes);
    // Without instruments the colour tells what is wrong with the coverage, if anything does;
    // `most`: the allowed set with the most fragments.
    void tell_coverage(const Sequence& most, cases::SampleId id,
                       const std::array<uint32_t, 4>& codes, ColorVerdict& verdict);
    // Which rule is broken by a wrong colour; `is_as_unmasked`: it is right but for a write mask.
    std::string rule_of(const Sequence& sequence, bool is_as_unmasked) const;

    const cases::Case& case_;
    const Expectation& expectation_;
    color::Unit unit_;
    color::Color cleared_;
    ValueReference values_;
    std::vector<color::Source> constants_;  // by draw, of those with a constant colour
    // By triangle, of the sample at hand: as accepted, and what may_explain() takes for them.
    std::map<uint32_t, color::Source> sources_, outer_sources_;
    cases::SampleId at_;
    bool takes_outer_ = false;         // in may_explain()
    color::ColorMemory memory_;        // of fragments that are_flat
    color::ColorMemory::Node beyond_;  // what it does not remember: computed last

    // Neighbours mostly have the same fragments and the same codes: what was accepted last, of
    // samples without and with fragments. Only where all colours are constant and nothing is open.
    struct Accepted {
        bool is_set = false;
        std::vector<path::Fragment> fragments;
        std::array<uint32_t, 4> codes{};
    };
    std::array<Accepted, 2> accepted_;

    // What a device would leave that takes something of another colour target: made when the first
    // colour is wrong.
    struct Mistake;
    bool is_of_neighbour(const Sequence& sequence, cases::SampleId id,
                         const std::array<uint32_t, 4>& codes);
    std::vector<std::unique_ptr<Mistake>> mistakes_;
    bool is_constant_ = false;  // every draw writes one colour
};

}  // namespace ref
