// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "probe/tell/page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "probe/tell/text.hpp"

namespace probe {

namespace {

constexpr const char* kStyle =
    ":root{color-scheme:light dark}"
    "body{font:15px/1.45 system-ui,sans-serif;max-width:70rem;margin:2rem auto;padding:0 1rem}"
    "h1{font-size:1.5rem}h2{font-size:1.15rem;margin-top:2rem}"
    "table{border-collapse:collapse;width:100%}"
    "td{border-top:1px solid #8884;padding:.3rem .6rem .3rem 0;vertical-align:top}"
    "td:first-child{width:40%}.no{opacity:.75;font-style:italic}"
    ".more{font-size:.85rem;opacity:.8}"
    "svg{display:block;max-width:100%;height:auto;margin:.4rem 0}"
    "svg text{font:11px system-ui,sans-serif;fill:currentColor}"
    "svg .axis{stroke:currentColor;stroke-opacity:.4;fill:none}"
    "svg .line{stroke:#06c;stroke-width:1.5;fill:none}"
    "svg .own{stroke:#06c;stroke-width:3}svg .other{stroke:#888;stroke-width:1;stroke-dasharray:3 "
    "3}"
    "@media(max-width:40rem){td,td:first-child{display:block;width:auto;padding-right:0}"
    "td+td{border-top:0;padding-top:0}}"
    "@media(prefers-color-scheme:dark){svg .line,svg .own{stroke:#5af}}";

std::string escaped(std::string_view text) {
    std::string out;
    for (const char c : text) {
        out += c == '&'   ? "&amp;"
               : c == '<' ? "&lt;"
               : c == '>' ? "&gt;"
               : c == '"' ? "&quot;"
                          : std::string(1, c);
    }
    return out;
}

// From each inner normal's direction a line to the middle: the edge whose triangle lies there owns
// the samples on it, or does not.
std::string star(const Picture& p) {
    std::string out =
        "<svg width=\"300\" height=\"240\" viewBox=\"-150 -120 300 240\" role=\"img\" "
        "aria-label=\"which edges own the samples on them\">";
    for (size_t k = 0; k < p.points.size(); ++k) {
        const auto [x, y] = p.points[k];
        const double length = std::hypot(x, y);
        const bool owns = k < p.marks.size() && p.marks[k] != 0;
        out += fmt::format("<line class=\"{}\" x1=\"0\" y1=\"0\" x2=\"{:.1f}\" y2=\"{:.1f}\"/>",
                           owns ? "own" : "other", 95 * x / length, 95 * y / length);
    }
    return out +
           "<text x=\"-148\" y=\"-106\">solid: the triangle there owns the edge</text>"
           "</svg>";
}

// A curve, or steps between points, with the range of both axes.
std::string curve(const Picture& p, bool has_steps) {
    constexpr double kWidth = 520;
    constexpr double kHeight = 180;
    if (p.points.empty()) {
        return {};
    }
    auto points = p.points;
    std::ranges::stable_sort(points, [](const auto& a, const auto& b) { return a[0] < b[0]; });
    double low_x = points.front()[0];
    double high_x = points.back()[0];
    double low_y = points.front()[1];
    double high_y = low_y;
    for (const auto& [x, y] : points) {
        low_y = std::min(low_y, y);
        high_y = std::max(high_y, y);
    }
    high_x = high_x > low_x ? high_x : low_x + 1;
    high_y = high_y > low_y ? high_y : low_y + 1;
    std::string path;
    double last = 0;
    for (size_t k = 0; k < points.size(); ++k) {
        const double x = kWidth * (points[k][0] - low_x) / (high_x - low_x);
        const double y = kHeight * (1 - (points[k][1] - low_y) / (high_y - low_y));
        if (k > 0 && has_steps) {
            path += fmt::format("L{:.1f} {:.1f}", x, last);
        }
        path += fmt::format("{}{:.1f} {:.1f}", k == 0 ? "M" : "L", x, y);
        last = y;
    }
    std::string out = fmt::format(
        "<svg width=\"620\" height=\"215\" viewBox=\"-80 -10 620 215\" role=\"img\" "
        "aria-label=\"{} over {}\">"
        "<rect class=\"axis\" x=\"0\" y=\"0\" width=\"{}\" height=\"{}\"/>"
        "<path class=\"line\" d=\"{}\"/>",
        escaped(p.axes[1]), escaped(p.axes[0]), kWidth, kHeight, path);
    out += fmt::format(
        "<g text-anchor=\"end\"><text x=\"-6\" y=\"10\">{:.4g}</text><text x=\"-6\" "
        "y=\"{}\">{:.4g}</text></g>"
        "<text transform=\"translate(-62 {}) rotate(-90)\" text-anchor=\"middle\">{}</text>",
        high_y, kHeight, low_y, kHeight / 2, escaped(p.axes[1]));
    out += fmt::format(
        "<text x=\"0\" y=\"{0}\">{1:.4g}</text><text x=\"{2}\" y=\"{0}\" "
        "text-anchor=\"middle\">{3}</text><text x=\"{4}\" y=\"{0}\" "
        "text-anchor=\"end\">{5:.4g}</text></svg>",
        kHeight + 16, low_x, kWidth / 2, escaped(p.axes[0]), kWidth, high_x);
    return out;
}

std::string row(const Property& p) {
    std::string out = fmt::format(
        "<tr id=\"{0}\"><td>{1}<div class=\"more\"><code>{0}</code>: {2}</div></td><td>",
        escaped(p.id), escaped(p.question), escaped(p.experiment));
    out += p.is_known() ? fmt::format("<b>{}</b>", escaped(p.answer))
                        : fmt::format("<span class=\"no\">{}</span>", kCannotTell);
    if (const std::string sure = sureness(p); !sure.empty() && p.is_known()) {
        out += fmt::format("<div class=\"more\">{} decisive observations agree</div>", sure);
    }
    for (const std::string& more : {p.why, figures_text(p)}) {
        if (!more.empty()) {
            out += fmt::format("<div class=\"more\">{}</div>", escaped(more));
        }
    }
    return out + to_svg(p.picture) + "</td></tr>\n";
}

}  // namespace

std::string to_svg(const Picture& picture) {
    switch (picture.kind) {
        case PictureKind::none:
            break;
        case PictureKind::star:
            return star(picture);
        case PictureKind::curve:
            return curve(picture, false);
        case PictureKind::staircase:
            return curve(picture, true);
    }
    return {};
}

std::string to_html(const Datasheet& sheet) {
    std::string title = "Datasheet";
    std::string device;
    for (const auto& [name, value] : sheet.device) {
        title += name == "device" ? " of " + value : "";
        device += fmt::format("<tr><td>{}</td><td>{}</td></tr>\n", escaped(name), escaped(value));
    }
    std::string out = fmt::format(
        "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" "
        "content=\"width=device-width\"><title>{0}</title><style>{1}</style></head>\n<body>\n"
        "<h1>{0}</h1>\n<p>{3}</p>\n<table>\n{2}</table>\n",
        escaped(title), kStyle, device, how_many_are_known(sheet));
    for (const Section& section : kSections) {
        std::string rows;
        for (const Property& p : sheet.properties) {
            rows += p.section() == section.name ? row(p) : "";
        }
        if (!rows.empty()) {
            out += fmt::format("<h2>{}</h2>\n<table>\n{}</table>\n", section.title, rows);
        }
    }
    return out + "</body></html>\n";
}

}  // namespace probe
