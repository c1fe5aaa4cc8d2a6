// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/prepare/on_threads.hpp"

#include <optional>

#include "cases/base/parallel.hpp"
#include "cli/prepare/outputs.hpp"
#include "run/process/pool.hpp"

namespace cli {

void for_each_on_threads(size_t count, const std::function<void(size_t)>& work) {
    run::Pool pool(cases::cores());
    for (size_t k = 0; k < count; ++k) {
        pool.submit([&work, k] { work(k); }, [] {});
    }
    Progress progress(ProgressStyle::automatic, count);
    while (pool.outstanding() > 0) {
        pool.wait();
        pool.collect();
        progress.show(count - pool.outstanding(), std::nullopt);
    }
    progress.clear();
}

}  // namespace cli
