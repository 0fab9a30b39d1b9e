// SPDX-License-Identifier: BSD-3-Clause
#include "limber/app/console/terminal.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <memory>
#include <new>

#include "limber/app/console/time_estimate.hpp"
#include "limber/common/echo.hpp"

namespace limber::app {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int kBarWidth = 30;
constexpr double kRefresh = 0.1;  // s

double now() {
  return std::chrono::duration<double>(Clock::now().time_since_epoch()).count();
}

bool is_terminal() { return isatty(STDERR_FILENO) == 1; }

/// Current task, its estimated time, and when the bar was last drawn.
struct Bar {
  TimeEstimate estimate;
  double drawn = 0.0;  // wall time [s]

  void note(std::string_view what, double fraction) {
    const bool is_new = what != estimate.what();
    const double time = now();
    estimate.note(what, fraction, time);
    const std::string line = estimate.take_announcement();
    if (!line.empty()) {
      clear_progress_bar();
      fmt::print(stderr, "limber: {}\n", line);
    }
    if (!is_terminal()) return;
    if (!is_new && fraction < 1.0 && time - drawn < kRefresh) return;
    drawn = time;
    draw(fraction);
  }

  void draw(double fraction) const {
    const double done = std::fmin(std::fmax(fraction, 0.0), 1.0);  // NaN: 0
    const int filled = static_cast<int>(done * kBarWidth);
    const std::optional<double> left = estimate.left();
    fmt::print(stderr, "\r\033[K{:<24} [{:<{}}] {:3.0f} %  {}", estimate.what(),
               std::string(static_cast<std::size_t>(filled), '#'), kBarWidth,
               100.0 * done, left ? to_duration(*left) + " left" : "");
    std::fflush(stderr);
  }
};

}  // namespace

Progress make_progress_bar() {
  return
      [bar = std::make_shared<Bar>()](std::string_view what, double fraction) {
        bar->note(what, fraction);
      };
}

void clear_progress_bar() {
  if (!is_terminal()) return;
  fmt::print(stderr, "\r\033[K");
  std::fflush(stderr);
}

void print_notice(const std::string& text) noexcept {
  try {
    const std::string line = "limber: " + escape_controls(text) + "\n";
    static_cast<void>(!std::fwrite(line.data(), 1, line.size(), stderr));
  } catch (const std::bad_alloc&) {
    std::fputs("limber: error: out of memory\n", stderr);
  }
}

void print_error(const std::string& text) noexcept {
  try {
    print_notice("error: " + text);
  } catch (const std::bad_alloc&) {
    std::fputs("limber: error: out of memory\n", stderr);
  }
}

void print_warnings(const std::vector<std::string>& warnings) {
  for (const std::string& text : warnings) print_notice("warning: " + text);
}

}  // namespace limber::app
