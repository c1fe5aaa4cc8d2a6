// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "report/text/wrap.hpp"

#include <algorithm>
#include <array>

namespace report {

namespace {

// Columns of UTF-8 text without its escape sequences (ESC [ ... m), one a code point.
size_t columns(std::string_view text) {
    size_t count = 0;
    for (size_t k = 0; k < text.size(); ++k) {
        if (text[k] == '\x1b') {
            k = std::min(text.find('m', k), text.size() - 1);
        } else if ((static_cast<unsigned char>(text[k]) & 0xc0U) != 0x80U) {
            ++count;
        }
    }
    return count;
}

bool starts_as_command(std::string_view text) {
    constexpr std::array<std::string_view, 5> kWords = {
        "rerun: ", "explain: ", "update: ", "debug: ", "settings: "};
    return std::ranges::any_of(kWords,
                               [text](std::string_view word) { return text.starts_with(word); });
}

std::string wrapped_line(std::string_view line, size_t width) {
    const size_t indent = std::min(line.find_first_not_of(' '), line.size());
    const std::string_view body = line.substr(indent);
    if (columns(line) <= width || starts_as_command(body)) {
        return std::string(line);
    }
    // A command after other words keeps a line of its own, so that it can be copied.
    for (size_t at = line.find("   ", indent); at != std::string_view::npos;
         at = line.find("   ", at + 1)) {
        if (starts_as_command(line.substr(at + 3))) {
            return wrapped_line(line.substr(0, at), width) + '\n' + std::string(indent + 2, ' ') +
                   std::string(line.substr(at + 3));
        }
    }
    const std::string deeper(std::min(indent + 2, width / 2), ' ');
    std::string text(indent, ' ');
    size_t at = indent;  // column
    bool first = true;
    size_t begin = 0;
    while (begin < body.size()) {
        // A word, and the spaces before it.
        const size_t word = std::min(body.find_first_not_of(' ', begin), body.size());
        const size_t end = std::min(body.find(' ', word), body.size());
        const std::string_view gap = body.substr(begin, word - begin);
        const std::string_view piece = body.substr(word, end - word);
        if (!first && at + gap.size() + columns(piece) > width) {
            text += '\n' + deeper;
            at = deeper.size();
        } else {
            text += gap;
            at += gap.size();
        }
        text += piece;
        at += columns(piece);
        first = false;
        begin = end;
    }
    return text;
}

}  // namespace

std::string wrapped(std::string_view text, uint32_t width) {
    std::string result;
    size_t begin = 0;
    while (begin < text.size()) {
        const size_t end = std::min(text.find('\n', begin), text.size());
        result += wrapped_line(text.substr(begin, end - begin), width);
        if (end < text.size()) {
            result += '\n';
        }
        begin = end + 1;
    }
    return result;
}

}  // namespace report
