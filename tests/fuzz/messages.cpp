// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What comes through a worker's pipe: frames of any bytes, and a request and a result with a right
// checksum and any change inside.
#include "cases/load/loader.hpp"
#include "run/process/frame.hpp"
#include "run/worker/message.hpp"
#include "tests/fuzz/input.hpp"

namespace {

struct Whole {
    std::string request, result, frames;
    Whole() {
        const auto loaded = cases::load_text(
            "format = 1\ndescription = \"A triangle.\"\nrules = [\"cover.inside\"]\n[target]\n"
            "size = [4, 4]\n[[draw]]\nvertices = [[0,0], [4,0], [0,4]]\n",
            "case.toml", "case");
        fuzz::require(loaded.has_value());
        request = run::encode_request(1, {0, 4096}, {&loaded->front()});
        run::CaseResult drawn;
        drawn.rendered.capture.target = loaded->front().target;
        drawn.is_shared = true;
        result = run::encode_result(drawn);
        frames = run::encode_frame(run::FrameType::step, "submit") +
                 run::encode_frame(run::FrameType::result, result) +
                 run::encode_frame(run::FrameType::batch_done, "");
    }
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    static const Whole whole;
    const std::string_view edits = fuzz::text_of(data, size);
    (void)run::decode_request(fuzz::edited(whole.request, edits));
    (void)run::decode_result(fuzz::edited(whole.result, edits));
    run::FrameReader reader;
    const std::string stream = fuzz::edited(whole.frames, edits);
    for (size_t at = 0; at < stream.size(); at += 7) {  // in pieces, as a pipe gives them
        reader.feed(std::string_view(stream).substr(at, 7));
        while (const auto frame = reader.next()) {
            fuzz::require(!reader.is_malformed());
        }
    }
    return 0;
}
