// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "report/journal/journal.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>

#include "report/journal/json_codec.hpp"
#include "report/journal/picture_codec.hpp"
#include "sample_run.hpp"

namespace report {

namespace fs = std::filesystem;

namespace {

class JournalTest : public testing::Test {
  protected:
    JournalTest() {
        std::string name = (fs::temp_directory_path() / "edgecase-journal-XXXXXX").string();
        dir_ = ::mkdtemp(name.data());
    }
    ~JournalTest() override { fs::remove_all(dir_); }

    fs::path file() const { return dir_ / "journal.jsonl"; }
    std::string content() const {
        std::ifstream stream(file(), std::ios::binary);
        std::ostringstream text;
        text << stream.rdbuf();
        return text.str();
    }
    void set_content(const std::string& text) const {
        std::ofstream(file(), std::ios::binary | std::ios::trunc) << text;
    }
    // Writes a run as the run loop does: cases first without results.
    void write(const report::Run& run) const {
        report::Run header = run;
        for (CaseRecord& r : header.cases) {
            CaseRecord bare;
            bare.id = r.id;
            r = bare;
        }
        auto journal = Journal::open(dir_, false);
        ASSERT_TRUE(journal) << journal.error().message;
        ASSERT_TRUE(journal->write_run(header));
        ASSERT_TRUE(journal->write_device(run.device));
        for (const CaseRecord& r : run.cases) {
            ASSERT_TRUE(journal->write_begin(r.id, 1));
            ASSERT_TRUE(journal->write_end(r));
        }
        ASSERT_TRUE(journal->write_stop(run));
    }

