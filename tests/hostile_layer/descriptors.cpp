// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What a driver can do to a worker's descriptors: requests come on 3, results go to 4, pictures lie
// in the memory of 5 (run/process/process.hpp), what is printed goes to 1 and 2.
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdint>
#include <cstring>
#include <string>
#include <thread>

#include "behaviour.hpp"

namespace hostile {

namespace {

constexpr int kRequests = 3, kResults = 4, kShared = 5;
constexpr size_t kMiB = size_t{1} << 20;

void write_to(int fd, const void* bytes, size_t size) {
    for (const char* at = static_cast<const char*>(bytes); size > 0;) {
        const ssize_t n = ::write(fd, at, size);
        if (n <= 0) {
            return;
        }
        at += n;
        size -= static_cast<size_t>(n);
    }
}

// A frame's header that announces `length` bytes (run/process/frame.cpp).
void write_header(uint64_t length) {
    const uint64_t header[] = {0x31656d6672636465U, 8, length, 0};
    write_to(kResults, header, sizeof header);
}

void write_for_ever(int fd) {
    const std::string bytes(kMiB, '\x5a');
    for (;;) {
        write_to(fd, bytes.data(), bytes.size());
    }
}

// Writes over the pages that are there, again and again, beside what the worker does.
[[noreturn]] void scribble() {
    struct stat status {};
    ::fstat(kShared, &status);
    void* data = ::mmap(nullptr, static_cast<size_t>(status.st_size), PROT_READ | PROT_WRITE,
                        MAP_SHARED, kShared, 0);
    for (;; ::usleep(100)) {
        const off_t begin = ::lseek(kShared, 0, SEEK_DATA);
        if (data != MAP_FAILED && begin >= 0) {
            const off_t end = ::lseek(kShared, begin, SEEK_HOLE);
            std::memset(static_cast<char*>(data) + begin, 0x5a, static_cast<size_t>(end - begin));
        }
    }
}

void print(size_t mebibytes) {
    const std::string bytes(kMiB, 'x');
    for (size_t k = 0; k < mebibytes; ++k) {
        write_to(STDERR_FILENO, bytes.data(), bytes.size());
    }
}

}  // namespace

std::span<const Behaviour> descriptor_behaviours() {
    static constexpr Behaviour kBehaviours[] = {
        {"close-requests", Point::submit, [] { ::close(kRequests); }},
        {"close-results", Point::submit, [] { ::close(kResults); }},
        {"close-shared", Point::device, [] { ::close(kShared); }},
        {"close-output", Point::submit,
         [] {
             ::close(STDOUT_FILENO);
             ::close(STDERR_FILENO);
         }},
        {"close-all", Point::submit, [] { ::close_range(0, ~0U, 0); }},
        {"steal-requests", Point::submit,
         [] {
             char bytes[4096];
             ::fcntl(kRequests, F_SETFL, O_NONBLOCK);
             while (::read(kRequests, bytes, sizeof bytes) > 0) {
             }
         }},
        {"results-nonblocking", Point::instance,
         [] {
             ::fcntl(kRequests, F_SETFL, O_NONBLOCK);
             ::fcntl(kResults, F_SETFL, O_NONBLOCK);
         }},
        {"results-garbage", Point::submit,
         [] { write_to(kResults, std::string(5000, '\x5a').data(), 5000); }},
        {"results-half-a-frame", Point::submit,
         [] {
             write_header(100);
             ::_exit(0);
         }},
        {"results-60-gib", Point::submit,
         [] {
             write_header(uint64_t{60} << 30);
             write_for_ever(kResults);
         }},
        {"results-60-gib-and-wait", Point::submit,
         [] {
             write_header(uint64_t{60} << 30);
             for (;;) {
                 ::pause();
             }
         }},
        {"results-without-end", Point::instance, [] { write_for_ever(kResults); }},
        {"shared-scribbled", Point::submit, [] { std::thread(scribble).detach(); }},
        {"shared-truncated", Point::submit,
         [] {
             if (::ftruncate(kShared, 0) != 0) {
                 ::fallocate(kShared, FALLOC_FL_PUNCH_HOLE | FALLOC_FL_KEEP_SIZE, 0, 1 << 30);
             }
         }},
        {"output-200-mb", Point::submit, [] { print(200); }},
        {"output-without-end", Point::submit, [] { write_for_ever(STDOUT_FILENO); }},
        {"output-esc-and-nul", Point::submit,
         [] {
             constexpr char kNoise[] =
                 "\x1b]0;title\x07\x1b[31m \0 \xff ]]> </script>\n::error::x\n";
             write_to(STDERR_FILENO, kNoise, sizeof kNoise - 1);
             ::_exit(1);
         }},
    };
    return kBehaviours;
}

}  // namespace hostile
