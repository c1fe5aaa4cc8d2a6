// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "run/process/frame.hpp"

#include <gtest/gtest.h>

#include "run/process/process.hpp"
#include "run/worker/message.hpp"

namespace run {
namespace {

TEST(Frame, ArrivesInPiecesOfAnySize) {
    const std::string bytes = encode_frame(FrameType::step, "submit") +
                              encode_frame(FrameType::result, std::string(1000, 'x'));
    for (size_t piece = 1; piece < bytes.size(); piece += 7) {
        FrameReader reader;
        std::vector<Frame> frames;
        for (size_t at = 0; at < bytes.size(); at += piece) {
            reader.feed(std::string_view(bytes).substr(at, piece));
            while (std::optional<Frame> frame = reader.next()) {
                frames.push_back(std::move(*frame));
            }
        }
        ASSERT_EQ(frames.size(), 2U);
        EXPECT_EQ(frames[0].payload, "submit");
        EXPECT_EQ(frames[1].type, FrameType::result);
        EXPECT_EQ(frames[1].payload, std::string(1000, 'x'));
        EXPECT_FALSE(reader.has_rest());
    }
}

TEST(Frame, EveryFlippedBitIsSeen) {
    const std::string bytes = encode_frame(FrameType::result, "0123456789abcdef!");
    for (size_t bit = 0; bit < bytes.size() * 8; ++bit) {
        std::string broken = bytes;
        broken[bit / 8] = static_cast<char>(broken[bit / 8] ^ (1 << (bit % 8)));
        FrameReader reader;
        reader.feed(broken);
        // malformed, or still waiting for bytes that a longer length promises
        EXPECT_FALSE(reader.next()) << "bit " << bit;
        EXPECT_TRUE(reader.is_malformed() || reader.has_rest()) << "bit " << bit;
    }
}

CaseResult small_result() {
    CaseResult result;
    result.index = 3;
    result.rendered.status = capture::Rendered::Status::drawn;
    result.rendered.messages = {"one", ""};
    capture::Capture& c = result.rendered.capture;
    c.target = {2, 1, 1};
    c.attribute_count = 1;
    c.has_primitive = true;
    c.hits.assign(2, glm::vec4(1, 0, 4096, 4097));
    c.writers.assign(2, capture::Writer{1, 2, 3, capture::kClearId});
    c.frag_coord.assign(2, glm::vec4(0.5F));
    c.depth = {0.25F, -0.0F};
    c.attributes[0].assign(2, glm::vec4(7));
    result.rendered.stray_writes = {{"depth", true, 12, 1, 2, 3, 4}, {"color", false, 0, 5, 6, 7}};
    return result;
}

TEST(Message, ResultComesBackBitForBit) {
    const std::string bytes = encode_result(small_result());
    const std::optional<CaseResult> back = decode_result(bytes);
    ASSERT_TRUE(back);
    EXPECT_EQ(encode_result(*back), bytes);
    EXPECT_EQ(back->rendered.capture.writers[1].provoking_vertex, 3U);
    EXPECT_EQ(back->rendered.stray_writes, small_result().rendered.stray_writes);
}

TEST(Message, FindingsOfTheWorkerAreTheirBytes) {
    const CaseResult result = small_result();
    CaseResult other = result;
    EXPECT_EQ(encode_findings(other), encode_findings(result));
    other.rendered.stray_writes[1].got = 9;
    EXPECT_NE(encode_findings(other), encode_findings(result));
}

TEST(Message, TruncatedResultsAreRefused) {
    const std::string bytes = encode_result(small_result());
    for (size_t size = 0; size < bytes.size(); ++size) {
        EXPECT_FALSE(decode_result(std::string_view(bytes).substr(0, size))) << size;
    }
    EXPECT_FALSE(decode_result(bytes + "x"));
}

TEST(Message, PlanesMustFitTheTarget) {
    CaseResult result = small_result();
    result.rendered.capture.depth.pop_back();
    EXPECT_FALSE(decode_result(encode_result(result)));
}

TEST(Message, DifferencesComeBackAndImpossibleOnesAreRefused) {
    CaseResult result = small_result();
    result.consistency = {{2, 1, {{1, 0, 3, 7, 8}}, {}, {}}, {2, 0, {}, {}, {}}};
    const std::optional<CaseResult> back = decode_result(encode_result(result));
    ASSERT_TRUE(back);
    EXPECT_EQ(back->consistency, result.consistency);

    const auto refuses = [&](const diff::Consistency& found) {
        result.consistency = {found};
        return !decode_result(encode_result(result));
    };
    EXPECT_TRUE(refuses({3, 0, {}, {}, {}})) << "more samples than the target has";
    EXPECT_TRUE(refuses({1, 2, {{0, 0, 0, 1, 2}, {1, 0, 0, 1, 2}}, {}, {}}))
        << "more than were compared";
    EXPECT_TRUE(refuses({2, 1, {}, {}, {}})) << "one is kept back";
    EXPECT_TRUE(refuses({2, 1, {{2, 0, 0, 1, 2}}, {}, {}})) << "a sample outside";
    EXPECT_TRUE(refuses({2, 1, {{1, diff::kCounts, 0, 1, 2}}, {}, {}})) << "no such plane";
    EXPECT_TRUE(refuses({2, 1, {{1, 0, 4, 1, 2}}, {}, {}})) << "no such word";
    EXPECT_TRUE(refuses({2, 1, {{1, 0, 0, 2, 2}}, {}, {}})) << "no difference";
    // Counts are whole: the lowest 32 bits of these are the same.
    result.rendered.capture.counted = {64};
    result.consistency = {{3, 1, {{0, diff::kCounts, 0, 64, 64 + (1ULL << 32)}}, {}, {}}};
    const std::optional<CaseResult> counts = decode_result(encode_result(result));
    ASSERT_TRUE(counts);
    EXPECT_EQ(counts->consistency, result.consistency);
    result.rendered.capture.counted.clear();
    result.consistency.assign(257, {2, 0, {}, {}, {}});
    EXPECT_FALSE(decode_result(encode_result(result))) << "too many";
}

TEST(HeadAndTail, KeepsBothEnds) {
    HeadAndTail output;
    output.add("first line\n");
    for (int k = 0; k < 100000; ++k) {
        output.add("0123456789\n");
    }
    output.add("last line\n");
    const std::string text = output.text();
    EXPECT_TRUE(text.starts_with("first line\n"));
    EXPECT_TRUE(text.ends_with("last line\n"));
    EXPECT_NE(text.find("bytes left out"), std::string::npos);
    EXPECT_LE(text.size(), HeadAndTail::kLimit + 100);
    HeadAndTail little;
    little.add("abc");
    EXPECT_EQ(little.text(), "abc");
}

}  // namespace
}  // namespace run
