// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "capture/exchange/plane_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <system_error>

#include "capture/capture.hpp"
#include "capture/exchange/plane_numbers.hpp"
#include "cases/base/input_file.hpp"
#include "cases/base/number_text.hpp"
#include "cases/format/color_format.hpp"
#include "cases/model/derive.hpp"
#include "cases/model/sample.hpp"
#include "cases/select/selector.hpp"

namespace capture {

namespace fs = std::filesystem;

namespace {

constexpr std::array<const char*, 4> kComponents = {"x", "y", "z", "w"};

bool is_same(double a, double b) {
    return std::equal_to<>()(a, b);
}

std::vector<std::string> components(uint32_t count) {
    return {kComponents.begin(), kComponents.begin() + count};
}

}  // namespace

std::vector<PlaneSpec> planes_of(const cases::Case& c) {
    std::vector<PlaneSpec> planes;
    const std::vector<std::string> whole = {"u8", "u32", "f32", "png", "tif", "exr"};
    const std::vector<std::string> real = {"f32", "tif", "exr"};
    const auto add = [&planes](std::string name, PlaneKind kind, std::vector<std::string> channels,
                               std::vector<std::string> endings, std::string what) {
        const size_t least = channels.size();
        planes.push_back({std::move(name), kind, std::move(channels), least, std::move(endings),
                          std::move(what)});
    };
    if (!c.blit) {
        add("coverage", PlaneKind::mask, {"covered"}, whole,
            "whether any fragment was written: 0, or the largest number of the format (u8 and "
            "whole numbers also 1)");
        add("hits", PlaneKind::count, {"front", "back"}, whole,
            "instead of coverage: how many fragments of front and of back faces were written; with "
            "one channel, of both together");
        planes.back().least_channels = 1;
        add("writer", PlaneKind::id, {"draw", "primitive"}, {"u32", "f32", "tif", "exr"},
            "the triangle that wrote last: number of the draw and of the triangle in it, from 0; "
            "-1 (u32: 4294967295) where nothing was drawn");
        std::vector<uint32_t> counts(cases::attributes_of(c), 1);
        for (const cases::Draw& draw : c.draws) {
            for (size_t a = 0; a < draw.attributes.size(); ++a) {
                counts[a] = std::max(counts[a], draw.attributes[a].components);
            }
        }
        for (size_t a = 0; a < counts.size(); ++a) {
            add(fmt::format("attribute{}", a), PlaneKind::value, components(counts[a]), real,
                "what the last fragment has of this attribute");
        }
        add("fragcoord", PlaneKind::value, components(4), real,
            "gl_FragCoord of the last fragment: x, y, z and 1/w");
        if (c.target.has_depth) {
            add("depth", PlaneKind::value, {"z"}, real,
                "the stored depth; of UNORM formats code / (2^n - 1)");
        }
        if (c.target.has_stencil) {
            add("stencil", PlaneKind::byte, {"value"}, {"u8", "u32"},
                "the stored stencil, 0 to 255");
        }
    }
    if (c.target.color) {
        add("color", PlaneKind::code, components(4), {"u32", "png", "tif"},
            "the stored code of each component, red first: UNORM codes, bits of floats, whole "
            "numbers; 0 for components that the format lacks");
    }
    return planes;
}

std::string folder_of(const std::string& id) {
    std::string folder;
    bool in_matrix = false;
    for (const char c : id) {
        const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
                           (c >= '0' && c <= '9') ||
                           std::string_view("._-+=,()^").find(c) != std::string_view::npos ||
                           (c == '/' && !in_matrix);
        if (c == ':' && !in_matrix) {
            folder += '@';
            in_matrix = true;
        } else if (plain) {
            folder += c;
        } else {
            folder += fmt::format("%{:02X}", static_cast<unsigned char>(c));
        }
    }
    return folder;
}

namespace {

// From the order of files to that of captures: sample s of pixel p is at s * pixels + p there.
class Placement {
  public:
    explicit Placement(const cases::Target& target)
        : pixels_(size_t{target.width} * target.rows()), samples_(target.samples) {}
    size_t count() const { return pixels_ * samples_; }
    size_t in_file(size_t index) const { return index % samples_ * pixels_ + index / samples_; }

  private:
    size_t pixels_, samples_;
};

// Where an entry lies, in words: "pixel (3, 4)", "sample 1 of pixel (3, 4)".
std::string place(const cases::Target& target, size_t index) {
    const cases::SampleId id = cases::sample_at(target, index);
    const std::string at = cases::pixel_text(target, id);
    return target.samples == 1 ? at : fmt::format("sample {} of {}", id.sample, at);
}

class Reader {
  public:
    Reader(const fs::path& folder, const cases::Case& c) : folder_(folder), case_(c) {}

