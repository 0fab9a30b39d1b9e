// SPDX-License-Identifier: BSD-3-Clause
#include "limber/results/draw_all.hpp"

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <iterator>
#include <system_error>
#include <thread>

namespace limber::results {
namespace {

constexpr std::size_t kMostAtATime = 4;
constexpr std::size_t kMostTogether = 16;  // charts of one process

std::size_t count_threads() {
  return std::clamp(std::size_t{std::thread::hardware_concurrency()},
                    std::size_t{1}, kMostAtATime);
}

// Results of all pictures, drawn by threads that take one after the other.
class Drawing {
 public:
  explicit Drawing(const std::vector<Picture>& pictures)
      : pictures_(pictures),
        words_(pictures.size()),
        errors_(pictures.size()) {}

  void work() {
    while (failures_ < kMostFailures) {
      const std::size_t i = next_++;
      if (i >= pictures_.size()) return;
      try {
        words_[i] = pictures_[i]();
        if (!words_[i].empty()) ++failures_;
      } catch (...) {
        errors_[i] = std::current_exception();
        failures_ = kMostFailures;
      }
    }
  }

  [[nodiscard]] std::vector<std::string> find_words() const {
    std::vector<std::string> all;
    for (std::size_t i = 0; i < words_.size(); ++i) {
      if (errors_[i]) std::rethrow_exception(errors_[i]);
      if (words_[i].empty()) continue;
      if (std::find(all.begin(), all.end(), words_[i]) != all.end()) continue;
      all.push_back(words_[i]);
    }
    return all;
  }

 private:
  const std::vector<Picture>& pictures_;
  std::vector<std::string> words_;
  std::vector<std::exception_ptr> errors_;
  std::atomic<std::size_t> next_ = 0;
  std::atomic<int> failures_ = 0;
};

}  // namespace

void add_charts(std::vector<GnuplotScript> charts,
                std::vector<Picture>& pictures) {
  // Two processes a thread, so that none draws long after the others.
  const std::size_t processes = 2 * count_threads();
  const std::size_t together =
      std::clamp((charts.size() + processes - 1) / processes, std::size_t{1},
                 kMostTogether);
  for (std::size_t first = 0; first < charts.size(); first += together) {
    const std::size_t last = std::min(first + together, charts.size());
    const auto from = [&](std::size_t i) {
      return std::make_move_iterator(charts.begin() +
                                     static_cast<std::ptrdiff_t>(i));
    };
    std::vector<GnuplotScript> some(from(first), from(last));
    pictures.emplace_back(
        [some = std::move(some)] { return run_together(some); });
  }
}

std::vector<std::string> draw_all(const std::vector<Picture>& pictures) {
  Drawing drawing(pictures);
  const std::size_t count = std::min(pictures.size(), count_threads());
  std::vector<std::thread> helpers;
  try {
    while (helpers.size() + 1 < count) {
      helpers.emplace_back([&drawing] { drawing.work(); });
    }
  } catch (const std::system_error&) {  // NOLINT(bugprone-empty-catch)
    // No more threads are available: the existing ones draw all.
  }
  drawing.work();
  for (std::thread& helper : helpers) helper.join();
  return drawing.find_words();
}

}  // namespace limber::results
