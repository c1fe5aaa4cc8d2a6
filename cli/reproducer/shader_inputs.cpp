// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/reproducer/shader_inputs.hpp"

#include <algorithm>
#include <span>

#include "cases/format/color_format.hpp"
#include "cases/model/derive.hpp"
#include "shaders/spirv_variant.hpp"

namespace cli {

namespace {

shaders::FragmentVariant variant_of(const cases::Draw& d, const Inputs& inputs) {
    shaders::FragmentVariant v;
    v.attributes = static_cast<uint32_t>(inputs.attributes.size());
    v.split = inputs.has_instruments;
    v.instruments = inputs.has_instruments;
    v.color = inputs.color;
    v.mask_out = d.multisample.shader_mask.has_value();
    for (const cases::Attribute* a : inputs.attributes) {
        if (a == nullptr) {
            continue;
        }
        v.barycentrics = v.barycentrics || a->source == cases::Source::barycentric;
        v.mask_in = v.mask_in || a->source == cases::Source::sample_mask_in;
        v.sample = v.sample || a->source == cases::Source::sample_id ||
                   a->source == cases::Source::sample_position;
        v.probes = v.probes || a->probe != cases::Probe::value;
        v.lod = v.lod || a->probe == cases::Probe::lod;
    }
    v.mask_in = v.mask_in || v.sample;  // compiled together
    return v;
}

}  // namespace

Inputs inputs_of(const cases::Case& c, const cases::Draw& d) {
    Inputs out;
    out.has_instruments = c.target.has_instruments;
    if (c.target.color) {
        out.color = cases::is_integer(c.target.color->format) ? shaders::ColorKind::integer
                                                              : shaders::ColorKind::number;
    }
    const auto add = [&](size_t k) {
        out.attributes.push_back(k < d.attributes.size() ? &d.attributes[k] : nullptr);
    };
    if (out.has_instruments) {
        for (size_t k = 0; k < cases::attributes_of(c); ++k) {
            add(k);
        }
    } else if (std::ranges::any_of(
                   c.draws, [](const cases::Draw& draw) { return draw.color.attribute >= 0; })) {
        // The colour alone; of a draw without such an attribute it is a constant.
        add(d.color.attribute >= 0 ? static_cast<size_t>(d.color.attribute) : d.attributes.size());
    }
    return out;
}

std::vector<uint32_t> Inputs::fragment_code(const cases::Draw& d) const {
    const std::span<const uint32_t> code = shaders::capture_fragment(variant_of(d, *this));
    if (code.empty()) {
        return {};
    }
    std::vector<shaders::InputChange> changes;
    for (size_t k = 0; k < attributes.size(); ++k) {
        shaders::InputChange change;
        change.number = static_cast<uint32_t>(1 + k);
        const cases::Attribute* a = attributes[k];
        if (a == nullptr) {
            change.flat = true;
            changes.push_back(change);
            continue;
        }
        change.flat = a->interpolation == cases::Interpolation::flat;
        change.no_perspective = a->interpolation == cases::Interpolation::noperspective;
        change.centroid = a->auxiliary == cases::Auxiliary::centroid;
        change.sample = a->auxiliary == cases::Auxiliary::sample;
        if (a->source == cases::Source::barycentric) {
            change.by = shaders::InputBy::built_in;
            change.number = change.no_perspective ? shaders::kBuiltInBaryCoordNoPersp
                                                  : shaders::kBuiltInBaryCoord;
            change.no_perspective = false;
        } else if (a->source != cases::Source::vertex) {
            continue;
        }
        const bool is_change =
            change.flat || change.no_perspective || change.centroid || change.sample;
        if (is_change && std::ranges::find(changes, change) == changes.end()) {
            changes.push_back(change);
        }
    }
    const std::vector<uint32_t> changed = shaders::change_inputs(code, changes).value();
    if (color != shaders::ColorKind::integer) {
        return changed;
    }
    const auto first = static_cast<uint32_t>(has_instruments ? 4 + attributes.size() : 0);
    return shaders::with_outputs(changed, {first, {shaders::Output::whole}}).value();
}

uint32_t Inputs::choice(size_t k) const {
    const cases::Attribute* a = attributes[k];
    if (a == nullptr) {
        return 0;
    }
    switch (a->source) {
        case cases::Source::barycentric:
            return static_cast<uint32_t>(a->interpolation == cases::Interpolation::noperspective
                                             ? shaders::Choice::barycentric_linear
                                             : shaders::Choice::barycentric);
        case cases::Source::sample_mask_in:
            return static_cast<uint32_t>(shaders::Choice::sample_mask_in);
        case cases::Source::sample_id:
            return static_cast<uint32_t>(shaders::Choice::sample_id);
        case cases::Source::sample_position:
            return static_cast<uint32_t>(shaders::Choice::sample_position);
        case cases::Source::shading_rate:  // of no case that becomes a program
        case cases::Source::vertex:
            break;
    }
    return static_cast<uint32_t>(a->probe);
}

std::span<const uint32_t> vertex_code(const cases::Case& c, const cases::Draw& d) {
    shaders::VertexVariant vertex;
    vertex.attributes = static_cast<uint32_t>(inputs_of(c, d).attributes.size());
    vertex.clip_count = d.distances.clip_count;
    vertex.cull_count = d.distances.cull_count;
    vertex.layer =
        std::ranges::any_of(c.draws, [](const cases::Draw& draw) { return draw.layer > 0; });
    return shaders::capture_vertex(vertex);
}

bool has_shaders(const cases::Case& c) {
    const auto all_have = [](const cases::Case& drawn) {
        return std::ranges::all_of(drawn.draws, [&](const cases::Draw& d) {
            return !vertex_code(drawn, d).empty() &&
                   !shaders::capture_fragment(variant_of(d, inputs_of(drawn, d))).empty();
        });
    };
    const std::vector<cases::Derivation> derivations = cases::derivations(c);
    return all_have(c) && std::ranges::all_of(derivations, [&](const auto& d) {
               return all_have(cases::derive(c, d));
           });
}

}  // namespace cli
