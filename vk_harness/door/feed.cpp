// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "vk_harness/door/feed.hpp"

#include <algorithm>
#include <cstring>

#include "capture/capture.hpp"
#include "cases/model/instances.hpp"
#include "cases/model/triangle.hpp"
#include "vk_harness/device/clip_support.hpp"
#include "vk_harness/target/shader_interface.hpp"

namespace vk_harness {

using cases::Door;

namespace {

constexpr uint32_t kSkippedIndices = 7;  // before the first, if a draw does not begin with it
constexpr uint32_t kRestart16 = 65535;   // a vertex like any other among indices of 32 bits
constexpr uint32_t kNegativeOffset = 9;  // what is taken off again by vertexOffset
constexpr uint32_t kInstance = 2;        // the element that is read once an instance
constexpr uint32_t kInstances = shaders::kShownInstance + 1;  // that there are inputs of
constexpr VkDeviceSize kAlignment = 16;      // of everything that is bound as usual
constexpr VkDeviceSize kCommandStride = 32;  // of several commands: longer than one is

// What must not be read: a coordinate far outside of every target, no index of a vertex of a draw,
// a number of vertices that draws nothing but would be seen if it were read as anything else.
constexpr uint32_t kForeign = 0x4b4b4b4bU;  // as binary32: 13323083

VkDeviceSize aligned(VkDeviceSize offset, VkDeviceSize to = kAlignment) {
    return (offset + to - 1) / to * to;
}

bool is_indirect(Door door) {
    return door == Door::indirect || door == Door::indirect_count || door == Door::multi_indirect ||
           door == Door::indirect_after_count;
}

// What a driver reads at a wrong place of a buffer shall not depend on what else is drawn.
bool has_own_buffers(Door door) {
    return door == Door::separate_buffers || door == Door::memory_imported || is_indirect(door);
}

// Doors that draw by indices whatever the case does.
bool makes_indices(Door door) {
    switch (door) {
        case Door::index_8:
        case Door::index_16:
        case Door::index_32:
        case Door::index_8_largest:
        case Door::index_16_largest:
        case Door::first_index:
        case Door::vertex_offset:
        case Door::vertex_offset_negative:
        case Door::index_offset:
            return true;
        default:
            return false;
    }
}

bool moves_index_buffer(Door door) {
    return door == Door::index_offset || door == Door::indirect_count;
}

VkIndexType index_type_of(Door door) {
    switch (door) {
        case Door::index_8:
        case Door::index_8_largest:
            return VK_INDEX_TYPE_UINT8_EXT;
        case Door::index_16:
        case Door::index_16_largest:
            return VK_INDEX_TYPE_UINT16;
        default:
            return VK_INDEX_TYPE_UINT32;
    }
}

uint32_t largest_of(VkIndexType type) {
    return type == VK_INDEX_TYPE_UINT8_EXT ? 0xff
           : type == VK_INDEX_TYPE_UINT16  ? 0xffff
                                           : 0xffffffffU;
}

}  // namespace

Feed::Feed(const cases::Case& c, const cases::Draw& draw, const VertexWay& way)
    : draw_(&draw),
      door_(c.variation.door),
      way_(way),
      bindings_(bindings_of(input_count(c), draw.distances.clip_count, draw.distances.cull_count,
                            way.instances == shaders::Instances::placed)) {
    values_[0] = cases::base_positions(draw);
    for (uint32_t k = 0; k < input_count(c); ++k) {
        const cases::Attribute* attribute = input_attribute(c, draw, k);
        if (attribute != nullptr && attribute->source == cases::Source::vertex) {
            values_[1 + k] = cases::elements_read(draw, attribute->values, attribute->divisor);
        } else {
            values_[1 + k].assign(draw.vertex_count(),
                                  glm::vec4(attribute ? 0.0F : capture::kClearValue));
        }
    }
    values_[kClipBinding] = cases::elements_read(draw, draw.distances.clip, std::nullopt);
    values_[kCullBinding] = cases::elements_read(draw, draw.distances.cull, std::nullopt);
    values_[kOffsetBinding] = draw.offsets;
    make_indices();
    if (way_.instances == shaders::Instances::placed) {
        instances_ = draw.instances;
        first_instance_ = draw.first_instance;
        values_[kOffsetBinding].resize(draw.instances, glm::vec4(0));
    } else if (way_.instance_rate != 0) {
        (way_.instances == shaders::Instances::shown ? instances_ = kInstances
                                                     : first_instance_ = kInstance);
    }
    if (door_ == Door::mesh_shader) {
        make_triangles(c);
    }
}

// Each begins with the vertex that provokes, or ends with it, whatever it is a part of.
void Feed::make_triangles(const cases::Case& c) {
    const auto number = static_cast<uint32_t>(draw_ - c.draws.data());
    const size_t place = draw_->provoking == cases::ProvokingVertex::last ? 2 : 0;
    for (const cases::Triangle& t : cases::assemble(c, number)) {
        std::array<uint32_t, 3> vertex = t.vertex;
        for (size_t k = 0; k < 2 && vertex.at(place) != t.provoking; ++k) {
            std::rotate(vertex.begin(), vertex.begin() + 1, vertex.end());
        }
        triangles_.push_back({vertex[0], vertex[1], vertex[2], 0});
    }
}

void Feed::make_indices() {
    const bool has_more = adds_restarts(door_, *draw_);
    is_indexed_ = draw_->indices.has_value() || makes_indices(door_) || has_more;
    index_type_ = index_type_of(door_);
    const uint32_t shift = cases::vertex_shift(door_);
    if (!is_indexed_) {
        count_ = static_cast<uint32_t>(draw_->vertex_count());
        first_ = shift;
        return;
    }
    if (draw_->indices) {
        indices_ = *draw_->indices;
    } else {
        for (uint32_t k = 0; k < draw_->vertex_count(); ++k) {
            indices_.push_back(k);
        }
    }
    uint32_t added = 0;
    if (door_ == Door::index_8_largest || door_ == Door::index_16_largest) {
        added = largest_of(index_type_) - cases::largest_index(*draw_);
    } else if (door_ == Door::vertex_offset_negative) {
        added = kNegativeOffset;
    } else if (has_more && cases::largest_index(*draw_) <= kRestart16) {
        added = kRestart16 - cases::largest_index(*draw_);
    }
    vertex_offset_ = static_cast<int32_t>(shift) - static_cast<int32_t>(added);
    for (uint32_t& index : indices_) {
        const bool is_restart = draw_->primitive_restart && index == cases::kRestartIndex;
        index = is_restart ? largest_of(index_type_) : index + added;
    }
    if (has_more) {
        indices_.insert(indices_.begin(), 2, cases::kRestartIndex);
        indices_.push_back(cases::kRestartIndex);
    }
    count_ = static_cast<uint32_t>(indices_.size());
    first_ = door_ == Door::first_index ? kSkippedIndices : 0;
}

VkDeviceSize Feed::index_size() const {
    return index_type_ == VK_INDEX_TYPE_UINT8_EXT ? 1 : index_type_ == VK_INDEX_TYPE_UINT16 ? 2 : 4;
}

VkDeviceSize Feed::place(VkDeviceSize begin) {
    arrays_.clear();
    const VkDeviceSize before = cases::vertex_shift(door_);  // vertices
    const VkDeviceSize vertices = before + draw_->vertex_count();
    // More than are read, so that a wrong number is read, too.
    const VkDeviceSize elements = std::max(kInstances, 2 * first_instance_ + instances_);
    VkDeviceSize at = begin;
    if (way_.interleaved) {
        const VkDeviceSize size = vertices * 16 * bindings_.count;
        arrays_.push_back({0, at, at, at + size});
        at = aligned(at + size);
    } else {
        for (const uint32_t binding : bindings_) {
            Array array;
            array.binding = binding;
            array.begin = at;
            // A multiple of 4, of which more is never demanded of numbers of 32 bits.
            array.offset = door_ == Door::bind_offset ? at + 20 + 8 * binding : at;
            array.end = array.offset + (way_.is_of_instance(binding) ? elements : vertices) *
                                           stride_of(way_, binding);
            at = aligned(array.end);
            arrays_.push_back(array);
        }
    }
    index_begin_ = at;
    index_offset_ = moves_index_buffer(door_) ? at + 12 : at;
    index_end_ = index_offset_ + (first_ + indices_.size()) * index_size();
    if (is_indexed_ && moves_index_buffer(door_)) {
        index_end_ += 12;
    }
    if (is_indexed_) {
        at = aligned(index_end_);
    }
    return aligned(place_commands(at));
}

VkDeviceSize Feed::place_commands(VkDeviceSize begin) {
    if (!is_indirect(door_)) {
        return begin;
    }
    draw_count_ = begin + 8;  // 0 and other numbers of draws lie around it
    commands_ = begin + 16;
    return commands_ + kCommands * kCommandStride;
}

void Feed::write_vertices(std::span<std::byte> memory, bool is_mirrored) const {
    const size_t before = cases::vertex_shift(door_);
    for (const Array& array : arrays_) {
        for (VkDeviceSize at = array.begin; at + 4 <= array.end; at += 4) {
            std::memcpy(memory.data() + at, &kForeign, sizeof kForeign);
        }
        if (way_.interleaved) {
            size_t place = 0;
            for (const uint32_t binding : bindings_) {
                const std::vector<glm::vec4>& values = values_[binding];
                for (size_t v = 0; v < values.size(); ++v) {
                    std::memcpy(memory.data() + array.offset +
                                    ((before + v) * bindings_.count + place) * sizeof(glm::vec4),
                                &values[v], sizeof(glm::vec4));
                }
                ++place;
            }
            continue;
        }
        const std::vector<glm::vec4>& values = values_[array.binding];
        if (values.empty()) {
            continue;
        }
        const size_t stride = stride_of(way_, array.binding);
        const cases::VertexFormat format = way_.formats.at(array.binding);
        const bool is_usual = format == cases::VertexFormat::rgba32_float;
        const bool is_place = array.binding == 0 || array.binding == kOffsetBinding;
        const auto put = [&](size_t vertex, glm::vec4 value) {
            value.x = is_mirrored && is_place ? -value.x : value.x;
            std::byte* to = memory.data() + array.offset + vertex * stride;
            if (is_usual) {
                std::memcpy(to, &value, sizeof value);
            } else {
                cases::encode_vertex(format, value, to);
            }
        };
        if (way_.is_of_instance(array.binding) &&
            way_.instances != shaders::Instances::placed) {  // all are the same
            put(way_.divisors.at(array.binding) == 0 ? 0 : kInstance, values.front());
            continue;
        }
        const size_t first = way_.is_of_instance(array.binding) ? first_instance_ : before;
        for (size_t v = 0; v < values.size(); ++v) {
            put(first + v, values[v]);
        }
    }
}

void Feed::write_indices(std::span<std::byte> memory) const {
    if (!is_indexed_) {
        return;
    }
    // Indices that are not asked for name the first vertex.
    const uint32_t other = indices_.empty() ? 0 : *std::ranges::min_element(indices_);
    const auto put = [&](VkDeviceSize at, uint32_t index) {
        std::memcpy(memory.data() + at, &index, index_size());  // little-endian, as all hosts here
    };
    for (VkDeviceSize at = index_begin_; at + index_size() <= index_end_; at += index_size()) {
        put(at, other);
    }
    for (size_t k = 0; k < indices_.size(); ++k) {
        put(index_offset_ + (first_ + k) * index_size(), indices_[k]);
    }
}

void Feed::write_commands(std::span<std::byte> memory) const {
    if (!is_indirect(door_)) {
        return;
    }
    const auto put = [&](VkDeviceSize at, std::span<const uint32_t> words) {
        std::memcpy(memory.data() + at, words.data(), words.size_bytes());
    };
    constexpr std::array<uint32_t, 4> counts = {0, kCommands, 1, kCommands};
    put(draw_count_ - 8, counts);
    // A driver that reads them at wrong places shall find no draw there.
    std::memset(memory.data() + commands_, 0, kCommands * kCommandStride);
    const std::array<Part, kCommands> parts = parts_of();
    for (uint32_t k = 0; k < kCommands; ++k) {
        const VkDeviceSize at = commands_ + k * kCommandStride;
        if (is_indexed_) {
            const std::array<uint32_t, 5> words = {parts[k].count, instances_, parts[k].first,
                                                   static_cast<uint32_t>(vertex_offset_),
                                                   first_instance_};
            put(at, words);
        } else {
            const std::array<uint32_t, 4> words = {parts[k].count, instances_, parts[k].first,
                                                   first_instance_};
            put(at, words);
        }
    }
}

std::array<Feed::Part, Feed::kCommands> Feed::parts_of() const {
    const Part whole{first_, count_}, none{0, 0};
    const uint32_t split = 3 * cases::split_of(door_, *draw_);
    switch (door_) {
        case Door::indirect:  // the second is asked for
            return {none, whole, whole};
        case Door::indirect_count:  // the first alone is counted
            return {whole, whole, whole};
        case Door::multi_draw_empty:
            return {none, whole, none};
        default:
            break;
    }
    return split == 0 ? std::array{whole, none, none}
                      : std::array{Part{first_, split}, none, Part{first_ + split, count_ - split}};
}

void Feed::write(std::span<std::byte> memory, bool is_mirrored) const {
    write_vertices(memory, is_mirrored);
    write_indices(memory);
    write_commands(memory);
}

void Feed::make_pulled(const Device& device, std::span<const std::byte> memory,
                       VkDescriptorSetLayout layout) {
    constexpr VkDeviceSize kHead = kPulledWords * sizeof(uint32_t);
    const VkDeviceSize first = arrays_.front().begin;
    const auto bytes = memory.subspan(first, arrays_.back().end - first);
    const VkDeviceSize vertices = (bytes.size() + sizeof(glm::vec4) - 1) / sizeof(glm::vec4);
    const VkDeviceSize triangles = triangles_.size() * sizeof triangles_[0];
    auto made = Buffer::create(device, kHead + (vertices + 1) * sizeof(glm::vec4) + triangles,
                               VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, HostAccess::write);
    std::array<uint32_t, kPulledWords> head{};
    for (const Array& array : arrays_) {
        head.at(array.binding) = static_cast<uint32_t>((array.offset - first) / sizeof(glm::vec4));
    }
    head.back() = static_cast<uint32_t>(vertices);
    std::memcpy(made.bytes().data(), head.data(), sizeof head);
    if (!triangles_.empty()) {
        std::memcpy(made.bytes().data() + kHead + vertices * sizeof(glm::vec4), triangles_.data(),
                    triangles);
    }
    std::ranges::copy(bytes, made.bytes().begin() + kHead);
    made.flush();
    pulled_ = std::move(made);
    pulled_set_ = make_sets(device, {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER}, layout);
    DescriptorWrites writes;
    writes.add(pulled_set_.sets.front(), 0, {pulled_.get(), 0, VK_WHOLE_SIZE});
    writes.write(device);
}

void Feed::record_feedback(const Device& device, VkCommandBuffer commands, VkPipeline pipeline,
                           VkBuffer vertices) const {
    const VolkDeviceTable& vk = device.vk();
    const VkBuffer target = buffers_.front().get();
    const VkDeviceSize begin = 0, size = VK_WHOLE_SIZE;
    vk.vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline);
    vk.vkCmdBindVertexBuffers(commands, 0, 1, &vertices, &arrays_.front().offset);
    vk.vkCmdBindTransformFeedbackBuffersEXT(commands, 0, 1, &target, &begin, &size);
    vk.vkCmdBeginTransformFeedbackEXT(commands, 0, 0, nullptr, nullptr);
    vk.vkCmdDraw(commands, count_, 1, 0, 0);
    vk.vkCmdEndTransformFeedbackEXT(commands, 0, 0, nullptr, nullptr);
}

