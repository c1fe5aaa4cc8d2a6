// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Which failures are of one cause.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <iterator>
#include <set>
#include <string>
#include <string_view>
#include <utility>

#include "fuzz/cause.hpp"
#include "fuzz/entry.hpp"

namespace fuzz {

using report::Status;

namespace {

diff::FindingKind sort_of(diff::FindingKind kind) {
    return kind == diff::FindingKind::double_hit ? diff::FindingKind::extra : kind;
}

bool is_value(const Symptom& symptom) {
    return symptom.kind == diff::FindingKind::value;
}

// The essentials that say something of a case's numbers only.
const std::set<std::string> kNumbers = {"behind the eye", "several draws", "several triangles",
                                        "sloping depth", "unequal w"};
const std::set<std::string> kSamples = {"several samples"};
const std::set<std::string> kThinToo = {"behind the eye", "several draws",     "several samples",
                                        "sloping depth",  "several triangles", "unequal w"};

bool is_within(const std::set<std::string>& part, const std::set<std::string>& whole) {
    return std::includes(whole.begin(), whole.end(), part.begin(), part.end());
}

std::set<std::string> without(const std::set<std::string>& words,
                              const std::set<std::string>& left_out) {
    std::set<std::string> rest;
    std::set_difference(words.begin(), words.end(), left_out.begin(), left_out.end(),
                        std::inserter(rest, rest.end()));
    return rest;
}

// What a case needs without its numbers. A constant and an attribute are two ways to write a
// colour, and it is chance which factor takes a second source.
std::set<std::string> keys_of(const Entry& entry) {
    std::set<std::string> keys = without(entry.essentials, kNumbers);
    if (keys.contains("draw.color.second")) {
        std::erase_if(
            keys, [](const std::string& word) { return word.starts_with("draw.color.blend."); });
    }
    // A shader may write a depth in several ways.
    if (std::erase_if(keys, [](const std::string& word) {
            return word.starts_with("draw.frag_depth.") &&
                   !word.starts_with("draw.frag_depth.layout");
        }) > 0) {
        keys.insert("draw.frag_depth");
    }
    if (keys.erase("draw.color.attribute") > 0) {
        keys.erase("draw.attribute");
        keys.insert("draw.color.value");
    }
    return keys;
}

// What a case needs besides numbers, samples and plain colours, however they are written.
std::set<std::string> special_of(const Entry& entry) {
    std::set<std::string> words = without(keys_of(entry), kThinToo);
    for (const char* plain : {kThinTriangle, "attachments=color", "attachments=color+depth",
                              "color", "color.clear", "draw.attribute", "draw.color.value"}) {
        words.erase(plain);
    }
    return words;
}

// "format rgba8-unorm" of the colours that an entry's case is judged by.
std::string format_of(const Entry& entry) {
    const std::set<std::string> facts = facts_of(entry.text);
    const auto at = std::ranges::find_if(
        facts, [](const std::string& fact) { return fact.starts_with("format "); });
    return at == facts.end() ? "" : *at;
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
    return is_of_rounding(entry) || std::ranges::any_of(entry.needs, [](const std::string& need) {
               return need.starts_with("not with the format");
           });
}

bool has_format_of(const std::set<std::string>& facts, const Entry& entry) {
    return facts.contains(format_of(entry)) ||
           std::ranges::any_of(entry.other_formats,
                               [&](const std::string& format) { return facts.contains(format); });
}

}  // namespace

std::set<std::string> with_implied(std::set<std::string> essentials) {
    if (essentials.contains("attachments=color+depth")) {
        essentials.insert("attachments=color");
    }
    return essentials;
}

bool explains(const Entry& entry, const Symptom& symptom, const std::set<std::string>& facts) {
    // Whatever is done with colours that are rounded otherwise is wrong as they are (is_of_stored);
    // a reduction would say no more.
    const bool is_of_values = is_value(symptom) || symptom.kind == diff::FindingKind::order;
    if (symptom.status == Status::fail && is_of_rounding(entry) && special_of(entry).empty() &&
        symptom.level == cases::Profile::direct3d && is_of_values && is_color_rule(symptom.rule) &&
        has_format_of(facts, entry)) {
        return true;
    }
    std::set<std::string> words = facts;
    if (!special_of(entry).empty() && facts.contains("draw.color.attribute")) {
        words.insert("draw.color.value");  // what writes the colour is not what is special
    }
    if (!is_within(entry.essentials, words)) {
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
    const bool is_like = std::any_of(entry.also.begin(), entry.also.end(), [&](const auto& known) {
        return is_value(symptom) || entry.essentials.empty()
                   ? known == std::pair(symptom.kind, symptom.rule)
                   : sort_of(known.first) == sort_of(symptom.kind);
    });
    return is_like && (!hangs_on_format(entry) || has_format_of(facts, entry));
}

namespace {

// Whether a word says which fragments there are: a state of a draw, not what it writes, nor where
// in a pixel that is evaluated.
bool decides_hits(const std::string& word) {
    return word.starts_with("draw.color.alpha_to_coverage") ||
           (word.starts_with("draw.") && !word.starts_with("draw.attribute") &&
            !word.starts_with("draw.color") && !word.starts_with("draw.min_sample_shading"));
}

// Whether an earlier entry hits too much or too little by something special that the fresh one
// needs, too: whatever hits write, and later draws find, is wrong with them. A stencil that counts
// where a scissor lets fragments through is the scissor's.
bool is_consequence(const Entry& earlier, const Entry& fresh) {
    // What writes a colour decides no hit.
    const std::set<std::string> keys = without(keys_of(earlier), {"color", "draw.color.value"});
    return !is_value(earlier.symptom) && std::ranges::any_of(keys, decides_hits) &&
           is_within(keys, with_implied(fresh.essentials));
}

// Whether what is wrong was seen in a colour.
bool is_of_color(const Entry& entry) {
    return with_implied(entry.essentials).contains("attachments=color") ||
           is_color_rule(entry.symptom.rule);
}

// Whether an entry lacks hits or has too many that are read from a colour that varies, since its
// case counts none: that may as well be a wrong one. No state may decide them but these words.
bool is_hit_by_color(const Entry& entry, const std::set<std::string>& but = {}) {
    const std::set<std::string> words = keys_of(entry);
    return !is_value(entry.symptom) && with_implied(words).contains("attachments=color") &&
           std::ranges::any_of(
               words, [](const std::string& word) { return word.starts_with("draw.color."); }) &&
           std::ranges::none_of(without(words, but), decides_hits);
}

// Whether an earlier entry has wrong values by something special of an attribute or of a colour,
// and a fresh one has wrong hits by the same that are read from a colour; or the shader discards by
// an input.
bool is_of_value(const Entry& earlier, const Entry& fresh) {
    const std::set<std::string> special = special_of(earlier);
    const bool is_input = std::ranges::all_of(
        special, [](const std::string& word) { return word.starts_with("draw.attribute."); });
    std::set<std::string> but = special;
    but.insert("draw.discard=negative");
    const bool is_discard = is_input && !is_value(fresh.symptom) &&
                            fresh.essentials.contains("draw.discard=negative") &&
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
        {{"interp.sample", "draw.attribute.auxiliary=sample"},
         {"interp.centroid", "draw.attribute.auxiliary=centroid"}}};
    return is_value(earlier.symptom) && fresh.symptom.rule == "discard.value" &&
           fresh.symptom.level >= earlier.symptom.level &&
           fresh.essentials.contains("draw.discard=negative") &&
           std::ranges::any_of(kPlaces,
                               [&](const auto& place) {
                                   return earlier.symptom.rule == place.first &&
                                          fresh.essentials.contains(std::string(place.second));
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
    const std::set<std::string> special = special_of(earlier);
    if (!special.empty()) {
        return fresh.symptom.level >= earlier.symptom.level && is_within(special, fresh.essentials);
    }
    return is_of_rounding(earlier) && fresh.symptom.level == cases::Profile::direct3d &&
           format_of(earlier) == format_of(fresh);
}

// Whether a word is of a test that leaves some samples of a fragment: depth, stencil, masks,
// discards.
bool takes_samples(const std::string& word) {
    constexpr std::array<std::string_view, 6> kTests = {
        "draw.depth.compare", "draw.depth.bounds", "draw.stencil",
        "draw.sample_mask",   "draw.discard",      "draw.color.alpha_to_coverage"};
    return std::ranges::any_of(kTests,
                               [&](std::string_view test) { return word.starts_with(test); });
}

// What an entry needs besides such tests, and how it asks for a centroid; nothing if it has no
// values at a wrong centroid, or no test moves it.
std::optional<std::set<std::string>> beside_moved_centroid(const Entry& entry) {
    const bool is_centroid =
        entry.symptom.rule == "interp.centroid" || entry.symptom.rule == "interp.at-centroid";
    if (!is_value(entry.symptom) || !is_centroid || !entry.essentials.contains("several samples") ||
        std::ranges::none_of(entry.essentials, takes_samples)) {
        return std::nullopt;
    }
    std::set<std::string> words = special_of(entry);
    std::erase_if(words, [](const std::string& word) {
        return takes_samples(word) || word.starts_with("draw.attribute.") ||
               word == "stencil=true" || word == "depth_clear";
    });
    return words;
}

bool is_of_moved_centroid(const Entry& earlier, const Entry& fresh) {
    const auto words = beside_moved_centroid(earlier);
    return words && words == beside_moved_centroid(fresh) &&
           earlier.symptom.level <= fresh.symptom.level;
}

bool is_stencil_word(const std::string& word) {
    return word.starts_with("draw.stencil") || word == "stencil=true";
}

// Whether two entries show the same state beside a stencil in what the stencil holds: by which rule
// depends on its operations, and whether it compares, which are chance; a later draw may compare
// it, too. So are the face whose operations they are, and how depth came to what it is.
bool is_of_stencil_beside(const Entry& earlier, const Entry& fresh) {
    const auto holds_wrong = [](const Entry& entry) {
        const bool is_compared =
            entry.symptom.rule == "stencil.compare" && entry.essentials.contains("several draws");
        return entry.essentials.contains("stencil=true") &&
               (is_value(entry.symptom) ? entry.symptom.rule.starts_with("stencil.") ||
                                              entry.symptom.rule == "depth.bounds"
                                        : is_compared);
    };
    const auto beside = [](const Entry& entry) {
        std::set<std::string> words = special_of(entry);
        std::erase_if(words, [](const std::string& word) {
            return is_stencil_word(word) || word.starts_with("draw.front_face") ||
                   word == "depth_clear";
        });
        if (words.contains("draw.depth.bounds")) {
            words.erase("draw.frag_depth");
        }
        return words;
    };
    return holds_wrong(earlier) && holds_wrong(fresh) &&
           std::ranges::any_of(beside(earlier), decides_hits) && beside(earlier) == beside(fresh) &&
           earlier.symptom.level <= fresh.symptom.level;
}

// Whether "r -4514752 to -65472, g 0" has a range whose outer end binary16 does not reach, and
// whose inner end is most of the way there. The largest finite number of binary16 is 65504.
bool reaches_beyond_half(std::string_view expected) {
    constexpr double kLargest = 65504;
    constexpr std::string_view kTo = " to ";
    for (size_t to = expected.find(kTo); to != std::string_view::npos;
         to = expected.find(kTo, to + 1)) {
        const size_t begin = expected.rfind(' ', to - 1) + 1;
        const double first = std::strtod(std::string(expected.substr(begin)).c_str(), nullptr);
        const double last =
            std::strtod(std::string(expected.substr(to + kTo.size())).c_str(), nullptr);
        const double inner = std::min(std::abs(first), std::abs(last));
        const double outer = std::max(std::abs(first), std::abs(last));
        if (first * last > 0 && outer > kLargest && inner >= kLargest / 2) {
            return true;
        }
    }
    return false;
}

// Whether what was seen is no number where a colour lies beyond the range of binary16, or may.
bool is_beyond_half(const Entry& entry) {
    const size_t got = entry.seen.find(", got ");
    if (!is_of_color(entry) || got == std::string::npos) {
        return false;
    }
    const std::string found = entry.seen.substr(got);
    return reaches_beyond_half(std::string_view(entry.seen).substr(0, got)) &&
           (found.find("NaN") != std::string::npos || found.find("infinity") != std::string::npos);
}

// "draw.discard" of "draw.discard=front".
std::set<std::string> names_of(const std::set<std::string>& words) {
    std::set<std::string> names;
    for (const std::string& word : words) {
        names.insert(word.substr(0, word.find('=')));
    }
    return names;
}

// Whether a fresh entry shows the very same by the same keys with other words, or by all but one of
// several: that one was needed for the earlier case's numbers alone.
bool shows_the_same(const Entry& earlier, const Entry& fresh) {
    if (!(earlier.symptom == fresh.symptom)) {
        return false;
    }
    const std::set<std::string> special = special_of(earlier);
    const bool is_special = !special.empty() && !special_of(fresh).empty();
    // What is stored wrongly, and not by its rounding, is so in each format of the sort that the
    // rule is of. An attribute may be interpolated wrongly instead.
    const auto is_interpolated = [](const Entry& entry) {
        // The only attribute may be the same everywhere.
        const size_t attribute = entry.text.find("[[draw.attribute]]");
        return entry.essentials.contains("draw.color.attribute") &&
               (attribute != entry.text.rfind("[[draw.attribute]]") ||
                entry.text.find("\nconstant = ") == std::string::npos);
    };
    if (earlier.symptom.rule.starts_with("store.") && !is_of_rounding(earlier) &&
        is_interpolated(earlier) == is_interpolated(fresh) && special.empty() &&
        special_of(fresh).empty()) {
        return true;
    }
    // Where nothing but colours is needed, a constant and an attribute are two things: one of them
    // is interpolated.
    const std::set<std::string> keys =
        is_special ? keys_of(fresh) : without(fresh.essentials, kNumbers);
    const std::set<std::string> others =
        is_special ? keys_of(earlier) : without(earlier.essentials, kNumbers);
    // All that an earlier one needs, by the same words or of several keys by others, and more.
    const bool has_all =
        is_special &&
        (is_within(special, keys) ||
         (special.size() >= 2 && is_within(names_of(special), names_of(keys)))) &&
        (!hangs_on_format(earlier) || has_format_of(facts_of(fresh.text), earlier));
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
        return earlier.essentials == fresh.essentials;
    }
    if (is_of_rounding(earlier) && is_of_rounding(fresh) &&
        format_of(earlier) != format_of(fresh)) {
        return false;
    }
    // A colour beyond the range may be drawn, masked or cleared to.
    const bool is_of_overflow = earlier.symptom.rule.starts_with("store.") &&
                                is_beyond_half(earlier) && is_beyond_half(fresh) &&
                                earlier.symptom.level <= fresh.symptom.level;
    if (is_consequence(earlier, fresh) || is_of_value(earlier, fresh) ||
        is_of_stored(earlier, fresh) || is_of_overflow || is_discard_by_place(earlier, fresh) ||
        is_of_stencil_beside(earlier, fresh)) {
        return true;
    }
    // What is gravest in the fresh one's own reduced case is the earlier one's: what else is wrong
    // there follows from it, since no smaller case shows that without it.
    if (const std::optional<Symptom> first = parse_symptom(fresh.shown_first);
        first && explains(earlier, *first, facts_of(fresh.text))) {
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
    const bool is_same_rule =
        std::any_of(fresh.also.begin(), fresh.also.end(),
                    [&](const auto& one) { return earlier.also.contains(one); });
    if (earlier.essentials == fresh.essentials) {
        return is_same_rule || !fresh.essentials.empty();
    }
    // Whatever else of its numbers and samples a case needs in which a thin triangle fails is
    // chance: with other numbers another one would.
    if (earlier.essentials.contains(kThinTriangle) && fresh.essentials.contains(kThinTriangle)) {
        const std::set<std::string> a = without(earlier.essentials, kThinToo),
                                    b = without(fresh.essentials, kThinToo);
        return is_within(a, b) || is_within(b, a);
    }
    // What only Direct3D's rules forbid is mostly another thing.
    const bool are_grave =
        std::max(earlier.symptom.level, fresh.symptom.level) <= cases::Profile::practice;
    const std::set<std::string> keys = without(fresh.essentials, kNumbers);
    return (are_grave || earlier.symptom.level == fresh.symptom.level) &&
           without(earlier.essentials, kNumbers) == keys && !without(keys, kSamples).empty();
}

void merge(Entry& earlier, Entry fresh) {
    earlier.also.insert(fresh.also.begin(), fresh.also.end());
    earlier.other_formats.merge(fresh.other_formats);
    earlier.other_formats.insert(format_of(fresh));
    if (earlier.is_known) {
        return;
    }
    std::set<std::string> both;
    std::set_intersection(earlier.essentials.begin(), earlier.essentials.end(),
                          fresh.essentials.begin(), fresh.essentials.end(),
                          std::inserter(both, both.end()));
    earlier.essentials = std::move(both);
    if (fresh.symptom.level < earlier.symptom.level) {
        fresh.also = std::move(earlier.also);
        fresh.other_formats = std::move(earlier.other_formats);
        fresh.other_formats.insert(format_of(earlier));
        fresh.essentials = std::move(earlier.essentials);
        fresh.count = earlier.count;
        fresh.stale_file = earlier.stale_file.empty() ? earlier.file : earlier.stale_file;
        earlier = std::move(fresh);
    }
}

}  // namespace fuzz
