// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

namespace limber::results {

/// A gnuplot script that draws one PNG, built line by line and then run. It
/// contains its data, so there are no other files.
class GnuplotScript {
 public:
  /// Canvas in pixels.
  GnuplotScript(const std::filesystem::path& file, int width, int height);

  /// Appends one line of commands or data.
  void add(const std::string& line);

  /// Runs gnuplot, for at most 20 s; for 1 s after one has hung.
  /// @returns an empty string, or why there is no picture.
  [[nodiscard]] std::string run() const;

 private:
  std::filesystem::path file_;
  std::string text_;
};

/// `text` as a gnuplot string literal, escaped.
[[nodiscard]] std::string quote(const std::string& text);

}  // namespace limber::results
