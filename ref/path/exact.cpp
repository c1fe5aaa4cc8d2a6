// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
#include "ref/path/exact.hpp"

#include <algorithm>
#include <array>

namespace ref::path::exact {

namespace {

using cases::CompareOp;
using cases::StencilFace;
using cases::StencilOp;

constexpr size_t kBits = 8;
constexpr uint64_t kMostSteps = uint64_t{1} << 26U;  // of all paths together
using Byte = std::array<bool, kBits>;                // bit 0 first

Byte byte_of(uint32_t value) {
    Byte out{};
    for (size_t k = 0; k < kBits; ++k) {
        out.at(k) = (value >> k & 1U) != 0;
    }
    return out;
}

uint32_t number_of(const Byte& byte) {
    uint32_t out = 0;
    for (size_t k = 0; k < kBits; ++k) {
        out += byte.at(k) ? 1U << k : 0U;
    }
    return out;
}

uint32_t both(uint32_t a, uint32_t b) {
    const Byte x = byte_of(a);
    const Byte y = byte_of(b);
    Byte out{};
    for (size_t k = 0; k < kBits; ++k) {
        out.at(k) = x.at(k) && y.at(k);
    }
    return number_of(out);
}

bool is_passed(const StencilFace& face, uint32_t stored) {
    const uint32_t a = both(face.reference, face.compare_mask);
    const uint32_t b = both(stored, face.compare_mask);
    const bool is_less = a < b;
    const bool is_equal = a == b;
    const bool is_greater = !is_less && !is_equal;
    return face.compare == CompareOp::always ||
           (is_less && (face.compare == CompareOp::less || face.compare == CompareOp::not_equal ||
                        face.compare == CompareOp::less_or_equal)) ||
           (is_equal &&
            (face.compare == CompareOp::equal || face.compare == CompareOp::less_or_equal ||
             face.compare == CompareOp::greater_or_equal)) ||
           (is_greater &&
            (face.compare == CompareOp::greater || face.compare == CompareOp::not_equal ||
             face.compare == CompareOp::greater_or_equal));
}

// What an operation makes of a whole byte.
uint32_t made_of(StencilOp op, uint32_t stored, uint32_t reference) {
    constexpr uint32_t kMost = 255;
    if (op == StencilOp::zero) {
        return 0;
    }
    if (op == StencilOp::replace) {
        return reference;
    }
    if (op == StencilOp::invert) {
        Byte bits = byte_of(stored);
        for (bool& bit : bits) {
            bit = !bit;
        }
        return number_of(bits);
    }
    if (op == StencilOp::increment_and_clamp || op == StencilOp::increment_and_wrap) {
        if (stored < kMost) {
            return stored + 1;
        }
        return op == StencilOp::increment_and_clamp ? kMost : 0;
    }
    if (op == StencilOp::decrement_and_clamp || op == StencilOp::decrement_and_wrap) {
        if (stored > 0) {
            return stored - 1;
        }
        return op == StencilOp::decrement_and_clamp ? 0 : kMost;
    }
    return stored;
}

uint32_t written(StencilOp op, const StencilFace& face, uint32_t stored) {
    const Byte old = byte_of(stored);
    const Byte made = byte_of(made_of(op, stored, face.reference));
    const Byte is_written = byte_of(face.write_mask);
    Byte out{};
    for (size_t k = 0; k < kBits; ++k) {
        out.at(k) = is_written.at(k) ? made.at(k) : old.at(k);
    }
    return number_of(out);
}

// What one path did with each fragment.
enum class Deed : uint8_t {
    absent,
    failed_bounds,
    failed,
    failed_depth,
    discarded,
    passed_front,
    passed_back
};

class Walk {
  public:
    explicit Walk(const Question& question) : question_(question) {
        const size_t count = question.fragments.size();
        out_.fates.resize(count);
        out_.is_last.assign(count, false);
        out_.is_stored.assign(count, false);
    }

    std::vector<History> all() {
        keeps_ = true;
        return run().is_free ? std::vector<History>() : std::move(histories_);
    }

    Resolution run() {
        for (uint32_t value = 0; question_.is_unknown && value < uint32_t{1} << kBits; ++value) {
            follow(value, kClearDepth);
        }
        if (!question_.is_unknown) {
            follow(byte_value(question_.clear), kClearDepth);
        }
        if (out_.outcomes.empty()) {
            out_.is_free = true;
        }
        std::sort(out_.outcomes.begin(), out_.outcomes.end(),
                  [](const Outcome& a, const Outcome& b) {
                      return a.front < b.front || (a.front == b.front && a.back < b.back);
                  });
        return std::move(out_);
    }

  private:
    static uint32_t byte_value(uint32_t value) { return number_of(byte_of(value)); }

