// SPDX-License-Identifier: BSD-3-Clause
#include "results/gnuplot.hpp"

#include <fmt/format.h>

#include <cstdio>

namespace limber::results {

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
  // The command is fixed; names travel inside the script, quoted.
  std::FILE* pipe = popen("gnuplot 2>/dev/null", "w");
  if (pipe == nullptr) return "no picture: gnuplot cannot be started";
  const std::size_t written = std::fwrite(text_.data(), 1, text_.size(), pipe);
  const int status = pclose(pipe);
  if (status == 0 && written == text_.size() &&
      std::filesystem::exists(file_, ignored)) {
    return {};
  }
  constexpr int kNotFound = 127;  // the shell's word for a missing program
  if (WIFEXITED(status) && WEXITSTATUS(status) == kNotFound) {
    return "no pictures: gnuplot is not installed (Debian: gnuplot-nox)";
  }
  return fmt::format("no picture '{}': gnuplot could not draw or write it",
                     file_.string());
}

}  // namespace limber::results
