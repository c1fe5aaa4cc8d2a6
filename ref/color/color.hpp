// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What the colour target may hold at a sample: the fragments in drawing order, each written or
// blended (ref/color/blend.hpp), for every set of fragments that the coverage rules allow.
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

// What a device tells of a sample besides its colour, if it has instruments.
struct ColorWitness {
    uint32_t hits = 0;
    uint32_t writer = 0;  // the triangle that wrote last, if hits > 0
    // What its fragment wrote, if that was captured; nothing is concluded from NaN or infinity,
    // which the attribute's own plane has findings for.
    const glm::vec4* written = nullptr;
};

struct ColorVerdict {
    enum class Kind : uint8_t {
        ok,
        open,     // too many fragments that may or may not be there: nothing is claimed
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

    // `index`: of the sample. `witness`: nothing if the target has no instruments.
    ColorVerdict judge(size_t index, cases::SampleId id, const std::array<uint32_t, 4>& codes,
                       const std::optional<ColorWitness>& witness);
    // As judge, but says only whether an allowed set of fragments explains the codes.
    bool explains(size_t index, cases::SampleId id, const std::array<uint32_t, 4>& codes,
                  const std::optional<ColorWitness>& witness);
    // False only if explains() is, in less time: interpolated colours may be all that lies between
    // bounds of what is accepted.
    bool may_explain(size_t index, cases::SampleId id, const std::array<uint32_t, 4>& codes,
                     const std::optional<ColorWitness>& witness);
    // Codes that are allowed: of the first allowed set of fragments; of the clear colour if there
    // is none.
    std::array<uint32_t, 4> codes(size_t index, cases::SampleId id,
                                  const std::optional<ColorWitness>& witness);
    // Whether some allowed set has so many fragments (at least one), the triangle's the last of
    // them; where there are too many open ones to try out, everything may be.
    bool may_have_left(size_t index, uint32_t hits, uint32_t writer) const;
    // The triangles of the first allowed set of fragments, in drawing order; none if there is none.
    std::vector<uint32_t> drawn(size_t index) const;
    // How the colour of that set comes about.
    std::vector<ColorStep> steps(size_t index, cases::SampleId id);
    // Codes that the fragments of these triangles leave, whether or not they are allowed there.
    std::array<uint32_t, 4> codes_after(std::span<const uint32_t> triangles, cases::SampleId id);
    // Whether depth may be what the last of an allowed set of fragments left, or one that was
    // discarded once its depth was stored, for targets without instruments; `clear`: what it holds
    // where nothing was drawn. Only for D32 and draws that write depth without a test, bias or
    // clamp; true otherwise.
    bool explains_depth(size_t index, cases::SampleId id, float depth, float clear);

    // Whether judge() depends on the sample's expectation, its codes and its witness alone.
    bool is_uniform() const { return is_constant_; }

    // More open fragments at a sample than this are not tried out.
    static constexpr size_t kMaxOpen = 10;
    // Colours that are remembered at most: some 600 bytes each.
    static constexpr size_t kRemembered = 4096;

  private:
    using Sequence = std::vector<uint32_t>;  // triangles in drawing order
    std::span<const PossibleHit> hits_at(size_t index) const;
    std::vector<Sequence> allowed(size_t index, const std::optional<ColorWitness>& witness) const;
    bool explains(const std::vector<Sequence>& sets, cases::SampleId id,
                  const std::array<uint32_t, 4>& codes, const std::optional<ColorWitness>& witness);
    const cases::ColorOutput& output_of(uint32_t triangle) const;
    // Whether the fragment writes all components, whatever was there.
    bool replaces(uint32_t triangle, bool masked) const;
    const color::Source& source_of(uint32_t triangle, cases::SampleId id);
    // What the fragment wrote; `written`, if that was captured.
    color::Source source_of(uint32_t triangle, cases::SampleId id, const glm::vec4* written);
    // Whether what it writes is one colour, or one for every triangle.
    bool is_flat(uint32_t triangle) const;
    // What the fragments leave, until the next call; `masked` false: with every write mask full.
    color::ColorMemory::Node& left_by(const Sequence& sequence, cases::SampleId id,
                                      const glm::vec4* last, bool masked = true);
    const color::Color& color_of(const Sequence& sequence, cases::SampleId id,
                                 const glm::vec4* last, bool masked = true) {
        return left_by(sequence, id, last, masked).color;
    }
    // Whether the fragments may leave the codes.
    bool leaves(const Sequence& sequence, cases::SampleId id, const glm::vec4* last,
                const std::array<uint32_t, 4>& codes);
    // The same where the last fragment replaces what was there, in binary64; nothing where only
    // rationals tell.
    std::optional<bool> may_write(uint32_t triangle, cases::SampleId id, const glm::vec4* written,
                                  const std::array<uint32_t, 4>& codes);
    // Without instruments the colour tells what is wrong with the coverage, if anything does;
    // `most`: the allowed set with the most fragments.
    void tell_coverage(const Sequence& most, cases::SampleId id,
                       const std::array<uint32_t, 4>& codes, ColorVerdict& verdict);
    // Which rule is broken by a wrong colour; `is_as_unmasked`: it is right but for a write mask.
    std::string rule_of(const Sequence& sequence, bool is_as_unmasked) const;
    bool is_constant_depth(uint32_t triangle, float depth) const;

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
    // samples without and with fragments. Only where all colours are constant.
    struct Accepted {
        bool is_set = false;
        std::vector<PossibleHit> hits;
        uint32_t total_min = 0, total_max = 0;
        std::array<uint32_t, 4> codes{};
        uint32_t witnessed = 0, writer = 0;
    };
    bool is_as_before(const Accepted& accepted, size_t index, const std::array<uint32_t, 4>& codes,
                      const std::optional<ColorWitness>& witness) const;
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
