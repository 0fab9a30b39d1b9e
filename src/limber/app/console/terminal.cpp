// SPDX-License-Identifier: BSD-3-Clause
#include "limber/app/console/terminal.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <new>
#include <string_view>

#include "limber/app/console/grouped_texts.hpp"
#include "limber/app/console/time_estimate.hpp"
#include "limber/app/console/verbosity.hpp"
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

/// https://no-color.org, and terminals without colours.
bool has_colour() {
  const auto read = [](const char* name) {
    const char* const text = std::getenv(name);
    return std::string_view(text == nullptr ? "" : text);
  };
  return is_terminal() && read("NO_COLOR").empty() && read("TERM") != "dumb";
}

constexpr const char* kRed = "\033[1;31m";
constexpr const char* kYellow = "\033[1;33m";

/// "limber: KIND text", the kind in its colour.
void print_line(std::string_view kind, const char* colour,
                const std::string& text) noexcept {
  try {
    std::string line = "limber: ";
    if (!kind.empty()) {
      line += has_colour() ? colour + std::string(kind) + "\033[0m"
                           : std::string(kind);
      line += ' ';
    }
    line += escape_controls(text) + "\n";
    static_cast<void>(!std::fwrite(line.data(), 1, line.size(), stderr));
  } catch (const std::bad_alloc&) {
    std::fputs("limber: error: out of memory\n", stderr);
  }
}

/// Current task, its estimated time, and when the bar was last drawn.
struct Bar {
  TimeEstimate estimate;
  double drawn = 0.0;  // wall time [s]
  double begun = 0.0;  // wall time [s] of this work
  bool has_ended = true;

  Bar() = default;
  Bar(const Bar&) = delete;
  Bar& operator=(const Bar&) = delete;
  ~Bar() { end_work(); }

  void note(std::string_view what, double fraction) {
    if (find_verbosity() == Verbosity::quiet) return;
    const bool is_new = what != estimate.what();
    const double time = now();
    if (is_new) {
      end_work();
      begun = time;
      has_ended = false;
    }
    if (fraction >= 1.0 && !has_ended) {
      estimate.note(what, fraction, time);
      end_work();
    }
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

  void end_work() {
    if (has_ended) return;
    has_ended = true;
    if (find_verbosity() != Verbosity::verbose) return;
    clear_progress_bar();
    print_notice(fmt::format("{}: {:.3g} s", estimate.what(), now() - begun));
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

Progress delay_progress(const Progress& bar) {
  constexpr double kShort = 1.0;  // [s]
  return [bar, begun = now()](std::string_view what, double fraction) {
    if (is_terminal() && now() - begun > kShort) report(bar, what, fraction);
  };
}

void clear_progress_bar() {
  if (!is_terminal()) return;
  fmt::print(stderr, "\r\033[K");
  std::fflush(stderr);
}

void print_notice(const std::string& text) noexcept {
  print_line("", "", text);
}

void print_error(const std::string& text) noexcept {
  print_line("error:", kRed, text);
}

void print_notes(const std::vector<std::string>& notes) {
  for (const std::string& text : notes) print_line("note:", "", text);
}

void print_warnings(const std::vector<std::string>& warnings) {
  for (const std::string& text : group_texts(warnings)) {
    print_line("warning:", kYellow, text);
  }
}

}  // namespace limber::app
