// SPDX-License-Identifier: BSD-3-Clause
#include "limber/results/pictures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>

#include "limber/results/gnuplot.hpp"

namespace limber::results {
namespace {

// Palette for colour-blind readers (Okabe and Ito, 2008).
constexpr std::array<const char*, 7> kProbeColours = {
    "#0072B2", "#D55E00", "#009E73", "#CC79A7",
    "#E69F00", "#56B4E9", "#000000"};
constexpr int kWidth = 1200;
constexpr int kPanelHeight = 300;
constexpr int kHeaderHeight = 110;

std::string style(std::size_t i) {
  return fmt::format("lc rgb '{}' dt {} lw {}",
                     kProbeColours[i % kProbeColours.size()],
                     i < 2 ? 1 : i % 5 + 1, i == 0 ? 2.2 : 1.8);
}

void add_data(GnuplotScript& script, const std::string& block,
              const Series& series) {
  script.add(fmt::format("${} << EOD", block));
  const std::size_t n = std::min(series.times.size(), series.values.size());
  for (std::size_t i = 0; i < n; ++i) {
    const double value = series.values[i];
    script.add(std::isfinite(value)
                   ? fmt::format("{:.9g} {:.9g}", series.times[i], value)
                   : fmt::format("{:.9g} NaN", series.times[i]));
  }
  script.add("EOD");
}

// Largest finite value; only finite ones are drawn.
double largest(const Panel& panel) {
  double value = 0.0;
  const auto include = [&](const std::vector<double>& values) {
    for (const double v : values) {
      if (std::isfinite(v)) value = std::max(value, std::abs(v));
    }
  };
  for (const Series& series : panel.series) {
    include(series.values);
    if (series.band) {
      include(series.band->least);
      include(series.band->most);
    }
    if (series.peak) value = std::max(value, std::abs(series.peak->value));
  }
  return value;
}

// A point with its value beside it, on the side that has more room.
void add_peak(GnuplotScript& script, const std::string& block,
              const Series& series) {
  script.add(fmt::format("${}p << EOD", block));
  script.add(fmt::format("{:.9g} {:.9g} {:.3g}", series.peak->time,
                         series.peak->value, series.peak->value));
  script.add("EOD");
}

// Two rows an interval, so that each is a rectangle.
void add_band(GnuplotScript& script, const std::string& block,
              const Band& band) {
  script.add(fmt::format("${}b << EOD", block));
  for (std::size_t k = 0; k < band.least.size(); ++k) {
    const double least = band.least[k];
    const double most = band.most[k];
    if (!std::isfinite(least) || !std::isfinite(most)) continue;
    for (const double t : {band.edges[k], band.edges[k + 1]}) {
      script.add(fmt::format("{:.9g} {:.9g} {:.9g}", t, least, most));
    }
  }
  script.add("EOD");
}

std::string plot_error(const std::string& block, const Series& series,
                       std::size_t s) {
  return fmt::format(
      "${0} using 1:($2-({1:.9g})):($2+({1:.9g})) with filledcurves fs "
      "transparent solid 0.15 noborder lc rgb '{2}' notitle, ",
      block, *series.error, kProbeColours[s % kProbeColours.size()]);
}

std::string plot_band(const std::string& block, std::size_t s) {
  return fmt::format(
      "${}b using 1:2:3 with filledcurves fs transparent solid 0.25 noborder "
      "lc rgb '{}' notitle, ",
      block, kProbeColours[s % kProbeColours.size()]);
}

bool has_peak(const Series& series) {
  return series.peak && series.peak->value != 0.0 &&
         std::isfinite(series.peak->value);
}

std::string plot_peak(const std::string& block, const Series& series,
                      std::size_t s) {
  const double middle = 0.5 * (series.times.front() + series.times.back());
  const bool is_late = series.peak->time > middle;
  return fmt::format(
      ", ${}p using 1:2:3 with labels point pt 6 ps 1.3 lc rgb '{}' font "
      "'sans,10' {} offset {},0.4 notitle",
      block, kProbeColours[s % kProbeColours.size()],
      is_late ? "right" : "left", is_late ? -1 : 1);
}

// A panel whose values are round-off relative to the others (or all zero) shows
// a flat line instead of magnified noise.
void set_range(GnuplotScript& script, const Panel& panel, double reference) {
  const double own = largest(panel);
  if (own > 1e-9 * reference && own > 0.0) {
    script.add("set yrange [*:*]");
    script.add("set offsets 0, 0, graph 0.08, graph 0.08");
    return;
  }
  const double half = reference > 0.0 ? 1e-6 * reference : 1.0;
  script.add("unset offsets");
  script.add(fmt::format("set yrange [{:g}:{:g}]", -half, half));
}

void add_panel(GnuplotScript& script, std::size_t p, const Panel& panel,
               double reference, const std::string& key_height,
               const std::string& time_label) {
  set_range(script, panel, reference);
  script.add("set ylabel " + quote(panel.label) + " offset 0.3,0");
  const bool is_last = !time_label.empty();
  script.add(is_last ? "set xlabel " + quote(time_label) : "unset xlabel");
  script.add(is_last ? "set format x '%g'" : "set format x ''");
  if (p == 0) {
    script.add("set key at screen 0.97, screen " + key_height +
               " right horizontal samplen 3");
  } else {
    script.add("unset key");
  }
  std::string plot = "plot ";
  for (std::size_t s = 0; s < panel.series.size(); ++s) {
    const Series& series = panel.series[s];
    const std::string block = fmt::format("d{}_{}", p, s);
    if (series.error) plot += plot_error(block, series, s);
    if (series.band) plot += plot_band(block, s);
  }
  for (std::size_t s = 0; s < panel.series.size(); ++s) {
    plot += fmt::format("{}$d{}_{} using 1:2 with lines {} title {}",
                        s == 0 ? "" : ", ", p, s, style(s),
                        quote(panel.series[s].name));
  }
  for (std::size_t s = 0; s < panel.series.size(); ++s) {
    if (!has_peak(panel.series[s])) continue;
    plot += plot_peak(fmt::format("d{}_{}", p, s), panel.series[s], s);
  }
  script.add(plot);
}

// Times from the first to the last of all curves.
struct TimeRange {
  double first = 0.0;
  double last = 1.0;

