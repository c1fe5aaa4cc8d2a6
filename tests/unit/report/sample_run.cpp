// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "sample_run.hpp"

#include <limits>

namespace report::test {

using cases::Profile;
using diff::FindingKind;

namespace {

CaseRecord make(const std::string& id, Status status) {
    CaseRecord r;
    r.id = id;
    r.file = "cases/suite/" + id.substr(0, id.find(':')) + ".toml";
    r.line = 1;
    r.description = "Two triangles share a diagonal: each sample on it belongs to exactly one.";
    r.rules = {"cover.shared-edge", "tie.top-left"};
    r.status = status;
    r.drawn.seconds = 0.0125;
    r.drawn.attempts = 1;
    r.outcome.compared_samples = 64;
    r.outcome.compared_values = 128;
    r.outcome.must_samples = 28;
    r.outcome.either_samples = 8;
    r.outcome.worst_ratio = 0.25;
    r.outcome.worst_quantity = "depth";
    r.drawn.bits = "0123456789abcdef";
    r.drawn.hit_bits = "fedcba9876543210";
    r.rerun = "edgecase run '" + id + "'";
    return r;
}

// An 8 x 8 picture of two triangles with one sample of every mark on the diagonal.
Pictures make_pictures() {
    Pictures p;
    p.width = 8;
    p.height = 8;
    for (uint32_t j = 0; j < 8; ++j) {
        for (uint32_t i = 0; i < 8; ++i) {
            p.expected_hits.push_back(i + j < 7 ? 1 : i + j == 7 ? 255 : 0);
            p.device_hits.push_back(i + j < 8 ? 1 : 0);
            p.marks.push_back(i + j == 7 ? 1 : 0);
        }
    }
    const auto set = [&](size_t x, size_t y, uint8_t expected, uint8_t got, diff::SampleMark mark) {
        p.expected_hits[y * 8 + x] = expected;
        p.device_hits[y * 8 + x] = got;
        p.marks[y * 8 + x] = static_cast<uint8_t>(mark);
    };
    set(3, 2, 1, 0, diff::SampleMark::missing);
    set(6, 6, 0, 1, diff::SampleMark::extra);
    set(1, 1, 1, 2, diff::SampleMark::double_hit);
    set(2, 4, 1, 1, diff::SampleMark::value);
    set(5, 0, 1, 1, diff::SampleMark::order);
    p.errors.assign(64, 1);
    p.errors[2 + 4 * 8] = error_code(2.0e6F);
    p.device_colors.assign(3 * 64, 7);
    p.expected_colors.assign(3 * 64, 8);
    p.device_depths.assign(64, 9);
    p.expected_depths.assign(64, 10);
    p.depth_low = 0.25;
    p.depth_high = 0x1.8p-1;
    return p;
}

Geometry make_geometry() {
    Geometry g;
    g.width = g.height = 8;
    g.sample_locations = {{8, 8}};
    g.triangle_total = 3;
    g.scissors = {{0, 0, 8, 8}};
    g.viewports = {{"0", "25/2", "8", "-1/3"}};
    Shape upper;
    upper.vertex = {0, 1, 2};
    upper.points = {0, 0, 8 << 16, 0, 0, 8 << 16};
    upper.has_points = upper.is_exact = true;
    Shape cut;  // one vertex behind the eye
    cut.primitive = 1;
    cut.layer = 2;
    cut.vertex = {2, 1, 0xffffffffU};
    cut.is_clipped = true;
    cut.piece = {0.1, -0.5, 8, 0, 3.25, 1e300};
    cut.cuts = {{4, {"1", "-2", "123456789012345678901234567890", "7"}},
                {7, {"0", "0", "-1", "1"}}};
    cut.boxes = {{0, 0, 256, 256}, {-256, 0, 0, 0}, {1, 2, 3, 4}};
    g.triangles = {upper, cut};
    return g;
}

SampleEvidence make_evidence() {
    SampleEvidence e;
    e.at = {2, 4, 0};
    e.writer = "triangle 0 of draw 0";
    e.allowed = "1";
    e.hits = "1 front, 0 back";
    SampleValue value;
    value.quantity = "attribute 0.x";
    value.exact = "1/2";
    value.nearest = 0.5;
    value.budget = 1.2e-7;
    value.low = 0.5 - 2.4e-7;
    value.high = std::numeric_limits<double>::infinity();
    value.has_device = true;
    value.bits = 0x7fc00001;
    SampleValue missing;
    missing.quantity = "depth";
    missing.also = "or 1.375";
    e.values = {value, missing};
    return e;
}

}  // namespace

Run sample_run() {
    Run run;
    run.tool_version = "0.2.0";
    run.arguments = {"edgecase", "run", "-o", "out"};
    run.environment = {{"VK_DRIVER_FILES", "/usr/share/vulkan/icd.d/lvp_icd.x86_64.json"}};
    run.started = "2026-01-02T03:04:05Z";
    run.ended = "2026-01-02T03:04:17Z";
    run.host = "Linux x86_64";
    run.seed = 18446744073709551615ULL;
    run.suite_root = "cases/suite";
    run.suite_hash = "00112233445566778899";
    run.expectation_file = "cases/expectations/llvmpipe.txt";
    run.seconds = 12.4;
    run.device.name = "llvmpipe (LLVM 15.0.6, 256 bits)";
    run.device.driver_name = "llvmpipe";
    run.device.driver_info = "Mesa 22.3.6 (LLVM 15.0.6)";
    run.device.uuid = "6d657361000000000000000000000000";
    run.device.type = "cpu";
    run.device.api_version = "1.3.230";
    run.device.vendor_id = 0x10005;
    run.device.subpixel_bits = 8;
    run.device.viewport_subpixel_bits = 0;
    run.device.has_primitive_id = true;

    run.sources = {{"cases/suite/coverage/half-square.toml", "format = 1\n<&>\xff"}};

    run.cases.push_back(make("coverage/half-square", Status::pass));
    run.cases.back().evidence.reference = {2, 1, 3, 4, 5, {0, 255}};
    run.cases.back().evidence.geometry = make_geometry();
    run.cases.push_back(make("coverage/wide:samples=4", Status::unsupported));
    run.cases.back().reason = "the device has no target of 4 samples";
    run.cases.push_back(make("coverage/slow", Status::skip));
    run.cases.back().known.expected = Status::skip;

    CaseRecord fail = make("shared-edge/diag:rot=90,flip=false", Status::fail);
    fail.outcome.level = Profile::vulkan;
    fail.outcome.counts = {1, 1, 1, 1, 1};
    fail.outcome.wrong_samples = 5;
    fail.outcome.min_x = 1;
    fail.outcome.max_x = 6;
    fail.outcome.max_y = 6;
    fail.outcome.findings = {
        {FindingKind::missing, "cover.shared-edge", Profile::vulkan, 3, 2, 0, "", "1", "0",
         "2 triangles meet here along edges they share with identical end points", 0},
        {FindingKind::extra, "tie.top-left", Profile::direct3d, 6, 6, 0, "", "0", "1",
         "triangle 0 of draw 0: E(v1,v2) = 0, no top or left edge", 0},
        {FindingKind::double_hit, "cover.shared-edge", Profile::vulkan, 1, 1, 0, "", "1", "2",
         "2 triangles meet here along edges they share with identical end points", 0},
        {FindingKind::value, "interp.perspective", Profile::practice, 2, 4, 0, "attribute 0.x",
         "0.5 +- 1.2e-07", "0.75", "the value is (1/2)/(1)", 2.0e6},
        {FindingKind::order, "order.primitive", Profile::vulkan, 5, 0, 0, "",
         "triangle 1 of draw 0", "triangle 0 of draw 0", "later primitives overwrite earlier ones",
         0},
    };
    for (const diff::Finding& f : fail.outcome.findings) {
        fail.outcome.groups.push_back({f.kind, f.rule, f.level, 1, 0});
    }
    fail.outcome.worst_ratio = std::numeric_limits<double>::infinity();
    fail.outcome.worst_quantity = "attribute 0.x";
    fail.evidence.pictures = make_pictures();
    fail.evidence.geometry = make_geometry();
    fail.evidence.samples = {make_evidence()};
    fail.catches = "a diagonal that is drawn twice";
    fail.commands.explain = "edgecase explain 'shared-edge/diag:rot=90,flip=false' --pixel 3,2";
    run.cases.push_back(fail);

    CaseRecord ties = make("ties/left", Status::fail);
    ties.outcome.level = Profile::direct3d;
    ties.outcome.counts = {1, 0, 0, 0, 0};
    ties.outcome.findings = {{FindingKind::missing, "tie.top-left", Profile::direct3d, 0, 3, 2, "",
                              "1", "0", "E(v1,v2) = 0 exactly on a left edge", 0}};
    ties.outcome.max_y = ties.outcome.min_y = 3;
    run.cases.push_back(ties);

    CaseRecord xfail = make("clip/near", Status::xfail);
    xfail.known.expected = Status::fail;
    xfail.known.bug = "mesa#1234";
    xfail.known.actual = Status::fail;
    xfail.known.place = "cases/expectations/llvmpipe.txt:4";
    run.cases.push_back(xfail);
    CaseRecord xpass = make("clip/far", Status::xpass);
    xpass.known.expected = Status::fail;
    xpass.known.bug = "mesa#1235";
    xpass.known.actual = Status::pass;
    xpass.known.place = "cases/expectations/llvmpipe.txt:5";
    run.cases.push_back(xpass);
    CaseRecord improved = make("clip/guard", Status::improved);
    improved.known.expected = Status::crash;
    run.cases.push_back(improved);
    run.cases.push_back(make("interp/flat", Status::flake));
    run.cases.back().drawn.attempts = 2;
    run.cases.push_back(make("interp/lost", Status::device_lost));
    run.cases.back().death.step = "submit";
    run.cases.push_back(make("large/hang", Status::timeout));
    run.cases.back().death.step = "submit";
    run.cases.back().drawn.seconds = 30;
    CaseRecord crash = make("large/offscreen:n=3", Status::crash);
    crash.death.signal = "SIGSEGV";
    crash.death.step = "pipeline";
    crash.death.output = "LLVM ERROR: cannot select\nstack dump:\n";
    run.cases.push_back(crash);
    run.cases.push_back(make("large/poison", Status::error));
    run.cases.back().reason = "read-back failed: 12 samples still hold the poison";
    run.cases.push_back(make("large/never", Status::not_run));
    return run;
}

Run hostile_run() {
    Run run = sample_run();
    run.tool_version = run.host = run.suite_root = run.expectation_file = kHostile;
    run.started = run.ended = kHostile;
    run.arguments = {kHostile, kHostile};
    run.environment = {{kHostile, kHostile}};
    capture::DeviceInfo& d = run.device;
    d.name = d.driver_name = d.driver_info = d.uuid = d.type = d.api_version = kHostile;
    for (CaseRecord& r : run.cases) {
        r.id += kHostile;
        r.catches = kHostile;
        for (SampleEvidence& e : r.evidence.samples) {
            e.writer = e.allowed = e.hits = e.values[0].quantity = e.values[0].exact =
                e.values[1].also = kHostile;
        }
        r.file = r.description = r.known.bug = r.reason = r.death.step = r.death.signal =
            r.death.output = kHostile;
        r.rerun = r.commands.explain = r.outcome.worst_quantity = kHostile;
        r.commands.reproducer = r.commands.no_reproducer = kHostile;
        r.known.place = r.known.expired = r.drawn.bits = r.drawn.hit_bits = kHostile;
        r.rules = r.links = r.drawn.messages = {kHostile};
        for (diff::Finding& f : r.outcome.findings) {
            f.rule = f.quantity = f.expected = f.got = f.why = kHostile;
        }
    }
    return run;
}

}  // namespace report::test
