// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "rasterizers/strength/picture.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>

#include "cases/fault/fault.hpp"

namespace software {

namespace {

using capture::Capture;
using cases::operator""_fault;

// Draws that the device draws more than once, or in another order, keep their numbers.
void renumber(Capture& picture, uint32_t (*number)(uint32_t)) {
    for (capture::Writer& writer : picture.writers) {
        writer.draw = writer.draw == capture::kClearId ? writer.draw : number(writer.draw);
    }
}

// Rounds depths that were drawn to multiples of 1/65535.
float in_sixteen_bits(float depth) {
    return std::isfinite(depth) ? std::round(depth * 65535.0F) / 65535.0F : depth;
}
void round_stored(Capture& picture) {
    for (float& depth : picture.depth) {
        const bool is_clear = std::equal_to<>()(depth, picture.target.depth_clear);
        depth = is_clear ? depth : in_sixteen_bits(depth);
    }
}
void round_all(Capture& picture) {
    round_stored(picture);
    for (size_t k = 0; k < picture.frag_coord.size(); ++k) {
        if (k < picture.writers.size() && picture.writers[k].draw != capture::kClearId) {
            picture.frag_coord[k].z = in_sixteen_bits(picture.frag_coord[k].z);
        }
    }
}

// Moves entries of a picture: entry (x, y) is taken from (x + dx, y + dy) where there is one.
void shift(Capture& picture, int64_t dx, int64_t dy) {
    const int64_t width = picture.target.width;
    const int64_t height = picture.target.rows();
    capture::for_each_plane(
        [&](const capture::Plane& plane, auto& entries) {
            if (entries.empty()) {
                return;
            }
            const auto per_pixel =
                static_cast<int64_t>(plane.entries) / std::max<int64_t>(1, width * height);
            const auto old = entries;
            for (int64_t y = 0; y < height; ++y) {
                for (int64_t x = 0; x < width; ++x) {
                    const int64_t from =
                        std::min(y + dy, height - 1) * width + std::min(x + dx, width - 1);
                    for (int64_t s = 0; s < per_pixel; ++s) {
                        entries[static_cast<size_t>((y * width + x) * per_pixel + s)] =
                            old[static_cast<size_t>(from * per_pixel + s)];
                    }
                }
            }
        },
        picture, picture);
}

struct PictureBody {
    cases::Fault fault;
    void (*change)(Capture&);
};
constexpr PictureBody kPictureBodies[] = {
    {"draw-each-twice"_fault,
     [](Capture& p) { renumber(p, [](uint32_t draw) { return draw / 2; }); }},
    {"draw-second-twice"_fault,
     [](Capture& p) { renumber(p, [](uint32_t draw) { return draw < 2 ? draw : draw - 1; }); }},
    {"draws-swapped"_fault,
     [](Capture& p) { renumber(p, [](uint32_t draw) { return draw < 2 ? 1 - draw : draw; }); }},
    {"depth-16-bits"_fault, round_all},
    {"depth-16-bits-stored"_fault, round_stored},
    {"read-back-right"_fault, [](Capture& p) { shift(p, 1, 0); }},
    {"read-back-below"_fault, [](Capture& p) { shift(p, 0, 1); }},
};

const PictureBody* picture_body_of(cases::Fault fault) {
    const auto* body = std::ranges::find(kPictureBodies, fault, &PictureBody::fault);
    return body == std::end(kPictureBodies) ? nullptr : body;
}

}  // namespace

bool has_picture(cases::Fault fault) {
    return picture_body_of(fault) != nullptr;
}

void spoil(cases::Fault fault, Capture& picture) {
    if (const PictureBody* body = picture_body_of(fault)) {
        body->change(picture);
    }
}

}  // namespace software
