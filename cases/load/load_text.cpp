// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The top of a case file: claims, matrix, target, draws, expectation.
#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "cases/generate/vertices.hpp"
#include "cases/load/expected_hits.hpp"
#include "cases/load/loader.hpp"
#include "cases/load/matrix.hpp"
#include "cases/load/open_values.hpp"
#include "cases/load/parts.hpp"
#include "cases/model/device.hpp"
#include "cases/model/rule.hpp"
#include "cases/select/selector.hpp"
#include "cases/toml/field_reader.hpp"
#include "cases/toml/toml_reader.hpp"

namespace cases {

namespace {

using Kind = TomlValue::Kind;

constexpr size_t kMaxDraws = 256;

class CaseLoader {
  public:
    CaseLoader(const TomlValue& root, LeafContext& context) : root_(root), context_(context) {}

    Case load() {
        c_.claim.where = {root_.where.file, 1, 1};
        context_.known_keys(root_, kFileKeys);
        if (const TomlValue* format = required("format", "write format = 1")) {
            const std::optional<Number> n = context_.number(*format, "format");
            if (n && n->value != 1) {
                context_.error(format->where, "format is not 1, the only one that is read");
            }
        }
        if (const TomlValue* value =
                required("description", "say in one sentence what is claimed")) {
            c_.claim.description = sentence(*value, "description");
        }
        if (const TomlValue* value = root_.find("catches")) {
            c_.claim.catches = sentence(*value, "catches");
        }
        if (const TomlValue* value = required("rules", "name at least one rule of docs/rules.md")) {
            read_rules(*value);
        }
        if (const TomlValue* value = root_.find("links")) {
            read_links(*value);
        }
        read_target();
        if (const TomlValue* value = root_.find("blit")) {
            read_blit(*value);
        } else {
            read_draws();
        }
        if (const TomlValue* value = root_.find("relations")) {
            c_.relations = load_relations(context_, *value, c_);
        }
        return std::move(c_);
    }

  private:
    const TomlValue* required(const char* key, const char* advice) {
        const TomlValue* value = root_.find(key);
        if (value == nullptr) {
            context_.error({root_.where.file, 1, 1},
                           fmt::format("the key {} is missing; {}", key, advice));
        }
        return value;
    }

    std::string sentence(const TomlValue& value, const char* key) {
        const std::optional<std::string> text = context_.text(value, key);
        if (text && text->find_first_not_of(" \t\r\n") == std::string::npos) {
            context_.error(value.where, fmt::format("{} is empty; write a sentence", key));
        }
        return text.value_or("");
    }

    void read_rules(const TomlValue& value) {
        if (!context_.array(value, "rules")) {
            return;
        }
        if (value.array.empty()) {
            context_.error(value.where,
                           "rules is empty, so the case claims nothing; name at least one rule of "
                           "docs/rules.md");
        }
        for (const TomlValue& element : value.array) {
            const std::optional<std::string> id = context_.text(element, "a rule");
            if (!id) {
                continue;
            }
            if (find_rule(*id) == nullptr) {
                context_.error(element.where, fmt::format("no rule is called \"{}\"; {}", *id,
                                                          rule_hint(*id, '"')));
            } else if (is_of_device(*id)) {
                context_.error(element.where,
                               fmt::format("the rule \"{}\" is of devices, not of what they draw; "
                                           "'edgecase run {}' judges it, and no case can claim it",
                                           *id, kLimitsCase));
            } else if (std::ranges::find(c_.claim.rules, *id) != c_.claim.rules.end()) {
                context_.error(element.where, fmt::format("the rule \"{}\" stands twice", *id));
            } else {
                c_.claim.rules.push_back(*id);
            }
        }
    }

    void read_links(const TomlValue& value) {
        if (!context_.array(value, "links")) {
            return;
        }
        for (const TomlValue& element : value.array) {
            const std::optional<std::string> link = context_.text(element, "a link");
            if (!link) {
                continue;
            }
            if (link->rfind("https://", 0) != 0 && link->rfind("http://", 0) != 0) {
                context_.error(element.where,
                               fmt::format("the link \"{}\" does not start with https://", *link));
            }
            c_.claim.links.push_back(*link);
        }
    }

