// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "diff/attribution.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "cases/model/sample.hpp"
#include "ref/expectation/explain.hpp"
#include "ref/reason/reason.hpp"

namespace diff {

namespace {

std::string range(uint32_t low, uint32_t high) {
    if (low == high) {
        return fmt::format("{}", low);
    }
    return high == low + 1 ? fmt::format("{} or {}", low, high)
                           : fmt::format("{} to {}", low, high);
}

using Detail = ref::path::SeenHits::Detail;

std::string hits_text(uint32_t front, uint32_t back, bool by_face) {
    return by_face ? fmt::format("{} front, {} back", front, back)
                   : fmt::format("{}", front + back);
}

bool faces_matter(const ref::HitBounds& b, const ref::path::SeenHits& seen) {
    return seen.detail == Detail::faces && (b.front_max > 0 || seen.front > 0) &&
           (b.back_max > 0 || seen.back > 0);
}

}  // namespace

std::string to_text(const ref::HitBounds& b) {
    if (b.front_max > 0 && b.back_max > 0) {
        return fmt::format(
            "{} front, {} back{}", range(b.front_min, b.front_max), range(b.back_min, b.back_max),
            b.is_decided() ? "" : fmt::format(" ({} in all)", range(b.total_min, b.total_max)));
    }
    return range(b.total_min, b.total_max);
}

const ref::Expectation& Attribution::at(cases::Profile profile) {
    if (profile == expectation_.profile) {
        return expectation_;
    }
    std::optional<ref::Expectation>& slot = looser_[static_cast<size_t>(profile)];
    if (!slot) {
        slot = explainer(profile).expectation();
    }
    return *slot;
}

const ref::Expectation& Attribution::at(cases::Profile profile, size_t index) {
    if (profile == expectation_.profile) {
        return expectation_;
    }
    return explainer(profile).expectation_at(index);
}

ref::Explainer& Attribution::explainer(cases::Profile level) {
    std::optional<ref::Explainer>& slot = explainers_[static_cast<size_t>(level)];
    if (!slot) {
        slot.emplace(case_, expectation_.limits, level);
    }
    return *slot;
}

size_t Attribution::index_of(const Finding& finding) const {
    return cases::index_of(case_.target, sample_of(finding));
}

void Attribution::attribute_writer(Finding& finding,
                                   const std::function<bool(const cases::Triangle&)>& wrote) {
    const size_t index = index_of(finding);
    finding.level = loosest_wrong(expectation_.profile, [&](cases::Profile profile) {
        const ref::Expectation& e = at(profile, index);
        return std::ranges::none_of(e.writers_of(e.samples[index]),
                                    [&](uint32_t t) { return wrote(e.triangles[t]); });
    });
    const auto earlier = like_writer_.find(finding.level);
    if (explained_ >= explains_ && earlier != like_writer_.end()) {
        finding.rule = earlier->second.rule;
        finding.why = fmt::format("as at pixel ({}, {})", earlier->second.x, earlier->second.y);
        return;
    }
    ++explained_;
    const Causes causes(explainer(finding.level), case_, sample_of(finding), finding.level);
    if (finding.level == cases::Profile::vulkan) {
        // Whatever is granted, that triangle cannot have been the last. If it may not cover the
        // sample at all, that says more than the order.
        if (const std::optional<Cause> cause = causes.of_stray_writer(wrote)) {
            tell(finding, *cause);
        }
    } else if (const std::optional<Cause> tie = causes.of_tie();
               tie && finding.level == cases::Profile::direct3d) {
        // A looser profile lets the writer cover the sample: it is a question of who owns it.
        tell(finding, *tie);
    } else {
        tell(finding, ref::ReasonKind::snapped_owner);
    }
    like_writer_.insert_or_assign(finding.level, finding);
}

void Attribution::attribute_hits(Finding& finding, const ref::path::SeenHits& seen,
                                 const LastHit& last) {
    const size_t index = index_of(finding);
    finding.level = loosest_wrong(expectation_.profile, [&](cases::Profile profile) {
        return !at(profile, index).samples[index].hits.allows(seen);
    });
    attribute_at_level(finding, seen, last);
}

void Attribution::attribute_color(Finding& finding, uint32_t hits, cases::Profile level,
                                  const std::optional<uint32_t>& triangle) {
    const size_t index = index_of(finding);
    finding.level = level;
    const uint32_t most = at(cases::Profile::vulkan, index).samples[index].hits.front_max;
    const ref::HitBounds asked = at(level, index).samples[index].hits;
    if (hits < asked.total_min || hits > asked.total_max) {
        const uint32_t front = std::min(hits, most);
        attribute_at_level(finding, {Detail::faces, front, hits - front}, {});
    } else if (triangle) {
        attribute_triangle(finding, *triangle);
    } else {
        tell(finding, ref::ReasonKind::color_none);
    }
}

void Attribution::attribute_triangle(Finding& finding, uint32_t triangle) {
    const std::tuple like(finding.kind, finding.level, expectation_.triangles[triangle].draw);
    const auto earlier = like_triangle_.find(like);
    if (explained_ >= explains_ && earlier != like_triangle_.end()) {
        finding.rule = earlier->second.rule;
        finding.why = "as at " + cases::pixel_text(case_.target, sample_of(earlier->second));
        return;
    }
    const Causes causes(explainer(finding.level), case_, sample_of(finding), finding.level);
    const std::optional<Cause> cause = finding.kind == FindingKind::missing
                                           ? causes.of_lost(triangle)
                                           : causes.of_another(triangle);
    if (cause) {
        tell(finding, *cause);
    } else {
        tell(finding, ref::ReasonKind::color_none);
    }
    ++explained_;
    like_triangle_.insert_or_assign(like, finding);
}

void Attribution::attribute_at_level(Finding& finding, const ref::path::SeenHits& seen,
                                     const LastHit& last) {
    const size_t index = index_of(finding);
    const ref::HitBounds asked = at(finding.level, index).samples[index].hits;
    const bool by_face = faces_matter(asked, seen);
    finding.expected =
        seen.detail == Detail::faces ? to_text(asked) : range(asked.total_min, asked.total_max);
    if (by_face && asked.is_decided()) {
        finding.expected = hits_text(asked.front_min, asked.back_min, true);
    }
    finding.got = hits_text(seen.front, seen.back, by_face);
    if (seen.detail == Detail::any) {
        finding.got = seen.front > 0 ? "some" : "none";
    }

    // The writer is asked where there is a hit too many. The case bounds how many draws there are,
    // not what a broken device says.
    const bool is_blamed =
        seen.total() > asked.total_max && last.wrote && last.draw < case_.draws.size();
    const uint32_t draw = is_blamed ? last.draw : ~uint32_t{0};
    const std::string key =
        fmt::format("{} {} {} {}|{}", static_cast<int>(finding.kind),
                    static_cast<int>(finding.level), draw, finding.expected, finding.got);
    const Finding* earlier = nullptr;
    const std::tuple rough(finding.kind, finding.level, draw);
    if (const auto like = like_.find(key); like != like_.end() && explained_ >= explains_) {
        earlier = &like->second;
    } else if (const auto alike = alike_.find(rough);
               alike != alike_.end() && explained_ >= most_explained_) {
        earlier = &alike->second;
    }
    if (earlier != nullptr) {
        finding.rule = earlier->rule;
        finding.quantity = earlier->quantity;
        finding.why = "as at " + cases::pixel_text(case_.target, sample_of(*earlier));
        return;
    }
    explain_hits(finding, asked, seen.total(), is_blamed ? last : LastHit{});
    ++explained_;
    like_.insert_or_assign(key, finding);
    alike_.insert_or_assign(rough, finding);
}

void Attribution::explain_hits(Finding& finding, const ref::HitBounds& asked, uint32_t total,
                               const LastHit& last) {
    const Causes causes(explainer(finding.level), case_, sample_of(finding), finding.level);
    if (finding.kind == FindingKind::value) {
        finding.quantity = "facing";
        if (const std::optional<Cause> tie = causes.of_tie();
            tie && finding.level == cases::Profile::direct3d) {
            tell(finding, *tie);
        } else {
            tell(finding, causes.of_facing());
        }
        return;
    }
    if (last.wrote) {
        // The last of several hits too many may rightly follow from an earlier one, as a depth test
        // does from what that one stored.
        const bool is_of_several = total > asked.total_max + 1;
        const std::optional<Cause> root =
            is_of_several ? causes.of_earlier_hit(last.draw) : std::nullopt;
        if (const std::optional<Cause> hit = root ? root : causes.of_last_hit(last.wrote)) {
            tell(finding, *hit);
            return;
        }
    }
    const bool is_few = total < asked.total_min;
    std::optional<Cause> cause = causes.of_bounds(is_few);
    cause = cause ? cause : causes.of_stencil(is_few);
    cause = cause ? cause : causes.of_depth(is_few);
    tell(finding, cause                  ? *cause
                  : asked.total_max == 0 ? causes.of_extra()
                                         : causes.of_count(total, is_few));
}

FindingKind kind_of(const ref::HitBounds& bounds, const ref::path::SeenHits& seen) {
    const auto [detail, front, back] = seen;
    const uint32_t total = front + back;
    const int32_t sign = static_cast<int32_t>(front) - static_cast<int32_t>(back);
    if (total < bounds.total_min) {
        return FindingKind::missing;
    }
    if (total > bounds.total_max) {
        return bounds.total_max == 0 ? FindingKind::extra : FindingKind::double_hit;
    }
    const bool too_few_front = front < bounds.front_min, too_few_back = back < bounds.back_min;
    const bool too_many_front = front > bounds.front_max, too_many_back = back > bounds.back_max;
    if ((too_few_front && too_many_back) || (too_few_back && too_many_front)) {
        return FindingKind::value;  // the right number of hits, by the wrong face
    }
    if (too_few_front || too_few_back) {
        return FindingKind::missing;
    }
    if (too_many_front || too_many_back) {
        return FindingKind::double_hit;
    }
    // Only the signed sum of a closed mesh is wrong: a gap pulls it towards zero.
    return std::abs(sign) < std::abs(bounds.signed_min) ? FindingKind::missing
                                                        : FindingKind::double_hit;
}

void tell(Finding& finding, const Cause& cause) {
    finding.rule = cause.rule;
    finding.why = cause.words();
}

void tell(Finding& finding, ref::ReasonKind why) {
    finding.rule = ref::rule_of(why, finding.level);
    finding.why = ref::text_of(why);
}

}  // namespace diff
