// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "ref/value/drawn_fragment.hpp"

#include <algorithm>
#include <array>
#include <numeric>
#include <optional>
#include <utility>

#include "ref/value/accept/failing.hpp"

namespace ref::value {

using cases::Profile;

namespace {

using Indices = std::vector<size_t>;

bool is_in(const Indices& set, size_t index) {
    return std::ranges::find(set, index) != set.end();
}

// The quantities that a profile asks for.
Indices asked_at(const DrawnFragment& f, Profile at) {
    Indices out(f.quantities().size());
    std::iota(out.begin(), out.end(), size_t{0});
    std::erase_if(out, [&](size_t index) {
        return !f.has(f.quantities()[index]) || !f.set_ups.is_asked(f.t, index, at);
    });
    return out;
}

// What depends on the plane of depth, and all else.
std::array<Indices, 2> groups_of(const DrawnFragment& f, const Indices& all) {
    std::array<Indices, 2> groups;
    for (const size_t index : all) {
        groups.at(f.quantities()[index].plane == kPlaneDepth ? 0 : 1).push_back(index);
    }
    return groups;
}

Asked ask(const DrawnFragment& f, const Indices& only, const ProbePlace* place = nullptr) {
    return {f.quantities(), f.primitive().is_projectable, place, &f.device, only};
}

// `groups` get verdicts of their own where these come with that on all.
CandidateVerdict verdict_on(const DrawnFragment& f, Profile at, const Indices& only,
                            bool exact_only, std::span<GroupVerdict> groups = {}) {
    if (only.empty()) {
        return {true, true, BasisKind::unsnapped, {}, {}, {}};
    }
    const ProbePlace place = f.set_ups.probe_place(f.t, f.id, at);
    const Asked asked = ask(f, only, &place);
    const auto judge_by = [&]<class T>(const CandidateSet<T>& set) {
        CandidateVerdict verdict =
            judge_candidates(set, f.set_ups.places<T>(f.t, f.id, at, exact_only), asked,
                             std::is_same_v<T, Ball> ? groups : std::span<GroupVerdict>());
        return verdict.is_known ? std::optional(std::move(verdict)) : std::nullopt;
    };
    auto verdict = exact_only ? std::nullopt : f.set_ups.ask_balls(f.t, at, judge_by);
    return verdict ? *std::move(verdict) : *judge_by(f.set_ups.candidates<mpq_class>(f.t, at));
}

// Of values that each stand alone, and of which a stricter profile has accepted all but the
// suspects.
std::optional<Indices> failing_each(const DrawnFragment& f, Indices only, const Indices& suspects) {
    constexpr Profile kAt = Profile::vulkan;
    const ProbePlace place = f.set_ups.probe_place(f.t, f.id, kAt);
    const auto places = f.set_ups.places<Ball>(f.t, f.id, kAt);
    Indices rejected;
    if (places.size() == 1) {
        const SetBounds& all = f.set_ups.bounds(f.t, kAt);
        const Asked asked = ask(f, {}, &place);
        std::erase_if(only, [&](size_t index) {
            if (!is_in(suspects, index) || all.accepts(places.front(), asked, index)) {
                return true;
            }
            const bool is_rejected = all.rejects(places, asked, index);
            if (is_rejected) {
                rejected.push_back(index);
            }
            return is_rejected;
        });
        if (only.empty()) {
            return rejected;
        }
    }
    auto failing = f.set_ups.ask_balls(f.t, kAt, [&](const CandidateSet<Ball>& set) {
        return failing_separately(set, places, ask(f, only, &place));
    });
    if (failing) {
        failing->insert(failing->end(), rejected.begin(), rejected.end());
    }
    return failing;
}

// Of values that one candidate has to explain, or one a group.
std::optional<Indices> failing_in_groups(const DrawnFragment& f, Profile at, const Indices& only) {
    const auto places = f.set_ups.places<Ball>(f.t, f.id, at);
    Indices failing;
    for (const Indices& group : groups_of(f, only)) {
        if (group.empty()) {
            continue;
        }
        const auto of_group = f.set_ups.ask_balls(f.t, at, [&](const CandidateSet<Ball>& set) {
            return failing_together(set, places, ask(f, group));
        });
        if (!of_group) {
            return std::nullopt;
        }
        failing.insert(failing.end(), of_group->begin(), of_group->end());
    }
    return failing;
}

// Whether each of these values is proven to fail at the profile, whichever set-up is taken.
bool are_rejected(const DrawnFragment& f, Profile at, const Indices& suspects) {
    const SetBounds& all = f.set_ups.bounds(f.t, at);
    const auto places = f.set_ups.places<Ball>(f.t, f.id, at);
    return std::ranges::all_of(suspects, [&](size_t index) {
        return f.set_ups.is_asked(f.t, index, at) && all.rejects(places, ask(f, {}), index);
    });
}

}  // namespace

CandidateVerdict DrawnFragment::verdict(Profile at, bool exact_only) const {
    const Indices all = asked_at(*this, at);
    const CandidateVerdict unknown{false, false, BasisKind::unsnapped, {}, {}, {}};
    auto [of_depth, others] = groups_of(*this, all);
    std::array<GroupVerdict, 2> groups{
        {{std::move(of_depth), unknown}, {std::move(others), unknown}}};
    // At vulkan each value stands alone anyway.
    if (at == Profile::vulkan || groups[0].only.empty() || groups[1].only.empty()) {
        return verdict_on(*this, at, all, exact_only);
    }
    CandidateVerdict verdict = verdict_on(*this, at, all, exact_only, groups);
    if (verdict.ok) {
        return verdict;
    }
    bool is_known = true;  // the first that is not may have the set made more exact
    for (GroupVerdict& group : groups) {
        is_known = is_known && group.verdict.is_known;
        if (!is_known) {
            group.verdict = verdict_on(*this, at, group.only, exact_only);
        }
    }
    return verdict_of_both(groups[0].verdict, groups[1].verdict);
}

std::vector<size_t> DrawnFragment::failing(Profile at, const Indices& suspects) const {
    const Indices only = asked_at(*this, at);
    if (only.empty()) {
        return {};
    }
    auto failing = at == Profile::vulkan ? failing_each(*this, only, suspects)
                                         : failing_in_groups(*this, at, only);
    return failing ? *std::move(failing) : verdict(at).failing;
}

std::vector<size_t> DrawnFragment::failing_alone() const {
    Indices out = failing(Profile::vulkan, asked_at(*this, Profile::vulkan));
    std::ranges::sort(out, {}, [&](size_t index) {
        return std::pair(quantities()[index].kind == Kind::probe, index);
    });
    return out;
}

std::vector<Profile> DrawnFragment::levels_of(const Indices& failing) const {
    const Profile profile = set_ups.profile();
    std::vector<Profile> levels(failing.size(), profile);
    Indices blamed;  // by a looser profile
    for (const Profile p : cases::kProfiles) {
        const bool is_settled =
            std::ranges::all_of(levels, [p](Profile level) { return level < p; });
        if (p >= profile || is_settled) {
            break;
        }
        Indices left;
        for (size_t k = 0; k < failing.size(); ++k) {
            if (levels[k] > p) {
                left.push_back(failing[k]);
            }
        }
        if (are_rejected(*this, p, left)) {  // so each of them is blamed, whatever else is
            for (Profile& level : levels) {
                level = std::min(level, p);
            }
            break;
        }
        const Indices wrong = this->failing(p, failing);
        const auto is_news = [&](size_t index) { return !is_in(blamed, index); };
        const bool is_new = std::ranges::any_of(wrong, is_news);
        const bool is_shared = std::ranges::any_of(
            failing, [&](size_t index) { return is_in(wrong, index) && is_news(index); });
        for (size_t k = 0; k < failing.size() && is_new; ++k) {
            if (is_news(failing[k]) && (!is_shared || is_in(wrong, failing[k]))) {
                levels[k] = std::min(levels[k], p);
            }
        }
        blamed.insert(blamed.end(), wrong.begin(), wrong.end());
    }
    return levels;
}

}  // namespace ref::value
