// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

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

  [[nodiscard]] const std::filesystem::path& file() const { return file_; }
  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  std::filesystem::path file_;
  std::string text_;
};

/// Failures after which no further pictures are drawn, since they would fail
/// alike.
inline constexpr int kMostFailures = 3;

/// Runs all in one process, which saves most of the time of a small picture;
/// those that fail there once more, each alone, up to kMostFailures.
/// @returns an empty string, or why pictures are missing, each reason once
[[nodiscard]] std::string run_together(
    const std::vector<GnuplotScript>& scripts);

/// `text` as a gnuplot string literal, escaped.
[[nodiscard]] std::string quote(const std::string& text);

}  // namespace limber::results
