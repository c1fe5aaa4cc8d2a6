// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "fuzz/reduce/edits.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <string_view>
#include <utility>

namespace fuzz {

using cases::TomlEntry;
using Kind = Document::Kind;

namespace {

constexpr std::array<std::string_view, 3> kPerVertex = {"attribute", "clip_distance",
                                                        "cull_distance"};

std::vector<Document>* elements(Document& table, std::string_view key) {
    Document* found = fuzz::find(table, key);
    return found != nullptr && found->is(Kind::array) ? &found->array : nullptr;
}
Document* draw_at(Document& document, size_t d) {
    std::vector<Document>* draws = elements(document, "draw");
    return draws != nullptr && d < draws->size() ? &(*draws)[d] : nullptr;
}
std::string word_of(Document& table, std::string_view key) {
    const Document* found = fuzz::find(table, key);
    return found != nullptr ? found->string : "";
}
bool is_list(Document& draw) {
    const std::string topology = word_of(draw, "topology");
    return topology.empty() || topology == "triangle-list";
}

// What has one element a vertex: positions, values of attributes and distances.
std::vector<std::vector<Document>*> per_vertex(Document& draw) {
    std::vector<std::vector<Document>*> out;
    if (std::vector<Document>* vertices = elements(draw, "vertices"); vertices != nullptr) {
        out.push_back(vertices);
    }
    for (const std::string_view key : kPerVertex) {
        std::vector<Document>* tables = elements(draw, key);
        for (size_t k = 0; tables != nullptr && k < tables->size(); ++k) {
            if (std::vector<Document>* values = elements((*tables)[k], "values");
                values != nullptr) {
                out.push_back(values);
            }
        }
    }
    return out;
}

// False if there is nothing to erase: an edit may come to a document that others have changed.
bool erase_range(std::vector<Document>* from, size_t begin, size_t count) {
    if (from == nullptr || begin + count > from->size()) {
        return false;
    }
    from->erase(from->begin() + static_cast<std::ptrdiff_t>(begin),
                from->begin() + static_cast<std::ptrdiff_t>(begin + count));
    return true;
}

// The table of a path, or nullptr.
Document* find(Document& table, std::string_view outer, std::string_view inner) {
    Document* found = fuzz::find(table, outer);
    return found != nullptr ? fuzz::find(*found, inner) : nullptr;
}
bool erase(Document& table, std::string_view outer, std::string_view inner) {
    Document* found = fuzz::find(table, outer);
    return found != nullptr && fuzz::erase(*found, inner);
}

class Editor {
  public:
    explicit Editor(const Document& document) : document_(document) {}

    std::vector<Edit> all() {
        std::vector<Document>* draws = elements(document_, "draw");
        const size_t count = draws != nullptr ? draws->size() : 0;
        for (size_t d = 0; count > 1 && d < count; ++d) {
            add(fmt::format("without draw {}", d), true,
                [d](Document& document) { return erase_range(elements(document, "draw"), d, 1); });
        }
        for (size_t d = 0; d < count; ++d) {
            drop_triangles(d, (*draws)[d]);
        }
        drop_keys();
        smaller_target();
        for (size_t d = 0; d < count; ++d) {
            plainer_triangles(d, (*draws)[d]);
            simpler_numbers(d, (*draws)[d]);
        }
        move_to_corner();
        return std::move(edits_);
    }

  private:
    void add(std::string what, bool is_feature, std::function<bool(Document&)> apply) {
        edits_.push_back({std::move(what), is_feature, std::move(apply)});
    }
    // An edit of draw d.
    void add_to_draw(size_t d, const std::string& what, bool is_feature,
                     std::function<bool(Document&)> apply) {
        const bool is_only = elements(document_, "draw")->size() == 1;
        add(is_only ? what : fmt::format("draw {} {}", d, what), is_feature,
            [d, apply = std::move(apply)](Document& document) {
                Document* draw = draw_at(document, d);
                return draw != nullptr && apply(*draw);
            });
    }

