// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Values to bytes and back, for the pipe between the parent and its workers: same machine, same
// program, so native byte order and no versions. Structures go by their lists of fields
// (cases/base/fields.hpp). Reading never goes past the end and takes no memory for elements that
// are not there.
#pragma once

#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>

#include "cases/base/fields.hpp"

namespace cases::wire {

// Whether the memory of a T is what travels: numbers, vectors and arrays of them, words of planes.
template <class T>
inline constexpr bool is_raw = std::is_trivially_copyable_v<T> && !HasFields<T> &&
                               !std::is_enum_v<T> && !std::is_same_v<T, bool> && !is_optional<T>;

class Writer {
  public:
    template <class T>
    void put(const T& value) {
        if constexpr (HasFields<T>) {
            T::fields(
                [this](const Field& field, const auto& member) {
                    if (!field.has(kNotOnWire)) {
                        this->put(member);
                    }
                },
                value);
        } else if constexpr (is_optional<T>) {
            put(value.has_value());
            if (value) {
                put(*value);
            }
        } else if constexpr (is_pair<T>) {
            put(value.first);
            put(value.second);
        } else if constexpr (std::is_same_v<T, std::string>) {
            list(std::span(value));
        } else if constexpr (is_vector<T>) {
            list(std::span(value));
        } else if constexpr (std::is_same_v<T, bool>) {
            put(static_cast<uint8_t>(value ? 1 : 0));
        } else if constexpr (std::is_enum_v<T>) {
            put(static_cast<std::underlying_type_t<T>>(value));
        } else {
            static_assert(is_raw<T>);
            raw(std::as_bytes(std::span(&value, 1)));
        }
    }
    // A vector's bytes, wherever its elements lie.
    template <class T>
    void list(std::span<const T> values) {
        put(uint64_t{values.size()});
        if constexpr (is_raw<T>) {
            raw(std::as_bytes(values));
        } else {
            for (const T& value : values) {
                put(value);
            }
        }
    }
    void reserve(size_t size) { bytes_.reserve(size); }
    std::string take() { return std::move(bytes_); }

  private:
    void raw(std::span<const std::byte> bytes) {
        bytes_.append(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    }
    std::string bytes_;
};

// After the first failure every further read leaves zeros; good() tells.
class Reader {
  public:
    explicit Reader(std::string_view bytes) : rest_(bytes) {}

    template <class T>
    void get(T& to) {
        if constexpr (HasFields<T>) {
            T::fields(
                [this](const Field& field, auto& member) {
                    if (!field.has(kNotOnWire)) {
                        this->get(member);
                    }
                },
                to);
        } else if constexpr (is_optional<T>) {
            to.reset();
            if (get<bool>()) {
                get(to.emplace());
            }
        } else if constexpr (is_pair<T>) {
            get(to.first);
            get(to.second);
        } else if constexpr (is_vector<T> || std::is_same_v<T, std::string>) {
            get_list(to);
        } else if constexpr (std::is_same_v<T, bool>) {
            to = checked(get<uint8_t>(), 2) != 0;
        } else if constexpr (std::is_enum_v<T>) {
            static_assert(kValueCount<T> > 0, "nothing says which values this enumeration has");
            to = static_cast<T>(checked(get<std::underlying_type_t<T>>(), kValueCount<T>));
        } else {
            static_assert(is_raw<T>);
            to = T{};
            raw(&to, sizeof to);
        }
    }
    template <class T>
    T get() {
        T value{};
        get(value);
        return value;
    }
    void fail() {
        is_good_ = false;
        rest_ = {};
    }
    bool good() const { return is_good_; }
    bool at_end() const { return rest_.empty(); }

  private:
    void raw(void* to, size_t size) {
        if (rest_.size() < size) {
            fail();
        } else if (size > 0) {
            std::memcpy(to, rest_.data(), size);
            rest_.remove_prefix(size);
        }
    }
    template <class T>
    void get_list(T& to) {
        using Element = typename T::value_type;
        constexpr size_t kLeast = is_raw<Element> ? sizeof(Element) : 1;  // bytes of an element
        const auto count = get<uint64_t>();
        to.clear();
        if (count > rest_.size() / kLeast) {
            fail();
        } else if constexpr (is_raw<Element>) {
            to.resize(static_cast<size_t>(count));
            raw(to.data(), to.size() * sizeof(Element));
        } else {
            for (uint64_t k = 0; k < count && is_good_; ++k) {
                get(to.emplace_back());
            }
        }
    }
    // 0 for a number that is not below `end`.
    template <class T>
    T checked(T number, size_t end) {
        if (number < T{} || static_cast<size_t>(number) >= end) {
            fail();
            return T{};
        }
        return number;
    }

    std::string_view rest_;
    bool is_good_ = true;
};

}  // namespace cases::wire
