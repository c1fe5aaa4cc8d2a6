// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "cases/generate/generate.hpp"

#include <fmt/format.h>

#include <array>

#include "cases/generate/generator_keys.hpp"
#include "cases/model/words.hpp"

namespace cases {

namespace {

struct Generator {
    std::string_view word;
    std::optional<Generated> (*make)(GeneratorKeys&);
    std::vector<std::string_view> keys;
};
const std::array<Generator, 6> kGenerators = {{
    {"grid",
     generate_grid,
     {"kind", "seed", "columns", "rows", "from", "to", "jitter", "grid", "diagonal", "w",
      "shuffle"}},
    {"fan", generate_fan, {"kind", "seed", "center", "radius", "count", "grid", "w"}},
    {"strip", generate_strip, {"kind", "seed", "from", "to", "count", "grid", "jitter", "w"}},
    {"mesh", generate_mesh, {"kind", "seed", "points", "from", "to", "grid", "w", "shuffle"}},
    {"triangles",
     generate_triangles,
     {"kind", "seed", "count", "class", "from", "to", "grid", "w"}},
    {"surface", generate_surface, {"kind", "seed", "shape", "columns", "rows", "center", "radius"}},
}};

}  // namespace

std::optional<Generated> generate(LeafContext& context, const TomlValue& table,
                                  const Target& target) {
    if (!context.table(table, "generate")) {
        return std::nullopt;
    }
    const TomlValue* kind = table.find("kind");
    const auto kinds = detail::words_in(kGenerators);
    if (kind == nullptr) {
        context.error(table.where, "generate has no kind; write " + alternatives(kinds));
        return std::nullopt;
    }
    const std::optional<size_t> which = context.word(*kind, "kind", kinds);
    if (!which) {
        return std::nullopt;
    }
    const Generator& generator = kGenerators.at(*which);
    context.known_keys(table, fmt::format("the generator \"{}\"", generator.word), generator.keys);
    GeneratorKeys keys(context, table, target);
    return generator.make(keys);
}

}  // namespace cases