    // Halves, quarters, ... of the elements, in units that belong together [Zeller, Hildebrandt,
    // "Simplifying and Isolating Failure-Inducing Input", IEEE TSE 28(2), 2002].
    template <class Drop>
    void drop_parts(size_t d, size_t count, size_t unit, size_t least, std::string_view of,
                    const Drop& drop) {
        const size_t units = count / unit;
        for (size_t size = units / 2; size > 0; size /= 2) {
            for (size_t begin = 0; begin + size <= units; begin += size) {
                if (units - size < least) {
                    continue;
                }
                add_to_draw(d, fmt::format("without {} {} to {}", of, begin, begin + size - 1),
                            false,
                            [=](Document& draw) { return drop(draw, begin * unit, size * unit); });
            }
        }
    }

    void drop_triangles(size_t d, Document& draw) {
        const std::vector<Document>* vertices = elements(draw, "vertices");
        if (vertices == nullptr) {
            return;
        }
        const size_t unit = is_list(draw) ? 3 : 1;
        const size_t least = is_list(draw) ? 1 : 3;
        if (const std::vector<Document>* indices = elements(draw, "indices"); indices != nullptr) {
            drop_parts(d, indices->size(), unit, least, is_list(draw) ? "triangles" : "indices",
                       [](Document& of, size_t begin, size_t count) {
                           return erase_range(elements(of, "indices"), begin, count);
                       });
            add_to_draw(d, "without indices", true, write_out_indices);
            add_to_draw(d, "without vertices that no index names", false, drop_unused);
            return;
        }
        drop_parts(d, vertices->size(), unit, least, is_list(draw) ? "triangles" : "vertices",
                   [](Document& of, size_t begin, size_t count) {
                       const auto lists = per_vertex(of);
                       return std::all_of(lists.begin(), lists.end(), [&](auto* list) {
                           return erase_range(list, begin, count);
                       });
                   });
    }

    static bool write_out_indices(Document& draw) {
        const std::vector<Document>* given = elements(draw, "indices");
        const std::vector<Document> indices = given != nullptr ? *given : std::vector<Document>();
        for (std::vector<Document>* list : per_vertex(draw)) {
            std::vector<Document> out;
            for (const Document& index : indices) {
                if (!index.is(Kind::integer) || index.integer < 0 ||
                    static_cast<size_t>(index.integer) >= list->size()) {
                    return false;  // restart
                }
                out.push_back((*list)[static_cast<size_t>(index.integer)]);
            }
            *list = std::move(out);
        }
        return fuzz::erase(draw, "indices");
    }

    static bool drop_unused(Document& draw) {
        std::vector<Document>* const given = elements(draw, "indices");
        std::vector<Document>* const vertices = elements(draw, "vertices");
        if (given == nullptr || vertices == nullptr) {
            return false;
        }
        std::vector<Document>& indices = *given;
        const size_t count = vertices->size();
        std::vector<bool> is_used(count, false);
        for (const Document& index : indices) {
            if (index.is(Kind::integer) && static_cast<size_t>(index.integer) < count) {
                is_used[static_cast<size_t>(index.integer)] = true;
            }
        }
        std::vector<int64_t> now(count, 0);
        int64_t next = 0;
        for (size_t k = 0; k < count; ++k) {
            now[k] = next;
            next += is_used[k] ? 1 : 0;
        }
        if (static_cast<size_t>(next) == count) {
            return false;
        }
        for (std::vector<Document>* list : per_vertex(draw)) {
            for (size_t k = list->size(); k-- > 0;) {
                if (!is_used[k]) {
                    erase_range(list, k, 1);
                }
            }
        }
        for (Document& index : indices) {
            if (index.is(Kind::integer)) {
                index.integer = now[static_cast<size_t>(index.integer)];
            }
        }
        return true;
    }

