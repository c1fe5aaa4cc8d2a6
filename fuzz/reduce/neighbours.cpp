// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "fuzz/reduce/neighbours.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <span>

#include "cases/key/key.hpp"
#include "cases/load/loader.hpp"
#include "fuzz/reduce/measure.hpp"
#include "fuzz/reduce/path.hpp"

namespace fuzz {

namespace {

class Finder {
  public:
    explicit Finder(const Document& document) : document_(document) {}

    std::vector<Neighbour> find_all() {
        const Document* target = document_.find("target");
        if (target == nullptr) {
            return {};
        }
        const Document* color = target->find("color");
        if (color != nullptr && color->find("format") != nullptr) {
            add_first(Path() + "target" + "color", cases::kTargetColorKeys, "format", color);
        }
        // What is not told has its default: it has neighbours, too.
        add_first(Path() + "target", cases::kTargetKeys, "depth", target);
        add_samples(*target);
        walk(document_, {}, &cases::kFileKeys);
        return std::move(all_);
    }

  private:
    void add(const Document& changed, const std::string& place, const std::string& value,
             const std::string& now) {
        if (auto loaded = cases::load_tree(changed, "case"); loaded && !loaded->empty()) {
            all_.push_back({std::move(loaded->front()), place, value, now});
        }
    }

    // The other words of a key, whether the table has it or not. It has no others then.
    void add_first(const Path& path, const cases::KeyTable& keys, std::string_view name,
                   const Document* table) {
        if (const cases::Key* key = first_.emplace_back(keys.find(name))) {
            const Document* given = table->find(name);
            add_words(path, *key,
                      given == nullptr ? std::string(key->words.front()) : given->string, "");
        }
    }

    void add_words(const Path& path, const cases::Key& key, const std::string& now,
                   const std::string& in) {
        const std::string place =
            std::string(key.neighbour == "= {}" ? fmt::format("{} = {{}}", key.name)
                                                : key.neighbour) +
            in;
        // Each is drawn; of the many formats the first ones tell as much as all.
        constexpr size_t kMostWords = 20;
        for (const std::string_view word :
             key.words.first(std::min(key.words.size(), kMostWords))) {
            Document changed = document_;
            Document* table = at(changed, path);
            if (word == now || table == nullptr) {
                continue;
            }
            set(*table, key.name, text(std::string(word)));
            add(changed, place, std::string(word), now);
        }
    }

    void add_samples(const Document& target) {
        const Document* given = target.find("samples");
        const double now = given == nullptr ? 1 : value_of(*given).value_or(1);
        const cases::Key* key = cases::kTargetKeys.find("samples");
        for (const double samples : key == nullptr ? std::span<const double>() : key->numbers) {
            if (samples < now || samples > now) {
                Document changed = document_;
                Document* to = fuzz::find(changed, "target");
                set(*to, "samples", number(samples));
                erase(*to, "sample_locations");
                add(changed, "{}", fmt::format("{} sample{}", samples, samples > 1 ? "s" : ""),
                    fmt::format("{}", now));
            }
        }
    }

    // Keys with words, wherever they stand.
    void walk(const Document& value, const Path& path, const cases::KeyTable* keys) {
        for (size_t k = 0; k < value.array.size(); ++k) {
            walk(value.array[k], path + k, keys);
        }
        for (const cases::TomlEntry& entry : value.table) {
            const cases::Key* key = cases::find_key(keys, entry.key);
            if (key != nullptr && !key->neighbour.empty() && entry.value.is(Kind::string) &&
                std::ranges::find(first_, key) == first_.end()) {
                const Document* draws = document_.find("draw");
                const bool is_told = draws != nullptr && draws->array.size() > 1 &&
                                     path.parts.size() > 1 &&
                                     std::holds_alternative<size_t>(path.parts[1]);
                add_words(
                    path, *key, entry.value.string,
                    is_told ? fmt::format(" in draw {}", std::get<size_t>(path.parts[1])) : "");
            }
            walk(entry.value, path + entry.key, cases::keys_in(keys, entry.key));
        }
    }

    const Document& document_;
    std::vector<Neighbour> all_;
    std::vector<const cases::Key*> first_;  // whose words have been added
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
