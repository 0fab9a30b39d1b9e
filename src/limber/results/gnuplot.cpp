// SPDX-License-Identifier: BSD-3-Clause
#include "limber/results/gnuplot.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <atomic>
#include <chrono>

#include "limber/results/gnuplot_process.hpp"

namespace limber::results {
namespace {

constexpr std::chrono::seconds kLimit(20);
// For every picture after one that hung, since the next will hang too.
constexpr std::chrono::seconds kLimitAfterHang(1);

std::atomic<bool> has_hung = false;

GnuplotEnd run_script(const std::string& script) {
  const GnuplotEnd end =
      run_gnuplot(script, has_hung ? kLimitAfterHang : kLimit);
  if (end == GnuplotEnd::hung) has_hung = true;
  return end;
}

}  // namespace

std::string quote(const std::string& text) {
  std::string quoted = "'";
  for (const char c : text) {
    if (c == '\n') {
      quoted += ' ';
    } else if (c == '\'') {
      quoted += "''";
    } else {
      quoted += c;
    }
  }
  return quoted + "'";
}

GnuplotScript::GnuplotScript(const std::filesystem::path& file, int width,
                             int height)
    : file_(file) {
  add(
      fmt::format("set terminal pngcairo noenhanced size {},{} font "
                  "'sans,14' linewidth 1.6",
                  width, height));
  add("set output " + quote(file.string()));
  add("set encoding utf8");
}

void GnuplotScript::add(const std::string& line) {
  text_ += line;
  text_ += '\n';
}

std::string GnuplotScript::run() const {
  std::error_code ignored;
  std::filesystem::remove(file_, ignored);
  switch (run_script(text_)) {
    case GnuplotEnd::missing:
      return "no pictures: gnuplot is not installed (Debian: gnuplot-nox)";
    case GnuplotEnd::hung:
      std::filesystem::remove(file_, ignored);
      return fmt::format(
          "no picture '{}': gnuplot did not finish and was stopped",
          file_.filename().string());
    case GnuplotEnd::done:
      if (std::filesystem::exists(file_, ignored)) return {};
      break;
    case GnuplotEnd::failed:
      break;
  }
  std::filesystem::remove(file_, ignored);
  return fmt::format("no picture '{}': gnuplot could not draw or write it",
                     file_.filename().string());
}

std::string run_together(const std::vector<GnuplotScript>& scripts) {
  std::string all;
  std::error_code ignored;
  for (const GnuplotScript& script : scripts) {
    std::filesystem::remove(script.file(), ignored);
    // The file is written when the next output is set.
    all += script.text() + "set output\nreset session\n";
  }
  GnuplotEnd end = GnuplotEnd::done;
  if (scripts.size() > 1) end = run_script(all);
  std::vector<std::string> reasons;
  int failures = 0;
  for (const GnuplotScript& script : scripts) {
    // A process that was ended may have left half a picture.
    if (end == GnuplotEnd::done &&
        std::filesystem::exists(script.file(), ignored)) {
      continue;
    }
    const std::string why = script.run();
    if (why.empty()) continue;
    if (std::ranges::find(reasons, why) == reasons.end()) {
      reasons.push_back(why);
    }
    if (++failures == kMostFailures) break;
  }
  return fmt::format("{}", fmt::join(reasons, "; "));
}

}  // namespace limber::results
