// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "run/worker/worker.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <span>
#include <vector>

#include "capture/checksum.hpp"
#include "cases/base/heap.hpp"
#include "cases/base/limits.hpp"
#include "cases/format/color_format.hpp"
#include "cases/model/derive.hpp"
#include "report/record/run.hpp"
#include "run/process/frame.hpp"
#include "run/process/shared_memory.hpp"
#include "run/worker/derived.hpp"
#include "run/worker/fault.hpp"
#include "run/worker/message.hpp"

namespace run {

namespace {

using capture::Rendered;

void send(FrameType type, std::string_view payload) {
    if (!write_all(kResultFd, encode_frame(type, payload))) {
        ::_exit(report::kExitInternal);  // the parent is gone
    }
}

// The next frame of the parent; nothing at the end of the pipe.
std::optional<Frame> receive(FrameReader& reader) {
    for (;;) {
        if (std::optional<Frame> frame = reader.next(); frame) {
            return frame;
        }
        std::vector<char> chunk(size_t{1} << 16);
        const ssize_t n = ::read(kRequestFd, chunk.data(), chunk.size());
        if (n < 0 && errno == EINTR) {
            continue;
        }
        if (n <= 0 || reader.is_malformed()) {
            return std::nullopt;
        }
        reader.feed({chunk.data(), static_cast<size_t>(n)});
    }
}

// Bytes that no report may pass on as they are: ESC, NUL, invalid UTF-8, ends of CDATA and script.
void print_noise() {
    constexpr char kNoise[] =
        "driver \x1b[31mred\x1b[0m \0 nul \xff\xfe ]]> </script> & <b> \xed\xa0\x80\n";
    std::fwrite(kNoise, 1, sizeof kNoise - 1, stderr);
    std::fwrite(kNoise, 1, sizeof kNoise - 1, stdout);
    std::fflush(stdout);
}

// The planes of a rendering, wherever they lie.
capture::PlaneSpans planes_of(Rendered& rendered) {
    capture::Capture& own = rendered.capture;
    return rendered.placed.empty()
               ? capture::PlaneSpans(own)
               : capture::planes_at(own.target, own.attribute_count, rendered.placed.data());
}

// Another colour in the middle of a target that counts no hits, or `skipped` samples after it: the
// second highest bit of red; without colours another depth, or another stencil.
void flip_color(const capture::PlaneSpans& planes, uint32_t skipped) {
    if (const std::span codes = planes.color; !codes.empty()) {
        codes[(codes.size() / 2 + skipped) % codes.size()][0] ^=
            1U << (cases::component_of(planes.target.color->format, 0).bits - 2);
    } else if (const std::span depths = planes.depth; !depths.empty()) {
        float& depth = depths[(depths.size() / 2 + skipped) % depths.size()];
        depth = depth > 0.5F ? 0.125F : 0.875F;
    } else if (const std::span stencils = planes.stencil; !stencils.empty()) {
        stencils[(stencils.size() / 2 + skipped) % stencils.size()] ^= 64U;
    }
}

// Indices of the samples that were hit, from the middle of the target on.
std::vector<size_t> drawn_from_the_middle(std::span<const glm::vec4> hits) {
    std::vector<size_t> drawn;
    for (size_t k = 0; k < hits.size(); ++k) {
        const size_t at = (hits.size() / 2 + k) % hits.size();
        if (hits[at].x + hits[at].y > 0) {
            drawn.push_back(at);
        }
    }
    return drawn;
}

// One hit more at a drawn sample: a double hit.
void flip_pixel(Rendered& rendered, uint32_t skipped = 0) {
    const capture::PlaneSpans planes = planes_of(rendered);
    const std::vector<size_t> drawn = drawn_from_the_middle(planes.hits);
    if (!planes.target.has_instruments) {
        flip_color(planes, skipped);
    } else if (!drawn.empty()) {
        glm::vec4& hit = planes.hits[drawn[skipped % drawn.size()]];
        hit.x += 1;
        hit.w += 1;
    }
}

// One more in the first attribute of a drawn sample, or, after all of those, in its FragCoord.x.
void shift_value(Rendered& rendered, uint32_t skipped) {
    const capture::PlaneSpans planes = planes_of(rendered);
    std::vector<float*> values;
    for (const std::span plane : {planes.attributes[0], planes.frag_coord}) {
        for (const size_t at : drawn_from_the_middle(planes.hits)) {
            if (!plane.empty() && std::isfinite(plane[at].x)) {
                values.push_back(&plane[at].x);
            }
        }
    }
    if (!planes.target.has_instruments) {
        flip_color(planes, skipped);
    } else if (!values.empty()) {
        *values[skipped % values.size()] += 1;
    }
}

// The message about a result, with its planes or with the place where they lie.
std::string frame_of(uint32_t k, RenderedCase drawn, const SharedWriter& shared) {
    CaseResult result;
    result.index = k;
    result.consistency = std::move(drawn.consistency);
    Rendered& rendered = drawn.rendered;
    if (!rendered.placed.empty() && rendered.status == Rendered::Status::drawn) {
        result.is_shared = true;
        result.offset = shared.offset_of(rendered.placed);
        result.bits = capture::capture_bits(view_of(rendered));
    }
    result.rendered = std::move(rendered);
    return encode_frame(FrameType::result, encode_result(result));
}

void render_batch(capture::Renderer& renderer, const RenderRequest& request,
                  const std::vector<Fault>& faults, SharedWriter& shared) {
    const auto step = [](std::string_view name) { send(FrameType::step, name); };
    for (const cases::Case& c : request.cases) {
        if (has_fault(faults, FaultKind::noise, c.id)) {
            print_noise();
        }
        for (const FaultKind kind : {FaultKind::segv, FaultKind::abort, FaultKind::hang,
                                     FaultKind::flood, FaultKind::oom, FaultKind::exit0}) {
            if (has_fault(faults, kind, c.id)) {
                step("submit");
                commit(kind);
            }
        }
    }
    shared.open(request.room.offset, request.room.size);
    std::vector<RenderedCase> results;
    try {
        results = render_with_derived(
            renderer, request.cases, step,
            [&shared](size_t, uint64_t bytes) { return shared.place(bytes); },
            [&](size_t k, Rendered& derived) {
                if (has_fault(faults, FaultKind::flip_derived, request.cases[k].id)) {
                    flip_pixel(derived);
                }
            });
    } catch (const std::exception& e) {
        if (!cases::is_limit(e)) {
            throw;
        }
        results = std::vector<RenderedCase>(request.cases.size());
        for (RenderedCase& r : results) {
            r.rendered.status = Rendered::Status::error;
            r.rendered.reason = "in the worker " + cases::reason_of(e);
        }
    }
    for (const cases::Case& c : request.cases) {
        if (has_fault(faults, FaultKind::device_lost, c.id)) {
            for (RenderedCase& r : results) {
                r.rendered.status = Rendered::Status::device_lost;
                r.rendered.reason = "the device was lost on purpose (EDGECASE_FAULT)";
            }
        }
    }
    for (size_t k = 0; k < results.size(); ++k) {
        const std::string& id = request.cases[k].id;
        if (has_fault(faults, FaultKind::unsupported, id)) {
            results[k].rendered.status = Rendered::Status::unsupported;
            results[k].rendered.reason = "unsupported on purpose (EDGECASE_FAULT)";
        }
        if (const Fault* fault = find_fault(faults, FaultKind::flip_pixel, id); fault != nullptr) {
            flip_pixel(results[k].rendered, fault->skipped);
        } else if (request.attempt == 1 && has_fault(faults, FaultKind::flake, id)) {
            flip_pixel(results[k].rendered);
        }
        if (const Fault* fault = find_fault(faults, FaultKind::shift_value, id); fault != nullptr) {
            shift_value(results[k].rendered, fault->skipped);
        }
        const std::string frame = frame_of(static_cast<uint32_t>(k), std::move(results[k]), shared);
        if (has_fault(faults, FaultKind::truncate, id)) {
            write_all(kResultFd, std::string_view(frame).substr(0, frame.size() / 2));
            ::_exit(0);
        }
        if (has_fault(faults, FaultKind::garbage, id)) {
            write_all(kResultFd, std::string(4096, '\x5a'));
        }
        if (!write_all(kResultFd, frame)) {
            ::_exit(report::kExitInternal);
        }
    }
    shared.lock();
    send(FrameType::batch_done, {});
    cases::give_back_memory();  // the driver's, too, if it draws on the CPU
}

// What the device lacks for a case, whose relations name doors only if it is of doors alone
// (ask_what_is_lacking): it shows nothing on a device that has none of them (lacking_doors in
// run/judge.cpp says so of a drawn one).
std::string lacking_of(const capture::Renderer& renderer, const cases::Case& c) {
    std::string reason = renderer.lacking(c);
    if (!reason.empty()) {
        return reason;
    }
    for (const cases::Derivation& d : cases::derivations(c)) {
        const bool is_own = d.kind == cases::RelationKind::door &&
                            std::any_of(c.relations.begin(), c.relations.end(),
                                        [&](const auto& r) { return r.door == d.variation.door; });
        if (is_own) {
            const std::string closed = renderer.lacking(cases::derive(c, d));
            if (closed.empty()) {
                return {};
            }
            reason = reason.empty() ? closed : reason;
        }
    }
    return reason;
}

void answer_what_is_lacking(const capture::Renderer& renderer, const RenderRequest& request) {
    for (size_t k = 0; k < request.cases.size(); ++k) {
        CaseResult result;
        result.index = static_cast<uint32_t>(k);
        result.rendered.reason = lacking_of(renderer, request.cases[k]);
        if (!result.rendered.reason.empty()) {
            result.rendered.status = Rendered::Status::unsupported;
        }
        send(FrameType::result, encode_result(result));
    }
    send(FrameType::batch_done, {});
}

tl::unexpected<capture::Failure> no_device(const std::string& why) {
    return tl::unexpected(capture::Failure{capture::Stage::device, why, {}, {}, false});
}

capture::Result<std::vector<capture::DeviceInfo>> list_devices(
    capture::RendererKinds renderers, const capture::RendererOptions& options) {
    const capture::RendererKind* const kind = capture::find_renderer(renderers, options.renderer);
    if (kind == nullptr || kind->list == nullptr) {
        return no_device("the renderer '" + options.renderer + "' has no list of devices");
    }
    return kind->list(options);
}

capture::Result<std::unique_ptr<capture::Renderer>> make_renderer(
    capture::RendererKinds renderers, const capture::RendererOptions& options) {
    const capture::RendererKind* const kind = capture::find_renderer(renderers, options.renderer);
    return kind == nullptr ? no_device("there is no renderer '" + options.renderer + "'")
                           : kind->make(options);
}

}  // namespace

int run_worker(capture::RendererKinds renderers) {
    FrameReader reader;
    if (::isatty(kRequestFd) == 1 || ::fcntl(kRequestFd, F_GETFD) < 0 ||
        ::fcntl(kResultFd, F_GETFD) < 0) {
        std::fputs("edgecase: 'worker' is started by 'edgecase run' itself, not by hand\n", stderr);
        return report::kExitUsage;
    }
    const char* list = std::getenv("EDGECASE_FAULT");
    const auto parsed = parse_faults(list != nullptr ? list : "");
    const std::vector<Fault> faults = parsed.value_or(std::vector<Fault>());
    if (has_fault(faults, FaultKind::segv_at_start, "")) {
        commit(FaultKind::segv);
    }
    if (has_fault(faults, FaultKind::hang_at_start, "")) {
        commit(FaultKind::hang);
    }
    // A worker answers what it was asked; one that ended first would look like one that died.
    const std::string refused = !parsed ? parsed.error().message
                                : has_fault(faults, FaultKind::no_device, "")
                                    ? "no device, on purpose (EDGECASE_FAULT)"
                                    : "";
    WorkerOptions options;
    SharedWriter shared(kSharedFd);
    if (const Fd null(::open("/dev/null", O_RDONLY | O_CLOEXEC));
        ::fcntl(kSharedFd, F_GETFD) >= 0) {
        // Through the descriptor a driver could change pictures that are being judged. Its number
        // stays taken.
        ::dup2(null.get(), kSharedFd);
    }
    std::unique_ptr<capture::Renderer> renderer;
    while (std::optional<Frame> frame = receive(reader)) {
        if (frame->type == FrameType::configure) {
            const std::optional<WorkerOptions> decoded = decode<WorkerOptions>(frame->payload);
            if (!decoded) {
                return report::kExitInternal;
            }
            options = *decoded;
        } else if (frame->type == FrameType::list_devices) {
            const auto devices =
                parsed ? list_devices(renderers, options.device) : no_device(refused);
            send(devices ? FrameType::devices : FrameType::no_device,
                 devices ? encode(*devices) : encode(devices.error()));
        } else if (frame->type == FrameType::hello) {
            auto made =
                refused.empty() ? make_renderer(renderers, options.device) : no_device(refused);
            if (!made) {
                send(FrameType::no_device, encode(made.error()));
                continue;
            }
            renderer = std::move(*made);
            send(FrameType::hello, encode(renderer->device()));
        } else if (frame->type == FrameType::render && renderer != nullptr) {
            const std::optional<RenderRequest> request = decode_request(frame->payload);
            if (!request) {
                return report::kExitInternal;
            }
            if (options.only_asks) {
                answer_what_is_lacking(*renderer, *request);
            } else {
                render_batch(*renderer, *request, faults, shared);
            }
        } else {
            return report::kExitInternal;
        }
    }
    // The driver is not torn down: what it does at exit belongs to no case.
    std::fflush(nullptr);
    ::_exit(0);
}

}  // namespace run