    cases::Expected<ReadPlanes> run() {
        std::map<std::string, fs::path> files;  // by plane
        const std::vector<PlaneSpec> specs = planes_of(case_);
        for (const fs::path& file : files_in(folder_)) {
            std::error_code none;
            if (fs::exists(file, none)) {
                if (auto place = cases::place_inside(folder_, file); !place) {
                    return cases::failure(quoted(file) + " cannot be read: " +
                                          place.error().message + "; put a copy in its place");
                }
            }
            if (file.filename() == kUnsupportedFile && fs::is_regular_file(file, none)) {
                const std::string text = cases::read_file(file).value_or("");
                out_.unsupported = text.substr(0, text.find('\n'));
                if (out_.unsupported.empty()) {
                    return cases::failure("{} is empty; write the reason into its first line",
                                          quoted(file));
                }
                continue;
            }
            const auto spec = std::ranges::find(specs, file.stem().string(), &PlaneSpec::name);
            if (fs::is_directory(file, none)) {
                if (spec == specs.end()) {
                    continue;
                }
                return cases::failure(quoted(file) + " is a folder; a plane is a file");
            }
            if (fs::exists(file, none) && !fs::is_regular_file(file, none)) {
                return cases::failure(quoted(file) +
                                      " is a pipe or a device; write the plane into a file");
            }
            if (spec == specs.end()) {
                return cases::failure(unknown(file, specs));
            }
            const auto [other, is_new] = files.emplace(spec->name, file);
            if (!is_new) {
                return cases::failure("{} and {} are both the plane {}; leave one of them",
                                      quoted(other->second), quoted(file), spec->name);
            }
        }
        if (!out_.unsupported.empty() && !files.empty()) {
            return cases::failure(
                "{} says that the case is not supported, and {} is there "
                "all the same; remove one of them",
                quoted(folder_ / kUnsupportedFile), quoted(files.begin()->second));
        }
        if (files.contains("coverage") && files.contains("hits")) {
            return cases::failure("{} and {} say the same twice; leave one of them",
                                  quoted(files["coverage"]), quoted(files["hits"]));
        }
        for (const PlaneSpec& spec : specs) {
            if (!files.contains(spec.name)) {
                continue;
            }
            const cases::Expected<PlaneNumbers> numbers =
                read_numbers(files[spec.name], spec, case_.target);
            if (!numbers) {
                return tl::unexpected(numbers.error());
            }
            if (const std::string wrong = keep(spec, *numbers); !wrong.empty()) {
                return cases::failure(quoted(files[spec.name]) + " " + wrong);
            }
        }
        return std::move(out_);
    }

  private:
    static std::vector<fs::path> files_in(const fs::path& folder) {
        std::vector<fs::path> files;
        std::error_code none;
        for (const fs::directory_entry& entry : fs::directory_iterator(folder, none)) {
            // A folder that has a plane's name is a mistake, others may hold other cases; a link
            // that leads nowhere or a pipe is no plane that was left out.
            if (!entry.is_directory(none) || entry.path().has_extension()) {
                files.push_back(entry.path());
            }
        }
        std::ranges::sort(files);
        return files;
    }

    static std::string unknown(const fs::path& file, const std::vector<PlaneSpec>& specs) {
        std::vector<std::string> names;
        std::ranges::transform(specs, std::back_inserter(names), &PlaneSpec::name);
        return fmt::format("{} is no plane of this case, which has {}{}", quoted(file),
                           fmt::join(names, ", "),
                           cases::did_you_mean(file.stem().string(), names));
    }