void Feed::bind_pulled(const Device& device, VkCommandBuffer commands,
                       VkPipelineLayout layout) const {
    if (way_.pulled) {
        device.vk().vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layout,
                                            kPulledSet, 1, pulled_set_.sets.data(), 0, nullptr);
    }
}

void Feed::make_buffers(const Device& device, std::span<const std::byte> memory,
                        VkDescriptorSetLayout pulled) {
    buffers_.clear();
    if (way_.pulled) {
        make_pulled(device, memory, pulled);
        return;
    }
    if (door_ == Door::transform_feedback) {
        const VkDeviceSize size = arrays_.front().end - arrays_.front().begin;
        Buffer& made = buffers_.emplace_back(Buffer::create(
            device, std::max<VkDeviceSize>(size, 16),
            VK_BUFFER_USAGE_VERTEX_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFORM_FEEDBACK_BUFFER_BIT_EXT,
            HostAccess::write));
        for (size_t at = 0; at + sizeof kForeign <= made.bytes().size(); at += sizeof kForeign) {
            std::memcpy(made.bytes().data() + at, &kForeign, sizeof kForeign);
        }
        made.flush();
        return;
    }
    if (!has_own_buffers(door_)) {
        return;
    }
    const auto add = [&](VkDeviceSize begin, VkDeviceSize end, VkBufferUsageFlags usage) {
        const auto bytes = memory.subspan(begin, end - begin);
        const VkDeviceSize size = std::max<VkDeviceSize>(bytes.size(), 16);
        Buffer& made =
            buffers_.emplace_back(door_ == Door::memory_imported
                                      ? Buffer::import(device, size, usage)
                                      : Buffer::create(device, size, usage, HostAccess::write));
        std::ranges::copy(bytes, made.bytes().begin());
        made.flush();
    };
    for (const Array& array : arrays_) {
        add(array.begin, array.end, VK_BUFFER_USAGE_VERTEX_BUFFER_BIT);
    }
    if (is_indexed_) {
        add(index_begin_, index_end_, VK_BUFFER_USAGE_INDEX_BUFFER_BIT);
    }
}