    void follow(uint32_t value, int stored) {
        if (++steps_ > kMostSteps) {
            out_.is_free = true;
            return;
        }
        const size_t m = deeds_.size();
        if (m == question_.fragments.size()) {
            end(value, stored);
            return;
        }
        const Fragment& fragment = question_.fragments[m];
        const auto go_on = [&](Deed deed, uint32_t next, int next_stored) {
            deeds_.push_back(deed);
            met_.push_back(value);
            follow(next, next_stored);
            met_.pop_back();
            deeds_.pop_back();
        };
        if (!fragment.is_sure) {
            go_on(Deed::absent, value, stored);
        }
        if (question_.bounds) {
            const DepthOutcome bounds = question_.bounds(stored, static_cast<uint32_t>(m));
            if (bounds != DepthOutcome::passes) {
                go_on(Deed::failed_bounds, value, stored);
            }
            if (bounds == DepthOutcome::fails) {
                return;
            }
        }
        for (const bool front : {true, false}) {
            if (front ? !fragment.can_be_front : !fragment.can_be_back) {
                continue;
            }
            const StencilFace& face = front ? fragment.state->front : fragment.state->back;
            if (!is_passed(face, value)) {
                go_on(Deed::failed, written(face.fail, face, value), stored);
                continue;
            }
            const DepthOutcome depth = question_.depth
                                           ? question_.depth(stored, static_cast<uint32_t>(m))
                                           : DepthOutcome::passes;
            if (depth == DepthOutcome::fails || depth == DepthOutcome::open) {
                go_on(Deed::failed_depth, written(face.depth_fail, face, value), stored);
            }
            if (depth == DepthOutcome::passes || depth == DepthOutcome::open) {
                const bool is_discarded =
                    front ? fragment.is_discarded_front : fragment.is_discarded_back;
                for (const bool discards : {false, true}) {
                    if (discards == is_discarded || fragment.is_discard_open) {
                        go_on(discards ? Deed::discarded
                              : front  ? Deed::passed_front
                                       : Deed::passed_back,
                              written(face.pass, face, value),
                              fragment.writes_depth ? static_cast<int>(m) : stored);
                    }
                }
            }
        }
    }

    // Whether sets and twins allow what was there.
    bool is_allowed() const {
        std::vector<uint32_t> in_set(question_.sets.size());
        for (size_t m = 0; m < deeds_.size(); ++m) {
            const Fragment& fragment = question_.fragments[m];
            const bool is_there = deeds_[m] != Deed::absent;
            if (fragment.set >= 0 && is_there) {
                ++in_set[static_cast<size_t>(fragment.set)];
            }
            if (fragment.twin >= 0 &&
                is_there != (deeds_[static_cast<size_t>(fragment.twin)] != Deed::absent)) {
                return false;
            }
        }
        for (size_t k = 0; k < in_set.size(); ++k) {
            if (in_set[k] < question_.sets[k].least || in_set[k] > question_.sets[k].most) {
                return false;
            }
        }
        return true;
    }

    void end(uint32_t value, int stored) {
        if (!is_allowed()) {
            return;
        }
        Outcome outcome;
        int last = -1;
        for (size_t m = 0; m < deeds_.size(); ++m) {
            const Deed deed = deeds_[m];
            Fate& fate = out_.fates[m];
            const bool is_passed = deed == Deed::passed_front || deed == Deed::passed_back;
            fate.is_absent = fate.is_absent || deed == Deed::absent;
            fate.fails = fate.fails || deed == Deed::failed;
            fate.fails_depth = fate.fails_depth || deed == Deed::failed_depth;
            fate.passes = fate.passes || is_passed;
            fate.is_discarded = fate.is_discarded || deed == Deed::discarded;
            fate.fails_bounds = fate.fails_bounds || deed == Deed::failed_bounds;
            if (deed != Deed::absent && deed != Deed::failed_bounds) {
                fate.met.set(met_[m]);
            }
            outcome.front += deed == Deed::passed_front ? 1 : 0;
            outcome.back += deed == Deed::passed_back ? 1 : 0;
            last = is_passed ? static_cast<int>(m) : last;
        }
        if (last >= 0) {
            out_.is_last[static_cast<size_t>(last)] = true;
        }
        if (stored == kClearDepth) {
            out_.may_be_clear = true;
        } else {
            out_.is_stored[static_cast<size_t>(stored)] = true;
        }
        const auto same = std::find_if(
            out_.outcomes.begin(), out_.outcomes.end(),
            [&](const Outcome& o) { return o.front == outcome.front && o.back == outcome.back; });
        if (same != out_.outcomes.end()) {
            same->values.set(value);
        } else {
            outcome.values.set(value);
            out_.outcomes.push_back(outcome);
        }
        if (keeps_) {
            keep(value, stored);
        }
    }

    void keep(uint32_t value, int stored) {
        History& history = histories_.emplace_back();
        history.stencil = value;
        history.stored = stored;
        for (size_t m = 0; m < deeds_.size(); ++m) {
            if (deeds_[m] == Deed::discarded) {
                history.discarded.push_back(static_cast<uint32_t>(m));
            } else if (deeds_[m] == Deed::passed_front || deeds_[m] == Deed::passed_back) {
                history.shown.push_back(static_cast<uint32_t>(m));
                history.is_front.push_back(deeds_[m] == Deed::passed_front);
            }
        }
    }

    const Question& question_;
    Resolution out_;
    std::vector<Deed> deeds_;
    std::vector<uint32_t> met_;  // the stencil before each deed
    uint64_t steps_ = 0;
    bool keeps_ = false;
    std::vector<History> histories_;
};

}  // namespace

Resolution resolve(const Question& question) {
    return Walk(question).run();
}

std::vector<History> histories(const Question& question) {
    return Walk(question).all();
}

bool satisfies(const History& history, const Observed& observed) {
    using Detail = SeenHits::Detail;
    const auto fronts = static_cast<uint32_t>(std::ranges::count(history.is_front, true));
    const auto total = static_cast<uint32_t>(history.shown.size());
    const SeenHits& seen = observed.hits;
    if ((seen.detail == Detail::any && (total > 0) != (seen.front > 0)) ||
        (seen.detail == Detail::total && total != seen.front) ||
        (seen.detail == Detail::faces && (fronts != seen.front || total - fronts != seen.back))) {
        return false;
    }
    if (observed.stencil && *observed.stencil != history.stencil) {
        return false;
    }
    if (history.shown.empty() ? !observed.may_be_unhit
                              : !observed.last.empty() && !observed.last[history.shown.back()]) {
        return false;
    }
    return history.stored == kClearDepth
               ? observed.may_be_clear
               : observed.stored.empty() || observed.stored[static_cast<size_t>(history.stored)];
}

}  // namespace ref::path::exact
