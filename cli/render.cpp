// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The command "render": a picture of a case, without any device.
#include <gmpxx.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <vector>

#include "capture/image/image.hpp"
#include "cases/base/parallel.hpp"
#include "cases/model/words.hpp"
#include "cli/commands.hpp"
#include "cli/options/shared_options.hpp"
#include "cli/prepare/drawing.hpp"
#include "cli/prepare/loop_config.hpp"
#include "cli/prepare/outputs.hpp"
#include "cli/prepare/suite.hpp"
#include "cli/stored_depth.hpp"
#include "ref/expectation/counted.hpp"
#include "ref/expectation/expectation.hpp"
#include "ref/expectation/statistics.hpp"
#include "ref/value/reference.hpp"
#include "report/record/run.hpp"

namespace cli {

namespace {

struct RenderOptions {
    SuiteOptions suite;  // exactly one selector, one case
    std::string output;
    std::string renderer;  // "": what the reference allows; else what this one draws
    uint32_t scale = 0;    // side of a pixel in a *.png; 0: chosen by the target's size
    cases::Profile profile = cases::Profile::direct3d;
    JudgedDevice judged;
};

using Json = nlohmann::ordered_json;

struct Reference {
    const cases::Case& c;
    ref::Expectation expectation;
    ref::ValueReference values;

