// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "diff/consistency.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <optional>

#include "cases/model/rule.hpp"
#include "cases/model/sample.hpp"
#include "diff/resolve.hpp"

namespace diff {

using capture::kColorPlane;
using capture::kDepthPlane;
using capture::kHitsPlane;
using capture::kResolvedColorPlane;
using capture::kResolvedDepthPlane;
using capture::kResolvedStencilPlane;
using capture::kStencilPlane;
using capture::kWritersPlane;

namespace {

// Words of a writer: its draw, gl_PrimitiveID, gl_VertexIndex of its provoking vertex.
constexpr uint32_t kDrawWord = 0, kPrimitiveWord = 1, kVertexWord = 2;

// A plane as 32-bit words, `words` a sample; empty if the capture has none.
struct PlaneWords {
    const std::byte* data = nullptr;
    size_t samples = 0;
    uint32_t words = 0;

    uint32_t at(size_t sample, uint32_t word) const {
        uint32_t value = 0;
        std::memcpy(&value, data + (sample * words + word) * sizeof value, sizeof value);
        return value;
    }
    size_t bytes() const { return samples * words * sizeof(uint32_t); }
};

template <class T>
PlaneWords words_of(std::span<const T> plane) {
    static_assert(sizeof(T) % sizeof(uint32_t) == 0);
    return {reinterpret_cast<const std::byte*>(plane.data()), plane.size(),
            sizeof(T) / sizeof(uint32_t)};
}

std::array<PlaneWords, kPlanes> planes_of(const capture::CaptureView& capture) {
    std::array<PlaneWords, kPlanes> planes;
    capture::for_each_plane(
        [&planes](const capture::Plane& plane, const auto& words) {
            if (plane.number < kPlanes) {
                planes.at(plane.number) = words_of(words);
            }
        },
        capture, capture);
    return planes;
}

bool is_masked(const cases::Variation& variation, uint32_t plane) {
    return plane == kDepthPlane ? variation.masks_depth
                                : plane < kDepthPlane && (variation.masked >> plane & 1U) != 0;
}

// The word of a clear sample.
uint32_t clear_word(uint32_t plane, uint32_t word, const cases::Variation& variation) {
    const bool other = variation.other_clears;
    switch (plane) {
        case kHitsPlane:
            return std::bit_cast<uint32_t>(word < 2 ? 0.0F
                                           : other  ? capture::kOtherHitGuard
                                                    : capture::kHitGuard);
        case kWritersPlane:
            return other ? capture::kOtherClearId : capture::kClearId;
        case kDepthPlane:
            return std::bit_cast<uint32_t>(variation.other_depth_clear ? capture::kOtherClearDepth
                                                                       : capture::kClearDepth);
        default:
            return std::bit_cast<uint32_t>(other ? capture::kOtherClearValue
                                                 : capture::kClearValue);
    }
}

// Whether the planes of a sample do not contradict each other; a depth without a hit is judged
// elsewhere.
bool is_whole(capture::SampleState state) {
    return state == capture::SampleState::clear || state == capture::SampleState::drawn ||
           state == capture::SampleState::depth_only;
}

// What the variation makes of a word of the case's own rendering. Binary32 holds hit counts and
// their guards exactly, so moving a guard moves every count by as much.
uint32_t varied_word(uint32_t plane, uint32_t word, uint32_t base, capture::SampleState state,
                     const cases::Variation& variation) {
    if (plane == kDepthPlane && !variation.other_depth_clear && !variation.masks_depth) {
        return base;  // whatever the case clears depth to
    }
    if (plane > kDepthPlane) {
        return base;  // colour and stencil are cleared as the case says, and never masked
    }
    if (is_masked(variation, plane) || state == capture::SampleState::clear ||
        (state == capture::SampleState::depth_only && plane != kDepthPlane)) {
        return clear_word(plane, word, variation);
    }
    if (plane == kHitsPlane && word >= 2 && variation.other_clears) {
        return std::bit_cast<uint32_t>(std::bit_cast<float>(base) +
                                       (capture::kOtherHitGuard - capture::kHitGuard));
    }
    if (plane == kWritersPlane && word == kVertexWord && state == capture::SampleState::drawn) {
        return base + cases::vertex_shift(variation.door);
    }
    return base;
}

// A hit sample whose depth has the bits of the clear value may hold it or may have been drawn so:
// a draw need not write depth.
bool may_be_clear_depth(uint32_t plane, uint32_t base, uint32_t got,
                        const cases::Variation& variation) {
    return plane == kDepthPlane && variation.other_depth_clear &&
           base == std::bit_cast<uint32_t>(capture::kClearDepth) &&
           got == std::bit_cast<uint32_t>(capture::kOtherClearDepth);
}

// Whether a fragment may have stored its depth that no hit shows: the tests come early, and the
// shader discards it or takes its samples away.
bool may_store_without_hit(const std::vector<cases::Draw>& draws) {
    return std::ranges::any_of(draws, [](const cases::Draw& draw) {
        return draw.early_tests && draw.depth.write &&
               (draw.discard != cases::Discard::none || draw.multisample.shader_mask);
    });
}

// A sample that looks clear may hold a depth that was stored so and has the bits of the clear
// value.
bool may_be_stored_depth(uint32_t plane, uint32_t base, uint32_t got, capture::SampleState state,
                         const cases::Variation& variation) {
    return plane == kDepthPlane && variation.other_depth_clear &&
           state == capture::SampleState::clear && got == base;
}

// gl_PrimitiveID counts the primitives of a drawing command, and of one that has several draws the
// text does not say whether it begins again with each of them.
bool may_begin_again(uint32_t plane, uint32_t word, uint32_t base, uint32_t got, uint32_t draw,
                     const cases::Variation& variation) {
    const uint32_t split = draw < variation.splits.size() ? variation.splits[draw] : 0;
    return plane == kWritersPlane && word == kPrimitiveWord && split > 0 && base >= split &&
           got == base - split;
}

// A component that is +0 at every vertex of every draw is 0 in either sign where it is drawn, and
// +0 where it is not (cases::has_two_numbers).
bool is_zero_of_either_sign(uint32_t plane, uint32_t word, uint32_t expected, uint32_t got,
                            const std::vector<cases::Draw>& draws, uint32_t attributes) {
    constexpr uint32_t kSign = 0x80000000U;
    if (plane < capture::kAttributePlane || plane >= kDepthPlane || word < 2 ||
        ((expected | got) & ~kSign) != 0) {
        return false;
    }
    const uint32_t k = (plane - capture::kAttributePlane) % std::max(attributes, 1U);
    return std::ranges::all_of(draws, [k](const cases::Draw& draw) {
        return k >= draw.attributes.size() || cases::has_two_numbers(draw.attributes[k]);
    });
}

bool is_resolved(uint32_t plane) {
    return plane >= kResolvedColorPlane && plane <= kResolvedStencilPlane;
}

// What a pixel's depth resolves to where the variation makes other depths of its samples; nothing
// where it does not say: of an average, which a device rounds, and where a sample of the clear
// value's bits may hold it or may have been stored so.
std::optional<uint32_t> varied_resolve(uint32_t base, std::span<const float> depths,
                                       std::span<const capture::SampleState> states,
                                       const cases::Target& target, bool stores_without_hit,
                                       const cases::Variation& variation) {
    std::vector<float> varied;
    bool is_changed = false;
    const size_t count = target.depth_resolve == cases::Resolve::sample_zero ? 1 : depths.size();
    for (size_t k = 0; k < count; ++k) {
        const auto word = std::bit_cast<uint32_t>(depths[k]);
        const bool looks_clear = word == std::bit_cast<uint32_t>(capture::kClearDepth);
        if (!is_whole(states[k]) ||
            (variation.other_depth_clear && looks_clear &&
             (states[k] != capture::SampleState::clear || stores_without_hit))) {
            return std::nullopt;
        }
        const uint32_t expected = varied_word(kDepthPlane, 0, word, states[k], variation);
        is_changed = is_changed || expected != word;
        varied.push_back(std::bit_cast<float>(expected));
    }
    const auto [least, most] = std::ranges::minmax(varied);
    if (!is_changed) {
        return base;
    }
    if (target.depth_resolve == cases::Resolve::average && least < most) {
        return std::nullopt;
    }
    return std::bit_cast<uint32_t>(target.depth_resolve == cases::Resolve::min ? least : most);
}

// Which plane of the case's own rendering a plane of the derived one is held against; kPlanes:
// none.
uint32_t original_of(uint32_t plane, const capture::CaptureView& base,
                     const cases::Derivation& derivation) {
    const bool is_attribute = plane >= capture::kAttributePlane && plane < kDepthPlane;
    if (!is_attribute || plane - capture::kAttributePlane < base.attribute_count) {
        return plane;
    }
    return derivation.kind == cases::RelationKind::more_attributes ? plane - base.attribute_count
                                                                   : kPlanes;
}

class BitComparison {
  public:
    BitComparison(const cases::Case& c, const capture::CaptureView& base,
                  const capture::CaptureView& derived, const cases::Derivation& derivation)
        : draws_(c.draws),
          target_(c.target),
          stores_without_hit_(may_store_without_hit(c.draws)),
          base_(base),
          derived_(derived),
          variation_(derivation.variation),
          theirs_(planes_of(derived)),
          counted_(derived.counted),
          alike_(!variation_.other_clears && !variation_.other_depth_clear &&
                 variation_.masked == 0 && !variation_.masks_depth &&
                 cases::vertex_shift(variation_.door) == 0 &&
                 std::all_of(variation_.splits.begin(), variation_.splits.end(),
                             [](uint32_t split) { return split == 0; })) {
        const std::array<PlaneWords, kPlanes> own = planes_of(base);
        for (uint32_t p = 0; p < kPlanes; ++p) {
            const uint32_t original = original_of(p, base, derivation);
            ours_[p] = original < kPlanes ? own[original] : PlaneWords{};
            // What one of them lacks is not compared: attributes that were left out.
            is_compared_[p] = ours_[p].samples != 0 && theirs_[p].samples == ours_[p].samples;
            if (is_compared_[p] && is_resolved(p)) {
                resolved_ = ours_[p].samples;
            }
        }
    }

