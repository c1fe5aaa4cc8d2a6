// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "fuzz/reduce/neighbours.hpp"

#include <fmt/format.h>

#include <array>
#include <span>

#include "cases/load/loader.hpp"
#include "cases/model/words.hpp"
#include "fuzz/reduce/measure.hpp"
#include "fuzz/reduce/path.hpp"

namespace fuzz {

namespace {

using WordSpan = std::span<const std::string_view>;

constexpr std::array<std::string_view, 8> kBlends = {
    "none", "alpha", "premultiplied", "additive", "multiply", "reverse-subtract", "min", "max"};
constexpr std::array<std::string_view, 3> kPatterns = {"odd-columns", "odd-rows", "checker"};
constexpr std::array<std::string_view, 3> kAttachments = {"all", "color", "color+depth"};
constexpr std::array<double, 5> kSamples = {1, 2, 4, 8, 16};

// A key of a draw or of one of its attributes that has one of some words.
struct WordKey {
    std::string_view key, phrase;  // "{}" in the phrase stands for the word
    WordSpan words;
};
constexpr std::array<WordKey, 20> kKeys = {{
    {"discard_by", "discard_by = {}", cases::kWords<cases::DiscardBy>},
    {"cull", "cull = {}", cases::kWords<cases::CullMode>},
    {"front_face", "front_face = {}", cases::kWords<cases::FrontFace>},
    {"provoking", "the {} vertex as provoking one", cases::kWords<cases::ProvokingVertex>},
    {"depth_volume", "depth_volume = {}", cases::kVolumeWords},
    {"compare", "the comparison {}", cases::kWords<cases::CompareOp>},
    {"fail", "fail = {}", cases::kWords<cases::StencilOp>},
    {"depth_fail", "depth_fail = {}", cases::kWords<cases::StencilOp>},
    {"pass", "pass = {}", cases::kWords<cases::StencilOp>},
    {"discard", "discard = {}", cases::kWords<cases::Discard>},
    {"query", "query = {}", cases::kWords<cases::Query>},
    {"where", "where = {}", kPatterns},
    {"layout", "layout = {}", cases::kWords<cases::DepthLayout>},
    {"blend", "blend = {}", kBlends},
    {"logic", "logic = {}", cases::kWords<cases::LogicOp>},
    {"interpolation", "{} interpolation", cases::kWords<cases::Interpolation>},
    {"auxiliary", "auxiliary = {}", cases::kWords<cases::Auxiliary>},
    {"resolve", "resolve = {}", cases::kWords<cases::Resolve>},
    {"depth_resolve", "depth_resolve = {}", cases::kWords<cases::Resolve>},
    {"attachments", "attachments = {}", kAttachments},
}};

bool is_case(const std::string& text) {
    return cases::load_text(text, "case.toml", "case").has_value();
}

class Finder {
  public:
    explicit Finder(const Document& document) : document_(document) {}

    std::vector<Neighbour> find_all() {
        const Document* target = document_.find("target");
        if (target == nullptr) {
            return {};
        }
        if (const Document* color = target->find("color")) {
            if (const Document* format = color->find("format")) {
                add_words(Path() + "target" + "color", "format", format->string, "the format {}",
                          cases::kWords<cases::ColorFormat>);
            }
        }
        // What is not told has its default: it has neighbours, too.
        const Document* depth = target->find("depth");
        add_words(Path() + "target", "depth",
                  depth == nullptr ? std::string(cases::kWords<cases::DepthFormat>.front())
                                   : depth->string,
                  "depth {}", cases::kWords<cases::DepthFormat>);
        add_samples(*target);
        walk(document_, {});
        return std::move(all_);
    }

  private:
    void add(Document changed, const std::string& place, const std::string& value,
             const std::string& now) {
        std::string text = to_text(changed);
        if (is_case(text)) {
            all_.push_back({std::move(text), place, value, now});
        }
    }

    void add_words(const Path& path, const std::string& key, const std::string& now,
                   const std::string& place, WordSpan words) {
        for (const std::string_view word : words) {
            Document changed = document_;
            Document* table = at(changed, path);
            if (word == now || table == nullptr) {
                continue;
            }
            set(*table, key, text(std::string(word)));
            add(std::move(changed), place, std::string(word), now);
        }
    }

    void add_samples(const Document& target) {
        const Document* given = target.find("samples");
        const double now = given == nullptr ? 1 : value_of(*given).value_or(1);
        for (const double samples : kSamples) {
            if (samples < now || samples > now) {
                Document changed = document_;
                Document* to = fuzz::find(changed, "target");
                set(*to, "samples", number(samples));
                erase(*to, "sample_locations");
                add(std::move(changed), "{}",
                    fmt::format("{} sample{}", samples, samples > 1 ? "s" : ""),
                    fmt::format("{}", now));
            }
        }
    }

    // Keys with words, wherever they stand.
    void walk(const Document& value, const Path& path) {
        for (size_t k = 0; k < value.array.size(); ++k) {
            walk(value.array[k], path + k);
        }
        for (const cases::TomlEntry& entry : value.table) {
            for (const WordKey& key : kKeys) {
                if (entry.key != key.key || !entry.value.is(Document::Kind::string)) {
                    continue;
                }
                const Document* draws = document_.find("draw");
                const bool is_told = draws != nullptr && draws->array.size() > 1 &&
                                     path.parts.size() > 1 &&
                                     std::holds_alternative<size_t>(path.parts[1]);
                const std::string in =
                    is_told ? fmt::format(" in draw {}", std::get<size_t>(path.parts[1])) : "";
                add_words(path, entry.key, entry.value.string, std::string(key.phrase) + in,
                          key.words);
            }
            walk(entry.value, path + entry.key);
        }
    }

    const Document& document_;
    std::vector<Neighbour> all_;
};

std::string list_of(const std::vector<std::string>& words) {
    std::string text;
    for (size_t k = 0; k < words.size(); ++k) {
        text += k == 0 ? words[k] : (k + 1 == words.size() ? " or " : ", ") + words[k];
    }
    return text;
}

}  // namespace

std::vector<Neighbour> neighbours(const Document& document) {
    return Finder(document).find_all();
}

std::vector<std::string> sentences(const std::vector<Neighbour>& all,
                                   const std::vector<bool>& judged,
                                   const std::vector<bool>& passes) {
    std::vector<std::string> out;
    for (size_t begin = 0; begin < all.size();) {
        const std::string& place = all[begin].place;
        std::vector<std::string> good;
        size_t asked = 0, end = begin;
        for (; end < all.size() && all[end].place == place && all[end].now == all[begin].now;
             ++end) {
            asked += judged[end] ? 1U : 0U;
            if (passes[end]) {
                good.push_back(all[end].value);
            }
        }
        constexpr size_t kFew = 4;
        if (!good.empty()) {
            const bool is_any = good.size() == asked && good.size() > kFew;
            const std::string value = is_any ? "any other" : list_of(good);
            const size_t at = place.find("{}");
            out.push_back(fmt::format("with {}{}{} in place of {}", place.substr(0, at), value,
                                      place.substr(at + 2), all[begin].now));
        }
        begin = end;
    }
    return out;
}

}  // namespace fuzz
