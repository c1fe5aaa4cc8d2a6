// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/prepare/drawing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>

#include "cases/base/parallel.hpp"
#include "cases/format/color_format.hpp"
#include "cases/model/derive.hpp"
#include "cases/model/sample.hpp"
#include "cli/renderers/renderers.hpp"
#include "ref/blit/blit.hpp"
#include "ref/color/component.hpp"
#include "report/record/run.hpp"

namespace cli {

namespace {

using Json = nlohmann::ordered_json;

constexpr float kNothing = std::numeric_limits<float>::quiet_NaN();

std::string dump(const Json& json, int indent = -1) {
    return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

// A binary32 with its bits; JSON has no NaN and no infinity.
Json number(float v) {
    const Json value = std::isfinite(v) ? Json(static_cast<double>(v))
                       : std::isnan(v)  ? Json("nan")
                                        : Json(v > 0 ? "inf" : "-inf");
    return {{"value", value}, {"bits", fmt::format("{:08x}", std::bit_cast<uint32_t>(v))}};
}

// A value of a sample with its name.
struct Value {
    std::string name;
    float value = 0;
};

std::vector<Value> values_at(const cases::Case& c, const capture::Capture& capture, size_t index) {
    static constexpr std::string_view kNames = "xyzw";
    std::vector<Value> out;
    const auto add = [&out](const std::string& name, const glm::vec4& v, uint32_t components) {
        for (uint32_t k = 0; k < components; ++k) {
            out.push_back(
                {fmt::format("{}.{}", name, kNames[k]), v[static_cast<glm::vec4::length_type>(k)]});
        }
    };
    add("frag_coord", capture.frag_coord[index], 4);
    out.push_back({"depth", capture.depth[index]});
    for (uint32_t a = 0; a < capture.attribute_count; ++a) {
        uint32_t components = 0;
        for (const cases::Draw& draw : c.draws) {
            if (a < draw.attributes.size()) {
                components = std::max(components, draw.attributes[a].components);
            }
        }
        add(fmt::format("attribute{}", a), capture.attributes.at(a)[index], components);
    }
    return out;
}

bool is_hit(const capture::Capture& capture, size_t index) {
    return capture.hits[index].x + capture.hits[index].y > 0;
}

void drawing_json(const cases::Case& c, const capture::Capture& capture,
                  const std::string& renderer, const cases::Put& put) {
    JsonList samples({{"schema", "edgecase-drawing-1"},
                      {"id", c.id},
                      {"renderer", renderer},
                      {"width", c.target.width},
                      {"height", c.target.height},
                      {"layers", c.target.layers},
                      {"samples_per_pixel", c.target.samples},
                      {"note", "samples that were not hit are left out"}},
                     "samples", put);
    for (size_t index = 0; index < capture.sample_count(); ++index) {
        if (!is_hit(capture, index)) {
            continue;
        }
        const cases::SampleId at = cases::sample_at(c.target, index);
        Json values = Json::object();
        for (const Value& v : values_at(c, capture, index)) {
            values[v.name] = number(v.value);
        }
        Json sample = {{"x", at.x}, {"y", at.y}, {"sample", at.sample}};
        if (c.target.layers > 1) {
            sample["layer"] = at.layer;
        }
        sample["front"] = static_cast<uint32_t>(capture.hits[index].x);
        sample["back"] = static_cast<uint32_t>(capture.hits[index].y);
        sample["draw"] = capture.writers[index].draw;
        sample["primitive"] = capture.writers[index].primitive;
        sample["values"] = std::move(values);
        samples.add(sample);
    }
    samples.end();
}

capture::Image drawing_values(const cases::Case& c, const capture::Capture& capture) {
    capture::Image image{c.target.width, c.target.rows(), {}, {}};  // layers stacked
    for (uint32_t s = 0; s < c.target.samples; ++s) {
        const std::string prefix = c.target.samples > 1 ? fmt::format("sample{}.", s) : "";
        for (const char* name : {"front", "back", "draw", "primitive"}) {
            image.channels.push_back(prefix + name);
        }
        for (const Value& v : values_at(c, capture, 0)) {
            image.channels.push_back(prefix + v.name);
        }
    }
    for (size_t index = 0; index < capture.sample_count(); ++index) {
        const bool hit = is_hit(capture, index);
        const capture::Writer& writer = capture.writers[index];
        image.pixels.push_back(capture.hits[index].x);
        image.pixels.push_back(capture.hits[index].y);
        image.pixels.push_back(hit ? static_cast<float>(writer.draw) : kNothing);
        image.pixels.push_back(hit ? static_cast<float>(writer.primitive) : kNothing);
        for (const Value& v : values_at(c, capture, index)) {
            image.pixels.push_back(hit ? v.value : kNothing);
        }
    }
    return image;
}

// White where a sample was hit, black where not.
capture::Image drawing_picture(const cases::Case& c, const capture::Capture& capture) {
    capture::Image image{c.target.width, c.target.rows(), {"R", "G", "B"}, {}};
    for (size_t index = 0; index < capture.sample_count(); ++index) {
        image.pixels.insert(image.pixels.end(), 3, is_hit(capture, index) ? 1.0F : 0.0F);
    }
    return image;
}

}  // namespace

JsonList::JsonList(const Json& object, const std::string& name, const cases::Put& put) : put_(put) {
    std::string text = dump(object, 1);
    text.resize(text.find_last_not_of("\n}") + 1);
    put_(text + fmt::format(",\n \"{}\": [", name));
}

void JsonList::add(const Json& entry) {
    put_(fmt::format("{}\n  {}", is_empty_ ? "" : ",", dump(entry)));
    is_empty_ = false;
}

void JsonList::add_all(size_t count, size_t lanes,
                       const std::function<Json(size_t number, size_t lane)>& entry) {
    constexpr size_t kRun = 4096;  // some megabytes of text, and little waiting for each other
    std::vector<std::string> texts(lanes);
    for (size_t begin = 0; begin < count; begin += lanes * kRun) {
        cases::for_each_index(lanes, [&](size_t lane) {
            std::string& text = texts[lane];
            text.clear();
            const size_t first = begin + lane * kRun;
            for (size_t k = first; k < std::min(first + kRun, count); ++k) {
                if (const Json made = entry(k, lane); !made.is_null()) {
                    text += ",\n  " + dump(made);
                }
            }
        });
        for (const std::string& text : texts) {
            if (!text.empty()) {
                put_(std::string_view(text).substr(is_empty_ ? 1 : 0));
                is_empty_ = false;
            }
        }
    }
}

void JsonList::end() {
    put_("\n ]\n}\n");
}

capture::Image enlarged(const capture::Image& picture, uint32_t samples, uint32_t scale) {
    constexpr uint32_t kSide = 512;
    const uint32_t longer = std::max(picture.width, picture.height);
    const uint32_t side = scale > 0 ? scale : std::max(1U, kSide / longer);
    const uint32_t columns = samples >= 8 ? 4 : samples >= 2 ? 2 : 1;
    const uint32_t rows = samples / columns;
    const size_t channels = picture.channels.size();
    capture::Image out{picture.width * side, picture.height * side, picture.channels, {}};
    out.pixels.reserve(size_t{out.width} * out.height * channels);
    for (uint32_t y = 0; y < out.height; ++y) {
        for (uint32_t x = 0; x < out.width; ++x) {
            const size_t pixel = size_t{y / side} * picture.width + x / side;
            const uint32_t at = y % side * rows / side * columns + x % side * columns / side;
            for (size_t channel = 0; channel < channels; ++channel) {
                const auto of = [&](uint32_t s) {
                    return picture.pixels[(pixel * samples + s) * channels + channel];
                };
                float sum = 0;
                for (uint32_t s = 0; s < samples; ++s) {
                    sum += of(s);
                }
                out.pixels.push_back(side >= columns ? of(at) : sum / static_cast<float>(samples));
            }
        }
    }
    return out;
}

Drawing draw_picture(const cases::Case& c, const std::string& renderer) {
    cases::Case whole = c;
    whole.target.has_instruments = true;
    whole.target.has_depth = true;
    capture::RendererOptions options;
    options.renderer = renderer;
    const auto made = renderer_of(options).make(options);
    if (!made) {
        throw stop_with(report::kExitUsage, made.error().message);
    }
    capture::Rendered drawn = std::move((*made)->render({&whole, 1}).front());
    if (drawn.status != capture::Rendered::Status::drawn) {
        throw stop_with(report::kExitUsage,
                        "'" + renderer + "' cannot draw the case: " + drawn.reason);
    }
    const auto capture = std::make_shared<const capture::Capture>(std::move(drawn.capture));
    return Drawing{[&c, capture, renderer](const cases::Put& put) {
                       drawing_json(c, *capture, renderer, put);
                   },
                   [&c, capture] { return drawing_values(c, *capture); },
                   [&c, capture] { return drawing_picture(c, *capture); }};
}

namespace {

// The number of a component, from its code.
double number_of(cases::ColorFormat format, const cases::TexelCodes& codes, uint32_t k) {
    const cases::ComponentFormat component = cases::component_of(format, k);
    return component.bits == 0 ? 0.0 : ref::color::Component(component).number(codes.at(k));
}

void blit_json(const cases::Case& c, const ref::BlitReference& reference, cases::Profile profile,
               const cases::Put& put) {
    JsonList texels({{"schema", "edgecase-blit-1"},
                     {"id", c.id},
                     {"profile", std::string(cases::to_string(profile))},
                     {"format", cases::name_of(c.target.color->format)},
                     {"width", c.target.width},
                     {"height", c.target.height},
                     {"clear_codes", reference.clear_codes()},
                     {"note", "texels outside the destination region keep the clear codes"}},
                    "texels", put);
    for (uint32_t y = 0; y < c.target.height; ++y) {
        for (uint32_t x = 0; x < c.target.width; ++x) {
            if (reference.is_inside(x, y)) {
                texels.add({{"x", x},
                            {"y", y},
                            {"codes", reference.nominal(x, y)},
                            {"others_allowed", reference.has_freedom(x, y, profile)}});
            }
        }
    }
    texels.end();
}

// The numbers of the first components; those of integers in 0..1 if the image is to look at.
capture::Image blit_image(const cases::Case& c, const ref::BlitReference& reference,
                          std::vector<std::string> channels, bool is_to_look_at) {
    const cases::ColorFormat format = c.target.color->format;
    capture::Image out{c.target.width, c.target.height, std::move(channels), {}};
    for (uint32_t y = 0; y < c.target.height; ++y) {
        for (uint32_t x = 0; x < c.target.width; ++x) {
            const cases::TexelCodes codes = reference.nominal(x, y);
            for (uint32_t k = 0; k < out.channels.size(); ++k) {
                const cases::ComponentFormat component = cases::component_of(format, k);
                const bool is_whole = is_integer(component.kind);
                const double largest = is_to_look_at && is_whole
                                           ? std::ldexp(1.0, static_cast<int>(component.bits)) - 1
                                           : 1.0;
                out.pixels.push_back(static_cast<float>(number_of(format, codes, k) / largest));
            }
        }
    }
    return out;
}

}  // namespace

Drawing blit_picture(const cases::Case& c, cases::Profile profile) {
    const auto reference = std::make_shared<const ref::BlitReference>(c);
    return {
        [&c, reference, profile](const cases::Put& put) { blit_json(c, *reference, profile, put); },
        [&c, reference] {
            return blit_image(c, *reference, {"R", "G", "B", "A"}, false);
        },
        [&c, reference] {
            return blit_image(c, *reference, {"R", "G", "B"}, true);
        }};
}

}  // namespace cli
