// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "report/journal/journal.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <map>
#include <new>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <stdexcept>
#include <utility>
#include <vector>

#include "cases/base/input_file.hpp"
#include "cases/base/parallel.hpp"
#include "report/journal/json_codec.hpp"

namespace report {

using Json = nlohmann::ordered_json;

namespace {

constexpr int kFormat = 1;

tl::unexpected<cases::Error> failure_in(std::string file, std::string message, uint32_t line = 0) {
    return tl::unexpected(
        cases::Error{{std::move(file), line, line > 0 ? 1U : 0U}, std::move(message)});
}

std::string advice(int error) {
    switch (error) {
        case ENOSPC:
        case EDQUOT:
            return "; free some space and do it again, a run or a hunt with --resume";
        case ENOENT:
            return "; create the directory first";
        case EACCES:
        case EPERM:
        case EROFS:
            return "; choose another directory with -o";
        default:
            return {};
    }
}

// Cuts off what follows the last newline: a record whose write was cut short.
bool drop_torn_line(int fd) {
    struct stat status {};
    if (::fstat(fd, &status) != 0 || !S_ISREG(status.st_mode)) {
        return false;
    }
    off_t end = status.st_size;
    char byte = 0;
    while (end > 0 && ::pread(fd, &byte, 1, end - 1) == 1 && byte != '\n') {
        --end;
    }
    return end == status.st_size || ::ftruncate(fd, end) == 0;
}

std::string line_of(const char* type, const Json& body) {
    std::string line = fmt::format(R"({{"record":"{}")", type);
    line += body.empty() ? "" : ",";
    return line.append(body.dump(), 1).append(1, '\n');
}

}  // namespace

Journal::~Journal() {
    if (fd_ >= 0) {
        ::close(fd_);
    }
}

Journal::Journal(Journal&& other) noexcept
    : fd_(std::exchange(other.fd_, -1)), file_(std::move(other.file_)) {}

Journal& Journal::operator=(Journal&& other) noexcept {
    std::swap(fd_, other.fd_);
    std::swap(file_, other.file_);
    return *this;
}

cases::Expected<Journal> Journal::open(const std::filesystem::path& dir, bool append) {
    const std::string file = (dir / "journal.jsonl").string();
    const int flags = append ? O_RDWR | O_APPEND : O_WRONLY | O_CREAT | O_APPEND;
    // Neither a link is followed nor the reader of a pipe waited for: the folder may be a
    // stranger's.
    const int fd = ::open(file.c_str(), flags | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC, 0644);
    if (fd < 0) {
        const int error = errno;
        if (error == ELOOP) {
            return cases::failure("{} is a link; remove it, or choose another directory with -o",
                                  file);
        }
        if (append && error == ENOENT) {
            return cases::failure("{} does not exist, so there is no run to go on with", file);
        }
        return cases::failure("cannot open {}: {}{}", file, std::strerror(error), advice(error));
    }
    Journal journal(fd);
    journal.file_ = file;
    // Held until the journal is closed or its process ends. A file system without locks has none.
    if (::flock(fd, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
        return cases::failure(
            "another run is writing {}; wait for its end, or choose another "
            "directory with -o",
            file);
    }
    if (!append && ::ftruncate(fd, 0) != 0) {
        return cases::failure("cannot empty {}: {}", file, std::strerror(errno));
    }
    if (append && !drop_torn_line(fd)) {
        return cases::failure(
            "cannot go on with {}: it is no ordinary file, or its torn last "
            "line cannot be cut off",
            file);
    }
    return journal;
}

bool put_aside_journal(const std::filesystem::path& dir) {
    const std::filesystem::path file = dir / "journal.jsonl";
    const int fd = ::open(file.c_str(), O_RDWR | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
    if (fd < 0) {
        return false;
    }
    const bool is_written = ::flock(fd, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
    std::error_code error;
    if (!is_written) {
        std::filesystem::rename(file, file.string() + ".old", error);
    }
    ::close(fd);
    return !is_written && !error;
}

cases::Expected<void> Journal::write_line(const std::string& line) {
    if (fd_ < 0) {
        return cases::failure("the journal was moved away and cannot be written to");
    }
    size_t done = 0;
    while (done < line.size()) {
        const ssize_t count = ::write(fd_, line.data() + done, line.size() - done);
        if (count < 0 && errno == EINTR) {
            continue;
        }
        if (count <= 0) {
            const int error = count < 0 ? errno : ENOSPC;
            if (done > 0) {
                drop_torn_line(fd_);  // so that a later record begins a line
            }
            return cases::failure("cannot write {}: {}{}", file_, std::strerror(error),
                                  advice(error));
        }
        done += static_cast<size_t>(count);
    }
    return {};
}

cases::Expected<void> Journal::write_run(const Run& header) {
    Json body = {{"format", kFormat}};
    body.update(encode<RunHeader>(header));
    Json& list = body["cases"] = Json::array();
    for (const CaseRecord& record : header.cases) {
        list.push_back(encode<PlannedCase>(record));
    }
    return write_line(line_of("run", body));
}

cases::Expected<void> Journal::write_device(const capture::DeviceInfo& device) {
    return write_line(line_of("device", encode(device)));
}

cases::Expected<void> Journal::write_begin(const std::string& id, uint32_t attempt) {
    return write_line(line_of("begin", Json{{"id", encode_text(id)}, {"attempt", attempt}}));
}

cases::Expected<void> Journal::write_end(const CaseRecord& record) {
    return write_line(line_of("end", encode(record)));
}

cases::Expected<void> Journal::write_stop(const Run& run) {
    return write_line(line_of("stop", encode<RunEnd>(run)));
}

namespace {

// Takes away what grows with pictures and findings, but for the gravest of these. False: nothing.
bool shorten(CaseRecord& record) {
    constexpr size_t kFindings = 16, kTextBytes = 1024;
    std::vector<diff::Finding>& findings = record.outcome.findings;
    const Evidence& evidence = record.evidence;
    const bool is_long = evidence.pictures.width > 0 || evidence.reference.width > 0 ||
                         !evidence.samples.empty() || !record.drawn.messages.empty() ||
                         findings.size() > kFindings || record.death.output.size() > kTextBytes;
    record.evidence = {};
    record.drawn.messages = {};
    std::ranges::stable_sort(findings, {}, &diff::Finding::level);
    findings.resize(std::min(findings.size(), kFindings));
    findings.shrink_to_fit();
    record.death.output = record.death.output.substr(0, kTextBytes);
    return is_long;
}

// Puts records together, in the order of the file.
class Rebuilder {
  public:
    // Records behind so many bytes of "end" records are shortened.
    explicit Rebuilder(size_t detailed_bytes) : most_detailed_(detailed_bytes) {}

    // `ended`: what decode makes of an "end" record, if it is known; `bytes`: of its line.
    void add(const Json& record, std::optional<CaseRecord> ended, size_t bytes) {
        if (!record.is_object() || !record.contains("record") || !record["record"].is_string()) {
            throw std::invalid_argument("this is not a record of a journal");
        }
        const auto& type = record["record"].get_ref<const std::string&>();
        if (type != "run" && !begun_) {
            throw std::invalid_argument("the journal does not begin with a \"run\" record");
        }
        if (type == "run") {
            add_run(record);
        } else if (type == "device") {
            run_.device = decode<capture::DeviceInfo>(record);
        } else if (type == "begin") {
            open_.insert(known(decode_id(record)));
        } else if (type == "end") {
            CaseRecord done = ended ? std::move(*ended) : decode<CaseRecord>(record);
            const size_t at = known(done.id);
            open_.erase(at);
            detailed_ += bytes;
            if (detailed_ > most_detailed_ && shorten(done)) {
                shortened_.insert(at);
            } else {
                shortened_.erase(at);
            }
            run_.cases[at] = std::move(done);
        } else if (type == "stop") {
            decode<RunEnd>(record, "record", run_);
        } else {
            throw std::invalid_argument(fmt::format("\"{}\" is no kind of record", type));
        }
    }

    bool begun() const { return begun_; }
    Run take(std::vector<std::string>* in_flight) {
        if (in_flight != nullptr) {
            in_flight->clear();
            for (const size_t at : open_) {
                in_flight->push_back(run_.cases[at].id);
            }
        }
        run_.shortened_cases = shortened_.size();
        return std::move(run_);
    }

  private:
    static std::string decode_id(const Json& record) {
        const auto it = record.find("id");
        if (it == record.end()) {
            throw std::invalid_argument("\"id\" is missing");
        }
        return decode_text(*it, "id");
    }

    size_t known(const std::string& id) const {
        const auto it = index_.find(id);
        if (it == index_.end()) {
            throw std::invalid_argument(
                fmt::format("the case {} is not in the list that the run began with", id));
        }
        return it->second;
    }

    // The first run record opens the journal; a later one is a resumed run: what has ended stays.
    void add_run(const Json& record) {
        const auto format = record.find("format");
        if (format == record.end() || *format != kFormat) {
            throw std::invalid_argument(fmt::format(
                "the journal is not of format {}; use the edgecase that wrote it", kFormat));
        }
        Run header;
        decode<RunHeader>(record, "record", header);
        const auto cases = record.find("cases");
        if (cases == record.end() || !cases->is_array()) {
            throw std::invalid_argument("\"cases\" is not a list");
        }
        if (begun_) {
            header.started = run_.started;
            header.device = std::move(run_.device);
            header.seconds = run_.seconds;
            header.cases = std::move(run_.cases);
        }
        begun_ = true;
        run_ = std::move(header);
        for (const Json& entry : *cases) {
            CaseRecord c;
            decode<PlannedCase>(entry, "cases", c);
            if (index_.emplace(c.id, run_.cases.size()).second) {
                run_.cases.push_back(std::move(c));
            }
        }
    }

    Run run_;
    bool begun_ = false;
    std::map<std::string, size_t> index_;
    std::set<size_t> open_;  // begun and not ended
    size_t most_detailed_;
    size_t detailed_ = 0;  // bytes of "end" records
    std::set<size_t> shortened_;
};

// A line of the journal, read without the lines before it.
struct Line {
    std::optional<Json> record;  // none: this is not JSON
    size_t bytes = 0;
    std::optional<CaseRecord> ended;  // of a right "end" record
};

Line read_line(const std::string& text) {
    Line line;
    line.bytes = text.size();
    try {
        line.record = Json::parse(text);
        if (line.record->is_object() && line.record->value("record", "") == "end") {
            line.ended = decode<CaseRecord>(*line.record);
        }
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception&) {  // Rebuilder tells what is wrong, in the order of the file
    }
    return line;
}

// The next lines of a journal, read by several threads. Not all at once: what they are as values of
// the library takes ten times the memory of the text.
std::vector<Line> read_lines(std::istream& stream) {
    constexpr size_t kMost = 256;
    std::vector<std::string> texts;
    std::string text;
    // No newline: the write was cut short.
    while (texts.size() < kMost && std::getline(stream, text) && !stream.eof()) {
        texts.push_back(std::move(text));
    }
    std::vector<Line> lines(texts.size());
    cases::for_each_index(texts.size(), [&](size_t k) { lines[k] = read_line(texts[k]); });
    return lines;
}

cases::Expected<Run> load(const std::filesystem::path& dir, std::vector<std::string>* in_flight,
                          size_t detailed_bytes) {
    const std::string file = (dir / "journal.jsonl").string();
    const cases::Expected<std::filesystem::path> place = cases::place_inside(dir, file);
    if (!place) {
        return cases::failure("cannot read {}: {}; name the directory of a run", file,
                              place.error().message);
    }
    if (!std::filesystem::is_regular_file(*place)) {  // opening a pipe waits for its writer
        return cases::failure("cannot read {}: it is no ordinary file", file);
    }
    std::ifstream stream(*place, std::ios::binary);
    if (!stream) {
        return cases::failure("cannot read {}: {}; name the directory of a run", file,
                              std::strerror(errno));
    }
    Rebuilder rebuilder(detailed_bytes);
    uint32_t number = 0;
    const auto add = [&](Line& line) -> cases::Expected<void> {
        ++number;
        try {
            if (line.record) {
                rebuilder.add(*line.record, std::move(line.ended), line.bytes);
                return {};
            }
        } catch (const Json::exception&) {  // as if it were none
        } catch (const std::exception& e) {
            return failure_in(file, std::string(e.what()) + "; the journal was changed or damaged",
                              number);
        }
        return failure_in(file, "this line is not JSON; the journal was changed or damaged",
                          number);
    };
    for (std::vector<Line> lines = read_lines(stream); !lines.empty(); lines = read_lines(stream)) {
        for (Line& line : lines) {
            if (auto added = add(line); !added) {
                return tl::unexpected(added.error());
            }
        }
    }
    if (stream.bad()) {
        return cases::failure("cannot read {}: {}", file, std::strerror(errno));
    }
    if (!rebuilder.begun()) {
        return failure_in(file, "the journal ends before its first record; start the run again");
    }
    return rebuilder.take(in_flight);
}

}  // namespace

cases::Expected<Run> load_journal(const std::filesystem::path& dir,
                                  std::vector<std::string>* in_flight) {
    return load(dir, in_flight, SIZE_MAX);
}

cases::Expected<Run> load_for_reports(const std::filesystem::path& dir, size_t detailed_bytes) {
    return load(dir, nullptr, detailed_bytes);
}

}  // namespace report
