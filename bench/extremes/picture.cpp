// SPDX-License-Identifier: BSD-3-Clause
#include "picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "limber/results/gnuplot.hpp"

namespace limber::bench {
namespace {

using results::GnuplotScript;
using results::quote;

constexpr int kSquare = 46;  // width of a cell [pixels]
constexpr int kRow = 34;     // its height
constexpr int kLeft = 115;   // room for labels
constexpr int kBottom = 70;
constexpr int kTop = 40;
constexpr int kKey = 40;
constexpr const char* kColours[] = {"#7fc97f", "#ffe680", "#c8c8c8", "#e0301e"};

std::string write_value(double value) {
  const bool is_short = value == 0.0 || (value > 0.009 && value < 1001.0);
  return is_short ? fmt::format("{:.3g}", value) : fmt::format("{:.0e}", value);
}

std::string write_percent(double error) {
  const double percent = 100.0 * error;
  if (percent < 1e-3) return fmt::format("{:.0e}", percent);
  if (percent < 10.0) return fmt::format("{:.1g}", percent);
  return fmt::format("{:.0f}", percent);
}

std::string write_cell(const Verdict& verdict) {
  if (verdict.kind == Class::refused) return "R";
  if (verdict.kind == Class::failed) return "FAIL";
  return verdict.error < 0.0 ? "?" : write_percent(verdict.error);
}

void set_tics(GnuplotScript& script, char side, const Axis& axis) {
  std::string tics = fmt::format("set {}tics nomirror out scale 0.4 (", side);
  for (std::size_t i = 0; i < axis.values.size(); ++i) {
    tics += fmt::format("{}{} {}", i == 0 ? "" : ", ",
                        quote(write_value(axis.values[i])), i);
  }
  script.add(tics + ") font 'sans,9'");
  script.add(
      fmt::format("set {}label {} font 'sans,10'", side, quote(axis.label)));
  script.add(fmt::format("set {}range [-0.5:{}]", side,
                         static_cast<double>(axis.values.size()) - 0.5));
}

void add_squares(GnuplotScript& script, std::size_t panel,
                 const Verdicts& verdicts) {
  for (int kind = 0; kind < 4; ++kind) {
    script.add(fmt::format("$d{}_{} << EOD", panel, kind));
    for (std::size_t y = 0; y < verdicts.size(); ++y) {
      for (std::size_t x = 0; x < verdicts[y].size(); ++x) {
        if (static_cast<int>(verdicts[y][x].kind) != kind) continue;
        script.add(fmt::format("{} {} {}", x, y, write_cell(verdicts[y][x])));
      }
    }
    script.add("-9 -9 .");  // outside: no block is empty
    script.add("EOD");
  }
  std::string squares = "plot ";
  std::string labels;
  for (int kind = 0; kind < 4; ++kind) {
    squares += fmt::format(
        "$d{}_{} using 1:2:(0.48):(0.48) with boxxyerror fs solid 1 noborder "
        "lc rgb '{}' notitle, ",
        panel, kind, kColours[kind]);
    labels +=
        fmt::format("{}$d{}_{} using 1:2:3 with labels font 'sans,8' notitle",
                    kind == 0 ? "" : ", ", panel, kind);
  }
  script.add(squares + labels);
}

void add_key(GnuplotScript& script, double height) {
  const char* names[] = {"accurate (below 1 %)", "stable, inaccurate",
                         "refused with a message (R)", "failed"};
  for (int i = 0; i < 4; ++i) {
    script.add(
        fmt::format("set label {} {} at screen {}, screen {} left "
                    "font 'sans,9' point pt 5 ps 1.8 lc rgb '{}' "
                    "offset character 1, 0",
                    i + 1, quote(names[i]), 0.03 + 0.245 * i,
                    1.0 - 0.5 * kKey / height, kColours[i]));
  }
}

}  // namespace

std::string draw(const Map& map, const std::vector<Verdicts>& verdicts,
                 const std::filesystem::path& file) {
  const int panels = static_cast<int>(verdicts.size());
  const int columns = panels == 1 ? 1 : 2;
  const int rows = (panels + columns - 1) / columns;
  const int inner_width = kSquare * static_cast<int>(map.x.values.size());
  const int inner_height = kRow * static_cast<int>(map.y.values.size());
  const int panel_width = kLeft + inner_width + 20;
  const int panel_height = kTop + inner_height + kBottom;
  const double width = std::max(660, panel_width * columns);
  const double height = panel_height * rows + kKey;
  GnuplotScript script(file, static_cast<int>(width), static_cast<int>(height));
  script.add("set border 0");
  add_key(script, height);
  script.add("set multiplot");
  for (int p = 0; p < panels; ++p) {
    const double left = panel_width * (p % columns) + kLeft;
    const int row = p / columns;
    const double top = kKey + panel_height * row + kTop;
    script.add(fmt::format("set lmargin at screen {}", left / width));
    script.add(
        fmt::format("set rmargin at screen {}", (left + inner_width) / width));
    script.add(fmt::format("set tmargin at screen {}", 1.0 - top / height));
    script.add(fmt::format("set bmargin at screen {}",
                           1.0 - (top + inner_height) / height));
    const auto integrator =
        static_cast<std::size_t>(map.integrators[static_cast<std::size_t>(p)]);
    script.add("set title " + quote(dynamics::integrator_names()[integrator]) +
               " font 'sans,10'");
    set_tics(script, 'x', map.x);
    set_tics(script, 'y', map.y);
    add_squares(script, static_cast<std::size_t>(p),
                verdicts[static_cast<std::size_t>(p)]);
    if (p == 0) script.add("unset label");
  }
  script.add("unset multiplot");
  return script.run();
}

}  // namespace limber::bench
