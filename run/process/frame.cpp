// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "run/process/frame.hpp"

#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>

namespace cli {

namespace {

constexpr uint64_t kMagic = 0x31656d6672636465U;  // "edcrfme1"
// A capture of the largest target (16384 x 16384, 1 sample, 116 bytes a sample) is 29 GiB.
constexpr uint64_t kMaxPayload = uint64_t{64} << 30;

struct Header {
    uint64_t magic = kMagic;
    uint64_t type = 0;
    uint64_t length = 0;
    uint64_t sum = 0;
};
static_assert(sizeof(Header) == 32);

}  // namespace

uint64_t checksum(FrameType type, std::string_view payload) {
    constexpr uint64_t kPrime = 0x100000001b3U;
    // FNV alone never carries high bits of a word downwards.
    const auto add = [](uint64_t lane, uint64_t word_or_lane) {
        lane = (lane ^ word_or_lane) * kPrime;
        return lane ^ (lane >> 29);
    };
    // Four sums side by side, because each step waits for the last; every step is a bijection of
    // the sum, so one changed word always changes the result.
    constexpr uint64_t kBasis = 0xcbf29ce484222325U;
    uint64_t a = kBasis ^ static_cast<uint64_t>(type);
    uint64_t b = kBasis + 1;
    uint64_t c = kBasis + 2;
    uint64_t d = kBasis + 3;
    const char* const data = payload.data();
    const auto word = [data](size_t offset) {
        uint64_t w = 0;
        std::memcpy(&w, data + offset, sizeof w);
        return w;
    };
    size_t at = 0;
    for (; at + 32 <= payload.size(); at += 32) {
        a = add(a, word(at));
        b = add(b, word(at + 8));
        c = add(c, word(at + 16));
        d = add(d, word(at + 24));
    }
    uint64_t sum = add(add(add(a, b), c), d);
    for (; at < payload.size(); ++at) {
        sum = add(sum, static_cast<unsigned char>(payload[at]));
    }
    return sum ^ payload.size();
}

std::string encode_frame(FrameType type, std::string_view payload) {
    const Header header{kMagic, static_cast<uint64_t>(type), payload.size(),
                        checksum(type, payload)};
    std::string bytes;
    bytes.reserve(sizeof header + payload.size());
    std::array<char, sizeof header> raw{};
    std::memcpy(raw.data(), &header, sizeof header);
    bytes.append(raw.data(), raw.size());
    bytes.append(payload);
    return bytes;
}

std::optional<Frame> FrameReader::next() {
    if (malformed_ || buffer_.size() - begin_ < sizeof(Header)) {
        return std::nullopt;
    }
    Header header;
    std::memcpy(&header, buffer_.data() + begin_, sizeof header);
    if (header.magic != kMagic || header.type < kFirstFrameType || header.type > kLastFrameType ||
        header.length > kMaxPayload) {
        malformed_ = true;
        return std::nullopt;
    }
    const size_t whole = sizeof header + header.length;
    if (buffer_.size() - begin_ < whole) {
        return std::nullopt;
    }
    Frame frame;
    frame.type = static_cast<FrameType>(header.type);
    frame.payload = buffer_.substr(begin_ + sizeof header, header.length);
    if (checksum(frame.type, frame.payload) != header.sum) {
        malformed_ = true;
        return std::nullopt;
    }
    begin_ += whole;
    if (begin_ == buffer_.size()) {
        buffer_.clear();
        begin_ = 0;
    } else if (begin_ > (size_t{1} << 20)) {
        buffer_.erase(0, begin_);
        begin_ = 0;
    }
    return frame;
}

bool write_all(int fd, std::string_view bytes) {
    while (!bytes.empty()) {
        const ssize_t n = ::write(fd, bytes.data(), bytes.size());
        if (n < 0) {
            if (errno == EINTR) {
                continue;
            }
            return false;
        }
        bytes.remove_prefix(static_cast<size_t>(n));
    }
    return true;
}

}  // namespace cli
