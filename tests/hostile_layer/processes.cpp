// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What a driver can do to the process that it is in, and by starting others.
#include <alloca.h>
#include <dirent.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>
#ifdef __SSE2__
#include <xmmintrin.h>
#endif

#include <atomic>
#include <cfenv>
#include <clocale>
#include <cstdlib>
#include <cstring>
#include <stdexcept>
#include <thread>

#include "behaviour.hpp"

namespace hostile {

namespace {

constexpr unsigned kLongest = 600;  // seconds that a process may be left over, whatever goes wrong

[[noreturn]] void wait_for_ever() {
    for (;;) {
        ::pause();
    }
}

// Processes that sleep and hold every descriptor open.
void leave_behind(int count, bool escapes) {
    for (int k = 0; k < count; ++k) {
        if (::fork() == 0) {
            if (escapes) {
                ::setsid();
            }
            ::sleep(kLongest);
            ::_exit(0);
        }
    }
}

void block_signals() {
    sigset_t all;
    ::sigfillset(&all);
    ::sigprocmask(SIG_SETMASK, &all, nullptr);
    for (int k = 1; k < NSIG; ++k) {
        ::signal(k, SIG_IGN);
    }
}

void limit(__rlimit_resource resource, rlim_t most) {
    const rlimit to{most, most};
    ::setrlimit(resource, &to);
}

// Until the limit, which the behaviour sets itself, so that a machine is not what ends it.
void allocate_without_end() {
    constexpr size_t kChunk = size_t{1} << 24;
    limit(RLIMIT_AS, rlim_t{6} << 30);
    for (;;) {
        if (void* memory = std::malloc(kChunk)) {
            std::memset(memory, 1, kChunk / 64);
        } else {
            std::abort();
        }
    }
}

void overflow_stack() {
    for (;;) {
        *static_cast<volatile char*>(::alloca(4096)) = 1;
    }
}

void unlink_files() {
    DIR* folder = ::opendir(".");
    while (const dirent* entry = folder != nullptr ? ::readdir(folder) : nullptr) {
        ::unlink(entry->d_name);  // which takes no folder
    }
}

[[noreturn]] void spin() {
    for (std::atomic<unsigned> n = 0;; ++n) {
    }
}

}  // namespace

std::span<const Behaviour> process_behaviours() {
    static constexpr Behaviour kBehaviours[] = {
        {"exit", Point::submit, [] { std::exit(0); }},
        {"exit-by-status", Point::submit, [] { ::_exit(77); }},
        {"exit-by-atexit", Point::submit,
         [] {
             std::atexit([] { ::_exit(3); });
             std::exit(0);
         }},
        {"hang-at-exit", Point::submit,
         [] {
             std::atexit([] { wait_for_ever(); });
             std::exit(0);
         }},
        {"abort", Point::submit, [] { std::abort(); }},
        {"segv", Point::submit, [] { ::raise(SIGSEGV); }},
        {"stack-overflow", Point::submit, [] { overflow_stack(); }},
        {"throw", Point::submit, [] { throw std::runtime_error("thrown by a driver"); }},
        {"hang", Point::submit, [] { wait_for_ever(); }},
        {"hang-and-ignore", Point::submit,
         [] {
             block_signals();
             wait_for_ever();
         }},
        {"spin", Point::submit, [] { spin(); }},
        {"spin-in-threads", Point::submit,
         [] {
             for (int k = 0; k < 2; ++k) {
                 std::thread(spin).detach();
             }
         }},
        {"stop-itself", Point::submit, [] { ::raise(SIGSTOP); }},
        {"slow", Point::submit, [] { ::sleep(1); }},
        {"leave-a-child", Point::instance, [] { leave_behind(1, false); }},
        {"leave-children", Point::submit, [] { leave_behind(30, false); }},
        {"leave-a-child-and-exit", Point::submit,
         [] {
             leave_behind(1, false);
             ::_exit(0);
         }},
        {"leave-an-escaped-child", Point::submit, [] { leave_behind(1, true); }},
        {"exec-sleep", Point::submit,
         [] { ::execl("/bin/sleep", "sleep", "600", static_cast<char*>(nullptr)); }},
        {"exec-true", Point::submit,
         [] { ::execl("/bin/true", "true", static_cast<char*>(nullptr)); }},
        {"block-signals", Point::instance, [] { block_signals(); }},
        {"return-from-segv", Point::submit,
         [] {
             ::signal(SIGSEGV, [](int) {});
             *reinterpret_cast<volatile int*>(uintptr_t{16}) = 1;  // again and again
         }},
        {"interrupt-the-parent", Point::submit, [] { ::kill(-::getpgid(::getppid()), SIGINT); }},
        {"terminate-the-parent", Point::submit, [] { ::kill(-::getpgid(::getppid()), SIGTERM); }},
        {"disturb-the-parent", Point::submit,
         [] {
             for (const int signal : {SIGPIPE, SIGCHLD, SIGWINCH, SIGCONT}) {
                 ::kill(::getppid(), signal);
             }
         }},
        {"join-the-parents-group", Point::submit,
         [] {
             ::setpgid(0, ::getpgid(::getppid()));
             wait_for_ever();
         }},
        {"leave-the-session", Point::submit,
         [] {
             if (::fork() != 0) {
                 ::_exit(0);  // a leader of a group cannot, its child can
             }
             ::setsid();
             ::sleep(kLongest);
             ::_exit(0);
         }},
        {"allocate-without-end", Point::submit, [] { allocate_without_end(); }},
        {"no-descriptors", Point::submit, [] { limit(RLIMIT_NOFILE, 0); }},
        {"no-file-sizes", Point::submit, [] { limit(RLIMIT_FSIZE, 0); }},
        {"clear-environment", Point::instance, [] { ::clearenv(); }},
        {"locale", Point::instance, [] { std::setlocale(LC_ALL, "C.UTF-8"); }},
        {"rounding", Point::instance, [] { std::fesetround(FE_UPWARD); }},
        {"flush-to-zero", Point::instance,
         [] {
#ifdef __SSE2__
             ::_mm_setcsr(::_mm_getcsr() | 0x8040U);
#endif
         }},
        {"other-folder", Point::instance,
         [] {
             if (::chdir("/") != 0) {
                 std::abort();
             }
         }},
        {"umask", Point::instance, [] { ::umask(0777); }},
        {"unlink-files", Point::submit, [] { unlink_files(); }},
    };
    return kBehaviours;
}

}  // namespace hostile
