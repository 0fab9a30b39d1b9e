// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <vector>

namespace limber::scene {

/// A measured history.
struct Series {
  std::vector<double> times;  ///< [s]
  /// The file's second column [its unit].
  std::vector<double> values;
};

/// Reads two columns, time and value, separated by blanks, a comma or a
/// semicolon. Skips blank lines, lines that begin with '#' and one heading
/// line. Does not check the order of times.
/// @throws InputError naming the line.
[[nodiscard]] Series read_series(const std::filesystem::path& file);

}  // namespace limber::scene