    fs::path dir_;
};

// Everything that the codec writes of a run: two runs are equal if these are.
std::string image_of(const report::Run& run) {
    std::string text =
        encode<RunHeader>(run).dump() + encode<RunEnd>(run).dump() + encode(run.device).dump();
    for (const CaseRecord& r : run.cases) {
        text += encode(r).dump() + '\n';
    }
    return text;
}

TEST_F(JournalTest, round_trip_is_exact) {
    const report::Run run = test::sample_run();
    write(run);
    std::vector<std::string> in_flight{"stale"};
    const auto loaded = load_journal(dir_, &in_flight);
    ASSERT_TRUE(loaded) << cases::to_string(loaded.error());
    EXPECT_EQ(image_of(*loaded), image_of(run));
    EXPECT_TRUE(in_flight.empty());
    // The codec's own words aside: fields compared as they are.
    ASSERT_EQ(loaded->cases.size(), run.cases.size());
    const CaseRecord& a = loaded->cases[3];
    const CaseRecord& b = run.cases[3];
    EXPECT_EQ(a.evidence.pictures.marks, b.evidence.pictures.marks);
    EXPECT_EQ(a.evidence.pictures.expected_hits, b.evidence.pictures.expected_hits);
    EXPECT_EQ(a.evidence.pictures.device_hits, b.evidence.pictures.device_hits);
    EXPECT_EQ(a.evidence.pictures.errors, b.evidence.pictures.errors);
    EXPECT_EQ(a.evidence.pictures.device_colors, b.evidence.pictures.device_colors);
    EXPECT_EQ(a.evidence.pictures.expected_colors, b.evidence.pictures.expected_colors);
    EXPECT_EQ(a.evidence.pictures.device_depths, b.evidence.pictures.device_depths);
    EXPECT_EQ(a.evidence.pictures.expected_depths, b.evidence.pictures.expected_depths);
    EXPECT_EQ(a.evidence.geometry, b.evidence.geometry);
    EXPECT_EQ(a.evidence.samples, b.evidence.samples);
    EXPECT_EQ(loaded->cases[0].evidence.reference, run.cases[0].evidence.reference);
    EXPECT_EQ(loaded->sources, run.sources);
    EXPECT_EQ(a.catches, b.catches);
    EXPECT_EQ(a.outcome.counts, b.outcome.counts);
    EXPECT_EQ(a.outcome.level, cases::Profile::vulkan);
    EXPECT_EQ(a.outcome.findings[2].kind, diff::FindingKind::double_hit);
    EXPECT_EQ(a.outcome.findings[3].level, cases::Profile::practice);
    EXPECT_EQ(loaded->seed, 18446744073709551615ULL);
    EXPECT_EQ(loaded->cases[5].known.expected, Status::fail);
    EXPECT_EQ(loaded->cases[0].known.expected, std::nullopt);
}

// Reports of very many cases keep what grows of the first ones, and of each its status and counts.
TEST_F(JournalTest, reports_have_a_bound_and_say_so) {
    report::Run run = test::sample_run();
    CaseRecord one = run.cases.front();
    one.evidence.pictures.width = one.evidence.pictures.height = 1;
    one.evidence.pictures.device_hits = {1};
    one.status = Status::fail;
    one.outcome.counts = {};
    one.outcome.counts.front() = 40;
    diff::Finding strict, loose;
    strict.level = cases::Profile::direct3d;
    loose.level = cases::Profile::vulkan;
    one.outcome.findings.assign(40, strict);
    one.outcome.findings.back() = loose;
    run.cases.assign(4, one);
    for (size_t k = 0; k < run.cases.size(); ++k) {
        run.cases[k].id = "case/" + std::to_string(k);
    }
    write(run);
    const auto whole = load_for_reports(dir_);
    ASSERT_TRUE(whole);
    EXPECT_EQ(whole->shortened_cases, 0U);
    EXPECT_EQ(image_of(*whole), image_of(*load_journal(dir_)));
    const size_t line = content().size() / run.cases.size();
    const auto bounded = load_for_reports(dir_, 2 * line);
    ASSERT_TRUE(bounded);
    EXPECT_GE(bounded->shortened_cases, 1U);
    EXPECT_LE(bounded->shortened_cases, 3U);
    EXPECT_EQ(bounded->cases.front().outcome.findings.size(), 40U);
    EXPECT_EQ(bounded->cases.front().evidence.pictures.device_hits.size(), 1U);
    const CaseRecord& last = bounded->cases.back();
    EXPECT_EQ(last.status, Status::fail);
    EXPECT_EQ(last.outcome.counts, one.outcome.counts);
    EXPECT_TRUE(last.evidence.pictures.device_hits.empty());
    ASSERT_EQ(last.outcome.findings.size(), 16U);
    EXPECT_EQ(last.outcome.findings.front().level, cases::Profile::vulkan);  // the gravest is kept
}

TEST_F(JournalTest, layers_survive) {
    report::Run run = test::sample_run();
    run.cases[3].outcome.findings[0].layer = 0;
    run.cases[3].outcome.findings[1].layer = 255;
    run.cases[3].evidence.pictures.layer_height = 4;
    write(run);
    const auto loaded = load_journal(dir_);
    ASSERT_TRUE(loaded) << cases::to_string(loaded.error());
    const CaseRecord& r = loaded->cases[3];
    EXPECT_EQ(r.outcome.findings[0].layer, 0U);
    EXPECT_EQ(r.outcome.findings[1].layer, 255U);
    EXPECT_EQ(r.outcome.findings[2].layer, std::nullopt);
    EXPECT_EQ(r.evidence.pictures.layer_height, 4U);
    EXPECT_EQ(loaded->cases[4].evidence.pictures.layer_height, 0U);
}

TEST_F(JournalTest, hostile_bytes_survive) {
    const report::Run run = test::hostile_run();
    write(run);
    const auto loaded = load_journal(dir_);
    ASSERT_TRUE(loaded) << cases::to_string(loaded.error());
    EXPECT_EQ(loaded->device.name, test::kHostile);
    EXPECT_EQ(loaded->environment, run.environment);
    EXPECT_EQ(loaded->cases[4].id, run.cases[4].id);
    EXPECT_EQ(loaded->cases[4].death.output, test::kHostile);
    EXPECT_EQ(loaded->cases[4].outcome.findings[0].why, test::kHostile);
    EXPECT_EQ(image_of(*loaded), image_of(run));
}

RC_GTEST_FIXTURE_PROP(JournalTest, every_text_and_number_survives,
                      (const std::string& text, uint64_t bits, const std::vector<uint8_t>& bytes)) {
    CaseRecord r;
    r.id = "a/b";
    r.death.output = text;
    r.outcome.worst_ratio = std::bit_cast<double>(bits);
    r.evidence.pictures.marks = bytes;
    const auto json = nlohmann::ordered_json::parse(encode(r).dump());
    const CaseRecord back = decode<CaseRecord>(json);
    RC_ASSERT(back.death.output == text);
    RC_ASSERT(back.evidence.pictures.marks == bytes);
    if (!std::isnan(back.outcome.worst_ratio)) {
        RC_ASSERT(std::bit_cast<uint64_t>(back.outcome.worst_ratio) == bits);
    } else {
        RC_ASSERT(std::isnan(r.outcome.worst_ratio));
    }
}

TEST_F(JournalTest, special_numbers_survive) {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    for (const double value : {kInfinity, -kInfinity, -0.0, 5e-324, 1.7976931348623157e308, 0.1}) {
        CaseRecord r;
        r.drawn.seconds = value;
        const auto json = nlohmann::ordered_json::parse(encode(r).dump());
        EXPECT_EQ(std::bit_cast<uint64_t>(decode<CaseRecord>(json).drawn.seconds),
                  std::bit_cast<uint64_t>(value));
    }
}

TEST(evidence, of_older_journals_is_empty) {
    auto json = encode(test::sample_run().cases[3]);
    for (const char* key : {"catches", "geometry", "evidence"}) {
        json.erase(key);
    }
    for (const char* key : {"errors", "device_colors", "expected_colors", "device_depths",
                            "expected_depths", "depth_low", "depth_high"}) {
        json["pictures"].erase(key);
    }
    const CaseRecord old = decode<CaseRecord>(json);
    EXPECT_EQ(old.evidence.geometry, Geometry{});
    EXPECT_TRUE(old.evidence.samples.empty());
    EXPECT_TRUE(old.evidence.pictures.errors.empty());
    EXPECT_EQ(old.outcome.findings.size(), 5U);
}

TEST(evidence, that_is_malformed_is_an_error) {
    using Json = nlohmann::ordered_json;
    const Json good = encode(test::sample_run().cases[3]);
    EXPECT_NO_THROW(decode<CaseRecord>(good));
    const std::pair<const char*, Json> breaks[] = {
        {"/geometry", nullptr},
        {"/geometry/width", -1},
        {"/geometry/width", "8"},
        {"/geometry/locations/0/0", 256},
        {"/geometry/locations/0", 3},
        {"/geometry/triangles/0/p", Json::array({1, 2, 3})},
        {"/geometry/triangles/0/p/0", 0.5},
        {"/geometry/triangles/0/v", Json::array({1, 2})},
        {"/geometry/triangles/0/flags", "x"},
        {"/geometry/triangles/1/piece/0", Json::object()},
        {"/geometry/scissors/0", Json::array({1})},
        {"/geometry/blit", 1},
        {"/evidence", 1},
        {"/evidence/0/at", Json::array({1, 2})},
        {"/evidence/0/values/0", Json::array({"depth"})},
        {"/evidence/0/values/0/6", "bits"},
        {"/evidence/0/values/1/7", 1},
        {"/pictures/errors", "%"},
        {"/pictures/width", 1e10}};
    for (const auto& [place, value] : breaks) {
        Json bad = good;
        bad[Json::json_pointer(place)] = value;
        EXPECT_THROW(decode<CaseRecord>(bad), std::invalid_argument) << place;
    }
}

TEST(error_code, is_a_scale_of_eighths_of_an_octave) {
    EXPECT_EQ(error_code(-1.0F), 0);
    EXPECT_EQ(error_code(std::numeric_limits<float>::quiet_NaN()), 0);
    EXPECT_EQ(error_code(0.0F), 1);
    EXPECT_EQ(error_code(1e-30F), 2);
    EXPECT_EQ(error_code(1.0F), 128);
    EXPECT_EQ(error_code(2.0F), 136);
    EXPECT_EQ(error_code(0.5F), 120);
    EXPECT_EQ(error_code(1e30F), 254);
    EXPECT_EQ(error_code(std::numeric_limits<float>::infinity()), 255);
}

// A power cut may leave any prefix of the file.
TEST_F(JournalTest, every_prefix_loads_or_is_an_error) {
    report::Run run = test::sample_run();
    run.cases.resize(4);
    run.cases[3].outcome.findings.resize(2);
    write(run);
    const std::string whole = content();
    const size_t first_line = whole.find('\n') + 1;
    size_t lines = 0;
    for (size_t size = 0; size <= whole.size(); ++size) {
        if (size % 61 != 0 && whole[size - 1] != '\n') {
            continue;  // all cuts around newlines, one in 61 elsewhere
        }
        set_content(whole.substr(0, size));
        const auto loaded = load_journal(dir_);
        if (size < first_line) {
            ASSERT_FALSE(loaded) << size;
            EXPECT_NE(loaded.error().message.find("first record"), std::string::npos);
        } else {
            ASSERT_TRUE(loaded) << size << ": " << cases::to_string(loaded.error());
            EXPECT_EQ(loaded->cases.size(), 4U);
            lines += whole[size - 1] == '\n' ? 1U : 0U;
        }
    }
    EXPECT_EQ(lines, 11U);  // run, device, 4 begins, 4 ends, stop
}

TEST_F(JournalTest, a_case_without_end_is_in_flight_and_not_run) {
    const report::Run run = test::sample_run();
    write(run);
    const std::string whole = content();
    const size_t begin = whole.find("{\"record\":\"end\"", whole.find("{\"record\":\"begin\""));
    set_content(whole.substr(0, begin + 30));  // the first end is torn
    std::vector<std::string> in_flight;
    const auto loaded = load_journal(dir_, &in_flight);
    ASSERT_TRUE(loaded);
    EXPECT_EQ(in_flight, std::vector<std::string>{"coverage/half-square"});
    EXPECT_EQ(loaded->cases[0].status, Status::not_run);
    EXPECT_EQ(loaded->ended, "");
    EXPECT_EQ(exit_code(*loaded), kExitInternal);
}

TEST_F(JournalTest, append_goes_on_after_a_torn_line) {
    const report::Run run = test::sample_run();
    write(run);
    const std::string whole = content();
    const size_t end = whole.find("{\"record\":\"end\"");
    set_content(whole.substr(0, end + 30));
    {
        auto journal = Journal::open(dir_, true);
        ASSERT_TRUE(journal) << journal.error().message;
        ASSERT_TRUE(journal->write_run(run));
        for (const CaseRecord& r : run.cases) {
            ASSERT_TRUE(journal->write_end(r));
        }
        ASSERT_TRUE(journal->write_stop(run));
    }
    const auto loaded = load_journal(dir_);
    ASSERT_TRUE(loaded) << cases::to_string(loaded.error());
    EXPECT_EQ(image_of(*loaded), image_of(run));
}

TEST_F(JournalTest, the_last_end_of_a_case_counts) {
    report::Run run = test::sample_run();
    write(run);
    auto journal = Journal::open(dir_, true);
    ASSERT_TRUE(journal);
    run.cases[0].status = Status::flake;
    ASSERT_TRUE(journal->write_end(run.cases[0]));
    const auto loaded = load_journal(dir_);
    ASSERT_TRUE(loaded);
    EXPECT_EQ(loaded->cases[0].status, Status::flake);
}

TEST_F(JournalTest, damage_is_an_error_with_its_line) {
    const report::Run run = test::sample_run();
    write(run);
    const std::string whole = content();
    const size_t second = whole.find('\n') + 1;
    const size_t third = whole.find('\n', second) + 1;
    const auto error_of = [&](const std::string& line) {
        set_content(whole.substr(0, third) + line + "\n" + whole.substr(third));
        const auto loaded = load_journal(dir_);
        return loaded ? std::string("loaded") : cases::to_string(loaded.error());
    };
    EXPECT_NE(error_of("garbage").find("journal.jsonl:3:1: error: this line is not JSON"),
              std::string::npos)
        << error_of("garbage");
    EXPECT_NE(error_of("[]").find(":3:1: error: this is not a record"), std::string::npos);
    EXPECT_NE(error_of("").find(":3:1: error: "), std::string::npos);
    EXPECT_NE(error_of(R"({"record":"dance"})").find("no kind of record"), std::string::npos);
    EXPECT_NE(error_of(R"({"record":"begin","id":"x/y","attempt":1})").find("x/y"),
              std::string::npos);
    EXPECT_NE(error_of(R"({"record":"end","id":"coverage/slow"})").find("\"file\" is missing"),
              std::string::npos);
    EXPECT_NE(error_of(R"({"record":"stop","ended":3})").find("\"ended\" is not text"),
              std::string::npos);
    set_content(whole.substr(second));
    const auto headless = load_journal(dir_);
    ASSERT_FALSE(headless);
    EXPECT_EQ(headless.error().where.line, 1U);
}

// Every single-byte change of a short journal loads or is an error; none crashes.
TEST_F(JournalTest, changed_bytes_never_crash) {
    report::Run run = test::sample_run();
    run.cases.resize(1);
    write(run);
    const std::string whole = content();
    size_t errors = 0;
    for (size_t at = 0; at < whole.size(); at += 17) {
        for (const char byte : {'\0', '9', '"', '\xff'}) {
            std::string text = whole;
            text[at] = byte;
            set_content(text);
            const auto loaded = load_journal(dir_);
            if (!loaded) {
                EXPECT_FALSE(loaded.error().message.empty());
                ++errors;
            }
        }
    }
    EXPECT_GT(errors, 50U);
}

TEST_F(JournalTest, one_line_a_record) {
    write(test::hostile_run());
    const std::string whole = content();
    const auto lines = static_cast<size_t>(std::count(whole.begin(), whole.end(), '\n'));
    EXPECT_EQ(lines, 3 + 2 * test::sample_run().cases.size());
    EXPECT_EQ(whole.back(), '\n');
}

TEST_F(JournalTest, a_full_disk_is_a_sentence) {
    auto journal = Journal::open(dir_, false);
    ASSERT_TRUE(journal);
    // A file that may not grow, as on a full disk.
    rlimit before{};
    ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
    const auto handler = std::signal(SIGXFSZ, SIG_IGN);
    const rlimit none{0, before.rlim_max};
    ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &none), 0);
    const auto written = journal->write_begin("a/b", 1);
    ::setrlimit(RLIMIT_FSIZE, &before);
    std::signal(SIGXFSZ, handler);
    ASSERT_FALSE(written);
    EXPECT_NE(written.error().message.find("File too large"), std::string::npos);
    EXPECT_NE(written.error().message.find(file().string()), std::string::npos);
}

