// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "ref/expectation/vertex_numbers.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>

namespace ref {

namespace {

std::array<uint32_t, 4> bits_of(const glm::vec4& v) {
    return {std::bit_cast<uint32_t>(v.x), std::bit_cast<uint32_t>(v.y),
            std::bit_cast<uint32_t>(v.z), std::bit_cast<uint32_t>(v.w)};
}

// All of a draw that tells its vertices from another's.
std::array<uint32_t, 6> key_of(const cases::Draw& d) {
    const auto v = bits_of({d.viewport.x, d.viewport.y, d.viewport.width, d.viewport.height});
    return {d.clear ? ~0U : d.distances.clip_count, d.layer, v[0], v[1], v[2], v[3]};
}

uint64_t mixed(uint64_t hash, const std::array<uint32_t, 4>& words) {
    for (const size_t k : {size_t{0}, size_t{2}}) {
        hash = (hash ^ (uint64_t{words.at(k + 1)} << 32U | words.at(k))) * 0x9e3779b97f4a7c15U;
        hash ^= hash >> 32U;
    }
    return hash;
}

}  // namespace

VertexNumbers::VertexNumbers(const cases::Case& c)
    : case_(c), numbers_(c.draws.size()), slots_(64) {
    std::vector<std::array<uint32_t, 6>> keys;
    for (const cases::Draw& d : c.draws) {
        const auto known = std::find(keys.begin(), keys.end(), key_of(d));
        kinds_.push_back(static_cast<uint32_t>(known - keys.begin()));
        if (known == keys.end()) {
            keys.push_back(key_of(d));
        }
    }
}

uint64_t VertexNumbers::hash_of(uint32_t draw, uint32_t vertex) const {
    const cases::Draw& d = case_.draws[draw];
    const uint64_t hash = mixed(kinds_[draw], bits_of(d.positions[vertex]));
    // An edge that clip distances cut elsewhere is another edge.
    return d.distances.clip_count > 0 ? mixed(hash, bits_of(d.distances.clip[vertex])) : hash;
}

bool VertexNumbers::is_same(const Slot& slot, uint32_t draw, uint32_t vertex) const {
    const cases::Draw& a = case_.draws[slot.draw];
    const cases::Draw& b = case_.draws[draw];
    return kinds_[slot.draw] == kinds_[draw] &&
           bits_of(a.positions[slot.vertex]) == bits_of(b.positions[vertex]) &&
           (b.distances.clip_count == 0 ||
            bits_of(a.distances.clip[slot.vertex]) == bits_of(b.distances.clip[vertex]));
}

void VertexNumbers::grow() {
    std::vector<Slot> larger(2 * slots_.size());
    for (const Slot& slot : slots_) {
        if (slot.number != 0) {
            size_t k = slot.hash & (larger.size() - 1);
            while (larger[k].number != 0) {
                k = (k + 1) & (larger.size() - 1);
            }
            larger[k] = slot;
        }
    }
    slots_ = std::move(larger);
}

uint32_t VertexNumbers::of(uint32_t draw, uint32_t vertex) {
    std::vector<uint32_t>& numbers = numbers_[draw];
    if (numbers.empty()) {
        numbers.resize(case_.draws[draw].positions.size());
    }
    if (numbers[vertex] != 0) {
        return numbers[vertex];
    }
    if (2 * size_t{count_} >= slots_.size()) {
        grow();
    }
    const auto hash = static_cast<uint32_t>(hash_of(draw, vertex));
    size_t k = hash & (slots_.size() - 1);
    while (slots_[k].number != 0 && (slots_[k].hash != hash || !is_same(slots_[k], draw, vertex))) {
        k = (k + 1) & (slots_.size() - 1);
    }
    if (slots_[k].number == 0) {
        slots_[k] = {hash, ++count_, draw, vertex};
    }
    numbers[vertex] = slots_[k].number;
    return numbers[vertex];
}

}  // namespace ref
