// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "run/process/pool.hpp"

#include <poll.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <utility>

#include "run/process/process.hpp"

namespace run {

namespace {

// Threads of abandoned pools that have not ended.
std::atomic<size_t> abandoned_threads = 0;

}  // namespace

struct Pool::State {
    struct Task {
        std::function<void()> work, finish;
    };
    Fd event{::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)};
    std::mutex mutex;
    std::condition_variable changed;
    std::deque<Task> waiting, done;
    bool stop = false;
    bool is_abandoned = false;
};

Pool::Pool(unsigned threads) : state_(std::make_shared<State>()) {
    for (unsigned k = 0; k < std::max(threads, 1U); ++k) {
        threads_.emplace_back([state = state_]() mutable {
            run(*state);
            bool is_abandoned = false;
            {
                const std::lock_guard lock(state->mutex);
                is_abandoned = state->is_abandoned;
            }
            state.reset();
            if (is_abandoned) {
                --abandoned_threads;
            }
        });
    }
}

Pool::~Pool() {
    {
        const std::lock_guard lock(state_->mutex);
        state_->stop = true;
        state_->waiting.clear();
    }
    state_->changed.notify_all();
    for (std::thread& thread : threads_) {
        thread.join();
    }
}

void Pool::abandon() {
    {
        const std::lock_guard lock(state_->mutex);
        state_->stop = true;
        state_->is_abandoned = true;
        state_->waiting.clear();
    }
    abandoned_threads += threads_.size();
    state_->changed.notify_all();
    for (std::thread& thread : threads_) {
        thread.detach();
    }
    threads_.clear();
}

bool Pool::has_abandoned() {
    return abandoned_threads > 0;
}

int Pool::fd() const {
    return state_->event.get();
}

void Pool::submit(std::function<void()> work, std::function<void()> finish) {
    ++outstanding_;
    {
        const std::lock_guard lock(state_->mutex);
        state_->waiting.push_back({std::move(work), std::move(finish)});
    }
    state_->changed.notify_one();
}

void Pool::run(State& state) {
    for (;;) {
        State::Task task;
        {
            std::unique_lock lock(state.mutex);
            state.changed.wait(lock, [&] { return state.stop || !state.waiting.empty(); });
            if (state.stop) {
                return;
            }
            task = std::move(state.waiting.front());
            state.waiting.pop_front();
        }
        task.work();
        {
            const std::lock_guard lock(state.mutex);
            state.done.push_back(std::move(task));
        }
        ::eventfd_write(state.event.get(), 1);
    }
}

void Pool::collect() {
    eventfd_t ignored = 0;
    ::eventfd_read(state_->event.get(), &ignored);
    std::deque<State::Task> done;
    {
        const std::lock_guard lock(state_->mutex);
        done.swap(state_->done);
    }
    for (State::Task& task : done) {
        --outstanding_;
        task.finish();
    }
}

void Pool::wait() const {
    pollfd fd{state_->event.get(), POLLIN, 0};
    ::poll(&fd, 1, -1);
}

}  // namespace run
