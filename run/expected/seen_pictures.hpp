// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Files of pictures (NAME.pictures beside expectation files): the bits of known failures that
// somebody has seen, for all versions of a driver (cases/expectations/README.md). They are
// knowledge and no condition: an expectation says what is excused, and a run says which of the
// pictures that it excuses are new.
#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "cases/base/error.hpp"
#include "report/record/run.hpp"
#include "run/expected/expectation_file.hpp"

namespace run {

inline constexpr std::string_view kPicturesFirstLine = "# edgecase-pictures 1";
inline constexpr std::string_view kPicturesEnd = ".pictures";  // of the files' names

struct SeenPictures {
    std::filesystem::path path;
    std::string device_glob;            // on the device's name
    std::vector<std::string> comments;  // all lines above the first case, the first one left out
    std::map<std::string, std::set<std::string>> bits;  // CaseRecord::bits by case
};

// Parses a file's text: the first line, comments of which one says the device ("# device: GLOB"),
// and a line a case, its id and the bits of one picture or more.
cases::ExpectedAll<SeenPictures> parse_pictures(std::string_view text,
                                                const std::filesystem::path& path);
cases::ExpectedAll<SeenPictures> load_pictures(const std::filesystem::path& path);
std::string to_text(const SeenPictures& seen);

// A file without pictures for the device of a run.
SeenPictures new_pictures(const report::Run& run, const std::filesystem::path& path);
bool fits(const SeenPictures& seen, const capture::DeviceInfo& device);
// Adds the pictures of a run's failures, known or not.
void add_pictures(SeenPictures& seen, const report::Run& run);

// Tells the expectations which pictures of their cases were seen, by the files that fit the device;
// false: none does, so that nothing is known. `is_strict`: a picture that nobody has seen is news.
bool tell_pictures(std::map<std::string, ExpectationLine>& expected,
                   const std::vector<SeenPictures>& files, const capture::DeviceInfo& device,
                   bool is_strict);

}  // namespace run
