// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Frames on the pipes between the parent and a worker: magic, type, length, checksum, payload. A
// driver that writes over the worker's memory or dies half-way cannot produce a frame that looks
// whole.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

namespace run {

enum class FrameType : uint32_t {
    configure = 1,  // parent -> worker: which renderer and device
    render,         // parent -> worker: a batch of cases
    list_devices,   // parent -> worker: every device, for doctor
    hello,          // parent -> worker: open the device; worker -> parent: it is ready
    no_device,      // worker -> parent: it is not, and why
    devices,        // worker -> parent: answer to list_devices
    step,           // worker -> parent: the stage that begins now, as text
    result,         // worker -> parent: one case of the batch
    batch_done,     // worker -> parent: every result of the batch has been sent
};
inline constexpr uint32_t kFirstFrameType = 1;
inline constexpr uint32_t kLastFrameType = 9;

struct Frame {
    FrameType type = FrameType::step;
    std::string payload;
};

std::string encode_frame(FrameType type, std::string_view payload);

// Cuts a stream of bytes into frames.
class FrameReader {
  public:
    // Bytes of a payload at most, by the frame's type; nothing: no such frame may come.
    using Bound = std::function<std::optional<uint64_t>(FrameType)>;

    void feed(std::string_view bytes) { buffer_.append(bytes); }
    // The next whole frame, or nothing: more bytes are needed, or the stream is malformed.
    std::optional<Frame> next(const Bound& bound = {});
    // Bytes of the unfinished frame whose header has come; 0 if there is none.
    uint64_t announced() const { return announced_; }
    // A wrong magic, type, length or checksum, or more than the bound; stays true.
    bool is_malformed() const { return malformed_; }
    // True if bytes of an unfinished frame are left.
    bool has_rest() const { return buffer_.size() != begin_; }

  private:
    std::string buffer_;
    size_t begin_ = 0;
    uint64_t announced_ = 0;
    bool malformed_ = false;
};

// Writes everything, whatever EINTR and short writes do. False if the other end is gone.
bool write_all(int fd, std::string_view bytes);

}  // namespace run
