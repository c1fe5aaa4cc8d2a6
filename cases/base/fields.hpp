// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The fields of a structure, named once, beside the structure:
//
//     struct Rect {
//         int32_t x = 0, y = 0;
//         static void fields(auto&& visit, auto&... r) {
//             visit("x", r.x...);
//             visit("y", r.y...);
//         }
//     };
//
// Rect::fields(visit, rect) calls visit("x", rect.x) and visit("y", rect.y). Whoever sends, stores
// or shows structures walks these lists, so that a new field reaches all of them by one line: the
// bytes of a worker's messages (cases/wire/bytes.hpp), the journal and the results
// (report/journal/json_codec.hpp), the export of a case (capture/exchange/export_case.cpp). With
// two objects a field comes as a pair; with none, its name alone.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace cases {

// Where a field is left out. The reason stands beside the field that is marked.
enum Mark : unsigned {
    kEverywhere = 0,
    kNotOnWire = 1,       // whoever draws a case has no use for it
    kNotExported = 2,     // it does not alter what a case draws
    kOlderLackIt = 4,     // journals of earlier versions do not hold it
    kLeftOutIfEmpty = 8,  // journals hold it only where it is not as constructed
    kNotReported = 16,    // neither journal nor results hold it
};

struct Field {
    const char* name;
    unsigned marks;
    // Not explicit: most fields are a name and nothing else.
    constexpr Field(const char* field, unsigned left_out = kEverywhere)
        : name(field), marks(left_out) {}
    constexpr bool has(Mark mark) const { return (marks & mark) != 0; }
};

namespace detail {
struct NoVisitor {
    void operator()(const Field&, const auto&...) const {}
};
}  // namespace detail

// A structure with such a list.
template <class T>
concept HasFields = requires(T& value) { T::fields(detail::NoVisitor{}, value); };

// How many values an enumeration has, numbered from 0; specialized beside the enumeration or the
// table of its words. What comes from outside is checked by it.
template <class Enum>
inline constexpr size_t kValueCount = 0;

// What a value is made of, for whoever walks fields by their types.
template <class T>
inline constexpr bool is_optional = false;
template <class T>
inline constexpr bool is_optional<std::optional<T>> = true;
template <class T>
inline constexpr bool is_pair = false;
template <class A, class B>
inline constexpr bool is_pair<std::pair<A, B>> = true;
template <class T>
inline constexpr bool is_vector = false;
template <class T>
inline constexpr bool is_vector<std::vector<T>> = true;
template <class T>
inline constexpr bool is_array = false;
template <class T, size_t N>
inline constexpr bool is_array<std::array<T, N>> = true;

// Gives `to` the fields of `from` that have the same name and type.
template <class From, class To>
void copy_like_fields(const From& from, To& to) {
    To::fields(
        [&](const Field& own, auto& member) {
            From::fields(
                [&](const Field& other, const auto& value) {
                    if constexpr (std::is_same_v<decltype(member),
                                                 std::remove_cvref_t<decltype(value)>&>) {
                        if (std::string_view(own.name) == other.name) {
                            member = value;
                        }
                    }
                },
                from);
        },
        to);
}

// Calls change(text) for every text that a value holds, however deep.
template <class T, class Change>
void change_texts(T& value, const Change& change) {
    if constexpr (std::is_same_v<T, std::string>) {
        change(value);
    } else if constexpr (HasFields<T>) {
        T::fields([&](const Field&, auto& member) { change_texts(member, change); }, value);
    } else if constexpr (is_vector<T> || is_array<T>) {
        for (auto&& entry : value) {
            change_texts(entry, change);
        }
    } else if constexpr (is_pair<T>) {
        change_texts(value.first, change);
        change_texts(value.second, change);
    } else if constexpr (is_optional<T>) {
        if (value) {
            change_texts(*value, change);
        }
    }
}

}  // namespace cases
