// SPDX-License-Identifier: BSD-3-Clause
#include "limber/fem/linalg/parallel.hpp"

#include <algorithm>
#include <atomic>
#include <exception>
#include <thread>
#include <vector>

namespace limber::fem {
namespace {
std::atomic<unsigned> requested_threads{0};
}

void set_thread_count(unsigned threads) { requested_threads = threads; }

unsigned thread_count() {
  const unsigned requested = requested_threads;
  if (requested > 0) return requested;
  return std::max(1U, std::thread::hardware_concurrency());
}

void parallel_ranges(std::size_t count,
                     const std::function<void(std::size_t, std::size_t)>& work,
                     std::size_t grain) {
  const std::size_t parts = std::max<std::size_t>(
      1, std::min<std::size_t>(thread_count(), count / grain));
  std::vector<std::exception_ptr> failures(parts);
  const auto run = [&](std::size_t part) {
    try {
      work(count * part / parts, count * (part + 1) / parts);
    } catch (...) {
      failures[part] = std::current_exception();
    }
  };
  std::vector<std::jthread> threads;
  for (std::size_t part = 1; part < parts; ++part)
    threads.emplace_back(run, part);
  run(0);
  threads.clear();  // joins
  for (const std::exception_ptr& failure : failures)
    if (failure) std::rethrow_exception(failure);
}

}  // namespace limber::fem
