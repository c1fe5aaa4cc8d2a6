// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "cases/load/open_values.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "cases/toml/field_reader.hpp"

namespace cases {

namespace {

using Kind = TomlValue::Kind;

constexpr const char* kForms =
    "write [value, value, ...], or { from = 0, to = 8, step = \"1/256\" } for numbers";

class OpenReader {
  public:
    explicit OpenReader(const Matrix& matrix) : matrix_(matrix), context_({}) {}

    ExpectedAll<std::vector<OpenName>> read(const TomlValue& table) {
        if (!table.is(Kind::table) || table.table.empty()) {
            context_.error(table.where, fmt::format("[fuzz] leaves nothing open; {}, or leave "
                                                    "[fuzz] out",
                                                    kForms));
        }
        for (const TomlEntry& entry : table.table) {
            read_name(entry);
        }
        if (!context_.errors().empty()) {
            return tl::unexpected(context_.errors());
        }
        return std::move(names_);
    }

  private:
    void read_name(const TomlEntry& entry) {
        const auto is_taken = [&](const Matrix::Axis& axis) { return axis.key == entry.key; };
        if (!is_name(entry.key)) {
            context_.error(entry.where,
                           fmt::format("the [fuzz] key \"{}\" is not a name; write letters, "
                                       "digits and _",
                                       entry.key));
        } else if (std::ranges::any_of(matrix_.axes, is_taken)) {
            context_.error(entry.where, fmt::format("{} is a key of [matrix], too; name one of the "
                                                    "two otherwise",
                                                    entry.key));
        } else if (entry.value.is(Kind::array)) {
            read_list(entry);
        } else if (entry.value.is(Kind::table)) {
            read_range(entry);
        } else {
            context_.error(entry.value.where, fmt::format("the [fuzz] key {} is {}; {}", entry.key,
                                                          describe(entry.value), kForms));
        }
    }

    void read_list(const TomlEntry& entry) {
        OpenName name{entry.key, entry.where, {}, {}, {}, 0, 0};
        std::vector<std::string> texts;
        for (const TomlValue& value : entry.value.array) {
            const tl::expected<std::string, std::string> text = value_text(value);
            if (!text) {
                context_.error(value.where, fmt::format("a value of the [fuzz] key {} {}",
                                                        entry.key, text.error()));
            } else if (std::ranges::find(texts, *text) != texts.end()) {
                context_.error(value.where, fmt::format("the value {} of the [fuzz] key {} stands "
                                                        "twice",
                                                        *text, entry.key));
            } else {
                texts.push_back(*text);
                name.list.push_back(value);
            }
        }
        name.count = name.list.size();
        if (entry.value.array.size() < 2) {
            context_.error(
                entry.value.where,
                fmt::format("the [fuzz] key {} has {}, so nothing is open; {}", entry.key,
                            entry.value.array.empty() ? "no value" : "one value", kForms));
        }
        names_.push_back(std::move(name));
    }

    void read_range(const TomlEntry& entry) {
        const std::string what = fmt::format("the [fuzz] key {}", entry.key);
        context_.known_keys(entry.value, kOpenRangeKeys, what);
        OpenName name{entry.key, entry.where, {}, {}, 1, 0, 0};
        const TomlValue* from = entry.value.find("from");
        const TomlValue* to = entry.value.find("to");
        if (from == nullptr || to == nullptr) {
            context_.error(entry.value.where, fmt::format("{} has no {}; {}", what,
                                                          from == nullptr ? "from" : "to", kForms));
            return;
        }
        const std::optional<Number> low = context_.number(*from, "from");
        const std::optional<Number> high = context_.number(*to, "to");
        const TomlValue* by = entry.value.find("step");
        const std::optional<Number> step =
            by == nullptr ? Number{mpq_class(1)} : context_.number(*by, "step");
        if (!low || !high || !step) {
            return;
        }
        name.from = low->value;
        name.step = step->value;
        if (step->value <= 0) {
            context_.error(by->where, fmt::format("the step of {} is {}; write one above 0",
                                                  entry.key, step->value.get_str()));
            return;
        }
        if (low->value >= high->value) {
            context_.error(
                from->where,
                fmt::format("the range of {} goes from {} to {}; {}", entry.key,
                            low->value.get_str(), high->value.get_str(),
                            low->value > high->value ? "exchange from and to"
                                                     : "write the one value where it is used"));
            return;
        }
        const mpq_class steps = (high->value - low->value) / step->value;
        if (steps.get_den() != 1) {
            context_.error(
                to->where,
                fmt::format("from {} no whole number of steps of {} leads to {}; "
                            "choose another to or step",
                            low->value.get_str(), step->value.get_str(), high->value.get_str()));
            return;
        }
        if (steps.get_num() >= mpz_class(std::to_string(kMostOpenValues))) {
            context_.error(entry.value.where,
                           fmt::format("the range of {} has more than {} values; write a larger "
                                       "step",
                                       entry.key, kMostOpenValues));
            return;
        }
        name.count = steps.get_num().get_ui() + 1;
        read_nominal(entry, name);
        names_.push_back(std::move(name));
    }

    void read_nominal(const TomlEntry& entry, OpenName& name) {
        const TomlValue* value = entry.value.find("nominal");
        const std::optional<Number> nominal =
            value == nullptr ? std::nullopt : context_.number(*value, "nominal");
        if (!nominal) {
            return;
        }
        const mpq_class steps = (nominal->value - name.from) / name.step;
        if (steps.get_den() != 1 || steps < 0 ||
            steps >= mpq_class(mpz_class(std::to_string(name.count)))) {
            context_.error(value->where,
                           fmt::format("nominal = {} is none of the values of {}; write {} or "
                                       "another of them",
                                       nominal->value.get_str(), entry.key, name.from.get_str()));
            return;
        }
        name.nominal = steps.get_num().get_ui();
    }

    const Matrix& matrix_;
    LeafContext context_;
    std::vector<OpenName> names_;
};

}  // namespace

TomlValue OpenName::value(uint64_t number) const {
    if (!list.empty()) {
        return list[number];
    }
    TomlValue value;
    value.kind = Kind::string;
    value.where = where;
    value.string = mpq_class(from + step * mpq_class(mpz_class(std::to_string(number)))).get_str();
    return value;
}

ExpectedAll<std::vector<OpenName>> read_open(const TomlValue* table, const Matrix& matrix) {
    return table == nullptr ? std::vector<OpenName>() : OpenReader(matrix).read(*table);
}

}  // namespace cases