    Consistency run() {
        const size_t count = base_.sample_count();
        result_.compared = count + resolved_;
        compare_counts();
        if (alike_ && all_equal()) {
            return std::move(result_);
        }
        std::vector<capture::SampleState> states(count);
        for (size_t sample = 0; sample < count; ++sample) {
            states[sample] = capture::sample_state(base_, sample);
            if (is_whole(states[sample])) {
                compare_sample(sample, states[sample]);
            } else {
                --result_.compared;
            }
        }
        for (size_t pixel = 0; pixel < resolved_; ++pixel) {
            compare_pixel(pixel, states);
        }
        return std::move(result_);
    }

  private:
    bool all_equal() const {
        for (uint32_t p = 0; p < kPlanes; ++p) {
            if (is_compared_[p] &&
                std::memcmp(ours_[p].data, theirs_[p].data, ours_[p].bytes()) != 0) {
                return false;
            }
        }
        return true;
    }

    // The same samples pass in both, so that occlusion queries count as many. Statistics may
    // differ: how often a device does a thing is no part of the state that repeats
    // ("Repeatability").
    void compare_counts() {
        for (uint32_t k = 0; k < base_.counted.size() && k < counted_.size(); ++k) {
            if (cases::is_statistic(draws_[k].query)) {
                continue;
            }
            ++result_.compared;
            if (base_.counted[k] != counted_[k]) {
                add({0, kCounts, k, base_.counted[k], counted_[k]});
            }
        }
    }

