// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Steps that leave out a key, which then has its default, and those that make attributes plainer.
// Every key of every table is tried, so that keys to come are reduced too: what a case cannot do
// without does not load, and is no step.

#include <algorithm>
#include <array>

#include "fuzz/reduce/path.hpp"
#include "fuzz/reduce/steps.hpp"

namespace fuzz {

namespace {

// Keys that are no step by themselves: what the case claims, what changes its meaning if it is left
// out, and what has steps of its own.
constexpr std::array<std::string_view, 15> kNotAlone = {
    "format",   "description", "rules",  "links", "catches",   "relations", "expect", "space",
    "vertices", "samples",     "layers", "size",  "attribute", "color",     "draw"};

// Keys that mean nothing without another.
struct Company {
    std::string_view key;
    std::array<std::string_view, 3> with;
};
constexpr std::array<Company, 3> kCompany = {{
    {"blend", {"constants"}},
    {"probe", {"offset", "sample", "texture"}},
    {"where", {"other"}},
}};

// How people say that these have their default; of all others it is "without" their name.
struct Phrase {
    std::string_view key, words;  // "{}" stands for where it is
};
constexpr std::array<Phrase, 4> kPhrases = {{
    {"blend", "without blending"},
    {"cull", "without culling"},
    {"compare", "without a depth test"},
    {"interpolation", "with smooth {}"},
}};

std::string phrase_of(const Path& path, const std::string& key) {
    const bool is_in_stencil = words_of(path).find("stencil") != std::string::npos;
    if (is_in_stencil && key == "compare") {
        return "without {}test";  // "stencil", or "stencil back"
    }
    const auto phrase = std::ranges::find(kPhrases, key, &Phrase::key);
    return phrase != kPhrases.end() ? std::string(phrase->words) : "without {}" + key;
}

bool without_key(Document& document, const Path& path, const std::string& key) {
    Document* table = at(document, path);
    if (table == nullptr || !table->is(Kind::table) || !erase(*table, key)) {
        return false;
    }
    for (const Company& company : kCompany) {
        for (const std::string_view other : company.with) {
            if (company.key == key) {
                erase(*table, other);
            }
        }
    }
    return true;
}

void add_keys(const Document& document, const Document& value, const Path& path,
              std::vector<Step>& steps) {
    if (value.is(Kind::array)) {
        for (size_t k = 0; k < value.array.size(); ++k) {
            add_keys(document, value.array[k], path + k, steps);
        }
        return;
    }
    for (const cases::TomlEntry& entry : value.table) {
        if (std::ranges::find(kNotAlone, entry.key) == kNotAlone.end()) {
            Step step;
            name_at(document, path, phrase_of(path, entry.key), step);
            step.apply = [path, key = entry.key](Document& d) { return without_key(d, path, key); };
            steps.push_back(std::move(step));
        }
    }
    for (const cases::TomlEntry& entry : value.table) {
        const bool is_data = entry.key == "vertices" || entry.key == "values" ||
                             entry.key == "indices" || entry.key == "matrix" ||
                             entry.key == "relations";
        if (!is_data) {
            add_keys(document, entry.value, path + entry.key, steps);
        }
    }
}

// The arrays of numbers that say what an attribute is, one a vertex or one for all.
void for_each_entry(Document& attribute, const std::function<void(Document&)>& change) {
    if (Document* values = find(attribute, "values")) {
        std::ranges::for_each(values->array, change);
    }
    for (const char* key : {"constant", "plane"}) {
        if (Document* value = find(attribute, key)) {
            change(*value);
        }
    }
}

// One component fewer.
bool with_less(Document& attribute) {
    bool is_less = false;
    for_each_entry(attribute, [&](Document& entry) {
        if (!entry.is(Kind::array) || entry.array.empty()) {
            return;
        }
        is_less = true;
        if (entry.array.size() > 1) {
            entry.array.pop_back();
        } else {
            Document only = entry.array[0];
            entry = std::move(only);
        }
    });
    return is_less;
}

bool constant(Document& attribute) {
    Document* values = find(attribute, "values");
    if (values == nullptr || values->array.empty()) {
        return false;
    }
    Document first = values->array[0];
    erase(attribute, "values");
    set(attribute, "constant", std::move(first));
    return true;
}

bool from_vertices(Document& attribute) {
    const Document* source = attribute.find("source");
    if (source == nullptr || source->string == "vertex") {
        return false;
    }
    erase(attribute, "source");
    set(attribute, "constant", number(1));
    return true;
}

// The colour of a draw is plain white, or 1 in a format of integers.
bool white(Document& draw) {
    Document* color = find(draw, "color");
    if (color == nullptr || !erase(*color, "attribute")) {
        return false;
    }
    set(*color, "value", numbers({1, 1, 1, 1}));
    return true;
}

void add_source(const Document& document, const Path& path, const char* what,
                bool (*change)(Document&), std::vector<Step>& steps) {
    Step step;
    name_at(document, path, what, step);
    step.apply = [path, change](Document& d) {
        Document* table = at(d, path);
        return table != nullptr && change(*table);
    };
    steps.push_back(std::move(step));
}

}  // namespace

void add_key_steps(const Document& document, std::vector<Step>& steps) {
    add_keys(document, document, {}, steps);
}

void add_source_steps(const Document& document, std::vector<Step>& steps) {
    for (size_t draw = 0; draw < draw_count(document); ++draw) {
        const Path path = Path() + "draw" + draw;
        const Document* attributes = document.find("draw")->array[draw].find("attribute");
        for (size_t k = 0; attributes != nullptr && k < attributes->array.size(); ++k) {
            const Path attribute = path + "attribute" + k;
            add_source(document, attribute, "with {}from the vertices", from_vertices, steps);
            add_source(document, attribute, "with {}alike at all vertices", constant, steps);
            add_source(document, attribute, "with {}of one component fewer", with_less, steps);
        }
        add_source(document, path, "with a colour that is no attribute", white, steps);
    }
}

}  // namespace fuzz
