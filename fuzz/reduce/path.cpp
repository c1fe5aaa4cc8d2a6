// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "fuzz/reduce/path.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace fuzz {

Path Path::operator+(const std::string& key) const {
    Path longer = *this;
    longer.parts.emplace_back(key);
    return longer;
}

Path Path::operator+(size_t element) const {
    Path longer = *this;
    longer.parts.emplace_back(element);
    return longer;
}

Document* at(Document& document, const Path& path) {
    Document* value = &document;
    for (const auto& part : path.parts) {
        if (const auto* key = std::get_if<std::string>(&part)) {
            value = find(*value, *key);
        } else {
            const size_t element = std::get<size_t>(part);
            value = element < value->array.size() ? &value->array[element] : nullptr;
        }
        if (value == nullptr) {
            return nullptr;
        }
    }
    return value;
}

static bool is_in_draw(const Path& path) {
    return path.parts.size() >= 2 && path.parts[0] == std::variant<std::string, size_t>("draw");
}

std::string words_of(const Path& path) {
    constexpr std::array<const char*, 4> kComponent = {"x", "y", "z", "w"};
    std::string words;
    for (size_t k = is_in_draw(path) ? 2 : 0; k < path.parts.size(); ++k) {
        const auto* key = std::get_if<std::string>(&path.parts[k]);
        if (key != nullptr && *key == "vertices" && k + 2 < path.parts.size()) {
            return fmt::format("{} of vertex {}",
                               kComponent.at(std::get<size_t>(path.parts[k + 2])),
                               std::get<size_t>(path.parts[k + 1]));
        }
        if (key != nullptr) {
            words += (words.empty() ? "" : " ") + *key;
        } else {
            const bool is_table = words.ends_with("attribute") || words.ends_with("distance");
            words += fmt::format(fmt::runtime(is_table ? " {}" : "[{}]"),
                                 std::get<size_t>(path.parts[k]));
        }
    }
    std::ranges::replace(words, '_', ' ');
    return words;
}

void name_at(const Document& document, const Path& path, const std::string& what, Step& step) {
    std::string words = words_of(path);
    words += words.empty() ? "" : " ";
    std::string all = what;
    if (const size_t place = all.find("{}"); place != std::string::npos) {
        all.replace(place, 2, words);
    }
    std::ranges::replace(all, '_', ' ');
    all.erase(all.find_last_not_of(' ') + 1);
    if (is_in_draw(path)) {
        step.draw = std::get<size_t>(path.parts[1]);
        name_in_draw(document, step.draw, all, step);
    } else {
        step.words = all;
        step.need = "not " + all;
    }
}

}  // namespace fuzz
