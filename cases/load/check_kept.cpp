// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <functional>

#include "cases/load/parts.hpp"
#include "cases/model/derive.hpp"

namespace cases {

namespace {

// Whether a draw or a clear may write to the aspect, and whether what it does depends on it.
struct Use {
    bool writes = false, tests = false;
};

Use use_of_depth(const Draw& draw) {
    if (draw.clear) {
        return {draw.clear->depth.has_value(), false};
    }
    return {draw.depth.write, draw.depth.compare != CompareOp::always || draw.depth.bounds};
}

Use use_of_stencil(const Draw& draw) {
    if (draw.clear) {
        return {draw.clear->stencil.has_value(), false};
    }
    Use out;
    for (const StencilFace& face : {draw.stencil.front, draw.stencil.back}) {
        out.writes = out.writes || (face.write_mask & kStencilBits) != 0;
        out.tests = out.tests || face.compare != CompareOp::always;
    }
    return out;
}

// The operations of one aspect, by the names of their keys in a table.
struct Aspect {
    const TomlValue& table;
    const char* load_key;
    const char* store_key;
    LoadOp load;
    StoreOp store;
    std::function<Use(const Draw&)> use_of;
};

// Of an aspect that the pass does not store and leaves as it is: "If values are written during the
// render pass", nothing is known of them (VkAttachmentStoreOp), and what is not loaded is unknown
// within the pass alone (VkAttachmentLoadOp).
void check_aspect(LeafContext& context, const Aspect& aspect, const Case& c) {
    const auto any = [&](bool Use::*is) {
        return std::ranges::any_of(c.draws, [&](const Draw& d) { return aspect.use_of(d).*is; });
    };
    if (aspect.load == LoadOp::none && (aspect.store != StoreOp::none || any(&Use::tests))) {
        context.error(
            aspect.table.find(aspect.load_key)->where,
            fmt::format("{} = \"none\" leaves contents that nothing may test nor store; write {} = "
                        "\"none\", and no test of it",
                        aspect.load_key, aspect.store_key));
    } else if (aspect.store == StoreOp::none && (!is_loaded(aspect.load) || any(&Use::writes))) {
        context.error(
            aspect.table.find(aspect.store_key)->where,
            fmt::format("{} = \"none\" keeps what an earlier pass has left, if nothing is written; "
                        "write {} = \"load\", and draws that write none of it",
                        aspect.store_key, aspect.load_key));
    }
}

}  // namespace

void check_kept(LeafContext& context, const TomlValue& table, const Case& c) {
    const Target& t = c.target;
    check_aspect(context,
                 {table, "depth_load", "depth_store", t.depth_load, t.depth_store, use_of_depth},
                 c);
    check_aspect(
        context,
        {table, "stencil_load", "stencil_store", t.stencil_load, t.stencil_store, use_of_stencil},
        c);
    if (!t.color) {
        return;
    }
    const TomlValue& color = *table.find("color");
    const bool is_list = color.is(TomlValue::Kind::array);
    for (uint32_t k = 0; k < t.color_count(); ++k) {
        const ColorTarget& target = t.color_at(k);
        const auto use_of = [&t, k](const Draw& draw) {
            // A clear is of the judged colour (Clear::color).
            const bool writes = draw.clear ? k == t.judged_color && draw.clear->color
                                           : output_at(t, draw, k).write_mask != 0;
            return Use{writes, false};
        };
        check_aspect(
            context,
            {is_list ? color.array[k] : color, "load", "store", target.load, target.store, use_of},
            c);
    }
}

}  // namespace cases
