// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "run/expected/seen_pictures.hpp"

#include <fmt/format.h>
#include <fnmatch.h>

#include <algorithm>
#include <sstream>

#include "cases/base/input_file.hpp"
#include "cases/base/printable.hpp"

namespace run {

namespace {

constexpr std::string_view kDevice = "# device:";
constexpr size_t kDigits = 16;
constexpr std::string_view kSpace = " \t\r\v\f";

bool is_bits(const std::string& word) {
    return word.size() == kDigits && word.find_first_not_of("0123456789abcdef") == word.npos;
}

std::string trimmed(std::string_view text) {
    const size_t begin = text.find_first_not_of(kSpace);
    return begin == text.npos
               ? std::string()
               : std::string(text.substr(begin, text.find_last_not_of(kSpace) - begin + 1));
}

// What is wrong with a line below the first one, as one sentence; empty if it was taken.
std::string take_line(SeenPictures& seen, const std::string& line) {
    if (line.empty() || line.front() == '#') {
        if (!seen.bits.empty()) {
            return line.empty() ? "" : "a comment must stand above the first case";
        }
        seen.comments.push_back(line);
        if (line.starts_with(kDevice)) {
            if (!seen.device_glob.empty()) {
                return "a second 'device:' header; one file speaks of one device";
            }
            seen.device_glob = trimmed(std::string_view(line).substr(kDevice.size()));
        }
        return "";
    }
    std::istringstream in(line);
    std::string id, word;
    in >> id;
    std::set<std::string> bits;
    while (in >> word) {
        if (!is_bits(word)) {
            return "'" + word + "' is no picture; write the sixteen hexadecimal digits that " +
                   "results.json has in bits";
        }
        bits.insert(word);
    }
    if (bits.empty()) {
        return "'" + id + "' has no picture; write 'ID BITS'";
    }
    if (!seen.bits.emplace(id, std::move(bits)).second) {
        return "'" + id + "' has a line already; write its pictures in one";
    }
    return "";
}

}  // namespace

cases::ExpectedAll<SeenPictures> parse_pictures(std::string_view text,
                                                const std::filesystem::path& path) {
    SeenPictures seen;
    seen.path = path;
    cases::Errors errors;
    uint32_t number = 0;
    const auto fail = [&](const std::string& message) {
        errors.push_back({{path.string(), number, 1}, cases::printable(message)});
    };
    for (size_t begin = 0; begin < text.size();) {
        const size_t end = std::min(text.find('\n', begin), text.size());
        const std::string line = trimmed(text.substr(begin, end - begin));
        begin = end + 1;
        ++number;
        if (number > 1) {
            if (const std::string why = take_line(seen, line); !why.empty()) {
                fail(why);
            }
        } else if (line != kPicturesFirstLine) {
            fail(fmt::format("the first line must be '{}'", kPicturesFirstLine));
            return tl::unexpected(errors);  // something else: its lines would tell nothing
        }
    }
    number = 1;
    if (text.empty()) {
        fail(fmt::format("the file is empty; its first line must be '{}'", kPicturesFirstLine));
    } else if (seen.device_glob.empty()) {
        fail("no line says which device is meant; add '# device: NAME-GLOB'");
    }
    if (!errors.empty()) {
        return tl::unexpected(errors);
    }
    return seen;
}

cases::ExpectedAll<SeenPictures> load_pictures(const std::filesystem::path& path) {
    const cases::Expected<std::string> text = cases::read_file(path);
    if (!text) {
        std::error_code ignored;
        return tl::unexpected(cases::Errors{{{path.string(), 0, 0},
                                             std::filesystem::exists(path, ignored)
                                                 ? "the file of pictures cannot be read"
                                                 : "there is no such file of pictures"}});
    }
    return parse_pictures(*text, path);
}

std::string to_text(const SeenPictures& seen) {
    std::string text = std::string(kPicturesFirstLine) + "\n";
    for (const std::string& comment : seen.comments) {
        text += comment + "\n";
    }
    for (const auto& [id, bits] : seen.bits) {
        text += fmt::format("{} {}\n", id, fmt::join(bits, " "));
    }
    return text;
}

SeenPictures new_pictures(const report::Run& run, const std::filesystem::path& path) {
    SeenPictures seen;
    seen.path = path;
    for (const char c : cases::printable(run.device.name)) {
        seen.device_glob +=
            std::string_view("*?[]\\").find(c) == std::string_view::npos ? "" : "\\";
        seen.device_glob += c;
    }
    seen.comments = {std::string(kDevice) + " " + seen.device_glob};
    return seen;
}

bool fits(const SeenPictures& seen, const capture::DeviceInfo& device) {
    return ::fnmatch(seen.device_glob.c_str(), device.name.c_str(), 0) == 0;
}

void add_pictures(SeenPictures& seen, const report::Run& run) {
    for (const report::CaseRecord& record : run.cases) {
        if (report::actual_status(record) == report::Status::fail &&
            record.known.expected != report::Status::flake && is_bits(record.drawn.bits)) {
            seen.bits[record.id].insert(record.drawn.bits);
        }
    }
}

bool tell_pictures(std::map<std::string, ExpectationLine>& expected,
                   const std::vector<SeenPictures>& files, const capture::DeviceInfo& device,
                   bool is_strict) {
    bool is_any = false;
    for (const SeenPictures& file : files) {
        if (!fits(file, device)) {
            continue;
        }
        is_any = true;
        for (auto& [id, line] : expected) {
            line.pictures_are_known = true;
            line.excuses_seen_only = is_strict;
            if (const auto at = file.bits.find(id); at != file.bits.end()) {
                line.seen.insert(at->second.begin(), at->second.end());
            }
        }
    }
    return is_any;
}

}  // namespace run
