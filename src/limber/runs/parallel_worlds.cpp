// SPDX-License-Identifier: BSD-3-Clause
#include "limber/runs/parallel_worlds.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace limber::runs {
namespace {

/// Worlds left to do, and the first failure.
class WorldQueue {
 public:
  WorldQueue(std::size_t count,
             const std::function<void(std::size_t, std::size_t)>& work)
      : count_(count), work_(work), failed_(count) {}

  void work(std::size_t thread) {
    for (std::size_t i = next_++; i < count_; i = next_++) {
      try {
        work_(i, thread);
      } catch (...) {
        const std::lock_guard lock(mutex_);
        if (i < failed_) failure_ = std::current_exception();
        failed_ = std::min(i, failed_);
      }
    }
  }

  void rethrow() const {
    if (failure_) std::rethrow_exception(failure_);
  }

 private:
  const std::size_t count_;
  const std::function<void(std::size_t, std::size_t)>& work_;
  std::atomic<std::size_t> next_ = 0;
  std::mutex mutex_;
  std::size_t failed_;
  std::exception_ptr failure_;
};

}  // namespace

void for_each_world(std::size_t count, std::size_t threads,
                    const std::function<void(std::size_t, std::size_t)>& work,
                    const std::function<void()>& poll) {
  constexpr std::chrono::milliseconds kBetweenPolls{5};
  const std::size_t others = std::min(threads, count) - (count > 0 ? 1 : 0);
  WorldQueue queue(count, work);
  std::mutex mutex;
  std::condition_variable has_ended;
  std::size_t running = others;
  std::vector<std::jthread> team;
  for (std::size_t thread = 1; thread <= others; ++thread) {
    team.emplace_back([&, thread] {
      queue.work(thread);
      const std::lock_guard lock(mutex);
      --running;
      has_ended.notify_one();
    });
  }
  queue.work(0);
  {
    std::unique_lock lock(mutex);
    while (!has_ended.wait_for(lock, kBetweenPolls,
                               [&] { return running == 0; })) {
      lock.unlock();
      if (poll) poll();
      lock.lock();
    }
  }
  team.clear();
  queue.rethrow();
}

}  // namespace limber::runs
