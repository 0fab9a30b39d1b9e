// SPDX-License-Identifier: BSD-3-Clause
#include "limber/runs/library_lock.hpp"

namespace limber::runs {

std::unique_lock<std::mutex> lock_libraries() {
  static std::mutex mutex;
  return std::unique_lock(mutex);
}

}  // namespace limber::runs
