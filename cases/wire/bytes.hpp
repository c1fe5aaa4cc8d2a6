// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Plain values to bytes and back, for case_bytes.cpp. Reading never goes past the end and takes no
// memory for elements that are not there.
#pragma once

#include <bit>
#include <cstdint>
#include <cstring>
#include <glm/vec4.hpp>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

namespace cases::wire {

class Writer {
  public:
    template <class T>
    void number(T value) {
        static_assert(std::is_arithmetic_v<T> || std::is_enum_v<T>);
        char raw[sizeof(T)];
        std::memcpy(raw, &value, sizeof(T));
        bytes_.append(raw, sizeof(T));
    }
    void flag(bool value) { number(static_cast<uint8_t>(value ? 1 : 0)); }
    void text(const std::string& value) {
        number(static_cast<uint64_t>(value.size()));
        bytes_ += value;
    }
    void real(float value) { number(std::bit_cast<uint32_t>(value)); }
    void vector(const glm::vec4& v) {
        real(v.x);
        real(v.y);
        real(v.z);
        real(v.w);
    }
    void vectors(const std::vector<glm::vec4>& values) {
        number(static_cast<uint64_t>(values.size()));
        for (const glm::vec4& v : values) {
            vector(v);
        }
    }
    std::string take() { return std::move(bytes_); }

  private:
    std::string bytes_;
};

// After the first failure every further read yields zero; good() tells.
class Reader {
  public:
    explicit Reader(std::span<const char> bytes) : rest_(bytes) {}

    template <class T>
    T number() {
        T value{};
        if (rest_.size() < sizeof(T)) {
            fail();
            return value;
        }
        std::memcpy(&value, rest_.data(), sizeof(T));
        rest_ = rest_.subspan(sizeof(T));
        return value;
    }
    bool flag() {
        const auto value = number<uint8_t>();
        if (value > 1) {
            fail();
        }
        return value == 1;
    }
    template <class Enum>
    Enum enumerator(Enum last) {
        const auto value = number<std::underlying_type_t<Enum>>();
        if (value > static_cast<std::underlying_type_t<Enum>>(last)) {
            fail();
            return Enum{};
        }
        return static_cast<Enum>(value);
    }
    // A number of elements of at least `element_size` bytes each; checked before memory is taken.
    size_t count(size_t element_size) {
        const auto n = number<uint64_t>();
        if (n > rest_.size() / element_size) {
            fail();
            return 0;
        }
        return static_cast<size_t>(n);
    }
    std::string text() {
        const size_t size = count(1);
        std::string value(rest_.data(), size);
        rest_ = rest_.subspan(size);
        return value;
    }
    float real() { return std::bit_cast<float>(number<uint32_t>()); }
    glm::vec4 vector() {
        glm::vec4 v;
        v.x = real();
        v.y = real();
        v.z = real();
        v.w = real();
        return v;
    }
    std::vector<glm::vec4> vectors() {
        std::vector<glm::vec4> values(count(4 * sizeof(uint32_t)));
        for (glm::vec4& v : values) {
            v = vector();
        }
        return values;
    }
    void fail() {
        good_ = false;
        rest_ = {};
    }
    bool good() const { return good_; }
    bool at_end() const { return rest_.empty(); }

  private:
    std::span<const char> rest_;
    bool good_ = true;
};

}  // namespace cases::wire