    // Everything that has a default.
    void drop_keys() {
        add("without relations", true, [](Document& d) { return fuzz::erase(d, "relations"); });
        add("without a colour target", true, [](Document& document) {
            Document* target = fuzz::find(document, "target");
            if (target == nullptr || !fuzz::erase(*target, "color")) {
                return false;
            }
            std::vector<Document>* draws = elements(document, "draw");
            for (size_t d = 0; draws != nullptr && d < draws->size(); ++d) {
                fuzz::erase((*draws)[d], "color");
            }
            fuzz::erase(*target, "attachments");
            return true;
        });
        add("with one layer", true, [](Document& document) {
            Document* target = fuzz::find(document, "target");
            std::vector<Document>* draws = elements(document, "draw");
            for (size_t d = 0; draws != nullptr && d < draws->size(); ++d) {
                fuzz::erase((*draws)[d], "layer");
            }
            return target != nullptr && fuzz::erase(*target, "layers");
        });
        if (Document* target = fuzz::find(document_, "target"); target != nullptr) {
            if (const Document* samples = fuzz::find(*target, "samples"); samples != nullptr) {
                add("with 1 sample", true, [](Document& document) {
                    for (const char* key : {"sample_locations", "resolve", "depth_resolve"}) {
                        erase(document, "target", key);
                    }
                    return erase(document, "target", "samples");
                });
                for (const int64_t fewer : {2, 4, 8}) {
                    if (fewer < samples->integer) {
                        add(fmt::format("with {} samples", fewer), true,
                            [fewer](Document& document) {
                                erase(document, "target", "sample_locations");
                                Document* count = find(document, "target", "samples");
                                if (count == nullptr) {
                                    return false;
                                }
                                count->integer = fewer;
                                return true;
                            });
                    }
                }
            }
            for (const TomlEntry& entry : target->table) {
                const std::string& key = entry.key;
                if (key != "size" && key != "color" && key != "samples" && key != "layers") {
                    add("without " + key, true,
                        [key](Document& document) { return erase(document, "target", key); });
                }
            }
            if (Document* color = fuzz::find(*target, "color"); color != nullptr) {
                add("without a clear colour", false, [](Document& document) {
                    Document* c = find(document, "target", "color");
                    return c != nullptr && fuzz::erase(*c, "clear");
                });
                if (word_of(*color, "format") != "rgba8-unorm") {
                    add("with the colour format rgba8-unorm", true, [](Document& document) {
                        Document* c = find(document, "target", "color");
                        Document* format = c != nullptr ? fuzz::find(*c, "format") : nullptr;
                        if (format == nullptr) {
                            return false;
                        }
                        format->string = "rgba8-unorm";
                        return true;
                    });
                }
            }
        }
        std::vector<Document>* draws = elements(document_, "draw");
        for (size_t d = 0; draws != nullptr && d < draws->size(); ++d) {
            drop_keys_of_draw(d, (*draws)[d]);
        }
    }

    void drop_keys_of_draw(size_t d, Document& draw) {
        for (const std::string_view key : kPerVertex) {
            const std::vector<Document>* tables = elements(draw, key);
            for (size_t k = 0; tables != nullptr && k < tables->size(); ++k) {
                add_to_draw(d, fmt::format("without {} {}", key, k), true, [=](Document& of) {
                    std::vector<Document>* list = elements(of, key);
                    if (!erase_range(list, k, 1)) {
                        return false;
                    }
                    return !list->empty() || fuzz::erase(of, key);
                });
            }
        }
        for (const TomlEntry& entry : draw.table) {
            const std::string& key = entry.key;
            if (key == "vertices" || key == "indices" || key == "space" || key == "color" ||
                (key == "topology" && !is_list(draw)) ||
                std::find(kPerVertex.begin(), kPerVertex.end(), key) != kPerVertex.end()) {
                continue;
            }
            add_to_draw(d, "without " + key, true,
                        [key](Document& of) { return fuzz::erase(of, key); });
            drop_sub_keys(d, entry);
        }
        if (const Document* color = fuzz::find(draw, "color"); color != nullptr) {
            for (const TomlEntry& entry : color->table) {
                if (entry.key != "value" && entry.key != "attribute") {
                    add_to_draw(d, "without " + entry.key, true, [key = entry.key](Document& of) {
                        return erase(of, "color", key);
                    });
                }
            }
        }
        const std::vector<Document>* attributes = elements(draw, "attribute");
        for (size_t a = 0; attributes != nullptr && a < attributes->size(); ++a) {
            drop_keys_of_attribute(d, a, (*attributes)[a]);
        }
    }

