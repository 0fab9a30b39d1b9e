// SPDX-License-Identifier: BSD-3-Clause
#include "plot.hpp"

#include <fmt/format.h>
#include <fmt/ostream.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>

#include "limber/common/errors.hpp"
#include "limber/results/gnuplot.hpp"

namespace limber::bench {
namespace {

using results::GnuplotScript;
using results::quote;

// Colours that stay apart for every kind of sight (Okabe and Ito, 2008).
constexpr std::array<const char*, 7> kColours = {
    "#0072B2", "#D55E00", "#009E73", "#CC79A7",
    "#E69F00", "#56B4E9", "#000000"};
constexpr std::size_t kMostPoints = 2000;  // of a curve

std::string find_style(const Curve& curve, std::size_t position) {
  const std::size_t i =
      curve.colour < 0 ? position : static_cast<std::size_t>(curve.colour);
  const std::string colour =
      fmt::format("lc rgb '{}'", kColours[i % kColours.size()]);
  switch (curve.mark) {
    case Mark::line:
      return "with lines lw 1.6 " + colour;
    case Mark::thin_line:
      return "with lines lw 0.7 " + colour;
    case Mark::dashed:
      return "with lines dt 2 lw 1.6 " + colour;
    case Mark::points:
      return "with points pt 7 ps 0.8 " + colour;
    case Mark::line_points:
      break;
  }
  return fmt::format("with linespoints pt {} ps 0.9 lw 1.3 {}", 5 + 2 * i % 9,
                     colour);
}

void add_data(GnuplotScript& script, const std::string& block,
              const Curve& curve) {
  script.add(fmt::format("${} << EOD", block));
  const std::size_t n = std::min(curve.x.size(), curve.y.size());
  const std::size_t stride = (n + kMostPoints - 1) / kMostPoints;
  for (std::size_t i = 0; i < n; i += std::max<std::size_t>(1, stride)) {
    script.add(std::isfinite(curve.y[i])
                   ? fmt::format("{:.9g} {:.9g}", curve.x[i], curve.y[i])
                   : fmt::format("{:.9g} NaN", curve.x[i]));
  }
  script.add("EOD");
}

void add_panel(GnuplotScript& script, std::size_t p, const Panel& panel) {
  script.add("reset");
  script.add("set grid lc rgb '#dddddd' lw 0.6");
  script.add("set border 3 lc rgb '#444444' lw 0.8");
  script.add("set tics nomirror font 'sans,10'");
  script.add("set key above maxrows 2 font 'sans,10' samplen 2");
  script.add("set tmargin 4.6");  // the same with and without a key
  script.add("set offsets graph 0, 0, graph 0.06, graph 0.06");
  script.add("set title " + quote(panel.title) + " font 'sans,11'");
  script.add("set xlabel " + quote(panel.x_label) + " font 'sans,11'");
  script.add("set ylabel " + quote(panel.y_label) + " font 'sans,11'");
  if (!panel.is_log_x) script.add("set autoscale xfix");
  if (panel.is_log_x) script.add("set logscale x; set format x '10^{%L}'");
  if (panel.is_log_y) script.add("set logscale y; set format y '10^{%L}'");
  if (panel.is_log_y) script.add("unset offsets");
  for (const std::string& command : panel.commands) script.add(command);
  std::string plot = "plot ";
  for (std::size_t c = 0; c < panel.curves.size(); ++c) {
    const Curve& curve = panel.curves[c];
    const std::string title =
        curve.name.empty() ? "notitle" : "title " + quote(curve.name);
    plot += fmt::format("{}$d{}_{} using 1:2 {} {}", c == 0 ? "" : ", ", p, c,
                        find_style(curve, c), title);
  }
  script.add(plot);
}

}  // namespace

std::string draw(const Plot& plot, const std::filesystem::path& file) {
  const int count = static_cast<int>(plot.panels.size());
  const int columns = std::min(plot.columns, count);
  const int rows = (count + columns - 1) / columns;
  GnuplotScript script(file, plot.panel_width * columns,
                       plot.panel_height * rows);
  // Powers of ten on logarithmic axes need enhanced text; names are plain.
  script.add(
      fmt::format("set terminal pngcairo enhanced size {},{} font 'sans,11'",
                  plot.panel_width * columns, plot.panel_height * rows));
  for (std::size_t p = 0; p < plot.panels.size(); ++p) {
    for (std::size_t c = 0; c < plot.panels[p].curves.size(); ++c) {
      add_data(script, fmt::format("d{}_{}", p, c), plot.panels[p].curves[c]);
    }
  }
  script.add(fmt::format("set multiplot layout {},{}", rows, columns));
  for (std::size_t p = 0; p < plot.panels.size(); ++p) {
    add_panel(script, p, plot.panels[p]);
  }
  script.add("unset multiplot");
  return script.run();
}

void write_csv(const Plot& plot, const std::filesystem::path& file) {
  std::ofstream out(file);
  out << "panel,curve,x,y\n";
  for (std::size_t p = 0; p < plot.panels.size(); ++p) {
    for (const Curve& curve : plot.panels[p].curves) {
      for (std::size_t i = 0; i < std::min(curve.x.size(), curve.y.size());
           ++i) {
        fmt::print(out, "{},\"{}\",{:.17g},{:.17g}\n", p + 1, curve.name,
                   curve.x[i], curve.y[i]);
      }
    }
  }
  out.flush();
  if (!out) {
    throw InputError(fmt::format("'{}' cannot be written", file.string()));
  }
}

}  // namespace limber::bench
