// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "run/process/frame.hpp"

#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>

#include "cases/base/checksum.hpp"

namespace run {

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

std::string encode_frame(FrameType type, std::string_view payload) {
    const Header header{kMagic, static_cast<uint64_t>(type), payload.size(),
                        cases::checksum(static_cast<uint64_t>(type), payload)};
    std::string bytes;
    bytes.reserve(sizeof header + payload.size());
    std::array<char, sizeof header> raw{};
    std::memcpy(raw.data(), &header, sizeof header);
    bytes.append(raw.data(), raw.size());
    bytes.append(payload);
    return bytes;
}

std::optional<Frame> FrameReader::next(const Bound& bound) {
    announced_ = 0;
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
    const std::optional<uint64_t> most =
        bound ? bound(static_cast<FrameType>(header.type)) : kMaxPayload;
    if (!most || header.length > *most) {
        malformed_ = true;
        return std::nullopt;
    }
    const size_t whole = sizeof header + header.length;
    if (buffer_.size() - begin_ < whole) {
        announced_ = header.length;
        return std::nullopt;
    }
    Frame frame;
    frame.type = static_cast<FrameType>(header.type);
    frame.payload = buffer_.substr(begin_ + sizeof header, header.length);
    if (cases::checksum(static_cast<uint64_t>(frame.type), frame.payload) != header.sum) {
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

}  // namespace run