    // Of depth, bias and viewport.
    void drop_sub_keys(size_t d, const TomlEntry& entry) {
        if (!entry.value.is(Kind::table) || entry.value.table.size() < 2) {
            if (entry.value.is(Kind::table) && entry.value.find("bias") != nullptr) {
                drop_bias_keys(d, *entry.value.find("bias"));
            }
            return;
        }
        for (const TomlEntry& below : entry.value.table) {
            add_to_draw(d, fmt::format("without {}.{}", entry.key, below.key), true,
                        [outer = entry.key, inner = below.key](Document& of) {
                            return erase(of, outer, inner);
                        });
            if (below.key == "bias") {
                drop_bias_keys(d, below.value);
            }
        }
    }
    void drop_bias_keys(size_t d, const Document& bias) {
        for (const TomlEntry& entry : bias.table) {
            if (bias.table.size() > 1) {
                add_to_draw(d, "without the bias's " + entry.key, true,
                            [key = entry.key](Document& of) {
                                Document* table = find(of, "depth", "bias");
                                return table != nullptr && fuzz::erase(*table, key);
                            });
            }
        }
    }

    void drop_keys_of_attribute(size_t d, size_t a, const Document& attribute) {
        const auto edit = [&](const std::string& what, bool is_feature, auto apply) {
            add_to_draw(d, fmt::format("attribute {} {}", a, what), is_feature,
                        [a, apply](Document& of) {
                            std::vector<Document>* list = elements(of, "attribute");
                            return list != nullptr && a < list->size() && apply((*list)[a]);
                        });
        };
        for (const char* key : {"interpolation", "auxiliary", "name"}) {
            if (attribute.find(key) != nullptr) {
                edit(std::string("without ") + key, true,
                     [key](Document& of) { return fuzz::erase(of, key); });
            }
        }
        if (attribute.find("probe") != nullptr) {
            edit("without probe", true, [](Document& of) {
                for (const char* key : {"sample", "offset", "texture"}) {
                    fuzz::erase(of, key);
                }
                return fuzz::erase(of, "probe");
            });
        }
        const Document* values = attribute.find("values");
        if (values == nullptr || values->array.empty()) {
            return;
        }
        if (values->array.front().is(Kind::array) && values->array.front().array.size() > 1) {
            edit("with one component fewer", false, [](Document& of) {
                std::vector<Document>* list = elements(of, "values");
                for (size_t k = 0; list != nullptr && k < list->size(); ++k) {
                    if ((*list)[k].array.empty()) {
                        return false;
                    }
                    (*list)[k].array.pop_back();
                }
                return list != nullptr;
            });
        }
        edit("constant", true, [](Document& of) {
            const std::vector<Document>* list = elements(of, "values");
            if (list == nullptr || list->empty()) {
                return false;
            }
            set(of, "constant", Document(list->front()));
            return fuzz::erase(of, "values");
        });
        edit("of whole numbers", false, [](Document& of) {
            Document* list = fuzz::find(of, "values");
            return list != nullptr && round_all(*list, 1);
        });
    }

    static std::vector<Document>* size_in(Document& document) {
        Document* target = fuzz::find(document, "target");
        std::vector<Document>* size = target != nullptr ? elements(*target, "size") : nullptr;
        return size != nullptr && size->size() == 2 ? size : nullptr;
    }

    void smaller_target() {
        const std::vector<Document>* size = size_in(document_);
        if (size == nullptr) {
            return;
        }
        for (const size_t axis : {size_t{0}, size_t{1}}) {
            const int64_t side = (*size)[axis].integer;
            for (const int64_t smaller : {int64_t{1}, side / 4, side / 2, side - 4, side - 1}) {
                if (smaller < 1 || smaller >= side) {
                    continue;
                }
                add(fmt::format("with {} of {}", axis == 0 ? "a width" : "a height", smaller),
                    false, [axis, smaller](Document& document) {
                        std::vector<Document>* now = size_in(document);
                        if (now == nullptr || (*now)[axis].integer <= smaller) {
                            return false;
                        }
                        (*now)[axis].integer = smaller;
                        return true;
                    });
            }
        }
    }

