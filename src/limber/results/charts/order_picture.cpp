// SPDX-License-Identifier: BSD-3-Clause
#include "limber/results/charts/order_picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "limber/results/charts/tics.hpp"
#include "limber/results/gnuplot.hpp"

namespace limber::results {
namespace {

// Palette for colour-blind readers (Okabe and Ito, 2008).
constexpr std::array<const char*, 4> kOrderColours = {"#0072B2", "#D55E00",
                                                      "#009E73", "#CC79A7"};
constexpr std::array<int, 4> kOrderMarkers = {7, 5, 9, 13};

bool is_drawable(double y) { return y > 0.0 && std::isfinite(y); }

/// A logarithmic axis.
struct Axis {
  double least = std::numeric_limits<double>::infinity();
  double most = 0.0;

  void include(double value) {
    least = std::min(least, value);
    most = std::max(most, value);
  }
  /// Of `set xrange` and `set xtics` with some room, for axis 'x' or 'y'.
  [[nodiscard]] std::string text(char axis) const {
    constexpr double kRoom = 1.25;
    const double first = least / kRoom;
    const double last = most * kRoom;
    return fmt::format("set {0}range [{1:.6g}:{2:.6g}]; set {0}tics {3}", axis,
                       first, last,
                       to_tics(list_logarithmic_tics(first, last)));
  }
};

/// The line's points, then a line of the expected slope from the first.
void add_block(GnuplotScript& script, std::size_t index, const OrderLine& line,
               double slope, Axis& x, Axis& y) {
  script.add(fmt::format("$line{} << EOD", index));
  double first_x = 0.0;
  double first_y = 0.0;
  for (std::size_t i = 0; i < line.x.size(); ++i) {
    if (!is_drawable(line.y[i])) continue;
    if (first_x == 0.0) {
      first_x = line.x[i];
      first_y = line.y[i];
    }
    const double expected = first_y * std::pow(line.x[i] / first_x, slope);
    x.include(line.x[i]);
    y.include(line.y[i]);
    y.include(expected);
    script.add(
        fmt::format("{:.6g} {:.6g} {:.6g}", line.x[i], line.y[i], expected));
  }
  script.add("EOD");
}

}  // namespace

std::string draw_order(const std::filesystem::path& file,
                       const std::string& title, const std::string& x_label,
                       const std::string& y_label, double slope,
                       const std::vector<OrderLine>& lines) {
  GnuplotScript script(file, 900, 700);
  std::string plot;
  Axis x;
  Axis y;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (std::none_of(lines[i].y.begin(), lines[i].y.end(), is_drawable)) {
      continue;
    }
    add_block(script, i, lines[i], slope, x, y);
    const char* colour = kOrderColours[i % kOrderColours.size()];
    plot += fmt::format(
        "{}$line{} using 1:3 with lines lc rgb '#aaaaaa' dt 2 title {}, "
        "$line{} using 1:2 with linespoints pt {} ps 1.2 lc rgb '{}' title {}",
        plot.empty() ? "plot " : ", ", i,
        plot.empty() ? quote(fmt::format("slope {:g}", slope)) : "''", i,
        kOrderMarkers[i % kOrderMarkers.size()], colour, quote(lines[i].name));
  }
  if (plot.empty()) return "there is nothing above zero to draw";
  script.add("set title " + quote(title) + " font 'sans,16'");
  script.add("set logscale xy");
  script.add("set format xy '%g'");
  script.add(x.text('x'));
  script.add(y.text('y'));
  script.add("set grid lc rgb '#dddddd' dt 1 lw 0.6");
  script.add("set border lc rgb '#555555' lw 0.7");
  script.add("set tics nomirror");
  script.add("set key bottom left samplen 2");
  script.add("set xlabel " + quote(x_label));
  script.add("set ylabel " + quote(y_label));
  script.add(plot);
  return script.run();
}

}  // namespace limber::results
