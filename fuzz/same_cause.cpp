// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "fuzz/same_cause.hpp"

#include <algorithm>
#include <array>
#include <iterator>
#include <string>
#include <string_view>
#include <utility>

namespace fuzz {

using report::Status;

namespace {

diff::FindingKind sort_of(diff::FindingKind kind) {
    return kind == diff::FindingKind::double_hit ? diff::FindingKind::extra : kind;
}

bool is_value(const Symptom& symptom) {
    return symptom.kind == diff::FindingKind::value;
}

Essential key(std::string_view name, std::string_view word = {}) {
    return {Trait::key, std::string(name), std::string(word)};
}

// The essentials that say something of a case's numbers only.
const Essentials kNumbers = {{Trait::behind_the_eye},
                             {Trait::several_draws},
                             {Trait::several_triangles},
                             {Trait::sloping_depth},
                             {Trait::unequal_w}};
const Essentials kSamples = {{Trait::several_samples}};

bool is_within(const Essentials& part, const Essentials& whole) {
    return std::ranges::includes(whole, part);
}

Essentials without(const Essentials& all, const Essentials& left_out) {
    Essentials rest;
    std::ranges::set_difference(all, left_out, std::inserter(rest, rest.end()));
    return rest;
}

Essentials without_numbers_and_samples(const Essentials& all) {
    return without(without(all, kNumbers), kSamples);
}

// What a case needs without its numbers. A constant and an attribute are two ways to write a
// colour, and it is chance which factor takes a second source.
Essentials keys_of(const Entry& entry) {
    Essentials keys = without(entry.essentials, kNumbers);
    if (keys.contains(key("draw.color.second"))) {
        std::erase_if(keys, [](const Essential& e) { return e.begins("draw.color.blend."); });
    }
    // A shader may write a depth in several ways.
    if (std::erase_if(keys, [](const Essential& e) {
            return e.begins("draw.frag_depth.") && !e.begins("draw.frag_depth.layout");
        }) > 0) {
        keys.insert(key("draw.frag_depth"));
    }
    if (keys.erase(key("draw.color.attribute")) > 0) {
        keys.erase(key("draw.attribute"));
        keys.insert(key("draw.color.value"));
    }
    return keys;
}

// What a case needs besides numbers, samples and plain colours, however they are written.
Essentials special_of(const Entry& entry) {
    static const Essentials kPlain = {
        {Trait::thin_triangle}, key("attachments", "color"), key("attachments", "color+depth"),
        key("color"),           key("color.clear"),          key("draw.attribute"),
        key("draw.color.value")};
    return without(without_numbers_and_samples(keys_of(entry)), kPlain);
}

// Whether a rule is one of what a colour attachment holds.
bool is_color_rule(std::string_view rule) {
    constexpr std::array<std::string_view, 6> kRules = {
        "store.", "blend.", "logic.", "color.location", "order.primitive", "sample.alpha-to-one"};
    return std::ranges::any_of(kRules,
                               [&](std::string_view word) { return rule.starts_with(word); });
}

// Whether an entry stores colours wrongly rounded: those of other formats are another cause.
bool is_of_rounding(const Entry& entry) {
    return is_value(entry.symptom) && entry.symptom.rule.starts_with("store.") &&
           entry.symptom.level == cases::Profile::direct3d;
}

// Whether an entry is of its format: it needs another one than the default, or is of rounding.
bool hangs_on_format(const Entry& entry) {
    return is_of_rounding(entry) || entry.needs_format;
}

bool has_format_of(const Facts& facts, const Entry& entry) {
    return facts.format &&
           (facts.format == entry.facts.format || entry.other_formats.contains(*facts.format));
}

// Whether a key says which fragments there are: a state of a draw, not what it writes, nor where
// in a pixel that is evaluated.
bool decides_hits(const Essential& e) {
    return e.begins("draw.color.alpha_to_coverage") ||
           (e.begins("draw.") && !e.begins("draw.attribute") && !e.begins("draw.color") &&
            !e.begins("draw.min_sample_shading"));
}

// What a case needs to belong to an entry. Whatever a driver that ends was about to draw is chance.
Essentials needed_by(const Entry& entry) {
    Essentials special = special_of(entry);
    return entry.symptom.status == Status::fail || special.empty() ? entry.essentials
                                                                   : std::move(special);
}

// Essentials, and those of simpler cases that show as much: colours beside depth are colours.
Essentials with_implied(Essentials essentials) {
    if (essentials.contains(key("attachments", "color+depth"))) {
        essentials.insert(key("attachments", "color"));
    }
    return essentials;
}

}  // namespace

bool explains(const Entry& entry, const Symptom& symptom, const Facts& facts) {
    // Whatever is done with colours that are rounded otherwise is wrong as they are (is_of_stored);
    // a reduction would say no more.
    // Hits that are read from colours alone, and that no state decides, are those colours.
    const bool is_of_colors =
        is_value(symptom) || symptom.kind == diff::FindingKind::order
            ? is_color_rule(symptom.rule)
            : with_implied(facts.essentials).contains(key("attachments", "color")) &&
                  std::ranges::none_of(facts.essentials, decides_hits);
    if (symptom.status == Status::fail && is_of_rounding(entry) && special_of(entry).empty() &&
        symptom.level == cases::Profile::direct3d && is_of_colors && has_format_of(facts, entry)) {
        return true;
    }
    Essentials all = with_implied(facts.essentials);
    if (!special_of(entry).empty() && all.contains(key("draw.color.attribute"))) {
        all.insert(key("draw.color.value"));  // what writes the colour is not what is special
    }
    if (!is_within(needed_by(entry), all)) {
        return false;
    }
    if (symptom.status != Status::fail || entry.symptom.status != Status::fail) {
        return entry.symptom.status == symptom.status && entry.symptom.signal == symptom.signal;
    }
    // What breaks a looser profile than the entry does is news.
    if (entry.symptom.level > symptom.level) {
        return false;
    }
    // By which rule a sample is missing depends on the triangle that misses it, and whether one hit
    // too many is the only one on what else is drawn there: where the case has something special to
    // blame, too few or too many is enough.
    const bool is_like = std::ranges::any_of(entry.also, [&](const auto& known) {
        return is_value(symptom) || entry.essentials.empty()
                   ? known == std::pair(symptom.kind, symptom.rule)
                   : sort_of(known.first) == sort_of(symptom.kind);
    });
    return is_like && (!hangs_on_format(entry) || has_format_of(facts, entry));
}

namespace {

// Whether an earlier entry hits too much or too little by something special that the fresh one
// needs, too: whatever hits write, and later draws find, is wrong with them. A stencil that counts
// where a scissor lets fragments through is the scissor's.
bool is_consequence(const Entry& earlier, const Entry& fresh) {
    // What writes a colour decides no hit.
    const Essentials keys = without(keys_of(earlier), {key("color"), key("draw.color.value")});
    return !is_value(earlier.symptom) && std::ranges::any_of(keys, decides_hits) &&
           is_within(keys, with_implied(fresh.essentials));
}

// Whether what is wrong was seen in a colour.
bool is_of_color(const Entry& entry) {
    return with_implied(entry.essentials).contains(key("attachments", "color")) ||
           is_color_rule(entry.symptom.rule);
}

// Whether an entry lacks hits or has too many that are read from a colour that varies, since its
// case counts none: that may as well be a wrong one. No state may decide them but these keys.
bool is_hit_by_color(const Entry& entry, const Essentials& but = {}) {
    const Essentials keys = keys_of(entry);
    return !is_value(entry.symptom) && with_implied(keys).contains(key("attachments", "color")) &&
           std::ranges::any_of(keys, [](const Essential& e) { return e.begins("draw.color."); }) &&
           std::ranges::none_of(without(keys, but), decides_hits);
}

// Whether an earlier entry has wrong values by something special of an attribute or of a colour,
// and a fresh one has wrong hits by the same that are read from a colour; or the shader discards by
// an input.
bool is_of_value(const Entry& earlier, const Entry& fresh) {
    const Essentials special = special_of(earlier);
    const bool is_input = std::ranges::all_of(
        special, [](const Essential& e) { return e.begins("draw.attribute."); });
    const Essential discard = key("draw.discard", "negative");
    Essentials but = special;
    but.insert(discard);
    const bool is_of_hits = !is_value(fresh.symptom) || fresh.symptom.rule == "write.consistent";
    const bool is_discard = is_input && is_of_hits && fresh.essentials.contains(discard) &&
                            std::ranges::none_of(without(fresh.essentials, but), decides_hits);
    return is_value(earlier.symptom) && !special.empty() &&
           (is_discard ||
            ((is_input || is_of_color(earlier)) && is_hit_by_color(fresh, special))) &&
           fresh.symptom.level >= earlier.symptom.level && is_within(special, keys_of(fresh));
}

// Whether an earlier entry has wrong values of inputs at the sample or the centroid, and the shader
// of the fresh one discards by such an input.
bool is_discard_by_place(const Entry& earlier, const Entry& fresh) {
    constexpr std::array<std::pair<std::string_view, std::string_view>, 2> kPlaces = {
        {{"interp.sample", "sample"}, {"interp.centroid", "centroid"}}};
    return is_value(earlier.symptom) && fresh.symptom.rule == "discard.value" &&
           fresh.symptom.level >= earlier.symptom.level &&
           fresh.essentials.contains(key("draw.discard", "negative")) &&
           std::ranges::any_of(
               kPlaces,
               [&](const auto& place) {
                   return earlier.symptom.rule == place.first &&
                          fresh.essentials.contains(key("draw.attribute.auxiliary", place.second));
               }) &&
           is_within(without(earlier.essentials, kNumbers), fresh.essentials);
}

// Whether an earlier entry stores wrong colours, and the fresh one shows them by another rule, as
// write masks, logical operations and blending hand on what is stored. Those that need nothing
// special and that only Direct3D forbids are rounded otherwise than it says, by their format.
bool is_of_stored(const Entry& earlier, const Entry& fresh) {
    const bool is_told_of_values = is_value(fresh.symptom) ||
                                   fresh.symptom.kind == diff::FindingKind::order ||
                                   is_hit_by_color(fresh);
    if (!is_value(earlier.symptom) || !earlier.symptom.rule.starts_with("store.") ||
        !is_told_of_values || !is_of_color(fresh)) {
        return false;
    }
    const Essentials special = special_of(earlier);
    if (!special.empty()) {
        return fresh.symptom.level >= earlier.symptom.level && is_within(special, fresh.essentials);
    }
    return is_of_rounding(earlier) && fresh.symptom.level == cases::Profile::direct3d &&
           earlier.facts.format == fresh.facts.format;
}

// Whether an earlier entry has wrong depths by something special, and a fresh one that needs it,
// too, shows them in a test of depth, or in what the test lets through.
bool is_of_depth(const Entry& earlier, const Entry& fresh) {
    constexpr std::array<std::string_view, 4> kShown = {
        "depth.compare", "depth.bounds", "stencil.depth-outcome", "write.consistent"};
    const Essentials special = special_of(earlier);
    return is_value(earlier.symptom) && earlier.symptom.rule.starts_with("depth.") &&
           std::ranges::find(kShown, fresh.symptom.rule) != kShown.end() && !special.empty() &&
           fresh.symptom.level >= earlier.symptom.level && is_within(special, special_of(fresh));
}

// Whether a key is of a test that leaves some samples of a fragment: depth, stencil, masks,
// discards.
bool takes_samples(const Essential& e) {
    constexpr std::array<std::string_view, 6> kTests = {
        "draw.depth.compare", "draw.depth.bounds", "draw.stencil",
        "draw.sample_mask",   "draw.discard",      "draw.color.alpha_to_coverage"};
    return std::ranges::any_of(kTests, [&](std::string_view test) { return e.begins(test); });
}

// What an entry needs besides such tests, and how it asks for a centroid; nothing if it has no
// values at a wrong centroid, or no test moves it.
std::optional<Essentials> beside_moved_centroid(const Entry& entry) {
    const bool is_centroid =
        entry.symptom.rule == "interp.centroid" || entry.symptom.rule == "interp.at-centroid";
    if (!is_value(entry.symptom) || !is_centroid || !is_within(kSamples, entry.essentials) ||
        std::ranges::none_of(entry.essentials, takes_samples)) {
        return std::nullopt;
    }
    Essentials rest = special_of(entry);
    std::erase_if(rest, [](const Essential& e) {
        return takes_samples(e) || e.begins("draw.attribute.") || e == key("stencil", "true") ||
               e == key("depth_clear");
    });
    return rest;
}

bool is_of_moved_centroid(const Entry& earlier, const Entry& fresh) {
    const auto beside = beside_moved_centroid(earlier);
    return beside && beside == beside_moved_centroid(fresh) &&
           earlier.symptom.level <= fresh.symptom.level;
}

// Whether two entries show the same state beside a stencil in what the stencil holds: by which rule
// depends on its operations, and whether it compares, which are chance; a later draw may compare
// it, too. So are the face whose operations they are, and how depth came to what it is.
bool is_of_stencil_beside(const Entry& earlier, const Entry& fresh) {
    const auto holds_wrong = [](const Entry& entry) {
        const bool is_compared = entry.symptom.rule == "stencil.compare" &&
                                 entry.essentials.contains({Trait::several_draws});
        return entry.essentials.contains(key("stencil", "true")) &&
               (is_value(entry.symptom) ? entry.symptom.rule.starts_with("stencil.") ||
                                              entry.symptom.rule == "depth.bounds"
                                        : is_compared);
    };
    const auto beside = [](const Entry& entry) {
        Essentials rest = special_of(entry);
        std::erase_if(rest, [](const Essential& e) {
            return e.begins("draw.stencil") || e == key("stencil", "true") ||
                   e.begins("draw.front_face") || e == key("depth_clear");
        });
        if (rest.contains(key("draw.depth.bounds"))) {
            rest.erase(key("draw.frag_depth"));
        }
        return rest;
    };
    return holds_wrong(earlier) && holds_wrong(fresh) &&
           std::ranges::any_of(beside(earlier), decides_hits) && beside(earlier) == beside(fresh) &&
           earlier.symptom.level <= fresh.symptom.level;
}

// Whether what was seen is no number where a colour lies beyond the range of binary16, or may.
bool is_beyond_half(const Entry& entry) {
    return is_of_color(entry) && entry.overflows;
}

// All of them, whatever the words of keys are.
Essentials names_of(const Essentials& all) {
    Essentials names;
    for (Essential e : all) {
        e.word.clear();
        names.insert(std::move(e));
    }
    return names;
}

// Whether a fresh entry shows the very same by the same keys with other words, or by all but one of
// several: that one was needed for the earlier case's numbers alone.
bool shows_the_same(const Entry& earlier, const Entry& fresh) {
    if (!(earlier.symptom == fresh.symptom)) {
        return false;
    }
    const Essentials special = special_of(earlier);
    const bool is_special = !special.empty() && !special_of(fresh).empty();
    // What is stored wrongly, and not by its rounding, is so in each format of the sort that the
    // rule is of. An attribute may be interpolated wrongly instead.
    const auto is_interpolated = [](const Entry& entry) {
        return entry.essentials.contains(key("draw.color.attribute")) &&
               entry.facts.has_varying_attribute;
    };
    if (earlier.symptom.rule.starts_with("store.") && !is_of_rounding(earlier) &&
        is_interpolated(earlier) == is_interpolated(fresh) && special.empty() &&
        special_of(fresh).empty()) {
        return true;
    }
    // Where nothing but colours is needed, a constant and an attribute are two things: one of them
    // is interpolated.
    const Essentials keys = is_special ? keys_of(fresh) : without(fresh.essentials, kNumbers);
    const Essentials others = is_special ? keys_of(earlier) : without(earlier.essentials, kNumbers);
    // All that an earlier one needs, by the same words or of several keys by others, and more.
    const bool has_all = is_special &&
                         (is_within(special, keys) ||
                          (special.size() >= 2 && is_within(names_of(special), names_of(keys)))) &&
                         (!hangs_on_format(earlier) || has_format_of(fresh.facts, earlier));
    const bool is_one_less =
        keys.size() >= 3 && others.size() == keys.size() + 1 && is_within(keys, others);
    return has_all || is_one_less || (keys.size() >= 2 && names_of(keys) == names_of(others));
}

}  // namespace

bool is_same_cause(const Entry& earlier, const Entry& fresh) {
    if (earlier.symptom.status != fresh.symptom.status ||
        earlier.symptom.signal != fresh.symptom.signal ||
        (earlier.is_known && earlier.symptom.level > fresh.symptom.level)) {
        return false;
    }
    if (fresh.symptom.status != Status::fail) {
        return is_within(needed_by(earlier), fresh.essentials);
    }
    if (is_of_rounding(earlier) && is_of_rounding(fresh) &&
        earlier.facts.format != fresh.facts.format) {
        return false;
    }
    // A colour beyond the range may be drawn, masked or cleared to.
    const bool is_of_overflow = earlier.symptom.rule.starts_with("store.") &&
                                is_beyond_half(earlier) && is_beyond_half(fresh) &&
                                earlier.symptom.level <= fresh.symptom.level;
    if (is_consequence(earlier, fresh) || is_of_value(earlier, fresh) ||
        is_of_stored(earlier, fresh) || is_of_overflow || is_discard_by_place(earlier, fresh) ||
        is_of_stencil_beside(earlier, fresh) || is_of_depth(earlier, fresh)) {
        return true;
    }
    // What is gravest in the fresh one's own reduced case is the earlier one's: what else is wrong
    // there follows from it, since no smaller case shows that without it.
    if (fresh.shown_first && explains(earlier, *fresh.shown_first, fresh.facts)) {
        return true;
    }
    if (is_value(earlier.symptom) != is_value(fresh.symptom)) {
        return false;
    }
    // Which test leaves those samples, and whether the input or the shader asks for the centroid,
    // is chance.
    if (shows_the_same(earlier, fresh) || is_of_moved_centroid(earlier, fresh)) {
        return true;
    }
    const bool is_same_rule = std::ranges::any_of(
        fresh.also, [&](const auto& one) { return earlier.also.contains(one); });
    if (earlier.essentials == fresh.essentials) {
        return is_same_rule || !fresh.essentials.empty();
    }
    // Whatever else of its numbers and samples a case needs in which a thin triangle fails is
    // chance: with other numbers another one would.
    const Essential thin{Trait::thin_triangle};
    if (earlier.essentials.contains(thin) && fresh.essentials.contains(thin)) {
        const Essentials a = without_numbers_and_samples(earlier.essentials),
                         b = without_numbers_and_samples(fresh.essentials);
        return is_within(a, b) || is_within(b, a);
    }
    // What only Direct3D's rules forbid is mostly another thing.
    const bool are_grave =
        std::max(earlier.symptom.level, fresh.symptom.level) <= cases::Profile::practice;
    const Essentials keys = without(fresh.essentials, kNumbers);
    // What writes a colour decides no hit.
    static const Essentials kWritten = {key("color.clear"), key("draw.attribute"),
                                        key("draw.color.value")};
    const Essentials chance = is_value(fresh.symptom) ? Essentials() : kWritten;
    return (are_grave || earlier.symptom.level == fresh.symptom.level) &&
           without(without(earlier.essentials, kNumbers), chance) == without(keys, chance) &&
           !without(keys, kSamples).empty();
}

void merge(Entry& earlier, Entry fresh) {
    earlier.also.insert(fresh.also.begin(), fresh.also.end());
    earlier.other_formats.merge(fresh.other_formats);
    if (fresh.facts.format) {
        earlier.other_formats.insert(*fresh.facts.format);
    }
    if (earlier.is_known) {
        return;
    }
    Essentials both;
    std::ranges::set_intersection(earlier.essentials, fresh.essentials,
                                  std::inserter(both, both.end()));
    earlier.essentials = std::move(both);
    if (fresh.symptom.level < earlier.symptom.level) {
        fresh.also = std::move(earlier.also);
        fresh.other_formats = std::move(earlier.other_formats);
        if (earlier.facts.format) {
            fresh.other_formats.insert(*earlier.facts.format);
        }
        fresh.essentials = std::move(earlier.essentials);
        fresh.count = earlier.count;
        fresh.stale_file = earlier.stale_file.empty() ? earlier.file : earlier.stale_file;
        earlier = std::move(fresh);
    }
}

}  // namespace fuzz
