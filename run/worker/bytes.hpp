// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Plain values to bytes and back, for the pipe between the parent and its workers: same machine,
// same program, so native byte order and no versions. Reading never goes past the end.
#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace run {

class ByteWriter {
  public:
    template <class T>
    void value(const T& v) {
        static_assert(std::is_trivially_copyable_v<T>);
        const size_t at = bytes_.size();
        bytes_.resize(at + sizeof(T));
        std::memcpy(bytes_.data() + at, &v, sizeof(T));
    }
    void text(std::string_view s) {
        value(uint64_t{s.size()});
        bytes_.append(s);
    }
    template <class T>
    void plane(const std::vector<T>& v) {
        static_assert(std::is_trivially_copyable_v<T>);
        value(uint64_t{v.size()});
        if (!v.empty()) {
            const size_t at = bytes_.size();
            bytes_.resize(at + v.size() * sizeof(T));
            std::memcpy(bytes_.data() + at, v.data(), v.size() * sizeof(T));
        }
    }
    void texts(const std::vector<std::string>& v) {
        value(uint64_t{v.size()});
        for (const std::string& s : v) {
            text(s);
        }
    }
    void reserve(size_t n) { bytes_.reserve(n); }
    std::string take() { return std::move(bytes_); }

  private:
    std::string bytes_;
};

// After the first read that does not fit, every read fails and yields a default value.
class ByteReader {
  public:
    explicit ByteReader(std::string_view bytes) : bytes_(bytes) {}

    template <class T>
    bool value(T& v) {
        static_assert(std::is_trivially_copyable_v<T>);
        if (failed_ || bytes_.size() < sizeof(T)) {
            return fail();
        }
        std::memcpy(&v, bytes_.data(), sizeof(T));
        bytes_.remove_prefix(sizeof(T));
        return true;
    }
    bool text(std::string& s) {
        uint64_t size = 0;
        if (!value(size) || bytes_.size() < size) {
            return fail();
        }
        s.assign(bytes_.substr(0, size));
        bytes_.remove_prefix(size);
        return true;
    }
    template <class T>
    bool plane(std::vector<T>& v) {
        uint64_t count = 0;
        if (!value(count) || bytes_.size() / sizeof(T) < count) {
            return fail();
        }
        v.resize(count);
        if (count != 0) {
            std::memcpy(v.data(), bytes_.data(), count * sizeof(T));
            bytes_.remove_prefix(count * sizeof(T));
        }
        return true;
    }
    bool texts(std::vector<std::string>& v) {
        uint64_t count = 0;
        if (!value(count) || bytes_.size() / sizeof(uint64_t) < count) {
            return fail();
        }
        v.resize(count);
        for (std::string& s : v) {
            if (!text(s)) {
                return false;
            }
        }
        return true;
    }
    // True if everything fitted and nothing is left over.
    bool finished() const { return !failed_ && bytes_.empty(); }

  private:
    bool fail() {
        failed_ = true;
        return false;
    }
    std::string_view bytes_;
    bool failed_ = false;
};

}  // namespace run
