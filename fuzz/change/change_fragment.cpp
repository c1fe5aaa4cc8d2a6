// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Changes of what becomes of fragments: their size, depth bounds, depths that the shader writes,
// logical operations, what alpha does to coverage and to itself, queries of occlusion and of
// pipeline statistics.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "cases/model/target.hpp"
#include "fuzz/change/change.hpp"
#include "fuzz/reduce/measure.hpp"

namespace fuzz {

namespace {

void add_number(const Document* value, std::vector<double>& all) {
    if (const auto number = value == nullptr ? std::nullopt : value_of(*value);
        number && *number >= 0 && *number <= 1) {
        all.push_back(*number);
    }
}

// Depths, 0 to 1, that the document's attachment is cleared to or its draws may store.
std::vector<double> depths_of(Document& document) {
    std::vector<double> all = {static_cast<double>(cases::kDepthClear), 0.5};
    if (const Document* target = find(document, "target")) {
        add_number(target->find("depth_clear"), all);
    }
    for_each_draw(document, [&](Document& draw) {
        if (const Document* written = draw.find("frag_depth")) {
            add_number(written->find("value"), all);
            add_number(written->find("other"), all);
        }
        const Document* vertices = draw.find("vertices");
        if (vertices != nullptr && draw.find("space") == nullptr) {
            for (const Document& vertex : vertices->array) {
                add_number(vertex.array.size() > 2 ? &vertex.array[2] : nullptr, all);
            }
        }
    });
    return all;
}

// One of them, the next binary32, or any. Denormal numbers are taken for 0 here and there.
double near_depth(const std::vector<double>& depths, Dice& dice) {
    const auto depth = static_cast<float>(depths[dice.below(depths.size())]);
    const uint64_t kind = dice.below(6);
    const float near = kind == 0   ? static_cast<float>(dice.between(0, 8)) / 8
                       : kind == 1 ? std::nextafter(depth, 2.0F)
                       : kind == 2 ? std::nextafter(depth, -1.0F)
                                   : depth;
    const float within = std::clamp(near, 0.0F, 1.0F);
    return static_cast<double>(
        std::fpclassify(within) == FP_SUBNORMAL ? std::numeric_limits<float>::min() : within);
}

// Leaves the key out, if it is there and the dice say so.
bool drops(Document* table, std::string_view key, Dice& dice) {
    return table != nullptr && find(*table, key) != nullptr && dice.one_in(3) && erase(*table, key);
}

// Blending counts hits, which a logical operation switches off and alpha changes; queries are
// judged by hits.
void without_instruments(Document& document, Dice& dice) {
    Document* target = find(document, "target");
    if (target != nullptr && find(*target, "attachments") == nullptr) {
        set(*target, "attachments", text(dice.one_in(2) ? "color" : "color+depth"));
        for_each_draw(document, [](Document& one) { erase(one, "query"); });
    }
}

}  // namespace

Words change_bounds(Document& document, Document& draw, Dice& dice) {
    Document* depth = find(draw, "depth");
    if (drops(depth, "bounds", dice)) {
        return "without depth bounds";
    }
    const std::vector<double> depths = depths_of(document);
    const double one = near_depth(depths, dice);
    // Both ends, one of them, a single depth.
    const uint64_t kind = dice.below(5);
    const double other = kind == 0 ? 0 : kind == 1 ? 1 : kind == 2 ? one : near_depth(depths, dice);
    const auto [min, max] = std::minmax(one, other);
    set(depth != nullptr ? *depth : set(draw, "depth", table()), "bounds", numbers({min, max}));
    return fmt::format("depth bounds {} to {}", min, max);
}

Words change_frag_depth(Document& document, Document& draw, Dice& dice) {
    if (drops(&draw, "frag_depth", dice)) {
        return "without a written depth";
    }
    Words words;
    Document written = table();
    Document* depth = find(draw, "depth");
    const std::vector<double> depths = depths_of(document);
    if (dice.one_in(4)) {
        set(written, "from", text("frag-coord"));
        words += "writes gl_FragCoord.z";
        if (depth != nullptr) {
            erase(*depth, "bias");  // beside which neither is known
        }
    } else {
        const double value = near_depth(depths, dice);
        set(written, "value", number(value));
        words += fmt::format("writes the depth {}", value);
        if (dice.one_in(2)) {
            const double other = near_depth(depths, dice);
            set(written, "other", number(other));
            set_any(written, cases::kFragDepthKeys, "where", dice);
            words += fmt::format(" or {}", other);
        }
    }
    if (dice.one_in(4)) {
        set_any(written, cases::kFragDepthKeys, "layout", dice);
    }
    set(draw, "frag_depth", std::move(written));
    return words;
}

Words change_fragment_size(Document& /*document*/, Document& draw, Dice& dice) {
    if (drops(&draw, "fragment_size", dice)) {
        return "without a fragment size";
    }
    const auto width = static_cast<double>(1U << dice.below(3));
    const auto height = static_cast<double>(1U << dice.below(3));
    set(draw, "fragment_size", numbers({width, height}));
    return fmt::format("fragments of {} x {} pixels", width, height);
}

Words change_codes(Document& document, Document& draw, Dice& dice) {
    static constexpr std::array<std::string_view, 3> kKeys = {"logic", "alpha_to_one",
                                                              "alpha_to_coverage"};
    Document* color = color_table(draw);
    if (color == nullptr) {
        return {};
    }
    const std::string_view key = dice.of(kKeys);
    if (drops(color, key, dice)) {
        return fmt::format("without {}", key);
    }
    Words words = set_any(*color, cases::kColorKeys, key, dice);
    without_instruments(document, dice);
    return words;
}

Words change_query(Document& document, Document& draw, Dice& dice) {
    Document* target = find(document, "target");
    if (target == nullptr) {
        return {};
    }
    if (drops(&draw, "query", dice)) {
        return "without a query";
    }
    erase(*target, "attachments");
    for_each_draw(document, [](Document& one) {
        if (Document* color = find(one, "color")) {
            for (const char* key : {"logic", "alpha_to_one", "alpha_to_coverage", "second"}) {
                erase(*color, key);
            }
        }
    });
    return set_any(draw, cases::kDrawKeys, "query", dice);
}

}  // namespace fuzz
