// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Ways: the triangles of a case as an application would draw them, without the attachments that
// tell of fragments. A door promises the bits of the case; a way makes another case, which is
// judged by what its picture shows. Its id is that of the case, '@' and the way's word.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "cases/model/case.hpp"

namespace cases {

struct WayRow {
    std::string_view word;
    std::string_view does, takes;                // for people, one sentence each
    std::optional<Case> (*make)(const Case& c);  // nothing: the way would show nothing of the case
};

// In the order of the table.
std::span<const WayRow> all_ways();
std::vector<std::string> way_words();  // of all ways, in their order

// The case as it is drawn by a way; nothing if the way does not take it.
std::optional<Case> by_way(const WayRow& way, const Case& c);

// "ties/apex@bare-depth": the id of the case and the way's word, which is empty where there is
// none. Of a selector the base may be a path, and the way a glob; there is no way in "@rule:x",
// "my@home/a.toml" and "a@2x.toml".
struct WayId {
    std::string_view base, way;
};
WayId split_way(std::string_view id);

}  // namespace cases