void Feed::bind(const Device& device, VkCommandBuffer commands, VkBuffer vertices) const {
    const VolkDeviceTable& vk = device.vk();
    for (size_t k = 0; k < arrays_.size() && !way_.pulled; ++k) {
        const Array& array = arrays_[k];
        const VkBuffer buffer = buffers_.empty() ? vertices : buffers_[k].get();
        const VkDeviceSize offset = buffers_.empty() ? array.offset : array.offset - array.begin;
        if (way_.dynamic_stride) {
            const VkDeviceSize size = array.end - array.offset;
            const VkDeviceSize stride = stride_of(way_, array.binding);
            vk.vkCmdBindVertexBuffers2(commands, array.binding, 1, &buffer, &offset, &size,
                                       &stride);
        } else {
            vk.vkCmdBindVertexBuffers(commands, array.binding, 1, &buffer, &offset);
        }
    }
    if (is_indexed_ && door_ != Door::mesh_shader) {
        vk.vkCmdBindIndexBuffer(commands, buffers_.empty() ? vertices : buffers_.back().get(),
                                buffers_.empty() ? index_offset_ : index_offset_ - index_begin_,
                                index_type_);
    }
}

void Feed::draw(const Device& device, VkCommandBuffer commands, VkBuffer vertices) const {
    const VolkDeviceTable& vk = device.vk();
    constexpr auto kStride = static_cast<uint32_t>(kCommandStride);
    const auto draw_counted = [&](VkDeviceSize count) {
        is_indexed_ ? vk.vkCmdDrawIndexedIndirectCount(commands, vertices, commands_, vertices,
                                                       count, kCommands, kStride)
                    : vk.vkCmdDrawIndirectCount(commands, vertices, commands_, vertices, count,
                                                kCommands, kStride);
    };
    switch (door_) {
        case Door::indirect: {
            const VkDeviceSize second = commands_ + kCommandStride;
            is_indexed_ ? vk.vkCmdDrawIndexedIndirect(commands, vertices, second, 1, 0)
                        : vk.vkCmdDrawIndirect(commands, vertices, second, 1, 0);
            return;
        }
        case Door::indirect_count:
            draw_counted(draw_count_);
            return;
        case Door::multi_indirect:
        case Door::indirect_after_count:
            if (door_ == Door::indirect_after_count) {
                draw_counted(draw_count_ - 8);  // none
            }
            is_indexed_
                ? vk.vkCmdDrawIndexedIndirect(commands, vertices, commands_, kCommands, kStride)
                : vk.vkCmdDrawIndirect(commands, vertices, commands_, kCommands, kStride);
            return;
        case Door::multi_draw:
        case Door::multi_draw_empty: {
            const std::array<Part, kCommands> parts = parts_of();
            if (is_indexed_) {
                std::array<VkMultiDrawIndexedInfoEXT, kCommands> draws{};
                for (uint32_t k = 0; k < kCommands; ++k) {
                    draws[k] = {parts[k].first, parts[k].count, vertex_offset_};
                }
                vk.vkCmdDrawMultiIndexedEXT(commands, kCommands, draws.data(), instances_,
                                            first_instance_, sizeof draws[0], nullptr);
            } else {
                std::array<VkMultiDrawInfoEXT, kCommands> draws{};
                for (uint32_t k = 0; k < kCommands; ++k) {
                    draws[k] = {parts[k].first, parts[k].count};
                }
                vk.vkCmdDrawMultiEXT(commands, kCommands, draws.data(), instances_, first_instance_,
                                     sizeof draws[0]);
            }
            return;
        }
        case Door::mesh_shader:
            if (!triangles_.empty()) {
                vk.vkCmdDrawMeshTasksEXT(commands, static_cast<uint32_t>(triangles_.size()), 1, 1);
            }
            return;
        default:
            break;
    }
    if (is_indexed_) {
        vk.vkCmdDrawIndexed(commands, count_, instances_, first_, vertex_offset_, first_instance_);
    } else {
        vk.vkCmdDraw(commands, count_, instances_, first_, first_instance_);
    }
}

}  // namespace vk_harness