    // Into the planes; what is wrong with a number, if anything.
    std::string keep(const PlaneSpec& spec, const PlaneNumbers& from) {
        Delivered& to = out_.planes;
        switch (spec.kind) {
            case PlaneKind::mask:
                to.detail = HitDetail::coverage;
                return keep_whole(from, 0, to.front, [&](double v) { return mask(from, v); });
            case PlaneKind::count: {
                const bool by_face = from.channels == 2;
                to.detail = by_face ? HitDetail::faces : HitDetail::total;
                std::string wrong = keep_whole(from, 0, to.front, count);
                return wrong.empty() && by_face ? keep_whole(from, 1, to.back, count) : wrong;
            }
            case PlaneKind::id: {
                std::string wrong = keep_whole(from, 0, to.draws, id);
                return wrong.empty() ? keep_whole(from, 1, to.primitives, id) : wrong;
            }
            case PlaneKind::byte:
                return keep_whole(from, 0, to.stencil, byte);
            case PlaneKind::code:
                return keep_codes(from);
            case PlaneKind::value:
                break;
        }
        if (spec.name == "depth") {
            for (size_t k = 0; k < at_.count(); ++k) {
                const auto z = static_cast<float>(from.at(at_.in_file(k), 0));
                to.depth.push_back(nearest_depth_code(z, case_.target.depth_format));
            }
            return {};
        }
        auto& plane = spec.name == "fragcoord"
                          ? to.frag_coord
                          : to.attributes.at(static_cast<size_t>(spec.name.back() - '0'));
        plane.assign(at_.count(), glm::vec4(0));
        for (size_t k = 0; k < at_.count(); ++k) {
            for (uint32_t c = 0; c < from.channels; ++c) {
                plane[k][static_cast<glm::vec4::length_type>(c)] =
                    static_cast<float>(from.at(at_.in_file(k), c));
            }
        }
        return {};
    }

    // What a number means: nothing, and why it is none.
    struct Meaning {
        uint32_t value = 0;
        const char* wrong = nullptr;
    };
    static Meaning mask(const PlaneNumbers& from, double v) {
        const bool is_set = is_same(v, 1) || (from.largest > 0 && is_same(v, from.largest));
        return {is_set ? 1U : 0U, is_set || is_same(v, 0)
                                      ? nullptr
                                      : "a mask holds 0 and the largest number of its format only"};
    }
    static Meaning count(double v) {
        const bool fits = v >= 0 && v <= 0x1p22 && is_same(v, std::floor(v));
        return {fits ? static_cast<uint32_t>(v) : 0U,
                fits ? nullptr : "hits are whole numbers from 0 to 2^22"};
    }
    static Meaning byte(double v) {
        const bool fits = v >= 0 && v <= 255 && is_same(v, std::floor(v));
        return {fits ? static_cast<uint32_t>(v) : 0U,
                fits ? nullptr : "stencils are whole numbers from 0 to 255"};
    }
    static Meaning id(double v) {
        const bool is_none = is_same(v, -1) || is_same(v, 0xffffffffU);
        const bool fits = is_none || (v >= 0 && v < 0xfff00000U && is_same(v, std::floor(v)));
        return {
            is_none ? kClearId
            : fits  ? static_cast<uint32_t>(v)
                    : 0U,
            fits ? nullptr : "writers are whole numbers from 0 on, or -1 where nothing was drawn"};
    }

    std::string keep_whole(const PlaneNumbers& from, size_t channel, std::vector<uint32_t>& to,
                           const std::function<Meaning(double)>& meaning) const {
        to.clear();
        for (size_t k = 0; k < at_.count(); ++k) {
            const double v = from.at(at_.in_file(k), channel);
            const Meaning m = meaning(v);
            if (m.wrong != nullptr) {
                return fmt::format("holds {} at {}; {}", cases::number_text(v),
                                   place(case_.target, k), m.wrong);
            }
            to.push_back(m.value);
        }
        return {};
    }

    std::string keep_codes(const PlaneNumbers& from) {
        std::vector<ColorCodes>& to = out_.planes.color;
        for (size_t k = 0; k < at_.count(); ++k) {
            ColorCodes codes{};
            for (uint32_t c = 0; c < codes.size(); ++c) {
                const uint32_t bits = cases::component_of(case_.target.color->format, c).bits;
                if (from.largest > 0 && bits != 0 &&
                    !is_same(from.largest, std::ldexp(1.0, static_cast<int>(bits)) - 1)) {
                    return fmt::format(
                        "has {}-bit numbers, and {} has components of {} bits; use color.u32",
                        from.largest > 255 ? 16 : 8, cases::name_of(case_.target.color->format),
                        bits);
                }
                codes.at(c) = bits == 0 ? 0U : static_cast<uint32_t>(from.at(at_.in_file(k), c));
            }
            to.push_back(codes);
        }
        return {};
    }

    fs::path folder_;
    const cases::Case& case_;
    Placement at_{case_.target};
    ReadPlanes out_;
};

}  // namespace

cases::Expected<ReadPlanes> read_planes(const fs::path& folder, const cases::Case& c) {
    return Reader(folder, c).run();
}

}  // namespace capture
