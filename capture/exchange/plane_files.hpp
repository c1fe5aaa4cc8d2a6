// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The contract with renderers elsewhere: which planes of a case they may deliver, in which files,
// and how those are read. docs/other-renderers.md tells it to people.
//
// A file holds the samples of a plane row by row from the top; with several samples a pixel, the
// rows of sample 0 come first, then those of sample 1; of several layers, the rows of layer 0 come
// first, then those of layer 1, within each sample. The channels of a sample stand together.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "capture/delivered.hpp"
#include "cases/base/error.hpp"
#include "cases/model/case.hpp"

namespace capture {

enum class PlaneKind : uint8_t {
    mask,   // 0, or the largest number of the format (1, 255, 1.0)
    count,  // whole numbers
    id,     // whole numbers; -1, as u32 0xffffffff, where nothing was drawn
    value,  // binary32
    code,   // whole numbers as they are stored
    byte    // whole numbers from 0 to 255
};

struct PlaneSpec {
    std::string name;  // of the file, without its ending
    PlaneKind kind = PlaneKind::mask;
    std::vector<std::string> channels;
    size_t least_channels = 0;         // a file may have this many only: hits without faces
    std::vector<std::string> endings;  // "u8", "u32", "f32", "png", "tif", "exr"
    std::string what;                  // one sentence
};

// The planes that a renderer may deliver of a case.
std::vector<PlaneSpec> planes_of(const cases::Case& c);

// The folder of a case below the folder of captures, and with ".json" its file in an export. It is
// the id with '@' for ':' and %XX for characters but letters, digits and "._-+=,()^/"; '/' stays
// only in the part before the matrix. Different ids have different folders.
std::string folder_of(const std::string& id);

// A word in the folder of a case that says why it was not drawn; its first line is the reason.
inline constexpr std::string_view kUnsupportedFile = "unsupported.txt";

struct ReadPlanes {
    Delivered planes;         // empty: nothing was delivered
    std::string unsupported;  // the reason in kUnsupportedFile
};
// Reads what lies in the folder. Each of these is an error of one sentence: a file that is no plane
// of the case, two files of a plane, another size, what its kind does not allow.
cases::Expected<ReadPlanes> read_planes(const std::filesystem::path& folder, const cases::Case& c);

}  // namespace capture
