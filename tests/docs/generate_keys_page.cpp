// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Holds docs/cases.md and docs/schema/case-1.json to the rows of cases/key/key.cpp. A table of the
// page, between "<!-- keys NAME -->" and "<!-- end -->", has the keys of the rows in their order,
// their words and what absence means; the rest of a cell is kept as people wrote it.
//   usage: generate_keys_page PAGE            prints the page
//          generate_keys_page --schema FILE   prints the schema of an exported case
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <iostream>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "cases/key/key.hpp"
#include "cases/model/case.hpp"
#include "cases/model/words.hpp"

namespace {

using cases::Key;
using cases::KeyTable;
using Json = nlohmann::ordered_json;

const std::map<std::string, const KeyTable*> kTables = {
    {"target", &cases::kTargetKeys},
    {"target.color", &cases::kTargetColorKeys},
    {"draw", &cases::kDrawKeys},
    {"depth", &cases::kDepthKeys},
    {"bias", &cases::kBiasKeys},
    {"stencil", &cases::kStencilKeys},
    {"frag_depth", &cases::kFragDepthKeys},
    {"color", &cases::kColorKeys},
    {"blend", &cases::kBlendKeys},
    {"attribute", &cases::kAttributeKeys},
    {"distance", &cases::kDistanceKeys},
    {"blit", &cases::kBlitKeys},
    {"clear", &cases::kClearKeys},
    {"viewport", &cases::kViewportKeys},
    {"range", &cases::kOpenRangeKeys},
};

std::string words_of(const Key& key) {
    std::string text;
    for (const std::string_view word : key.words) {
        text += fmt::format("{}`\"{}\"`", text.empty() ? "" : ", ", word);
    }
    return text;
}

// What people wrote, behind the words that the row has now.
std::string told(const Key& key, const std::string& sentence) {
    if (key.kind != cases::KeyKind::word) {
        return sentence;
    }
    static const std::regex kWordList("^(`\"[^`]*\"`(, )?)+");
    return words_of(key) + std::regex_replace(sentence, kWordList, "");
}

// The sentences of a table's lines, by their key.
std::map<std::string, std::string> sentences_of(const std::vector<std::string>& lines) {
    static const std::regex kLine(R"(^\| `([^`]+)` \| (.*) \| [^|]*\|$)");
    std::map<std::string, std::string> out;
    for (const std::string& line : lines) {
        if (std::smatch match; std::regex_match(line, match, kLine)) {
            out[match[1]] = match[2];
        }
    }
    return out;
}

int print_page(const char* path) {
    std::ifstream page(path);
    std::set<std::string> open;
    for (const auto& [name, table] : kTables) {
        open.insert(name);
    }
    for (std::string line; std::getline(page, line);) {
        std::cout << line << '\n';
        const std::string begin = "<!-- keys ";
        if (!line.starts_with(begin)) {
            continue;
        }
        const std::string name =
            line.substr(begin.size(), line.find(' ', begin.size()) - begin.size());
        if (open.erase(name) == 0) {
            std::fprintf(stderr, "no table is called '%s', or it stands twice\n", name.c_str());
            return 3;
        }
        std::vector<std::string> lines;
        while (std::getline(page, line) && line != "<!-- end -->") {
            lines.push_back(line);
        }
        const auto sentences = sentences_of(lines);
        std::cout << "| key | value | default |\n| --- | --- | --- |\n";
        for (const Key& key : kTables.at(name)->keys) {
            const auto sentence = sentences.find(std::string(key.name));
            const std::string value =
                told(key, sentence == sentences.end() ? "" : sentence->second);
            if (value.empty()) {
                std::fprintf(stderr, "the page says nothing of '%s' of '%s': write its sentence\n",
                             std::string(key.name).c_str(), name.c_str());
                return 3;
            }
            std::cout << fmt::format("| `{}` | {} | {}{}|\n", key.name, value, key.absent,
                                     key.absent.empty() ? "" : " ");
        }
        std::cout << "<!-- end -->\n";
    }
    for (const std::string& name : open) {
        std::fprintf(stderr, "the page has no place for the keys '%s'\n", name.c_str());
    }
    return open.empty() ? 0 : 3;
}

// Members that other keys fill, and those that the export writes in another form.
const std::set<std::string> kNoRow = {"primitive_restart", "coord",      "width", "height", "depth",
                                      "depth_format",      "depth_clear"};

Json type_of(const Key& key) {
    switch (key.kind) {
        case cases::KeyKind::word:
            return {{"enum", key.words}};
        case cases::KeyKind::flag:
            return {{"type", "boolean"}};
        case cases::KeyKind::whole:
        case cases::KeyKind::bits:
            return {{"type", "integer"}, {"minimum", key.least}, {"maximum", key.most}};
        default:
            return {{"$ref", "#/definitions/number"}};
    }
}

// Gives the properties of a structure the words of their rows. Those without a row go, new ones
// come.
template <class T>
void update(Json& object, const KeyTable& keys) {
    const T plain;
    T::fields(
        [&](const cases::Field& field, const auto& member) {
            using Member = std::remove_cvref_t<decltype(member)>;
            Json& properties = object.at("properties");
            const Key* key = keys.find_field(field.name);
            const bool is_there = properties.contains(field.name);
            if (field.has(cases::kNotExported) || kNoRow.contains(field.name)) {
                return;
            }
            if constexpr (cases::is_simple_member<Member>) {
                if (key == nullptr) {
                    properties.erase(field.name);
                    std::erase(object.at("required").get_ref<Json::array_t&>(), Json(field.name));
                } else if (!is_there && key->is_simple()) {
                    properties[field.name] =
                        cases::is_optional<Member>
                            ? Json{{"anyOf", {{{"type", "null"}}, type_of(*key)}}}
                            : type_of(*key);
                    object.at("required").push_back(field.name);
                } else if (is_there && key->kind == cases::KeyKind::word) {
                    Json& value = properties[field.name];
                    (value.contains("anyOf") ? value["anyOf"][1] : value)["enum"] = key->words;
                }
            } else if (is_there && (key == nullptr || key->keys != nullptr)) {
                Json& value = properties[field.name];
                const auto inner = [&]<class Inner>(const Inner*) {
                    if constexpr (cases::HasFields<Inner> &&
                                  !std::is_same_v<Inner, cases::Viewport>) {
                        Json& of = value.contains("anyOf")   ? value["anyOf"][1]
                                   : value.contains("items") ? value["items"]
                                                             : value;
                        update<Inner>(of, key == nullptr ? keys : *key->keys);
                    }
                };
                if constexpr (cases::is_optional<Member> || cases::is_vector<Member>) {
                    inner(static_cast<const typename Member::value_type*>(nullptr));
                } else {
                    inner(&member);
                }
            }
        },
        plain);
}

int print_schema(const char* path) {
    std::ifstream file(path);
    Json schema = Json::parse(file);
    Json& properties = schema.at("properties");
    update<cases::Target>(properties.at("target"), cases::kTargetKeys);
    update<cases::Draw>(properties.at("draws").at("items"), cases::kDrawKeys);
    std::cout << schema.dump(1) << '\n';
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc == 3 && std::string(argv[1]) == "--schema") {
        return print_schema(argv[2]);
    }
    if (argc != 2) {
        std::fputs("usage: generate_keys_page PAGE | --schema FILE\n", stderr);
        return 2;
    }
    return print_page(argv[1]);
}
