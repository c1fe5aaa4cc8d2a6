// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The device's colour attachment: each fragment is converted, masked and blended when it is drawn,
// in integers where the format has 8 bits of fixed point, in binary32 elsewhere.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec4.hpp>
#include <vector>

#include "capture/capture.hpp"
#include "cases/model/case.hpp"
#include "rasterizers/software/choice/device.hpp"
#include "rasterizers/software/target/store.hpp"

namespace software {

class BlendUnit {
  public:
    // The device must outlive this object.
    BlendUnit(cases::ColorFormat format, const Device& device);

    Texel cleared(const glm::vec4& color) const;
    // The texel after a fragment whose shader wrote `written`.
    Texel write(const cases::ColorOutput& output, const glm::vec4& written,
                const Texel& before) const;
    // Its codes, red first.
    capture::ColorCodes read_back(const Texel& texel) const;
    // Source blended into destination, binary32: whatever the format is.
    glm::vec4 blend(const cases::Blend& blend, const glm::vec4& source,
                    const glm::vec4& destination) const;

  private:
    uint8_t mask_of(const cases::ColorOutput& output) const;
    // What the shader wrote, after alpha to one.
    glm::vec4 replaced(const cases::ColorOutput& output, const glm::vec4& written) const;
    // A component of a source as blending in fixed point takes it.
    float source_of_blending(float v) const;
    std::array<uint32_t, 4> blend_fixed(const cases::Blend& blend,
                                        const std::array<uint32_t, 4>& source,
                                        const std::array<uint32_t, 4>& destination) const;
    bool is_fixed() const;  // the target is of fixed point

    const Device& device_;
    cases::ColorFormat format_;
    FormatLayout layout_;
};

// The judged colour target of a case, in drawing order.
class ColorAttachment {
  public:
    // Both must outlive this object.
    ColorAttachment(const cases::Case& c, const Device& device);

    // A fragment of a primitive that has passed all tests, at one sample.
    void write(size_t sample, uint32_t draw, uint32_t primitive, const glm::vec4& value);
    // What a clear among the draws, which is their number `draw`, leaves.
    void clear(size_t sample, uint32_t draw);
    // What other attachments hold of `value`: the value itself.
    glm::vec4 beside(uint32_t draw, const glm::vec4& value, const glm::vec4& before) const;
    // What is read back; empty if the case has no colour target.
    std::vector<capture::ColorCodes> read_back() const;

  private:
    const cases::ColorOutput& output_of(uint32_t draw) const;
    void write_sample(size_t index, uint32_t draw, uint32_t primitive, const glm::vec4& source);

    const cases::Case& case_;
    const Device& device_;
    std::vector<cases::ColorOutput>
        outputs_;  // by draw, with the state that the device has in mind
    BlendUnit unit_;
    std::vector<Texel> texels_;
    struct Last {  // the fragment before
        uint32_t draw = UINT32_MAX, primitive = UINT32_MAX;
        Texel before{};
    };
    std::vector<Last> last_;
    uint32_t draw_ = 0;  // of the last fragment
};

}  // namespace software
