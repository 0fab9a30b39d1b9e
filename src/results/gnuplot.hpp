// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

namespace limber::results {

/// A gnuplot script that draws one PNG, built line by line and then run. Data
/// travel inside it, so nothing but the picture is left behind.
class GnuplotScript {
 public:
  /// Canvas in pixels.
  GnuplotScript(const std::filesystem::path& file, int width, int height);

  /// Appends one line of commands or data.
  void add(const std::string& line);

  /// Runs gnuplot, for 20 s at most; once one has hung, for 1 s.
  /// @returns an empty string, or why there is no picture.
  [[nodiscard]] std::string run() const;

 private:
  std::filesystem::path file_;
  std::string text_;
};

/// `text` as a gnuplot string literal that means exactly that text.
[[nodiscard]] std::string quote(const std::string& text);

}  // namespace limber::results
