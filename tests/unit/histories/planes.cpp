// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "planes.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

namespace histories {

namespace {

using capture::HitDetail;

constexpr std::array<const char*, kPlaneCount> kNames = {"hits", "writer", "frag_coord", "v",
                                                         "a",    "depth",  "color",      "stencil"};
constexpr std::array<const char*, 4> kDetails = {"none", "coverage", "total", "faces"};

bool is_equal(double a, double b, double free = 0) {
    return std::abs(a - b) < free + 1.0 / 64;
}

bool has_same_hits(HitDetail detail, const Seen& a, const Seen& b) {
    switch (detail) {
        case HitDetail::none:
            return true;
        case HitDetail::coverage:
            return (a.front + a.back == 0) == (b.front + b.back == 0);
        case HitDetail::total:
            return a.front + a.back == b.front + b.back;
        case HitDetail::faces:
            return a.front == b.front && a.back == b.back;
    }
    return false;
}

}  // namespace

float value_v(const Seen& seen) {
    return is_hit(seen) ? static_cast<float>(value_of(static_cast<size_t>(seen.draw),
                                                      static_cast<size_t>(seen.triangle)))
                        : capture::kClearValue;
}

Shown shown(const Seen& seen) {
    Shown out;
    out.fill(seen);
    return out;
}

std::vector<Shown> shown(const std::vector<Seen>& picture) {
    std::vector<Shown> out;
    for (const Seen& seen : picture) {
        out.push_back(shown(seen));
    }
    return out;
}

Planes whole_of(const Scene& scene) {
    Planes out{0, HitDetail::none, true};
    if (scene.has_instruments()) {
        out.set |=
            1U << kHits | 1U << kWriter | 1U << kFragCoord | 1U << kAttributeV | 1U << kAttributeA;
        out.detail = HitDetail::faces;
    }
    out.set |= scene.has_depth() ? 1U << kDepth : 0U;
    out.set |= scene.colors.empty() ? 0U : 1U << kColor;
    out.set |= scene.has_stencil ? 1U << kStencil : 0U;
    return out;
}

std::vector<Planes> subsets_of(const Scene& scene) {
    const uint32_t has = whole_of(scene).set & (takes_stencil() ? ~0U : ~(1U << kStencil));
    std::vector<Planes> out;
    for (uint32_t set = 1; set < 1U << kPlaneCount; ++set) {
        if ((set & ~has) != 0) {
            continue;
        }
        if ((set & 1U << kHits) == 0) {
            out.push_back({set, HitDetail::none});
            continue;
        }
        for (const HitDetail detail : {HitDetail::coverage, HitDetail::total, HitDetail::faces}) {
            out.push_back({set, detail});
        }
    }
    return out;
}

bool is_part(const Planes& fewer, const Planes& planes) {
    return (fewer.set & ~planes.set) == 0 && fewer.detail <= planes.detail;
}

bool shows(const Scene& scene, const Planes& planes, const Shown& picture, const Seen& history) {
    if (!has_same_hits(planes.detail, picture[kHits], history)) {
        return false;
    }
    const Seen& w = picture[kWriter];
    if (planes.has(kWriter) && (w.draw != history.draw || w.triangle != history.triangle)) {
        return false;
    }
    const bool is_known_clear = planes.has(kHits) ? picture[kHits].front + picture[kHits].back == 0
                                                  : planes.has(kWriter) && !is_hit(w);
    if (!is_known_clear) {
        if (planes.has(kFragCoord) &&
            (is_hit(picture[kFragCoord]) != is_hit(history) ||
             (is_hit(history) && !is_equal(picture[kFragCoord].z, history.z, history.z_free)))) {
            return false;
        }
        if (planes.has(kAttributeV) && !is_same(value_v(picture[kAttributeV]), value_v(history))) {
            return false;
        }
        if (planes.has(kAttributeA) &&
            (is_hit(picture[kAttributeA]) != is_hit(history) ||
             (is_hit(history) && !is_equal(picture[kAttributeA].a, history.a, history.a_free)))) {
            return false;
        }
    }
    return !(planes.has(kDepth) && !is_equal(picture[kDepth].depth, history.depth)) &&
           !(planes.has(kColor) &&
             !is_near(scene.colors[scene.judged].about(), picture[kColor].color, history.color)) &&
           !(planes.has(kStencil) && picture[kStencil].stencil != history.stencil);
}

std::string names_of(const Planes& planes) {
    std::string out = planes.is_whole ? "the whole capture" : "";
    for (uint32_t p = 0; p < kPlaneCount && !planes.is_whole; ++p) {
        if (planes.has(static_cast<PlaneNumber>(p))) {
            out += (out.empty() ? "" : ", ") + std::string(kNames[p]);
            out += p == kHits ? fmt::format(" ({})", kDetails[static_cast<size_t>(planes.detail)])
                              : "";
        }
    }
    return out;
}

std::string text_of(const Scene& scene, const Planes& planes, const Shown& picture) {
    const auto writer = [](const Seen& s) {
        return is_hit(s) ? fmt::format("{}.{}", s.draw, s.triangle) : std::string("nobody");
    };
    std::string out;
    if (planes.has(kHits)) {
        out += fmt::format(" hits {}+{}", picture[kHits].front, picture[kHits].back);
    }
    out += planes.has(kWriter) ? " writer " + writer(picture[kWriter]) : "";
    if (planes.has(kFragCoord)) {
        out += fmt::format(" z {} of {}", picture[kFragCoord].z, writer(picture[kFragCoord]));
    }
    out += planes.has(kAttributeV) ? " v of " + writer(picture[kAttributeV]) : "";
    out += planes.has(kAttributeA) ? " a of " + writer(picture[kAttributeA]) : "";
    out += planes.has(kDepth) ? fmt::format(" depth {}", picture[kDepth].depth) : "";
    if (planes.has(kColor)) {
        out += fmt::format(" color {:#x} of {}", fmt::join(picture[kColor].color, ","),
                           scene.colors[scene.judged].about().name);
    }
    out += planes.has(kStencil) ? fmt::format(" stencil {}", picture[kStencil].stencil) : "";
    return out;
}

}  // namespace histories
