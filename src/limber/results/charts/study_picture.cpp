// SPDX-License-Identifier: BSD-3-Clause
#include "limber/results/charts/study_picture.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "limber/results/charts/tics.hpp"
#include "limber/results/gnuplot.hpp"

namespace limber::results {
namespace {

// Palette for colour-blind readers (Okabe and Ito, 2008).
constexpr const char* kBlue = "#0072B2";
constexpr const char* kOrange = "#D55E00";
constexpr int kPanel = 360;  // pixels
constexpr std::size_t kMostColumns = 8;
constexpr const char* kMatrixMargins =
    "margins 0.10,0.98,0.10,0.95 spacing 0.012,0.012";

struct Layout {
  std::size_t rows = 1;
  std::size_t columns = 1;
};

Layout arrange(std::size_t count) {
  const std::size_t columns = std::min<std::size_t>(count, 3);
  return {(count + columns - 1) / columns, columns};
}

void set_look(GnuplotScript& script) {
  script.add("set grid lc rgb '#dddddd' dt 1 lw 0.6");
  script.add("set border lc rgb '#555555' lw 0.7");
  script.add("set tics nomirror font 'sans,9'");
  script.add("set format '%g'");
  script.add("unset key");
}

GnuplotScript begin(const std::filesystem::path& file, const std::string& title,
                    const Layout& layout, int panel,
                    const std::string& margins = "") {
  GnuplotScript script(file, panel * static_cast<int>(layout.columns) + 60,
                       panel * static_cast<int>(layout.rows) + 60);
  script.add(
      fmt::format("set multiplot layout {},{} title {} font 'sans,14' {}",
                  layout.rows, layout.columns, quote(title), margins));
  set_look(script);
  return script;
}

struct Ends {
  double least = std::numeric_limits<double>::infinity();
  double largest = -std::numeric_limits<double>::infinity();
};

Ends find_ends(const StudyColumn& column) {
  Ends ends;
  for (const double value : column.values) {
    if (!std::isfinite(value)) continue;
    ends.least = std::min(ends.least, value);
    ends.largest = std::max(ends.largest, value);
  }
  return ends;
}

// Around the values of a logarithmic axis.
constexpr double kLogRoom = 1.1;

std::string list_tics(const StudyColumn& column, const Ends& ends,
                      bool has_labels) {
  std::vector<std::string> tics;
  if (!column.texts.empty()) {
    for (std::size_t i = 0; i < column.texts.size(); ++i) {
      tics.push_back(
          fmt::format("{} {}", has_labels ? quote(column.texts[i]) : "''", i));
    }
  } else if (ends.least < ends.largest) {
    // Of values from just above 2 to just below 20 the ends are round, too.
    const bool is_logarithmic = column.is_logarithmic && ends.least > 0.0;
    for (const double value :
         is_logarithmic ? list_logarithmic_tics(ends.least / kLogRoom,
                                                ends.largest * kLogRoom)
                        : list_even_tics(ends.least, ends.largest)) {
      tics.push_back(fmt::format("{:.9g}", value));
    }
  } else {
    tics.push_back(fmt::format("{:.9g}", ends.least));
  }
  return fmt::format("({})", fmt::join(tics, ", "));
}

/// The scale of one axis, with some room around the values.
void set_axis(GnuplotScript& script, const char* axis,
              const StudyColumn& column, bool has_label) {
  const Ends ends = find_ends(column);
  if (!(ends.least <= ends.largest)) return;
  const bool is_logarithmic = column.is_logarithmic && ends.least > 0.0;
  script.add(
      fmt::format("{} logscale {}", is_logarithmic ? "set" : "unset", axis));
  if (is_logarithmic) {
    script.add(fmt::format("set {}range [{:.9g}:{:.9g}]", axis,
                           ends.least / kLogRoom, ends.largest * kLogRoom));
  } else {
    const double range = ends.largest - ends.least;
    const double room = range > 0.0
                            ? 0.06 * range
                            : std::max(0.1 * std::abs(ends.least), 1e-12);
    script.add(fmt::format("set {}range [{:.9g}:{:.9g}]", axis,
                           ends.least - room, ends.largest + room));
  }
  script.add(fmt::format("set format {} '{}'", axis, has_label ? "%g" : ""));
  script.add(fmt::format("set {}tics {} noenhanced", axis,
                         list_tics(column, ends, has_label)));
  script.add(fmt::format("set {}label {} noenhanced", axis,
                         has_label ? quote(column.name) : "''"));
}

bool is_number(double value) { return std::isfinite(value); }

void add_points(GnuplotScript& script, const std::string& block,
                const StudyColumn& x, const StudyColumn& y,
                const StudyColumn* colour = nullptr) {
  script.add(fmt::format("${} << EOD", block));
  for (std::size_t i = 0; i < x.values.size(); ++i) {
    const double c = colour == nullptr ? 0.0 : colour->values[i];
    if (!is_number(x.values[i]) || !is_number(y.values[i]) || !is_number(c)) {
      continue;
    }
    script.add(
        fmt::format("{:.9g} {:.9g} {:.9g}", x.values[i], y.values[i], c));
  }
  script.add("EOD");
}

// Many points are drawn smaller, so that they do not hide each other.
double find_size(double size, std::size_t points) {
  constexpr double kFew = 200.0;
  return size *
         std::clamp(std::sqrt(kFew / static_cast<double>(points)), 0.5, 1.0);
}

std::string plot_points(const std::string& block, double size,
                        std::size_t points) {
  return fmt::format(
      "plot ${} using 1:2 with points pt 7 ps {:.2g} lc rgb '{}'", block,
      find_size(size, points), kBlue);
}

bool is_empty(const StudyColumn& column) {
  return std::none_of(column.values.begin(), column.values.end(), is_number);
}

std::string find_why_none(const StudyColumn& response) {
  if (!is_empty(response)) return "";
  return fmt::format("no picture of '{}': no run has a value of it",
                     response.name);
}

}  // namespace

std::string draw_response(const std::filesystem::path& file,
                          const std::string& title, const StudyColumn& response,
                          const std::vector<StudyColumn>& factors) {
  if (is_empty(response)) return find_why_none(response);
  GnuplotScript script = begin(file, title, arrange(factors.size()), kPanel);
  for (std::size_t f = 0; f < factors.size(); ++f) {
    const std::string block = fmt::format("d{}", f);
    add_points(script, block, factors[f], response);
    set_axis(script, "x", factors[f], true);
    set_axis(script, "y", response, true);
    script.add(plot_points(block, 0.8, response.values.size()));
  }
  script.add("unset multiplot");
  return script.run();
}

std::string draw_maps(const std::filesystem::path& file,
                      const std::string& title, const StudyColumn& response,
                      const std::vector<StudyColumn>& factors) {
  if (is_empty(response)) return find_why_none(response);
  const std::size_t count =
      std::min<std::size_t>(factors.size() * (factors.size() - 1) / 2, 9);
  if (count == 0) return "";
  GnuplotScript script = begin(file, title, arrange(count), kPanel + 60);
  script.add(
      "set palette defined (0 '#440154', 0.25 '#3b528b', 0.5 '#21918c', "
      "0.75 '#5ec962', 1 '#fde725')");
  script.add("set cbtics font 'sans,8'");
  script.add("set colorbox");
  std::size_t drawn = 0;
  for (std::size_t a = 0; a < factors.size(); ++a) {
    for (std::size_t b = a + 1; b < factors.size() && drawn < count; ++b) {
      const std::string block = fmt::format("m{}", drawn++);
      add_points(script, block, factors[a], factors[b], &response);
      set_axis(script, "x", factors[a], true);
      set_axis(script, "y", factors[b], true);
      script.add(
          fmt::format("plot ${} using 1:2:3 with points pt 7 ps {:.2g} lc "
                      "palette",
                      block, find_size(1.4, response.values.size())));
    }
  }
  script.add("unset multiplot");
  return script.run();
}

std::string draw_matrix(const std::filesystem::path& file,
                        const std::string& title,
                        const std::vector<StudyColumn>& columns) {
  std::vector<StudyColumn> shown;
  for (const StudyColumn& column : columns) {
    if (!is_empty(column) && shown.size() < kMostColumns) {
      shown.push_back(column);
    }
  }
  if (shown.size() < 2) return "";
  // Each pair once: below the diagonal.
  const std::size_t last = shown.size() - 1;
  GnuplotScript script = begin(file, title, {last, last}, 210, kMatrixMargins);
  script.add("set xtics rotate by -35 font 'sans,8'");
  script.add("set ytics font 'sans,8'");
  for (std::size_t y = 1; y <= last; ++y) {
    for (std::size_t x = 0; x < last; ++x) {
      if (x >= y) {
        script.add("set multiplot next");
        continue;
      }
      const std::string block = fmt::format("s{}_{}", y, x);
      add_points(script, block, shown[x], shown[y]);
      set_axis(script, "x", shown[x], y == last);
      set_axis(script, "y", shown[y], x == 0);
      script.add(plot_points(block, 0.6, shown[x].values.size()));
    }
  }
  script.add("unset multiplot");
  return script.run();
}

std::string draw_distributions(
    const std::filesystem::path& file, const std::string& title,
    const std::vector<DistributionCurve>& responses) {
  if (responses.empty()) return "";
  GnuplotScript script = begin(file, title, arrange(responses.size()), kPanel);
  script.add("set style fill transparent solid 0.25 noborder");
  for (std::size_t r = 0; r < responses.size(); ++r) {
    const DistributionCurve& curve = responses[r];
    set_axis(script, "x", {curve.response, curve.values}, true);
    script.add("set yrange [0:1]");
    script.add("set ytics 0.25");
    script.add("set ylabel 'fraction of samples below [-]'");
    script.add(fmt::format("$c{} << EOD", r));
    const auto n = static_cast<double>(curve.values.size());
    for (std::size_t i = 0; i < curve.values.size(); ++i) {
      const double fraction = static_cast<double>(i + 1) / n;
      script.add(fmt::format("{:.9g} {:.6g} {:.6g} {:.6g}", curve.values[i],
                             fraction, std::max(fraction - curve.band, 0.0),
                             std::min(fraction + curve.band, 1.0)));
    }
    script.add("EOD");
    script.add("unset object");
    script.add("unset arrow");
    script.add(fmt::format(
        "set object 1 rectangle from first {:.9g}, graph 0 to first {:.9g}, "
        "graph 1 behind fc rgb '{}' fs transparent solid 0.25 noborder",
        curve.mean - curve.mean_error, curve.mean + curve.mean_error, kOrange));
    script.add(
        fmt::format("set arrow 1 from first {0:.9g}, graph 0 to first {0:.9g}, "
                    "graph 1 nohead lc rgb '{1}' lw 1.5",
                    curve.mean, kOrange));
    script.add(fmt::format(
        "plot $c{0} using 1:3:4 with filledcurves lc rgb '{1}', $c{0} using "
        "1:2 with steps lc rgb '{1}' lw 1.5",
        r, kBlue));
  }
  script.add("unset multiplot");
  return script.run();
}

std::string draw_bars(const std::filesystem::path& file,
                      const std::string& title, const BarLabels& labels,
                      const std::vector<FactorBars>& responses) {
  if (responses.empty()) return "";
  GnuplotScript script =
      begin(file, title, arrange(responses.size()), kPanel + 40);
  script.add("set style fill solid 0.85 noborder");
  script.add("set boxwidth 0.35");
  script.add("set key top right");
  script.add("set yrange " + labels.range);
  script.add("set ylabel " + quote(labels.axis));
  script.add("set xtics rotate by -25 noenhanced");
  for (std::size_t r = 0; r < responses.size(); ++r) {
    const FactorBars& bars = responses[r];
    script.add(fmt::format("$e{} << EOD", r));
    for (std::size_t f = 0; f < bars.factors.size(); ++f) {
      const Bar& a = bars.first[f];
      const Bar& b = bars.second[f];
      script.add(fmt::format(
          "\"{}\" {} {:.6g} {:.6g} {:.6g} {:.6g} {:.6g} {:.6g}",
          bars.factors[f], f, a.value, a.low, a.high, b.value, b.low, b.high));
    }
    script.add("EOD");
    script.add(fmt::format("set xrange [-0.6:{}]",
                           static_cast<double>(bars.factors.size()) - 0.4));
    script.add("set title " + quote(bars.response) + " noenhanced");
    script.add(fmt::format(
        "plot $e{0} using ($2-0.19):3:xtic(1) with boxes lc rgb '{1}' title "
        "{3}, $e{0} using ($2+0.19):6 with boxes lc rgb '{2}' title {4}, "
        "$e{0} using ($2-0.19):4:4:5 with yerrorbars pt 0 lc rgb 'black' "
        "notitle, $e{0} using ($2+0.19):7:7:8 with yerrorbars pt 0 lc rgb "
        "'black' notitle",
        r, kBlue, kOrange, quote(labels.first), quote(labels.second)));
  }
  script.add("unset multiplot");
  return script.run();
}

}  // namespace limber::results
