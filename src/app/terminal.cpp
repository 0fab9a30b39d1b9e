// SPDX-License-Identifier: BSD-3-Clause
#include "app/terminal.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <memory>

namespace limber::app {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int kBarWidth = 30;
constexpr double kRefresh = 0.1;  // s

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

bool is_terminal() { return isatty(STDERR_FILENO) == 1; }

/// What is being done, since when, and when it was last drawn.
struct Bar {
  std::string what;
  Clock::time_point start = Clock::now();
  Clock::time_point drawn = start;

  void draw(std::string_view now, double fraction) {
    if (now != what) {
      what = now;
      start = Clock::now();
    } else if (fraction < 1.0 && seconds_since(drawn) < kRefresh) {
      return;
    }
    drawn = Clock::now();
    const double done = std::fmin(std::fmax(fraction, 0.0), 1.0);  // NaN: 0
    const int filled = static_cast<int>(done * kBarWidth);
    const std::string left =
        done > 0.01 ? fmt::format("{:.0f} s left",
                                  seconds_since(start) * (1.0 - done) / done)
                    : "";
    fmt::print(stderr, "\r\033[K{:<24} [{:<{}}] {:3.0f} %  {}", what,
               std::string(static_cast<std::size_t>(filled), '#'), kBarWidth,
               100.0 * done, left);
    std::fflush(stderr);
  }
};

}  // namespace

Progress make_progress_bar() {
  if (!is_terminal()) return {};
  return
      [bar = std::make_shared<Bar>()](std::string_view what, double fraction) {
        bar->draw(what, fraction);
      };
}

void clear_progress_bar() {
  if (!is_terminal()) return;
  fmt::print(stderr, "\r\033[K");
  std::fflush(stderr);
}

void print_warnings(const std::vector<std::string>& warnings) {
  for (const std::string& text : warnings) {
    fmt::print(stderr, "limber: warning: {}\n", text);
  }
}

}  // namespace limber::app
