// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Whether the lists of fields (cases/base/fields.hpp) name all fields, and the list of planes all
// planes: what is missing in a list would neither be sent, stored nor shown.
#include "cases/base/fields.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <set>
#include <string>

#include "capture/capture.hpp"
#include "cases/model/case.hpp"
#include "diff/consistency.hpp"
#include "diff/verdict.hpp"
#include "report/record/run.hpp"
#include "run/worker/message.hpp"

namespace run {
namespace {

// Stands for any value in the braces of a structure, and is asked for none.
struct Any {
    template <class T>
        requires(!cases::is_optional<T>)
    operator T() const {
        std::abort();
    }
};

// How many values fit into the braces of a T: its fields.
template <class T, class... Values>
constexpr size_t field_count() {
    if constexpr (requires { T{Values{}..., Any{}}; }) {
        return field_count<T, Values..., Any>();
    } else {
        return sizeof...(Values);
    }
}

template <class T>
std::set<std::string> listed() {
    std::set<std::string> names;
    T value;
    T::fields([&names](const cases::Field& field, auto&) { names.insert(field.name); }, value);
    return names;
}

template <class T>
class Fields : public testing::Test {};

using Structures = testing::Types<
    cases::SourceLocation, cases::Viewport, cases::Rect, cases::Attribute, cases::DepthBias,
    cases::DepthState, cases::ClipDistances, cases::Multisample, cases::BlendEquation, cases::Blend,
    cases::ColorOutput, cases::ColorTarget, cases::Draw, cases::Target, cases::Corners, cases::Blit,
    cases::ExpectedHits, cases::Claim, cases::Case, cases::Relation, cases::Variation,
    capture::StrayWrite, diff::Difference, diff::Consistency, diff::Finding, diff::Outcome,
    capture::DeviceInfo, report::Pictures, report::Geometry, report::SampleValue,
    report::SampleEvidence, report::PlannedCase, report::RunHeader, report::RunEnd,
    capture::Failure, capture::RendererOptions, capture::Rendered, WorkerOptions>;
TYPED_TEST_SUITE(Fields, Structures);

TYPED_TEST(Fields, AreAllListed) {
    EXPECT_EQ(listed<TypeParam>().size(), field_count<TypeParam>());
}

// It lists the fields of its parts, and two of its own.
TEST(Fields, OfARecordAreAllListed) {
    EXPECT_EQ(listed<report::CaseRecord>().size(),
              listed<report::PlannedCase>().size() + field_count<report::Known>() +
                  field_count<report::Drawn>() + field_count<report::WorkerEnd>() +
                  listed<diff::Outcome>().size() + field_count<report::Commands>() +
                  field_count<report::Evidence>() + 2);
}

TEST(Planes, AreAllListed) {
    using View = capture::CaptureView;
    View view;
    size_t bytes = 0;
    std::set<std::string> names;
    capture::for_each_plane(
        [&](const capture::Plane& plane, const auto& span) {
            EXPECT_EQ(plane.entries, 0U) << "the target has no samples";
            EXPECT_EQ(capture::name_of_plane(plane.number), plane.name);
            bytes += sizeof span;
            names.insert(plane.name);
        },
        view, view);
    const auto* begin = reinterpret_cast<const std::byte*>(&view.hits);
    const auto* end = reinterpret_cast<const std::byte*>(&view + 1);
    EXPECT_EQ(bytes, static_cast<size_t>(end - begin));
    EXPECT_EQ(bytes, names.size() * sizeof view.hits);
}

}  // namespace
}  // namespace run
