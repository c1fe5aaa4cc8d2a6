// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Pictures as text: runs of equal bytes, then base64 (RFC 4648). Two bytes a run: its length minus
// one, its value. report.html decodes the same.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace report {

std::string base64_encode(std::string_view bytes);
// Nothing if the text is not base64 with its padding.
std::optional<std::string> base64_decode(std::string_view text);

std::string encode_picture(const std::vector<uint8_t>& bytes);
// Nothing if the text is malformed or means more than 64 MiB.
std::optional<std::vector<uint8_t>> decode_picture(std::string_view text);

}  // namespace report