    cases::SampleId id(size_t index) const { return cases::sample_at(c.target, index); }
};

const char* class_name(const ref::HitBounds& hits) {
    if (hits.total_max == 0) {
        return "must_not";
    }
    return hits.is_decided() ? "must" : "either";
}

// A binary64 as JSON can hold it: text for what is no finite number.
Json number(double v) {
    if (std::isfinite(v)) {
        return v;
    }
    return std::isnan(v) ? "nan" : v > 0 ? "inf" : "-inf";
}

// Whether the text of a number is a fraction that binary64 rounds, or no fraction.
bool is_rounded(const ref::ExpectedValue& v) {
    mpq_class exact;
    return !std::isfinite(v.nearest) || exact.set_str(v.exact, 10) != 0 ||
           exact != mpq_class(v.nearest);
}

// The values of a triangle at a sample, by their names: what must be stored bit for bit as [value],
// else [nearest, low, high], the last two null where nothing is promised. What few values have
// stands beside them.
// `of_depth`: of the depth alone, or, if it is false, of all others; nothing: of all.
Json writer_json(ref::ValueReference& reference, uint32_t triangle, cases::SampleId id,
                 std::optional<bool> of_depth) {
    Json values = Json::object(), exact, also, biased;
    for (const ref::ExpectedValue& v : reference.expected(triangle, id)) {
        if (of_depth && *of_depth != v.quantity.is_depth()) {
            continue;
        }
        const std::string name = to_text(v);
        Json& value = values[name];
        value.push_back(number(v.nearest));
        if (is_rounded(v)) {
            exact[name] = v.exact;
        }
        if (!v.also.empty()) {
            also[name] = v.also;
        }
        if (v.is_flat) {
            continue;
        }
        // A part beside a value and a level of detail are told, and held to no bounds of their own.
        const bool is_bounded = v.part.empty() && v.factor > 0;
        const ref::ValueRange all =
            is_bounded ? reference.range(triangle, id, v.quantity) : ref::ValueRange{};
        value.push_back(all.is_promised ? number(all.low) : Json());
        value.push_back(all.is_promised ? number(all.high) : Json());
        if (all.is_promised && all.has_biased) {
            biased[name] = {number(all.biased_low), number(all.biased_high)};
        }
    }
    Json writer;
    writer["triangle"] = triangle;
    writer["values"] = std::move(values);
    for (auto& [key, rare] : {std::pair("exact", &exact), {"also", &also}, {"biased", &biased}}) {
        if (!rare->is_null()) {
            writer[key] = std::move(*rare);
        }
    }
    return writer;
}

// The triangles whose depth a sample may hold; null: none's, but what depth was cleared to.
Json depths_json(Reference& r, ref::ValueReference& values, const ref::SampleExpectation& s,
                 cases::SampleId id) {
    Json list = Json::array();
    for (const uint32_t triangle : r.expectation.depth_writers_of(s)) {
        list.push_back(writer_json(values, triangle, id, true));
    }
    if (s.depth_may_be_clear) {
        Json none;
        none["triangle"] = nullptr;
        none["values"]["depth"].push_back(number(r.c.target.depth_clear));
        list.push_back(std::move(none));
    }
    return list;
}

Json triangles_json(const ref::Expectation& e) {
    Json list = Json::array();
    for (const cases::Triangle& t : e.triangles) {
        list.push_back(
            {{"draw", t.draw}, {"primitive", t.primitive}, {"provoking_vertex", t.provoking}});
    }
    return list;
}

// What each query counts, and of one that is not precise gives as 0 or any other number; null is no
// bound.
Json queries_json(const Reference& r) {
    Json list = Json::array();
    const std::vector<ref::CountBounds> all = ref::query_bounds(r.c, r.expectation, ref::ShownAt());
    for (size_t draw = 0; draw < all.size(); ++draw) {
        const cases::Query query = r.c.draws[draw].query;
        if (query == cases::Query::none) {
            continue;
        }
        const ref::CountBounds& bounds = all[draw];
        Json counted = {bounds.least, bounds.most};
        if (bounds.most == ref::kNoMost) {
            counted[1] = nullptr;
        }
        list.push_back(
            {{"draw", draw}, {"query", cases::word_of(query)}, {"counted", std::move(counted)}});
    }
    return list;
}

void put_json(Reference& r, const cases::Put& put) {
    const ref::Expectation& e = r.expectation;
    JsonList samples({{"schema", "edgecase-reference-2"},
                      {"id", r.c.id},
                      {"profile", std::string(cases::to_string(e.profile))},
                      {"subpixel_bits", e.limits.subpixel_bits},
                      {"width", r.c.target.width},
                      {"height", r.c.target.height},
                      {"samples_per_pixel", r.c.target.samples},
                      {"layers", r.c.target.layers},
                      {"must_samples", e.must_samples},
                      {"either_samples", e.either_samples},
                      {"triangles", triangles_json(e)},
                      {"queries", queries_json(r)},
                      {"note",
                       "samples that must not be covered are left out, but where a triangle "
                       "may have stored its depth"}},
                     "samples", put);
    std::vector<ref::ValueReference> values;  // a lane's own, which keeps what it was asked last
    for (unsigned k = 0; k < cases::most_threads(); ++k) {
        values.emplace_back(r.c, e.limits, e.profile);
    }
    samples.add_all(e.samples.size(), values.size(), [&](size_t index, size_t lane) -> Json {
        const ref::SampleExpectation& s = e.samples[index];
        const bool is_apart = has_own_depth(r.c, e, index);
        if (s.hits.total_max == 0 && !is_apart) {
            return {};
        }
        const cases::SampleId id = r.id(index);
        Json writers = Json::array();
        for (uint32_t k = 0; k < s.writers_count; ++k) {
            writers.push_back(writer_json(values[lane], e.writers[s.writers_begin + k], id,
                                          is_apart ? std::optional(false) : std::nullopt));
        }
        Json sample;  // member by member: a list of them in braces would be copied
        sample["x"] = id.x;
        sample["y"] = id.y;
        sample["sample"] = id.sample;
        sample["layer"] = id.layer;
        sample["class"] = class_name(s.hits);
        sample["front"] = std::array{s.hits.front_min, s.hits.front_max};
        sample["back"] = std::array{s.hits.back_min, s.hits.back_max};
        sample["total"] = std::array{s.hits.total_min, s.hits.total_max};
        sample["writers"] = std::move(writers);
        if (is_apart) {
            sample["depths"] = depths_json(r, values[lane], s, id);
        }
        return sample;
    });
    samples.end();
}

// Channels a sample: fewest and most hits, then the exact values of the last writer, and the depth
// of the triangle that stored it last, rounded to binary32; NaN where there is none.
capture::Image values_image(Reference& r) {
    const cases::Target& target = r.c.target;
    const ref::Expectation& e = r.expectation;
    std::vector<std::string> quantities;
    // The values of the last writer, and the depth that is stored.
    const auto values_at = [&](size_t index) {
        const ref::SampleExpectation& s = e.samples[index];
        std::vector<ref::ExpectedValue> values;
        const auto take = [&](std::span<const uint32_t> triangles, std::optional<bool> of_depth) {
            if (triangles.empty()) {
                return;
            }
            for (const ref::ExpectedValue& v : r.values.expected(triangles.back(), r.id(index))) {
                if (!of_depth || *of_depth == v.quantity.is_depth()) {
                    values.push_back(v);
                }
            }
        };
        const bool is_apart = has_own_depth(r.c, e, index);
        take(std::span(e.writers).subspan(s.writers_begin, s.writers_count),
             is_apart ? std::optional(false) : std::nullopt);
        if (is_apart) {
            take(e.depth_writers_of(s), true);
        }
        return values;
    };
    for (size_t index = 0; index < e.samples.size(); ++index) {
        for (const ref::ExpectedValue& v : values_at(index)) {
            if (std::ranges::find(quantities, to_text(v)) == quantities.end()) {
                quantities.push_back(to_text(v));
            }
        }
    }
    capture::Image image{target.width, target.rows(), {}, {}};  // layers stacked
    const size_t per_sample = 2 + quantities.size();
    for (uint32_t s = 0; s < target.samples; ++s) {
        const std::string prefix = target.samples > 1 ? "sample" + std::to_string(s) + "." : "";
        image.channels.push_back(prefix + "hits_min");
        image.channels.push_back(prefix + "hits_max");
        for (std::string name : quantities) {
            std::ranges::replace(name, ' ', '_');
            image.channels.push_back(prefix + name);
        }
    }
    image.pixels.assign(e.samples.size() * per_sample, std::numeric_limits<float>::quiet_NaN());
    for (size_t index = 0; index < e.samples.size(); ++index) {
        const ref::SampleExpectation& s = e.samples[index];
        float* at = &image.pixels[index * per_sample];
        at[0] = static_cast<float>(s.hits.total_min);
        at[1] = static_cast<float>(s.hits.total_max);
        for (const ref::ExpectedValue& v : values_at(index)) {
            const auto q = std::ranges::find(quantities, to_text(v));
            at[2 + (q - quantities.begin())] = static_cast<float>(v.nearest);
        }
    }
    return image;
}

// To look at: white must be covered, black must not, grey may.
capture::Image coverage_image(const Reference& r) {
    const cases::Target& target = r.c.target;
    capture::Image image{target.width, target.rows(), {"R", "G", "B"}, {}};
    for (size_t index = 0; index < r.expectation.samples.size(); ++index) {
        const ref::SampleExpectation& s = r.expectation.samples[index];
        const float shade = s.hits.total_min > 0 ? 1.0F : s.hits.total_max > 0 ? 0.5F : 0.0F;
        image.pixels.insert(image.pixels.end(), 3, shade);
    }
    return image;
}

// What the reference allows at each sample.
Drawing allowed_picture(const cases::Case& c, const RenderOptions& options) {
    const ref::Limits limits = limits_of(options.judged);
    const auto r =
        std::make_shared<Reference>(Reference{c, ref::expect(c, limits, options.profile),
                                              ref::ValueReference(c, limits, options.profile)});
    return {[r](const cases::Put& put) { put_json(*r, put); }, [r] { return values_image(*r); },
            [r] { return coverage_image(*r); }};
}

Drawing picture_of(const cases::Case& c, const RenderOptions& options) {
    if (!c.blit) {
        return options.renderer.empty() ? allowed_picture(c, options)
                                        : draw_picture(c, options.renderer);
    }
    if (!options.renderer.empty() && options.renderer != "reference") {
        throw Stop{report::kExitUsage,
                   {"'" + options.renderer +
                    "' draws triangles, and the case is a blit; leave "
                    "--renderer out"}};
    }
    return blit_picture(c, options.profile);
}

int carry_out(const Program& program, const RenderOptions& options) {
    cases::Case c = load_one_case(program, options.suite, options.judged);
    if (auto placed = ref::as_drawn(c, limits_of(options.judged))) {
        c = std::move(*placed);
    }
    const std::string extension = std::filesystem::path(options.output).extension().string();
    if (extension != ".json" && extension != ".png" && extension != ".exr" && extension != ".tif") {
        throw Stop{report::kExitUsage,
                   {"'" + options.output + "' has no known extension; use .exr, .png or .json"}};
    }
    const bool is_picture = extension == ".png";
    if (!is_picture && options.scale > 0) {
        throw Stop{report::kExitUsage,
                   {"--scale is for pictures to look at (*.png); values keep the "
                    "target's size, so leave it out"}};
    }
    const Drawing drawing = picture_of(c, options);
    const cases::Expected<void> written =
        extension == ".json"
            ? write_pieces(options.output, drawing.json)
            : capture::write_image(
                  options.output, is_picture
                                      ? enlarged(drawing.picture(), c.target.samples, options.scale)
                                      : drawing.values());
    if (!written) {
        throw Stop{report::kExitInternal, {cases::to_string(written.error())}};
    }
    return report::kExitOk;
}

// What 'render' takes: no driver.
const std::map<std::string, std::string>& drawing_names() {
    static const std::map<std::string, std::string> kNames = [] {
        std::map<std::string, std::string> names = renderer_names();
        names.erase("vulkan");
        names.emplace("allowed", "");
        return names;
    }();
    return kNames;
}

void declare(CLI::App& app, RenderOptions& o) {
    add_case(&app, o.suite);
    app.add_option("-o,--output", o.output, "*.exr (values), *.png (to look at) or *.json")
        ->type_name("FILE")
        ->required();
    add_value(&app, "--scale", o.scale,
              "*.png: pixels on each side of a pixel, 1 to 512 [the longer side near 512]", "N",
              "Output")
        ->check(in_range(1U, 512U));
    add_profile(&app, o.profile);
    add_judged_device(&app, o.judged);
    add_choice(&app, "--renderer", o.renderer, drawing_names(),
               "what draws: an algorithm of docs/algorithms.md, the reference or the software "
               "rasterizer; allowed: no drawing, but what the reference allows",
               takes_choices);
}

}  // namespace

Command render_command() {
    return make_command<RenderOptions>(
        {"render", kCases, "write the reference picture of a case; needs no Vulkan",
         "  edgecase render ties/apex-up -o picture.png                    what is allowed\n"
         "  edgecase render ties/apex-up -o picture.png --renderer tiles   what an algorithm "
         "draws\n"
         "  edgecase render blit/mirrored:sx=1,sy=0,dx=0,dy=0 -o blit.png  what a blit must "
         "leave\n"},
        declare, carry_out);
}

}  // namespace cli
