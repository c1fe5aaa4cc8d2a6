// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Pictures of what was drawn, or blitted, without any device: for the command "render".
#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <string>

#include "capture/capture.hpp"
#include "capture/image/image.hpp"
#include "cases/model/case.hpp"
#include "cli/prepare/outputs.hpp"
#include "cli/prepare/suite.hpp"

namespace cli {

// One picture in the three forms that "render" writes; each is made when it is asked for, and may
// refer to the case.
struct Drawing {
    std::function<void(const cases::Put& put)> json;
    std::function<capture::Image()> values;   // as many channels as there are values
    std::function<capture::Image()> picture;  // to look at: R, G, B in 0..1, the samples of a
                                              // pixel in turn
};

// A JSON object whose last member, `name`, is a list: put entry by entry, a line each.
class JsonList {
  public:
    // The object without that member, which is not empty.
    JsonList(const nlohmann::ordered_json& object, const std::string& name, const cases::Put& put);
    void add(const nlohmann::ordered_json& entry);
    // What `entry` gives of each number below `count`, in that order, without the nulls. Threads
    // make them, `lanes` at a time, each with a lane of its own (below `lanes`).
    void add_all(size_t count, size_t lanes,
                 const std::function<nlohmann::ordered_json(size_t number, size_t lane)>& entry);
    void end();

  private:
    const cases::Put& put_;
    bool is_empty_ = true;
};

// The picture with pixels of `scale` x `scale` (0: so many that the longer side has nearly 512),
// each a grid of its samples, sample 0 at the top left (2: side by side; 4: 2 x 2; 8: 4 x 2; 16:
// 4 x 4). Where a pixel is too small for that, its samples are averaged.
capture::Image enlarged(const capture::Image& picture, uint32_t samples, uint32_t scale);

// What `renderer` draws of a case with draws: "reference", or an algorithm. Planes that the case
// does not attach are drawn too. Error: why that renderer cannot draw it.
Drawing draw_picture(const cases::Case& c, const std::string& renderer);

// What the destination of a blit must hold, texel by texel.
Drawing blit_picture(const cases::Case& c, cases::Profile profile);

}  // namespace cli