    void read_target() {
        const TomlValue* target = required("target", "write [target] with size = [width, height]");
        if (target == nullptr || !context_.table(*target, "target")) {
            return;
        }
        c_.target = load_target(context_, *target);
    }

    void read_blit(const TomlValue& value) {
        if (!context_.table(value, "blit")) {
            return;
        }
        for (const char* key : {"draw", "expect"}) {
            if (const TomlValue* other = root_.find(key)) {
                context_.error(other->where,
                               fmt::format("a case with [blit] has no {}; leave it out", key));
            }
        }
        if (c_.target.samples != 1 || c_.target.layers != 1) {
            context_.error(value.where, "a blit writes to one sample a pixel and to one layer");
        }
        c_.target.has_instruments = false;
        c_.target.has_depth = false;
        if (c_.target.width != 0 && c_.target.height != 0) {
            c_.blit = load_blit(context_, value, c_.target);
        }
    }

    void read_draws() {
        const TomlValue* draws = required("draw", "write [[draw]] with vertices");
        if (draws == nullptr || c_.target.width == 0 || c_.target.height == 0) {
            return;
        }
        if (!draws->is(Kind::array)) {
            context_.error(draws->where, "draw is not an array of tables; write [[draw]]");
            return;
        }
        if (draws->array.empty() || draws->array.size() > kMaxDraws) {
            context_.error(draws->where, fmt::format("a case has 1 to {} draws, not {}", kMaxDraws,
                                                     draws->array.size()));
            return;
        }
        size_t vertices = 0;
        size_t indices = 0;
        for (const TomlValue& table : draws->array) {
            if (!context_.table(table, "draw")) {
                continue;
            }
            c_.draws.push_back(
                load_draw(context_, table, c_.target, c_.draws.size(), c_.claim.notes));
            const Draw& draw = c_.draws.back();
            vertices += draw.positions.size();
            indices += draw.indices ? draw.indices->size() : 0;
            if (vertices > kMaxVertices || indices > kMaxIndices) {
                context_.error(table.where,
                               fmt::format("the draws up to this one have {} vertices and {} "
                                           "indices; the most are {} and {} in a case",
                                           vertices, indices, kMaxVertices, kMaxIndices));
                return;  // what follows may be as large
            }
        }
        check_routes(*draws);
        check_kept(context_, *root_.find("target"), c_);
    }

    // The shaders that write gl_Layer and gl_ViewportIndex have no clip and cull distances.
    void check_routes(const TomlValue& draws) {
        const bool to_layers = std::ranges::any_of(
            c_.draws, [](const Draw& draw) { return !draw.clear && draw.layer > 0; });
        const bool to_viewports =
            std::ranges::any_of(c_.draws, [](const Draw& draw) { return draw.viewport_index > 0; });
        for (const TomlValue& table : draws.array) {
            for (const char* key : {"clip_distance", "cull_distance"}) {
                const TomlValue* value = table.find(key);
                if (value != nullptr && (to_layers || to_viewports)) {
                    context_.error(value->where,
                                   fmt::format("{} does not go with draws to several {}; leave "
                                               "out {}",
                                               key, to_layers ? "layers" : "viewports",
                                               to_layers ? "layer" : "viewport_index"));
                }
            }
        }
    }

