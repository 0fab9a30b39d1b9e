// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace limber::bench {

enum class Mark { line, thin_line, dashed, points, line_points };

struct Curve {
  std::string name;  ///< empty: not in the key
  std::vector<double> x;
  std::vector<double> y;
  Mark mark = Mark::line;
  int colour = -1;  ///< index into the palette; -1: by position
};

/// Curves on common axes.
struct Panel {
  std::string title;
  std::string x_label;  ///< with its unit
  std::string y_label;
  bool is_log_x = false;
  bool is_log_y = false;
  std::vector<Curve> curves;
  std::vector<std::string> commands;  ///< more gnuplot, before the drawing
};

/// Panels in rows of `columns`.
struct Plot {
  std::vector<Panel> panels;
  int columns = 1;
  int panel_width = 520;   // [pixels]
  int panel_height = 330;  // [pixels]
};

/// Draws a PNG. @returns an empty string, or why there is no picture.
[[nodiscard]] std::string draw(const Plot& plot,
                               const std::filesystem::path& file);

/// The plotted data, as rows of panel, curve, x, y.
void write_csv(const Plot& plot, const std::filesystem::path& file);

}  // namespace limber::bench
