// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "run/process/pool.hpp"

#include <poll.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <condition_variable>
#include <deque>
#include <exception>
#include <mutex>
#include <optional>
#include <system_error>
#include <utility>

#include "cases/base/parallel.hpp"
#include "run/process/process.hpp"

namespace run {

namespace {

// Threads of abandoned pools that have not ended.
std::atomic<size_t> abandoned_threads = 0;

}  // namespace

struct Pool::State {
    struct Task {
        std::function<void()> work, finish;
        std::exception_ptr error;  // of the work
    };
    Fd event{::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)};
    std::mutex mutex;
    std::condition_variable changed;
    std::deque<Task> waiting, done;
    bool stop = false;
    bool is_abandoned = false;
};

Pool::Pool(unsigned threads) : state_(std::make_shared<State>()) {
    if (!state_->event.is_open()) {
        throw std::system_error(errno, std::generic_category());
    }
    for (unsigned k = 0; k < std::max(threads, 1U); ++k) {
        std::optional<std::thread> thread = cases::try_thread([state = state_]() mutable {
            while (do_next(*state, true)) {
            }
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
        if (!thread) {
            break;
        }
        threads_.push_back(std::move(*thread));
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
        state_->waiting.push_back({std::move(work), std::move(finish), nullptr});
    }
    if (threads_.empty()) {  // collect() works
        ::eventfd_write(state_->event.get(), 1);
    }
    state_->changed.notify_one();
}

bool Pool::do_next(State& state, bool waits) {
    State::Task task;
    {
        std::unique_lock lock(state.mutex);
        if (waits) {
            state.changed.wait(lock, [&] { return state.stop || !state.waiting.empty(); });
        }
        if (state.stop || state.waiting.empty()) {
            return false;
        }
        task = std::move(state.waiting.front());
        state.waiting.pop_front();
    }
    try {
        task.work();
    } catch (...) {
        task.error = std::current_exception();
    }
    {
        const std::lock_guard lock(state.mutex);
        state.done.push_back(std::move(task));
    }
    ::eventfd_write(state.event.get(), 1);
    return true;
}

void Pool::collect() {
    eventfd_t ignored = 0;
    ::eventfd_read(state_->event.get(), &ignored);
    if (threads_.empty()) {
        do_next(*state_, false);
    }
    std::deque<State::Task> done;
    {
        const std::lock_guard lock(state_->mutex);
        done.swap(state_->done);
    }
    for (State::Task& task : done) {
        --outstanding_;
        if (task.error) {
            std::rethrow_exception(task.error);
        }
        task.finish();
    }
}

void Pool::wait() const {
    pollfd fd{state_->event.get(), POLLIN, 0};
    ::poll(&fd, 1, -1);
}

}  // namespace run