TEST_F(JournalTest, a_link_or_a_pipe_is_no_journal) {
    const fs::path other = dir_.parent_path() / (dir_.filename().string() + "-other");
    std::ofstream(other) << "mine\n";
    fs::create_symlink(other, file());
    for (const bool append : {false, true}) {
        const auto opened = Journal::open(dir_, append);
        ASSERT_FALSE(opened);
        EXPECT_NE(opened.error().message.find("is a link"), std::string::npos);
    }
    EXPECT_FALSE(put_aside_journal(dir_));
    EXPECT_NE(load_journal(dir_).error().message.find("a link leads out of the folder"),
              std::string::npos);
    EXPECT_EQ(fs::file_size(other), 5);
    fs::remove(other);
    fs::remove(file());
    ASSERT_EQ(::mkfifo(file().c_str(), 0600), 0);
    EXPECT_FALSE(Journal::open(dir_, false));
    EXPECT_FALSE(Journal::open(dir_, true));
    EXPECT_NE(load_journal(dir_).error().message.find("is no ordinary file"), std::string::npos);
}

TEST_F(JournalTest, what_cannot_be_opened_is_a_sentence) {
    const auto missing = Journal::open(dir_ / "none", false);
    ASSERT_FALSE(missing);
    EXPECT_NE(missing.error().message.find("No such file or directory"), std::string::npos);
    const auto nothing = Journal::open(dir_, true);
    ASSERT_FALSE(nothing);
    EXPECT_NE(nothing.error().message.find("does not exist"), std::string::npos);
    EXPECT_FALSE(fs::exists(file()));
    const auto unread = load_journal(dir_);
    ASSERT_FALSE(unread);
    EXPECT_NE(unread.error().message.find("cannot read"), std::string::npos);
}

