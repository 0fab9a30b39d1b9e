// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>

namespace limber::runs {

/// Calls `work(world, thread)` for each world in [0, count), in any order, on
/// several threads: this one, number 0, and threads - 1 others.
/// @param poll called by this thread every few milliseconds while it waits for
/// others
/// @throws what `work` does, for the first world that it fails for, after all.
void for_each_world(std::size_t count, std::size_t threads,
                    const std::function<void(std::size_t, std::size_t)>& work,
                    const std::function<void()>& poll = {});

}  // namespace limber::runs