    void plainer_triangles(size_t d, Document& draw) {
        if (!is_list(draw) && fuzz::find(draw, "indices") == nullptr) {
            add_to_draw(d, "as a triangle list", true, [](Document& of) {
                const bool is_strip = word_of(of, "topology") == "triangle-strip";
                for (std::vector<Document>* list : per_vertex(of)) {
                    std::vector<Document> out;
                    for (size_t k = 0; k + 2 < list->size(); ++k) {
                        // As Vulkan assembles them, the provoking vertex first ["Primitive
                        // Topologies"].
                        const bool is_odd = is_strip && k % 2 == 1;
                        const size_t second = is_odd ? k + 2 : k + 1,
                                     third = is_odd ? k + 1 : k + 2;
                        if (is_strip) {
                            out.push_back((*list)[k]);
                            out.push_back((*list)[second]);
                            out.push_back((*list)[third]);
                        } else {
                            out.push_back((*list)[k + 1]);
                            out.push_back((*list)[k + 2]);
                            out.push_back((*list)[0]);
                        }
                    }
                    *list = std::move(out);
                }
                return fuzz::erase(of, "topology");
            });
        }
        const bool in_clip = word_of(draw, "space") == "clip";
        const std::vector<Document>* vertices = elements(draw, "vertices");
        if (vertices == nullptr || vertices->empty()) {
            return;
        }
        if (in_clip) {
            if (const std::vector<Document>* size = size_in(document_); size != nullptr) {
                add_to_draw(d, "in pixels", true,
                            [width = number_of((*size)[0]), height = number_of((*size)[1])](
                                Document& of) { return to_pixels(of, width, height); });
            }
            for (Document& vertex : *elements(draw, "vertices")) {
                if (vertex.array.size() == 4 && std::abs(number_of(vertex.array[3]) - 1) > 0) {
                    add_to_draw(d, "with w = 1", true, divide_by_w);
                    break;
                }
            }
            return;
        }
        for (const size_t kept : {size_t{2}, size_t{3}}) {
            if (vertices->front().array.size() > kept) {
                add_to_draw(d, kept == 2 ? "without z and w" : "without w", true,
                            [kept](Document& of) {
                                std::vector<Document>* list = elements(of, "vertices");
                                for (size_t v = 0; list != nullptr && v < list->size(); ++v) {
                                    std::vector<Document>& vertex = (*list)[v].array;
                                    vertex.resize(std::min(vertex.size(), kept));
                                }
                                return list != nullptr;
                            });
            }
        }
    }

    // Clip space to the pixels of a target with the default viewport, to 1/256; false behind the
    // eye.
    static bool to_pixels(Document& draw, double width, double height) {
        std::vector<Document>* vertices = elements(draw, "vertices");
        for (size_t v = 0; vertices != nullptr && v < vertices->size(); ++v) {
            std::vector<Document>& p = (*vertices)[v].array;
            const double w = p.size() == 4 ? number_of(p[3]) : 0;
            if (!(w > 0) || !std::isfinite(w)) {
                return false;
            }
            const auto pixels = [w](const Document& value, double side) {
                return number(std::round((number_of(value) / w + 1) * side / 2 * 256) / 256);
            };
            p = {pixels(p[0], width), pixels(p[1], height), number(number_of(p[2]) / w), p[3]};
        }
        return vertices != nullptr && fuzz::erase(draw, "space");
    }
    static bool divide_by_w(Document& draw) {
        std::vector<Document>* vertices = elements(draw, "vertices");
        for (size_t v = 0; vertices != nullptr && v < vertices->size(); ++v) {
            std::vector<Document>& p = (*vertices)[v].array;
            const double w = p.size() == 4 ? number_of(p[3]) : 0;
            if (!(w > 0) || !std::isfinite(w)) {
                return false;
            }
            for (size_t k = 0; k < 3; ++k) {  // a binary32, as the space wants it
                p[k] = number(static_cast<double>(static_cast<float>(number_of(p[k]) / w)));
            }
            p[3] = number(1);
        }
        return vertices != nullptr;
    }

