// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "fuzz/essential.hpp"

#include <array>
#include <utility>

namespace fuzz {

namespace {

constexpr std::string_view kRelation = "relation ", kFar = " beyond 32767";
constexpr std::array<std::pair<Trait, std::string_view>, 8> kWords = {
    {{Trait::several_draws, "several draws"},
     {Trait::several_colors, "several colours"},
     {Trait::several_samples, "several samples"},
     {Trait::several_triangles, "several triangles"},
     {Trait::behind_the_eye, "behind the eye"},
     {Trait::unequal_w, "unequal w"},
     {Trait::sloping_depth, "sloping depth"},
     {Trait::thin_triangle, "thin triangle"}}};

}  // namespace

bool Essential::begins(std::string_view with) const {
    return (trait == Trait::key || trait == Trait::far) && name.starts_with(with);
}

std::string to_text(const Essential& essential) {
    for (const auto& [trait, words] : kWords) {
        if (trait == essential.trait) {
            return std::string(words);
        }
    }
    return (essential.trait == Trait::relation ? std::string(kRelation) : "") + essential.name +
           (essential.word.empty() ? "" : "=" + essential.word) +
           (essential.trait == Trait::far ? std::string(kFar) : "");
}

Essential parse_essential(std::string_view text) {
    for (const auto& [trait, words] : kWords) {
        if (words == text) {
            return {trait};
        }
    }
    if (text.starts_with(kRelation)) {
        return {Trait::relation, std::string(text.substr(kRelation.size()))};
    }
    if (text.ends_with(kFar)) {
        return {Trait::far, std::string(text.substr(0, text.size() - kFar.size()))};
    }
    const size_t is = text.find('=');
    return {Trait::key, std::string(text.substr(0, is)),
            std::string(is == text.npos ? "" : text.substr(is + 1))};
}

std::set<std::string> to_texts(const Essentials& essentials) {
    std::set<std::string> all;
    for (const Essential& essential : essentials) {
        all.insert(to_text(essential));
    }
    return all;
}

Essentials parse_essentials(const std::set<std::string>& texts) {
    Essentials all;
    for (const std::string& text : texts) {
        all.insert(parse_essential(text));
    }
    return all;
}

}  // namespace fuzz
