// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mutex>

namespace limber::app {

/// One thread at a time loads scenes, builds systems, and reads and writes
/// HDF5: the libraries for it are not safe in threads. Held by whoever may run
/// beside another.
[[nodiscard]] std::unique_lock<std::mutex> lock_libraries();

}  // namespace limber::app
