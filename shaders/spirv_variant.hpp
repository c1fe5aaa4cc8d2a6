// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Changes the decorations of a compiled fragment shader's inputs, and its execution modes.
// Interpolation and auxiliary qualifiers are decorations in SPIR-V and nothing else, so one module
// serves all combinations of them. Source: SPIR-V specification 1.3, sections 2.3 "Physical
// Layout", 2.4 "Logical Layout", 3.20 "Decoration", 3.21 "BuiltIn", 3.31 "Capability".
#pragma once

#include <compare>
#include <cstdint>
#include <span>
#include <string>
#include <tl/expected.hpp>
#include <vector>

#include "shaders/shaders.hpp"

namespace shaders {

// A changed module, or in one sentence why there is none.
using Changed = tl::expected<std::vector<uint32_t>, std::string>;

// How one Input variable is found: by its Location or by its BuiltIn.
enum class InputBy : uint8_t { location, built_in };

// The decorations that one Input variable shall get.
struct InputChange {
    InputBy by = InputBy::location;
    uint32_t number = 0;  // the Location or the BuiltIn
    bool flat = false, no_perspective = false, centroid = false, sample = false;
    bool becomes_primitive_id = false;  // BuiltIn PrimitiveId takes the place of its Location
    friend auto operator<=>(const InputChange&, const InputChange&) = default;
};

inline constexpr uint32_t kBuiltInBaryCoord = 5286, kBuiltInBaryCoordNoPersp = 5287;

// The module with these changes, and with the capabilities that they need: Sample needs
// SampleRateShading, PrimitiveId needs Geometry. Errors, one sentence each: not a SPIR-V module of
// version 1.0 to 1.6 in this machine's byte order, instructions that run over its end, decoration
// groups (which hide who is decorated), no Input variable or several with that number, a decoration
// that is there already or contradicts another.
Changed change_inputs(std::span<const uint32_t> module, std::span<const InputChange> changes);

// Which output each of several colours keeps, and where the first of them lies.
struct OutputChange {
    uint32_t first_location = 0;
    std::vector<Output> kept;  // by colour; empty: the module is left as it is
    friend auto operator<=>(const OutputChange&, const OutputChange&) = default;
};

// The module of a fragment shader that has three outputs for each of several colours from
// first_location on, numbered as Output, with the one that each colour keeps at the location of the
// colour. All others become Private variables, so that nothing is written. Errors:
// as above, and outputs that are not there.
Changed with_outputs(std::span<const uint32_t> module, const OutputChange& change);

// The module of a vertex or fragment shader with one more output, a vec4 at that location, to which
// its entry point writes a constant first of all. Errors: as above, and no entry point, no type of
// binary32, or an output at that location.
Changed with_unused_output(std::span<const uint32_t> module, uint32_t location);

// The module of a fragment shader with one subpass input, which gets that InputAttachmentIndex.
// Errors: as above, and no such input, or several.
Changed with_input_index(std::span<const uint32_t> module, uint32_t index);

// Execution modes of fragment shaders (3.6 "Execution Mode").
enum ExecutionMode : uint32_t {
    kEarlyFragmentTests = 9,
    kDepthGreater = 14,
    kDepthLess = 15,
    kDepthUnchanged = 16,
};

// The module of a fragment shader with one entry point, with more execution modes. Errors: as
// above, and no entry point or execution mode.
Changed with_modes(std::span<const uint32_t> module, std::span<const uint32_t> modes);

// What takes the place of OpKill.
enum class Ending : uint8_t { kill, demote, terminate };

// The module of a fragment shader that discards at its end, by another instruction:
// OpDemoteToHelperInvocation and OpReturn (SPV_EXT_demote_to_helper_invocation), or
// OpTerminateInvocation (SPV_KHR_terminate_invocation). Errors: as above, and no OpKill.
Changed with_ending(std::span<const uint32_t> module, Ending ending);

}  // namespace shaders