  [[nodiscard]] double fraction(double t) const {
    return (t - first) / (last - first);
  }
};

TimeRange find_range(const std::vector<Panel>& panels) {
  double first = std::numeric_limits<double>::infinity();
  double last = -first;
  for (const Panel& panel : panels) {
    for (const Series& series : panel.series) {
      for (const double t : series.times) {
        first = std::min(first, t);
        last = std::max(last, t);
      }
    }
  }
  if (last > first) return {first, last};
  const double middle = last == first ? first : 0.0;
  const double half = std::max(0.5, 1e-3 * std::abs(middle));
  return {middle - half, middle + half};
}

// Of finite numbers that differ by little, such as positions far from the
// origin: one near them, rounded to the power of ten of their range, from which
// nine digits show how they differ. Zero if they differ much, or by round-off.
double choose_origin(double least, double most) {
  constexpr double kLittle = 1e-2;
  constexpr double kSameNumber = 1e-12;
  const double range = most - least;
  const double size = std::max(std::abs(least), std::abs(most));
  if (!(range < kLittle * size && range > kSameNumber * size)) return 0.0;
  const double unit = std::pow(10.0, std::floor(std::log10(range)));
  const double steps = std::round(0.5 * (least + most) / unit);
  return unit < 1.0 ? steps / std::round(1.0 / unit) : steps * unit;
}

// "x [m]", or "x - 1000 [m]".
std::string label_from(const std::string& label, double offset) {
  if (offset == 0.0) return label;
  const std::size_t unit = std::min(label.find(" ["), label.size());
  return fmt::format("{} {} {:.15g}{}", label.substr(0, unit),
                     offset > 0.0 ? '-' : '+', std::abs(offset),
                     label.substr(unit));
}

// With values from an offset, which the label states.
Panel count_from_offset(Panel panel) {
  double least = std::numeric_limits<double>::infinity();
  double most = -least;
  for (const Series& series : panel.series) {
    for (const double value : series.values) {
      if (!std::isfinite(value)) continue;
      least = std::min(least, value);
      most = std::max(most, value);
    }
  }
  const double offset = choose_origin(least, most);
  if (offset == 0.0) return panel;
  panel.label = label_from(panel.label, offset);
  for (Series& series : panel.series) {
    for (double& value : series.values) value -= offset;
    if (series.band) {
      for (double& value : series.band->least) value -= offset;
      for (double& value : series.band->most) value -= offset;
    }
    if (series.peak) series.peak->value -= offset;
  }
  return panel;
}

// What times count from: the first, where they differ by little.
double find_start(const std::vector<Panel>& panels) {
  const TimeRange whole = find_range(panels);
  return choose_origin(whole.first, whole.last) == 0.0 ? 0.0 : whole.first;
}

void subtract_time(std::vector<Panel>& panels, std::vector<Mark>& marks,
                   double start) {
  for (Panel& panel : panels) {
    for (Series& series : panel.series) {
      for (double& t : series.times) t -= start;
      if (series.band) {
        for (double& t : series.band->edges) t -= start;
      }
      if (series.peak) series.peak->time -= start;
    }
  }
  for (Mark& mark : marks) mark.time -= start;
}

constexpr double kLeft = 0.11;  // margins [of the width]
constexpr double kRight = 0.97;
constexpr double kLabelWidth = 15.0;  // of a line of a label [pixels]
constexpr double kLetter = 6.0;       // of a label [pixels]
constexpr std::size_t kMostLetters = 36;

std::string shorten(const std::string& label) {
  if (label.size() <= kMostLetters) return label;
  return fmt::format("{:.{}}..", label, kMostLetters - 2);
}

// Height of the strip above the panels for the labels of marks [pixels].
double find_strip(const std::vector<Mark>& marks) {
  std::size_t longest = 0;
  for (const Mark& mark : marks) {
    longest = std::max(longest, shorten(mark.label).size());
  }
  return longest == 0 ? 0.0 : 26.0 + kLetter * static_cast<double>(longest);
}

// Positions of labels in increasing order, such that none covers another
// [pixels].
std::vector<double> spread_labels(const std::vector<double>& places) {
  std::vector<double> spread = places;
  for (std::size_t i = 1; i < spread.size(); ++i) {
    spread[i] = std::max(spread[i], spread[i - 1] + kLabelWidth);
  }
  double most = kRight * kWidth;
  for (std::size_t i = spread.size(); i-- > 0;) {
    spread[i] = std::min(spread[i], most);
    most = spread[i] - kLabelWidth;
  }
  return spread;
}

// Lines through every panel that follows; labels above the panels, where no
// curve is. @param top of the first panel, height of the picture [pixels]
void add_marks(GnuplotScript& script, std::vector<Mark> marks,
               const TimeRange& range, double top, double height) {
  std::stable_sort(
      marks.begin(), marks.end(),
      [](const Mark& a, const Mark& b) { return a.time < b.time; });
  std::vector<double> places;
  for (const Mark& mark : marks) {
    places.push_back(kWidth *
                     (kLeft + (kRight - kLeft) * range.fraction(mark.time)));
  }
  const std::vector<double> spread = spread_labels(places);
  for (std::size_t i = 0; i < marks.size(); ++i) {
    script.add(
        fmt::format("set arrow from first {0:.9g}, graph 0 to first {0:.9g}, "
                    "graph 1 nohead back lc rgb '#888888' dt 3 lw 0.9",
                    marks[i].time));
    script.add(fmt::format(
        "set arrow {} from screen {:.5f}, screen {:.5f} to screen {:.5f}, "
        "screen {:.5f} nohead lc rgb '#888888' lw 0.7",
        1001 + i, places[i] / kWidth, 1.0 - top / height, spread[i] / kWidth,
        1.0 - (top - 14.0) / height));
    script.add(
        fmt::format("set label {} {} at screen {:.5f}, screen {:.5f} "
                    "left rotate by 90 font 'sans,9' tc rgb '#555555'",
                    1001 + i, quote(shorten(marks[i].label)),
                    spread[i] / kWidth, 1.0 - (top - 18.0) / height));
  }
}

// A value for each curve of a panel.
void add_point(Panel& panel, double t, const std::vector<double>& values) {
  for (std::size_t s = 0; s < values.size(); ++s) {
    panel.series[s].times.push_back(t);
    panel.series[s].values.push_back(values[s]);
  }
}

}  // namespace

GnuplotScript write_overlay(const std::filesystem::path& file,
                            const std::string& title,
                            const std::vector<Panel>& absolute,
                            const std::vector<Mark>& absolute_marks) {
  std::vector<Panel> panels;
  std::transform(absolute.begin(), absolute.end(), std::back_inserter(panels),
                 count_from_offset);
  std::vector<Mark> marks = absolute_marks;
  const double start = find_start(panels);
  subtract_time(panels, marks, start);
  const int count = static_cast<int>(panels.size());
  const double strip = find_strip(marks);
  const double height = kHeaderHeight + strip + kPanelHeight * count;
  GnuplotScript script(file, kWidth, static_cast<int>(height));
  double reference = 0.0;
  for (std::size_t p = 0; p < panels.size(); ++p) {
    reference = std::max(reference, largest(panels[p]));
    for (std::size_t s = 0; s < panels[p].series.size(); ++s) {
      const std::string block = fmt::format("d{}_{}", p, s);
      add_data(script, block, panels[p].series[s]);
      if (has_peak(panels[p].series[s])) {
        add_peak(script, block, panels[p].series[s]);
      }
      if (panels[p].series[s].band) {
        add_band(script, block, *panels[p].series[s].band);
      }
    }
  }
  const std::string key_height = fmt::format("{:.4f}", 1.0 - 58.0 / height);
  const double top = 80.0 + strip;
  script.add(
      fmt::format("set multiplot layout {},1 title {} font 'sans,18' margins "
                  "{},{},{:.4f},{:.4f} spacing 0,{:.4f}",
                  count, quote(title), kLeft, kRight, 70.0 / height,
                  1.0 - top / height, 24.0 / height));
  const TimeRange range = find_range(panels);
  script.add(
      fmt::format("set xrange [{:.17g}:{:.17g}]", range.first, range.last));
  script.add("set grid lc rgb '#dddddd' dt 1 lw 0.6");
  script.add("set border lc rgb '#555555' lw 0.7");
  script.add("set ytics nomirror; set xtics nomirror");
  script.add("set format y '%.3g'");
  add_marks(script, marks, range, top, height);
  for (std::size_t p = 0; p < panels.size(); ++p) {
    if (p == 1) {
      script.add("unset label");
      for (std::size_t i = 0; i < marks.size(); ++i) {
        script.add(fmt::format("unset arrow {}", 1001 + i));
      }
    }
    add_panel(script, p, panels[p], reference, key_height,
              p + 1 == panels.size() ? label_from("time [s]", start) : "");
  }
  script.add("unset multiplot");
  return script;
}

GnuplotScript write_energy(const std::filesystem::path& file,
                           const std::string& title, const History& history) {
  Panel stored{"stored [J]",
               {{"total", {}, {}},
                {"kinetic, rigid", {}, {}},
                {"kinetic, modal", {}, {}},
                {"elastic", {}, {}},
                {"couplers", {}, {}}}};
  Panel audit{"since the start [J]",
              {{"change of total", {}, {}},
               {"work of loads", {}, {}},
               {"dissipated", {}, {}}}};
  double start_total = 0.0;
  for (const std::size_t i : list_drawn_outputs(history.energies.size())) {
    const dynamics::EnergyBalance e = history.energies[i];
    if (i == 0) start_total = e.total();
    add_point(
        stored, history.times[i],
        {e.total(), e.kinetic_rigid, e.kinetic_modal, e.elastic, e.coupler});
    add_point(audit, history.times[i],
              {e.total() - start_total, e.work, e.dissipated});
  }
  // The panels have different curves, so each has its own key.
  GnuplotScript script(file, kWidth, 900);
  std::vector<Panel> panels = {stored, audit};
  const double start = find_start(panels);
  std::vector<Mark> none;
  subtract_time(panels, none, start);
  for (std::size_t p = 0; p < panels.size(); ++p) {
    for (std::size_t s = 0; s < panels[p].series.size(); ++s) {
      add_data(script, fmt::format("d{}_{}", p, s), panels[p].series[s]);
    }
  }
  script.add("set multiplot layout 2,1 title " + quote(title + ": energy") +
             " font 'sans,18'");
  script.add("set grid lc rgb '#dddddd' dt 1 lw 0.6");
  script.add("set border lc rgb '#555555' lw 0.7");
  script.add("set format y '%.3g'; set lmargin 12; set rmargin 3");
  for (std::size_t p = 0; p < panels.size(); ++p) {
    script.add("set key outside top center horizontal samplen 3");
    // Without values gnuplot finds no range by itself.
    const bool has_values = largest(panels[p]) > 0.0;
    script.add(has_values ? "set yrange [*:*]" : "set yrange [-1:1]");
    script.add("set ylabel " + quote(panels[p].label));
    script.add("set xlabel " + quote(label_from("time [s]", start)));
    std::string plot = "plot ";
    for (std::size_t s = 0; s < panels[p].series.size(); ++s) {
      plot += fmt::format("{}$d{}_{} using 1:2 with lines {} title {}",
                          s == 0 ? "" : ", ", p, s, style(s),
                          quote(panels[p].series[s].name));
    }
    script.add(plot);
  }
  script.add("unset multiplot");
  return script;
}

}  // namespace limber::results
