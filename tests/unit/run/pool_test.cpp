// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "run/process/pool.hpp"

#include <gtest/gtest.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <latch>
#include <memory>
#include <new>
#include <vector>

#include "cases/base/parallel.hpp"
#include "run/process/signal_fd.hpp"

namespace run {
namespace {

TEST(Pool, FinishesWhereItIsCollected) {
    Pool pool(2);
    int sum = 0;
    for (int k = 1; k <= 10; ++k) {
        auto made = std::make_shared<int>(0);
        pool.submit([made, k] { *made = k; }, [made, &sum] { sum += *made; });
    }
    while (pool.outstanding() > 0) {
        pool.wait();
        pool.collect();
    }
    EXPECT_EQ(sum, 55);
    EXPECT_FALSE(Pool::has_abandoned());
}

// A pool that waited for the task would never be destroyed here.
TEST(Pool, DoesNotWaitForWhatItAbandons) {
    std::latch begun{1}, goes_on{1};
    auto own = std::make_shared<int>(0);
    const std::weak_ptr<int> seen = own;
    {
        Pool pool(2);
        pool.submit(
            [&, own = std::move(own)] {
                begun.count_down();
                goes_on.wait();
            },
            [] { ADD_FAILURE() << "nobody collects it"; });
        begun.wait();
        pool.abandon();
    }
    EXPECT_TRUE(Pool::has_abandoned());
    EXPECT_FALSE(seen.expired());
    goes_on.count_down();
    while (Pool::has_abandoned()) {
        ::poll(nullptr, 0, 1);
    }
    EXPECT_TRUE(seen.expired());
}

// What the work of a task throws reaches whoever collects it, and no thread dies of it.
TEST(Pool, ThrowsWhatWorkHasThrown) {
    Pool pool(1);
    pool.submit([] { throw std::bad_alloc(); }, [] { ADD_FAILURE() << "it was not done"; });
    pool.wait();
    EXPECT_THROW(pool.collect(), std::bad_alloc);
}

// Not one thread is left to a process of this user: all is done, by whoever waits for it.
TEST(Pool, AndLoopsDoAllWithoutAnyThread) {
    const pid_t child = ::fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
        constexpr uid_t kNobody = 65533;
        const rlimit none{0, 0};
        const bool is_limited = (::getuid() != 0 || ::setresuid(kNobody, kNobody, kNobody) == 0) &&
                                ::setrlimit(RLIMIT_NPROC, &none) == 0 && !cases::try_thread([] {});
        int sum = 0;
        Pool pool(2);
        for (int k = 1; k <= 10; ++k) {
            pool.submit([] {}, [&sum, k] { sum += k; });
        }
        while (pool.outstanding() > 0) {
            pool.wait();
            pool.collect();
        }
        std::vector<int> of(100, 0);
        cases::for_each_index(of.size(), [&of](size_t k) { ++of[k]; });
        const bool is_done = cases::beside([] { return 7; }).get() == 7;
        const bool is_right = sum == 55 && is_done && of == std::vector<int>(100, 1);
        ::_exit(!is_limited ? 2 : is_right ? 0 : 1);
    }
    int status = 0;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    ASSERT_TRUE(WIFEXITED(status));
    EXPECT_EQ(WEXITSTATUS(status), 0);
}

void say(int end, char what) {
    while (::write(end, &what, 1) != 1) {
    }
}

// Whatever the process does after the first signal, another one ends it.
TEST(SignalFd, TheSecondSignalEndsTheProcess) {
    std::array<int, 2> ends{};
    ASSERT_EQ(::pipe(ends.data()), 0);
    const pid_t child = ::fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
        ::prctl(PR_SET_PDEATHSIG, SIGKILL);
        SignalFd signals;
        say(ends[1], 'r');
        while (!signals.has_come()) {
            ::poll(nullptr, 0, 1);
        }
        say(ends[1], '1');
        for (;;) {
            ::pause();
        }
    }
    char said = 0;
    ASSERT_EQ(::read(ends[0], &said, 1), 1);
    ASSERT_EQ(::kill(child, SIGINT), 0);
    ASSERT_EQ(::read(ends[0], &said, 1), 1);  // it goes on after the first
    EXPECT_EQ(said, '1');
    int status = 0;
    while (::waitpid(child, &status, WNOHANG) == 0) {
        ::kill(child, SIGINT);
        ::poll(nullptr, 0, 50);
    }
    EXPECT_TRUE(WIFEXITED(status));
    EXPECT_EQ(WEXITSTATUS(status), 130);
    ::close(ends[0]);
    ::close(ends[1]);
}

// Not even the first one finds anybody who waits for it.
TEST(SignalFd, ASignalEndsAProcessThatDoesNotLook) {
    const pid_t child = ::fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
        ::prctl(PR_SET_PDEATHSIG, SIGKILL);
        SignalFd signals;
        ::raise(SIGTERM);
        for (;;) {
            ::pause();
        }
    }
    int status = 0;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    EXPECT_TRUE(WIFEXITED(status));
    EXPECT_EQ(WEXITSTATUS(status), 130);
}

}  // namespace
}  // namespace run
