// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <vector>

namespace limber::scene {

/// A measured history.
struct Series {
  std::vector<double> times;   ///< [s]
  std::vector<double> values;  ///< what the file's second column means
};

/// Reads two columns, time and value, separated by blanks, a comma or a
/// semicolon. Blank lines, lines that begin with '#' and one heading line are
/// passed over. Times are not checked for their order.
/// @throws InputError naming the line.
[[nodiscard]] Series read_series(const std::filesystem::path& file);

}  // namespace limber::scene