    const TomlValue& root_;
    LeafContext& context_;
    Case c_;
};

void check_used(const Matrix& matrix, const std::vector<OpenName>& open,
                const std::set<std::string>& used, Errors& errors) {
    for (const OpenName& name : open) {
        if (used.count(name.key) == 0) {
            errors.push_back(
                {name.where, fmt::format("the [fuzz] key {} is used nowhere; use it or "
                                         "leave it out",
                                         name.key)});
        }
    }
    for (const Matrix::Axis& axis : matrix.axes) {
        if (used.count(axis.key) == 0) {
            errors.push_back(
                {axis.where,
                 fmt::format("the matrix key {} is used nowhere; use it or leave it out",
                             axis.key)});
        }
    }
}

// What every command but one takes for what a file leaves open.
std::string note_of(const std::vector<std::pair<std::string, TomlValue>>& nominal) {
    std::string values;
    for (const auto& [key, value] : nominal) {
        values += fmt::format("{}{} = {}", values.empty() ? "" : ", ", key,
                              value_text(value).value_or("?"));
    }
    return "[fuzz] leaves open what 'edgecase fuzz FILE' varies; here " + values;
}

}  // namespace

ExpectedAll<std::vector<Case>> load_tree(const TomlValue& root, const std::string& id_base,
                                         Contents contents) {
    if (id_base == kLimitsCase) {
        return tl::unexpected(Errors{
            {root.where, fmt::format("runs tell of the device itself under the id '{}'; rename "
                                     "the file",
                                     kLimitsCase)}});
    }
    const ExpectedAll<Matrix> matrix = read_matrix(root.find("matrix"), root.find("leaves"));
    if (!matrix) {
        return tl::unexpected(matrix.error());
    }
    const ExpectedAll<std::vector<OpenName>> open =
        read_open(contents == Contents::all ? root.find("fuzz") : nullptr, *matrix);
    if (!open) {
        return tl::unexpected(open.error());
    }
    std::vector<std::pair<std::string, TomlValue>> nominal;
    for (const OpenName& name : *open) {
        nominal.emplace_back(name.key, name.value(name.nominal));
    }
    Errors errors;
    check_expectation_keys(root, *matrix, errors);
    std::vector<Case> cases;
    std::set<std::string> used;
    for (const size_t leaf : matrix->leaves) {
        std::vector<LeafContext::Parameter> parameters;
        std::vector<std::pair<std::string, std::string>> texts;
        const std::vector<size_t> choice = matrix->choice(leaf);
        for (size_t i = 0; i < choice.size(); ++i) {
            const Matrix::Axis& axis = matrix->axes[i];
            parameters.emplace_back(axis.key, axis.values[choice[i]]);
            texts.emplace_back(axis.key, axis.texts[choice[i]]);
        }
        const std::string leaf_text = matrix->text(leaf);
        const std::string id = leaf_text.empty() ? id_base : id_base + ":" + leaf_text;
        if (contents == Contents::ids) {
            Case& c = cases.emplace_back();
            c.id = id;
            c.claim.where = {root.where.file, 1, 1};
            c.claim.parameters = std::move(texts);
            continue;
        }
        for (const auto& [key, value] : nominal) {
            parameters.emplace_back(key, &value);
        }
        LeafContext context(std::move(parameters));
        Case c = CaseLoader(root, context).load();
        if (context.errors().empty()) {
            read_expectation(context, root, leaf_text, c);
        }
        if (!context.errors().empty()) {
            for (Error error : context.errors()) {
                if (leaf > 0) {
                    // The first leaf is free of it, so the matrix plays a part.
                    error.message += fmt::format(" (in the leaf {})", leaf_text);
                }
                errors.push_back(std::move(error));
            }
            break;
        }
        used.insert(context.used().begin(), context.used().end());
        c.id = id;
        c.claim.parameters = std::move(texts);
        if (!nominal.empty()) {
            c.claim.notes.push_back(note_of(nominal));
        }
        cases.push_back(std::move(c));
    }
    if (errors.empty() && contents == Contents::all) {
        check_used(*matrix, *open, used, errors);
    }
    if (!errors.empty()) {
        return tl::unexpected(errors);
    }
    return cases;
}

ExpectedAll<std::vector<Case>> load_text(std::string_view toml, const std::string& file_name,
                                         const std::string& id_base, Contents contents) {
    const Expected<TomlValue> root = read_toml(toml, file_name);
    return root ? load_tree(*root, id_base, contents) : tl::unexpected(Errors{root.error()});
}

}  // namespace cases
