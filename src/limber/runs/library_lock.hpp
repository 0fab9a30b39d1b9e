// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mutex>

namespace limber::runs {

/// Locks loading of scenes, building of systems, and HDF5: the libraries for
/// these are not thread-safe. To be held by code that may run in several
/// threads.
[[nodiscard]] std::unique_lock<std::mutex> lock_libraries();

}  // namespace limber::runs