    void compare_sample(size_t sample, capture::SampleState state) {
        for (uint32_t p = 0; p <= kStencilPlane; ++p) {
            for (uint32_t w = 0; is_compared_[p] && w < ours_[p].words; ++w) {
                const uint32_t base = ours_[p].at(sample, w);
                const uint32_t draw = p == kWritersPlane ? ours_[p].at(sample, kDrawWord) : 0;
                const uint32_t expected = varied_word(p, w, base, state, variation_);
                const uint32_t got = theirs_[p].at(sample, w);
                if (got == expected || may_be_clear_depth(p, base, got, variation_) ||
                    (stores_without_hit_ && may_be_stored_depth(p, base, got, state, variation_)) ||
                    is_zero_of_either_sign(p, w, expected, got, draws_, base_.attribute_count) ||
                    may_begin_again(p, w, base, got, draw, variation_)) {
                    continue;
                }
                add({sample, p, w, expected, got});
                return;
            }
        }
    }

    // What the samples of a pixel were resolved into.
    void compare_pixel(size_t pixel, std::span<const capture::SampleState> states) {
        const auto of_pixel = [&](auto samples) {
            return samples.subspan(pixel * target_.samples, target_.samples);
        };
        if (!std::ranges::all_of(of_pixel(states), is_whole)) {
            --result_.compared;
            return;
        }
        for (const uint32_t p : {kResolvedColorPlane, kResolvedDepthPlane, kResolvedStencilPlane}) {
            for (uint32_t w = 0; is_compared_[p] && w < ours_[p].words; ++w) {
                const uint32_t base = ours_[p].at(pixel, w);
                const std::optional<uint32_t> expected =
                    p == kResolvedDepthPlane
                        ? varied_resolve(base, of_pixel(base_.depth), of_pixel(states), target_,
                                         stores_without_hit_, variation_)
                        : base;
                const uint32_t got = theirs_[p].at(pixel, w);
                if (expected && got != *expected && !may_be_rounded(p, pixel)) {
                    add({pixel, p, w, *expected, got});
                    return;
                }
            }
        }
    }

