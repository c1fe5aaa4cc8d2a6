// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "cases/wire.hpp"

#include <bit>
#include <cstring>
#include <type_traits>

namespace cases {

namespace {

constexpr uint32_t kMagic = 0x45434731;  // "ECG1"

class Writer {
  public:
    template <class T>
    void number(T value) {
        static_assert(std::is_arithmetic_v<T> || std::is_enum_v<T>);
        char raw[sizeof(T)];
        std::memcpy(raw, &value, sizeof(T));
        bytes_.append(raw, sizeof(T));
    }
    void flag(bool value) { number(static_cast<uint8_t>(value ? 1 : 0)); }
    void text(const std::string& value) {
        number(static_cast<uint64_t>(value.size()));
        bytes_ += value;
    }
    void vectors(const std::vector<glm::vec4>& values) {
        number(static_cast<uint64_t>(values.size()));
        for (const glm::vec4& v : values) {
            number(std::bit_cast<uint32_t>(v.x));
            number(std::bit_cast<uint32_t>(v.y));
            number(std::bit_cast<uint32_t>(v.z));
            number(std::bit_cast<uint32_t>(v.w));
        }
    }
    std::string take() { return std::move(bytes_); }

  private:
    std::string bytes_;
};

// After the first failure every further read yields zero; good() tells.
class Reader {
  public:
    explicit Reader(std::span<const char> bytes) : rest_(bytes) {}

    template <class T>
    T number() {
        T value{};
        if (rest_.size() < sizeof(T)) {
            fail();
            return value;
        }
        std::memcpy(&value, rest_.data(), sizeof(T));
        rest_ = rest_.subspan(sizeof(T));
        return value;
    }
    bool flag() {
        const auto value = number<uint8_t>();
        if (value > 1) {
            fail();
        }
        return value == 1;
    }
    template <class Enum>
    Enum enumerator(Enum last) {
        const auto value = number<std::underlying_type_t<Enum>>();
        if (value > static_cast<std::underlying_type_t<Enum>>(last)) {
            fail();
            return Enum{};
        }
        return static_cast<Enum>(value);
    }
    // A number of elements of at least `element_size` bytes each; checked before memory is taken.
    size_t count(size_t element_size) {
        const auto n = number<uint64_t>();
        if (n > rest_.size() / element_size) {
            fail();
            return 0;
        }
        return static_cast<size_t>(n);
    }
    std::string text() {
        const size_t size = count(1);
        std::string value(rest_.data(), size);
        rest_ = rest_.subspan(size);
        return value;
    }
    std::vector<glm::vec4> vectors() {
        std::vector<glm::vec4> values(count(4 * sizeof(uint32_t)));
        for (glm::vec4& v : values) {
            v.x = std::bit_cast<float>(number<uint32_t>());
            v.y = std::bit_cast<float>(number<uint32_t>());
            v.z = std::bit_cast<float>(number<uint32_t>());
            v.w = std::bit_cast<float>(number<uint32_t>());
        }
        return values;
    }
    void fail() {
        good_ = false;
        rest_ = {};
    }
    bool good() const { return good_; }
    bool at_end() const { return rest_.empty(); }

  private:
    std::span<const char> rest_;
    bool good_ = true;
};

void write(Writer& w, const Draw& draw) {
    w.number(draw.topology);
    w.vectors(draw.positions);
    w.flag(draw.indices.has_value());
    if (draw.indices) {
        w.number(static_cast<uint64_t>(draw.indices->size()));
        for (const uint32_t index : *draw.indices) {
            w.number(index);
        }
    }
    w.flag(draw.primitive_restart);
    w.number(static_cast<uint64_t>(draw.attributes.size()));
    for (const Attribute& attribute : draw.attributes) {
        w.text(attribute.name);
        w.number(attribute.interpolation);
        w.number(attribute.components);
        w.vectors(attribute.values);
    }
    for (const float f : {draw.viewport.x, draw.viewport.y, draw.viewport.width,
                          draw.viewport.height, draw.viewport.min_depth, draw.viewport.max_depth}) {
        w.number(std::bit_cast<uint32_t>(f));
    }
    w.number(draw.scissor.x);
    w.number(draw.scissor.y);
    w.number(draw.scissor.width);
    w.number(draw.scissor.height);
    w.number(draw.cull);
    w.number(draw.front_face);
}

Draw read_draw(Reader& r) {
    Draw draw;
    draw.topology = r.enumerator(Topology::triangle_fan);
    draw.positions = r.vectors();
    if (r.flag()) {
        draw.indices.emplace(r.count(sizeof(uint32_t)));
        for (uint32_t& index : *draw.indices) {
            index = r.number<uint32_t>();
        }
    }
    draw.primitive_restart = r.flag();
    draw.attributes.resize(r.count(1));
    for (Attribute& attribute : draw.attributes) {
        attribute.name = r.text();
        attribute.interpolation = r.enumerator(Interpolation::flat);
        attribute.components = r.number<uint32_t>();
        attribute.values = r.vectors();
        if (!r.good()) {
            break;
        }
    }
    for (float* f : {&draw.viewport.x, &draw.viewport.y, &draw.viewport.width,
                     &draw.viewport.height, &draw.viewport.min_depth, &draw.viewport.max_depth}) {
        *f = std::bit_cast<float>(r.number<uint32_t>());
    }
    draw.scissor.x = r.number<int32_t>();
    draw.scissor.y = r.number<int32_t>();
    draw.scissor.width = r.number<uint32_t>();
    draw.scissor.height = r.number<uint32_t>();
    draw.cull = r.enumerator(CullMode::front_and_back);
    draw.front_face = r.enumerator(FrontFace::clockwise);
    return draw;
}

}  // namespace

std::string to_bytes(const Case& c) {
    Writer w;
    w.number(kMagic);
    w.text(c.id);
    w.number(c.target.width);
    w.number(c.target.height);
    w.number(c.target.samples);
    w.number(static_cast<uint64_t>(c.draws.size()));
    for (const Draw& draw : c.draws) {
        write(w, draw);
    }
    return w.take();
}

Expected<Case> from_bytes(std::span<const char> bytes) {
    Reader r(bytes);
    if (r.number<uint32_t>() != kMagic) {
        return tl::unexpected(Error{{}, "these bytes are not a case of this program"});
    }
    Case c;
    c.id = r.text();
    c.target.width = r.number<uint32_t>();
    c.target.height = r.number<uint32_t>();
    c.target.samples = r.number<uint32_t>();
    const size_t draws = r.count(1);
    for (size_t i = 0; i < draws && r.good(); ++i) {
        c.draws.push_back(read_draw(r));
    }
    if (!r.good()) {
        return tl::unexpected(Error{{}, "the bytes of a case are cut short or damaged"});
    }
    if (!r.at_end()) {
        return tl::unexpected(Error{{}, "more bytes follow than the case has"});
    }
    return c;
}

}  // namespace cases