    // Rounds the numbers to multiples of 1 / parts; false if none changes.
    static bool round_all(Document& value, double parts) {
        bool is_changed = false;
        for (Document& element : value.array) {
            is_changed = round_all(element, parts) || is_changed;
        }
        if (value.is(Kind::floating) && std::isfinite(value.floating)) {
            const double rounded = std::round(value.floating * parts) / parts;
            is_changed = std::abs(rounded - value.floating) > 0;
            value.floating = rounded;
        }
        return is_changed;
    }

    void simpler_numbers(size_t d, Document& draw) {
        const std::vector<Document>* vertices = elements(draw, "vertices");
        if (vertices == nullptr) {
            return;
        }
        for (const double parts : {1.0, 2.0, 4.0, 16.0, 256.0}) {
            add_to_draw(d, fmt::format("with positions in 1/{}", parts), false,
                        [parts](Document& of) {
                            Document* list = fuzz::find(of, "vertices");
                            return list != nullptr && round_all(*list, parts);
                        });
        }
        constexpr size_t kFewVertices = 12;
        for (size_t v = 0; vertices->size() <= kFewVertices && v < vertices->size(); ++v) {
            for (const double parts : {1.0, 2.0, 16.0}) {
                add_to_draw(d, fmt::format("with vertex {} in 1/{}", v, parts), false,
                            [v, parts](Document& of) {
                                std::vector<Document>* list = elements(of, "vertices");
                                return list != nullptr && v < list->size() &&
                                       round_all((*list)[v], parts);
                            });
            }
        }
        for (const char* key : {"viewport", "scissor", "sample_mask", "shader_mask"}) {
            if (const Document* value = fuzz::find(draw, key); value != nullptr) {
                add_to_draw(d, std::string("with whole numbers in ") + key, false,
                            [key](Document& of) {
                                Document* now = fuzz::find(of, key);
                                return now != nullptr && round_all(*now, 1);
                            });
            }
        }
        if (const std::vector<Document>* scissor = elements(draw, "scissor");
            scissor != nullptr && scissor->size() == 4) {
            for (size_t k = 0; k < 2; ++k) {  // its corner, one by one
                add_to_draw(d, k == 0 ? "with a scissor from x = 0" : "with a scissor from y = 0",
                            false, [k](Document& of) {
                                std::vector<Document>* now = elements(of, "scissor");
                                if (now == nullptr || now->size() != 4 || (*now)[k].integer == 0) {
                                    return false;
                                }
                                (*now)[k].integer = 0;
                                return true;
                            });
            }
        }
    }

    // What is drawn far from the origin comes nearer by whole pixels, and the target gets smaller.
    void move_to_corner() {
        for (const size_t axis : {size_t{0}, size_t{1}}) {
            for (const int64_t by : {8, 4, 2, 1}) {
                add(fmt::format("moved by {} pixels in {}", by, axis == 0 ? "x" : "y"), false,
                    [axis, by](Document& document) { return move(document, axis, by); });
            }
        }
    }
    static bool move(Document& document, size_t axis, int64_t by) {
        std::vector<Document>* size = size_in(document);
        std::vector<Document>* draws = elements(document, "draw");
        if (size == nullptr || draws == nullptr || (*size)[axis].integer <= by) {
            return false;
        }
        (*size)[axis].integer -= by;
        for (Document& draw : *draws) {
            std::vector<Document>* vertices = elements(draw, "vertices");
            if (vertices == nullptr || word_of(draw, "space") == "clip") {
                return false;
            }
            for (Document& vertex : *vertices) {
                if (vertex.array.size() <= axis) {
                    return false;
                }
                Document& coordinate = vertex.array[axis];
                coordinate = number(number_of(coordinate) - static_cast<double>(by));
            }
            for (const char* key : {"viewport", "scissor"}) {
                if (std::vector<Document>* rectangle = elements(draw, key);
                    rectangle != nullptr && rectangle->size() == 4) {
                    Document& corner = (*rectangle)[axis];
                    if (corner.is(Kind::integer)) {
                        corner.integer -= by;
                    } else {
                        corner = number(number_of(corner) - static_cast<double>(by));
                    }
                }
            }
        }
        return true;
    }

    Document document_;
    std::vector<Edit> edits_;
};

}  // namespace

std::vector<Edit> edits(const Document& document) {
    return Editor(document).all();
}

}  // namespace fuzz
