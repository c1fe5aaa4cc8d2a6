// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "run/process/pool.hpp"

#include <gtest/gtest.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <latch>
#include <memory>

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

}  // namespace
}  // namespace run
