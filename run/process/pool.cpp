// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "run/process/pool.hpp"

#include <poll.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <algorithm>

namespace run {

Pool::Pool(unsigned threads) : event_(::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)) {
    for (unsigned k = 0; k < std::max(threads, 1U); ++k) {
        threads_.emplace_back([this] { run(); });
    }
}

Pool::~Pool() {
    {
        const std::lock_guard lock(mutex_);
        stop_ = true;
        waiting_.clear();
    }
    changed_.notify_all();
    for (std::thread& thread : threads_) {
        thread.join();
    }
}

void Pool::submit(std::function<void()> work, std::function<void()> finish) {
    ++outstanding_;
    {
        const std::lock_guard lock(mutex_);
        waiting_.push_back({std::move(work), std::move(finish)});
    }
    changed_.notify_one();
}

void Pool::run() {
    for (;;) {
        Task task;
        {
            std::unique_lock lock(mutex_);
            changed_.wait(lock, [this] { return stop_ || !waiting_.empty(); });
            if (stop_) {
                return;
            }
            task = std::move(waiting_.front());
            waiting_.pop_front();
        }
        task.work();
        {
            const std::lock_guard lock(mutex_);
            done_.push_back(std::move(task));
        }
        ::eventfd_write(event_.get(), 1);
    }
}

void Pool::collect() {
    eventfd_t ignored = 0;
    ::eventfd_read(event_.get(), &ignored);
    std::deque<Task> done;
    {
        const std::lock_guard lock(mutex_);
        done.swap(done_);
    }
    for (Task& task : done) {
        --outstanding_;
        task.finish();
    }
}

void Pool::wait() const {
    pollfd fd{event_.get(), POLLIN, 0};
    ::poll(&fd, 1, -1);
}

}  // namespace run
