// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>

namespace limber::fem {

/// Splits [0, count) into one contiguous range per thread and runs
/// `work(begin, end)` on each. Work on one range must not depend on where the
/// ranges are cut, so that results do not depend on the number of threads.
/// The first exception of a thread is rethrown here.
/// @param grain least size of a range, worth the start of a thread (some 50
/// microseconds)
void parallel_ranges(
    std::size_t count,
    const std::function<void(std::size_t begin, std::size_t end)>& work,
    std::size_t grain = 1);

/// Number of threads used; 0 (the default) means one per core.
void set_thread_count(unsigned threads);
[[nodiscard]] unsigned thread_count();

}  // namespace limber::fem