    // How an average is rounded is the device's ("Render Pass Resolve Operations"), and it may be
    // another way where the images or the pass are others.
    bool may_be_rounded(uint32_t plane, size_t pixel) const {
        const cases::Resolve mode = plane == kResolvedColorPlane   ? target_.color_resolve
                                    : plane == kResolvedDepthPlane ? target_.depth_resolve
                                                                   : target_.stencil_resolve;
        return mode == cases::Resolve::average && variation_.door != cases::Door::none &&
               cases::row_of(variation_.door).promise != cases::DoorPromise::same_bits &&
               is_resolved_rightly(derived_, pixel, cases::Profile::practice);
    }

    void add(const Difference& difference) {
        ++result_.different;
        if (result_.differences.size() < kMaxDifferences) {
            result_.differences.push_back(difference);
        }
    }

    const std::vector<cases::Draw>& draws_;
    const cases::Target& target_;
    bool stores_without_hit_ = false;
    const capture::CaptureView& base_;
    const capture::CaptureView& derived_;
    const cases::Variation& variation_;
    std::array<PlaneWords, kPlanes> ours_, theirs_;
    const std::vector<uint64_t>& counted_;
    std::array<bool, kPlanes> is_compared_{};
    size_t resolved_ = 0;  // pixels
    bool alike_;
    Consistency result_;
};

std::string why_of_door(const cases::DoorRow& door, const Consistency& found) {
    std::string does(door.does);
    does.pop_back();  // its full stop
    std::string why =
        fmt::format("through the door {} the sample has other bits than in the plain picture ({})",
                    door.word, does);
    if (door.promise == cases::DoorPromise::same_bits) {
        return why + "; the same vertices reach the same pipeline (Invariance, Rule 4)";
    }
    return why +
           (found.wrong.empty()
                ? "; the pipeline or its state is another one, so that Vulkan itself does not "
                  "demand the bits, and the picture is not wrong at profile vulkan"
                : fmt::format("; the picture is wrong by itself: {}", found.wrong));
}

// The loosest profile at which the difference is a finding.
cases::Profile level_of(const cases::Rule& rule, const cases::Derivation& derivation,
                        const Consistency& found) {
    const bool is_only_other =
        derivation.kind == cases::RelationKind::door && found.wrong.empty() &&
        cases::row_of(derivation.variation.door).promise == cases::DoorPromise::right_picture;
    return is_only_other ? std::max(rule.profile, cases::Profile::practice) : rule.profile;
}

std::string why_of(const cases::Derivation& derivation, const Consistency& found) {
    using cases::RelationKind;
    switch (derivation.kind) {
        case RelationKind::door:
            return why_of_door(cases::row_of(derivation.variation.door), found);
        case RelationKind::same_twice:
            return derivation.variation.later
                       ? "the same commands in a later submission gave other bits"
                       : "the same commands, once more in the same submission, gave other bits";
        case RelationKind::scissor_tiles:
            return fmt::format(
                "with every draw repeated under the scissors of tiles of {} x {} pixels, the "
                "sample has other bits; fragments do not depend on the scissor (Invariance, Rule 2 "
                "and Corollary 1)",
                derivation.variation.tile[0], derivation.variation.tile[1]);
        case RelationKind::other_clears:
            return "with attachments cleared to other values the sample has other bits; fragments "
                   "do not depend on clear values (Invariance, Rule 2 and Corollary 1)";
        case RelationKind::write_masks:
            return "with some attachments masked, those that are written have other bits, or a "
                   "masked one was written (Invariance, Rule 2 and Corollary 1)";
        case RelationKind::fewer_attributes:
            return "drawn without attributes, the sample has other bits in the attachments that "
                   "are left";
        case RelationKind::more_attributes:
            break;
    }
    return "drawn with copies of its attributes, the sample has other bits, or a copy differs from "
           "its original (Invariance, Corollary 2)";
}

// Why the query of a draw has to give as much in both pictures.
std::string why_of_count(const cases::Derivation& derivation) {
    std::string what;
    if (derivation.kind == cases::RelationKind::door) {
        const cases::DoorRow& door = cases::row_of(derivation.variation.door);
        std::string_view does = door.does;
        does.remove_suffix(1);  // its full stop
        what = fmt::format("through the door {} ({}) ", door.word, does);
    }
    return what + "the same samples pass, so the query counts as many as in the plain picture";
}

std::string show_bits(uint32_t plane, uint64_t bits) {
    if (plane == kCounts) {
        return count_text(bits);
    }
    if (plane == kStencilPlane || plane == kResolvedStencilPlane) {
        return fmt::format("{}", bits);
    }
    return plane == kWritersPlane || plane == kColorPlane || plane == kResolvedColorPlane
               ? fmt::format("{:#010x}", bits)
               : fmt::format("{:#010x} ({})", bits,
                             std::bit_cast<float>(static_cast<uint32_t>(bits)));
}

// Whether a device may choose anew what is counted: of fragments that the shader discards after
// early tests (ref/expectation/counted.hpp), in another pipeline or another state.
bool may_count_otherwise(const cases::Case& c, const cases::Derivation& derivation,
                         const Difference& difference) {
    return difference.plane == kCounts && cases::stores_discarded(c.draws[difference.word]) &&
           derivation.kind != cases::RelationKind::same_twice;
}

template <class T>
void vary_plane(std::vector<T>& plane, uint32_t id, std::span<const capture::SampleState> states,
                const cases::Variation& variation) {
    for (size_t sample = 0; sample < plane.size(); ++sample) {
        if (!is_whole(states[sample])) {
            continue;
        }
        std::array<uint32_t, sizeof(T) / sizeof(uint32_t)> words{};
        std::memcpy(words.data(), &plane[sample], sizeof(T));
        for (uint32_t w = 0; w < words.size(); ++w) {
            words[w] = varied_word(id, w, words[w], states[sample], variation);
        }
        std::memcpy(static_cast<void*>(&plane[sample]), words.data(), sizeof(T));
    }
}

}  // namespace

Consistency compare_bits(const cases::Case& c, const capture::CaptureView& base,
                         const capture::CaptureView& derived, const cases::Derivation& derivation) {
    return BitComparison(c, base, derived, derivation).run();
}

void vary(capture::Capture& capture, const cases::Variation& variation) {
    std::vector<capture::SampleState> states(capture.sample_count());
    for (size_t sample = 0; sample < states.size(); ++sample) {
        states[sample] = capture::sample_state(capture, sample);
    }
    // Before the depths change of which they are made.
    for (size_t pixel = 0; pixel < capture.resolved_depth.size(); ++pixel) {
        const size_t first = pixel * capture.target.samples;
        float& resolved = capture.resolved_depth[pixel];
        const std::optional<uint32_t> varied =
            varied_resolve(std::bit_cast<uint32_t>(resolved),
                           std::span(capture.depth).subspan(first, capture.target.samples),
                           std::span(states).subspan(first, capture.target.samples), capture.target,
                           false, variation);
        resolved = varied ? std::bit_cast<float>(*varied) : resolved;
    }
    capture::for_each_plane(
        [&](const capture::Plane& plane, auto& words) {
            if (plane.number <= kDepthPlane) {
                vary_plane(words, plane.number, states, variation);
            }
        },
        capture, capture);
}

std::string count_text(uint64_t counted) {
    return counted == capture::kNotCounted ? "no result" : fmt::format("{}", counted);
}

std::string plane_name(uint32_t plane, uint32_t word) {
    constexpr std::array<const char*, 4> kOrigins = {"draw", "primitive", "provoking vertex",
                                                     "spare"};
    constexpr std::array<const char*, 4> kHits = {"front hits", "back hits", "guard of the hits",
                                                  "sum of the hits"};
    if (plane == kCounts) {
        return fmt::format("occlusion query of draw {}", word);
    }
    if (plane == kDepthPlane || plane == kStencilPlane) {
        return std::string(capture::name_of_plane(plane));
    }
    if (plane == kResolvedDepthPlane || plane == kResolvedStencilPlane) {
        return plane == kResolvedDepthPlane ? "resolved depth" : "resolved stencil";
    }
    if (plane == kColorPlane || plane == kResolvedColorPlane) {
        return fmt::format("{}color.{}", plane == kColorPlane ? "" : "resolved ", "rgba"[word % 4]);
    }
    if (plane == kWritersPlane) {
        return fmt::format("writer's {}", kOrigins[word % 4]);
    }
    if (plane == kHitsPlane) {
        return kHits[word % 4];
    }
    return fmt::format("{}.{}", capture::name_of_plane(plane), "xyzw"[word % 4]);
}

void add_differences(const cases::Case& c, std::span<const cases::Derivation> derivations,
                     std::span<const Consistency> found, Verdict& verdict) {
    for (size_t k = 0; k < found.size() && k < derivations.size(); ++k) {
        const cases::Rule* rule = cases::find_rule(derivations[k].rule);
        if (rule == nullptr) {
            continue;
        }
        const cases::Profile level = level_of(*rule, derivations[k], found[k]);
        if (level > verdict.profile) {
            continue;
        }
        std::string door;
        if (derivations[k].kind == cases::RelationKind::door) {
            door = cases::row_of(derivations[k].variation.door).word;
        }
        for (const Difference& difference : found[k].differences) {
            const cases::Profile demanded = may_count_otherwise(c, derivations[k], difference)
                                                ? std::max(level, cases::Profile::practice)
                                                : level;
            if (demanded > verdict.profile) {
                continue;
            }
            const bool is_count = difference.plane == kCounts;
            const uint64_t sample =
                difference.sample * (is_resolved(difference.plane) ? c.target.samples : 1);
            Finding finding = is_count ? finding_of_case(FindingKind::value)
                                       : finding_at(FindingKind::value, c.target,
                                                    cases::sample_at(c.target, sample));
            finding.rule = rule->id;
            finding.level = demanded;
            finding.quantity = fmt::format("{}, {}", plane_name(difference.plane, difference.word),
                                           derivations[k].name);
            finding.expected = show_bits(difference.plane, difference.expected);
            finding.got = show_bits(difference.plane, difference.got);
            finding.why =
                is_count ? why_of_count(derivations[k]) : why_of(derivations[k], found[k]);
            finding.door = door;
            verdict.add(std::move(finding), c.target);
        }
        if (const uint64_t more = found[k].different - found[k].differences.size(); more > 0) {
            Finding untold;
            untold.kind = FindingKind::value;
            untold.rule = rule->id;
            untold.level = level;
            untold.door = door;
            verdict.count(untold, more);
            verdict.has_unmarked = true;
        }
    }
}

}  // namespace diff
