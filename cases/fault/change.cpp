// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "cases/fault/change.hpp"

#include <array>

#include "cases/fault/bodies.hpp"

namespace cases {

namespace {

const fault::Body* body_of(Fault of) {
    static const auto kBodies = [] {
        std::array<const fault::Body*, std::size(kFaults) + 1> bodies{};
        for (const auto table :
             {fault::geometry_bodies(), fault::input_bodies(), fault::depth_bodies(),
              fault::clear_bodies(), fault::target_bodies()}) {
            for (const fault::Body& body : table) {
                bodies[static_cast<size_t>(body.fault)] = &body;
            }
        }
        return bodies;
    }();
    return kBodies[static_cast<size_t>(of)];
}

// Changes the parts of a case.
struct Changing {
    Case& c;
    bool operator()(fault::ChangeOf<Case> change) const { return change(c); }
    bool operator()(fault::ChangeOf<Draw> change) const { return each(change); }
    bool operator()(fault::ChangeOf<Attribute> change) const {
        return each([&](Draw& d) { return fault::any_of(d.attributes, change); });
    }
    bool operator()(fault::ChangeOf<glm::vec4> change) const {
        return each([&](Draw& d) { return fault::any_of(d.positions, change); });
    }
    bool operator()(fault::ChangeOf<DepthBias> change) const {
        return each([&](Draw& d) { return d.depth.bias && change(*d.depth.bias); });
    }
    bool operator()(fault::ChangeOf<StencilFace> change) const {
        return c.target.has_stencil && each([&](Draw& d) {
                   const bool front = change(d.stencil.front);
                   return change(d.stencil.back) || front;
               });
    }
    bool operator()(fault::ChangeOf<Blend> change) const {
        return each([&](Draw& d) { return d.color.blend && change(*d.color.blend); });
    }
    bool operator()(fault::ChangeOf<BlendEquation> change) const {
        return each([&](Draw& d) {
            const bool color = d.color.blend && change(d.color.blend->color);
            return (d.color.blend && change(d.color.blend->alpha)) || color;
        });
    }
    template <class ChangeDraw>
    bool each(const ChangeDraw& change) const {
        return fault::any_of(c.draws, change);
    }
};

}  // namespace

bool has_change(Fault fault) {
    return body_of(fault) != nullptr;
}

bool take_with(Fault fault, Case& c) {
    const fault::Body* body = body_of(fault);
    return body != nullptr && std::visit(Changing{c}, body->change);
}

}  // namespace cases