TEST_F(JournalTest, a_moved_journal_writes_and_an_empty_one_says_so) {
    auto journal = Journal::open(dir_, false);
    ASSERT_TRUE(journal);
    Journal other = std::move(*journal);
    EXPECT_TRUE(other.write_begin("a/b", 1));
    EXPECT_FALSE(journal->write_begin("a/b", 1));
}

TEST(picture_codec, base64_vectors_of_rfc_4648) {
    const std::pair<const char*, const char*> vectors[] = {{"", ""},
                                                           {"f", "Zg=="},
                                                           {"fo", "Zm8="},
                                                           {"foo", "Zm9v"},
                                                           {"foob", "Zm9vYg=="},
                                                           {"fooba", "Zm9vYmE="},
                                                           {"foobar", "Zm9vYmFy"}};
    for (const auto& [plain, text] : vectors) {
        EXPECT_EQ(base64_encode(plain), text);
        EXPECT_EQ(base64_decode(text), plain);
    }
    for (const char* bad : {"Z", "Zg=", "Z===", "====", "Zg==Zg==", "Zm9\xff", "Zm 9"}) {
        EXPECT_FALSE(base64_decode(bad)) << bad;
    }
}

TEST(picture_codec, long_runs_are_short_and_bombs_are_refused) {
    EXPECT_EQ(encode_picture(std::vector<uint8_t>(256, 7)), base64_encode(std::string("\xff\x07")));
    EXPECT_LE(encode_picture(std::vector<uint8_t>(65536, 7)).size(), 700U);
    std::string bomb;
    for (size_t k = 0; k < (size_t{64} << 20) / 256 + 1; ++k) {
        bomb += "\xff\x01";
    }
    EXPECT_FALSE(decode_picture(base64_encode(bomb)));
    EXPECT_FALSE(decode_picture(base64_encode("abc")));
}

}  // namespace

}  // namespace report
