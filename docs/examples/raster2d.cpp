// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The textbook rasterizer: an edge function, a loop over all pixels, barycentric coordinates.
//
//     c++ -std=c++20 -O2 -o raster2d raster2d.cpp          (needs nlohmann/json.hpp)
//     usage: raster2d EXPORT CAPTURES [--reverse-ties]
//
// It draws the cases in EXPORT ('edgecase export') that need nothing but triangles with w = 1 and
// writes raw planes into CAPTURES for 'edgecase diff'. For each pixel centre P and triangle V0V1V2
//     E_ab(P)  = (b - a) x (P - a)                 twice the signed area of a, b, P
//     lambda_i = E_jk(P) / E_01(V2)                barycentric coordinates
//     value    = lambda_0 f_0 + lambda_1 f_1 + lambda_2 f_2
// P is inside if all E > 0; on an edge (E = 0) if that is a top or a left edge. Vertices are
// rounded to 1/256 pixel first, so that E is exact in 64 bits and a shared edge has no crack.
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

static_assert(std::endian::native == std::endian::little, "raw planes are little endian");
namespace fs = std::filesystem;
using Json = nlohmann::json;

struct Point {
    int64_t x, y;  // in 1/256 pixel
};

int64_t edge_function(const Point& a, const Point& b, const Point& p) {
    return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
}

// Whether a point on the edge a -> b counts as inside, the triangle lying to its right (y goes
// down): a top edge is horizontal and leads right, a left edge leads up.
bool is_top_left(const Point& a, const Point& b) {
    return b.y < a.y || (b.y == a.y && b.x > a.x);
}

Json read_json(const fs::path& file) {
    return Json::parse(std::ifstream(file));
}

template <class T>
void write_plane(const fs::path& file, const std::vector<T>& plane) {
    std::ofstream(file, std::ios::binary)
        .write(reinterpret_cast<const char*>(plane.data()),
               static_cast<std::streamsize>(plane.size() * sizeof(T)));
}

void draw_case(const Json& c, const fs::path& folder, bool reverse_ties) {
    const int64_t width = c["target"]["width"], height = c["target"]["height"];
    const auto count = static_cast<size_t>(width * height);
    std::vector<uint8_t> hits(2 * count);  // front, back
    std::vector<std::vector<float>> attributes;
    std::vector<size_t> components;
    for (const Json& plane : c["captures"]["planes"]) {
        if (plane["name"].get<std::string>().starts_with("attribute")) {
            components.push_back(plane["channels"].size());
            attributes.emplace_back(count * components.back(), plane["clear"].get<float>());
        }
    }
    for (const Json& draw : c["draws"]) {
        for (size_t t = 0; t < draw["triangles"].size(); ++t) {
            const std::array<size_t, 3> vertex = draw["triangles"][t];
            std::array<Point, 3> v;
            for (size_t k = 0; k < 3; ++k) {  // clip space with w = 1 -> framebuffer
                const Json& p = draw["positions"][vertex[k]];
                const auto snap = [](double ndc, int64_t side) {
                    return std::llround((ndc + 1) * static_cast<double>(side) * 128);
                };
                v[k] = {snap(p[0], width), snap(p[1], height)};
            }
            const int64_t area = edge_function(v[0], v[1], v[2]);
            if (area == 0) {
                continue;
            }
            const bool is_front = (area > 0) == (draw["front_face"] == "clockwise");
            for (int64_t y = 0; y < height; ++y) {
                for (int64_t x = 0; x < width; ++x) {
                    const Point p{x * 256 + 128, y * 256 + 128};
                    std::array<double, 3> lambda{};
                    bool inside = true;
                    for (size_t k = 0; k < 3; ++k) {
                        const Point &a = v[(k + 1) % 3], &b = v[(k + 2) % 3];
                        const int64_t e = edge_function(a, b, p);
                        lambda[k] = static_cast<double>(e) / static_cast<double>(area);
                        const bool owned = area > 0 ? is_top_left(a, b) : is_top_left(b, a);
                        inside = inside && (lambda[k] > 0 || (e == 0 && owned != reverse_ties));
                    }
                    if (!inside) {
                        continue;
                    }
                    const auto at = static_cast<size_t>(y * width + x);
                    ++hits[2 * at + (is_front ? 0 : 1)];
                    for (size_t a = 0; a < draw["attributes"].size(); ++a) {
                        const Json& attribute = draw["attributes"][a];
                        const bool flat = attribute["interpolation"] == "flat";
                        const Json& values = attribute["values"];
                        for (size_t i = 0; i < values[0].size(); ++i) {
                            double f = 0;
                            for (size_t k = 0; k < 3; ++k) {
                                f += lambda[k] * values[vertex[k]][i].get<double>();
                            }
                            attributes[a][at * components[a] + i] =
                                static_cast<float>(flat ? values[vertex[0]][i].get<double>() : f);
                        }
                    }
                }
            }
        }
    }
    write_plane(folder / "hits.u8", hits);
    for (size_t a = 0; a < attributes.size(); ++a) {
        write_plane(folder / ("attribute" + std::to_string(a) + ".f32"), attributes[a]);
    }
}

int main(int argc, char** argv) {
    if (argc < 3) {
        std::fputs("usage: raster2d EXPORT CAPTURES [--reverse-ties]\n", stderr);
        return 2;
    }
    const fs::path from = argv[1], to = argv[2];
    const bool reverse_ties = argc > 3 && std::string(argv[3]) == "--reverse-ties";
    const std::set<std::string> can = {"strip",   "fan",          "indices",
                                       "restart", "restart-list", "beyond-viewport"};
    const Json index = read_json(from / "index.json");
    for (const Json& entry : index["cases"]) {
        const fs::path folder = to / entry["folder"].get<std::string>();
        fs::create_directories(folder);
        std::string missing;
        for (const std::string need : entry["needs"]) {
            missing += can.contains(need) ? "" : " " + need;
        }
        if (missing.empty()) {
            draw_case(read_json(from / entry["file"].get<std::string>()), folder, reverse_ties);
        } else {
            std::ofstream(folder / "unsupported.txt") << "raster2d cannot draw:" << missing << "\n";
        }
    }
}
