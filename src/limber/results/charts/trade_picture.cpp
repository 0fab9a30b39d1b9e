// SPDX-License-Identifier: BSD-3-Clause
#include "limber/results/charts/trade_picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "limber/results/charts/label_placement.hpp"
#include "limber/results/charts/tics.hpp"
#include "limber/results/gnuplot.hpp"

namespace limber::results {
namespace {

// Palette for colour-blind readers (Okabe and Ito, 2008), and markers for print
// without colour.
constexpr std::array<const char*, 6> kTradeColours = {
    "#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9"};
constexpr std::array<int, 6> kTradeMarkers = {7, 5, 9, 13, 11, 15};
constexpr int kTradeWidth = 1500;
constexpr int kHeight = 720;
// Width of a panel within the margins below [pixels].
constexpr double kPanelWidth = 0.405 * kTradeWidth;
constexpr double kTradePanelHeight = 0.66 * kHeight;
// With more labels than this only the front's are written.
constexpr std::size_t kMostLabels = 16;

using Errors = std::vector<std::optional<double>>;

struct TradePanel {
  const char* title;
  Errors errors;
};

bool is_drawable_error(const std::optional<double>& error) {
  return error && std::isfinite(*error) && *error > 0.0;
}

std::vector<std::string> find_groups(const std::vector<TradePoint>& points) {
  std::vector<std::string> groups;
  for (const TradePoint& point : points) {
    if (std::find(groups.begin(), groups.end(), point.group) == groups.end()) {
      groups.push_back(point.group);
    }
  }
  return groups;
}

/// A range of a logarithmic axis.
struct Range {
  double least = std::numeric_limits<double>::infinity();
  double most = 0.0;

  void include(double value) {
    least = std::min(least, value);
    most = std::max(most, value);
  }
  void widen(double below, double above) {
    least /= below;
    most *= above;
  }
  [[nodiscard]] double find_fraction(double value) const {
    return std::log(value / least) / std::log(most / least);
  }
  /// Of `set xrange` and `set xtics`, for axis 'x' or 'y'.
  [[nodiscard]] std::string text(char axis) const {
    return fmt::format("set {0}range [{1:.6g}:{2:.6g}]; set {0}tics {3}", axis,
                       least, most,
                       to_tics(list_logarithmic_tics(least, most)));
  }
};

void add_trade_points(GnuplotScript& script, const std::string& block,
                      const std::vector<TradePoint>& points,
                      const Errors& errors, const std::string& group) {
  script.add(fmt::format("${} << EOD", block));
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (points[i].group != group || !is_drawable_error(errors[i])) continue;
    script.add(
        fmt::format("{:.6g} {:.6g}", points[i].cost, 100.0 * *errors[i]));
  }
  script.add("EOD");
}

/// Staircase: the least error at each cost.
void add_front(GnuplotScript& script, const std::string& block,
               const std::vector<TradePoint>& points, const Errors& errors,
               const std::vector<std::size_t>& front, double end) {
  script.add(fmt::format("${} << EOD", block));
  double last = 0.0;
  for (const std::size_t i : front) {
    if (!is_drawable_error(errors[i])) continue;
    if (last > 0.0)
      script.add(fmt::format("{:.6g} {:.6g}", points[i].cost, last));
    last = 100.0 * *errors[i];
    script.add(fmt::format("{:.6g} {:.6g}", points[i].cost, last));
  }
  if (last > 0.0) script.add(fmt::format("{:.6g} {:.6g}", end, last));
  script.add("EOD");
}

/// The front's labels first, in black; all labels if there are few points.
void add_labels(GnuplotScript& script, const std::vector<TradePoint>& points,
                const Errors& errors, const std::vector<std::size_t>& front,
                const Range& x, const Range& y,
                std::optional<double> tolerance) {
  std::vector<std::size_t> order = front;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (std::find(front.begin(), front.end(), i) == front.end()) {
      order.push_back(i);
    }
  }
  std::erase_if(order,
                [&](std::size_t i) { return !is_drawable_error(errors[i]); });
  std::vector<LabelledPoint> labels;
  for (const std::size_t i : order) {
    const bool is_shown =
        points.size() <= kMostLabels || labels.size() < front.size();
    labels.push_back({kPanelWidth * x.find_fraction(points[i].cost),
                      kTradePanelHeight * y.find_fraction(100.0 * *errors[i]),
                      is_shown ? points[i].label : ""});
  }
  std::vector<double> lines;
  if (tolerance) {
    const double height =
        kTradePanelHeight * y.find_fraction(100.0 * *tolerance);
    lines = {height, height + 12.0};  // and the line's label
  }
  const auto places =
      place_labels(labels, kPanelWidth, kTradePanelHeight, lines);
  for (std::size_t l = 0; l < labels.size(); ++l) {
    if (!places[l]) continue;
    script.add(fmt::format(
        "set label {} at graph {:.4f},{:.4f} {} font 'sans,10' textcolor rgb "
        "'{}'",
        quote(labels[l].text), places[l]->x / kPanelWidth,
        places[l]->y / kTradePanelHeight,
        places[l]->reaches_right ? "left" : "right",
        l < front.size() ? "#000000" : "#777777"));
  }
}

std::vector<double> list_costs(const std::vector<TradePoint>& points) {
  std::vector<double> costs;
  for (const TradePoint& point : points) costs.push_back(point.cost);
  return costs;
}

void set_lines(GnuplotScript& script, double reference_cost,
               std::optional<double> tolerance) {
  script.add("unset arrow; unset label");
  script.add(fmt::format(
      "set arrow from {0:.6g}, graph 0 to {0:.6g}, graph 1 nohead back lc rgb "
      "'#555555' dt 2",
      reference_cost));
  script.add(fmt::format(
      "set label 'reference' at {:.6g}, graph 0.98 right rotate offset "
      "character -1.2,0 font 'sans,10' textcolor rgb '#555555'",
      reference_cost));
  if (!tolerance) return;
  script.add(
      fmt::format("set arrow from graph 0, first {0:.6g} to graph 1, first "
                  "{0:.6g} nohead back lc rgb '#b23b2a' dt 2",
                  100.0 * *tolerance));
  script.add(fmt::format(
      "set label {} at graph 0.01, first {:.6g} left offset character 0,0.5 "
      "font 'sans,10' textcolor rgb '#b23b2a'",
      quote(fmt::format("tolerance {:g} %", 100.0 * *tolerance)),
      100.0 * *tolerance));
}

void add_trade_panel(GnuplotScript& script, std::size_t p,
                     const TradePanel& panel,
                     const std::vector<TradePoint>& points, const Range& costs,
                     double reference_cost, std::optional<double> tolerance) {
  const std::vector<std::string> groups = find_groups(points);
  const auto front = find_front(list_costs(points), panel.errors);
  for (std::size_t g = 0; g < groups.size(); ++g) {
    add_trade_points(script, fmt::format("p{}_{}", p, g), points, panel.errors,
                     groups[g]);
  }
  add_front(script, fmt::format("f{}", p), points, panel.errors, front,
            costs.most);
  Range errors;
  for (const auto& error : panel.errors) {
    if (is_drawable_error(error)) errors.include(100.0 * *error);
  }
  if (tolerance) errors.include(100.0 * *tolerance);
  if (errors.most == 0.0) errors = {1.0, 100.0};
  errors.widen(2.5, 2.5);
  set_lines(script, reference_cost, tolerance);
  add_labels(script, points, panel.errors, front, costs, errors, tolerance);
  script.add("set title " + quote(panel.title));
  script.add(costs.text('x'));
  script.add(errors.text('y'));
  std::string plot = fmt::format(
      "plot $f{} using 1:2 with lines lc rgb '#bbbbbb' lw 2.2 title {}", p,
      p == 0 ? "'front'" : "''");
  for (std::size_t g = 0; g < groups.size(); ++g) {
    plot += fmt::format(
        ", $p{}_{} using 1:2 with points pt {} ps 1.3 lc rgb "
        "'{}' title {}",
        p, g, kTradeMarkers[g % kTradeMarkers.size()],
        kTradeColours[g % kTradeColours.size()],
        p == 0 ? quote(groups[g]) : "''");
  }
  script.add(plot);
}

}  // namespace

std::vector<std::size_t> find_front(const std::vector<double>& costs,
                                    const Errors& errors) {
  std::vector<std::size_t> order(costs.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::erase_if(order, [&](std::size_t i) {
    return !errors[i] || !std::isfinite(*errors[i]);
  });
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return std::pair(costs[a], *errors[a]) < std::pair(costs[b], *errors[b]);
  });
  double least = std::numeric_limits<double>::infinity();
  std::vector<std::size_t> front;
  for (const std::size_t i : order) {
    if (!(*errors[i] < least)) continue;
    least = *errors[i];
    front.push_back(i);
  }
  return front;
}

std::string draw_trade(const std::filesystem::path& file,
                       const std::string& title,
                       const std::vector<TradePoint>& points,
                       double reference_cost, std::optional<double> tolerance) {
  TradePanel total{"displacement", {}};
  TradePanel elastic{"deformation", {}};
  Range costs;
  costs.include(reference_cost);
  for (const TradePoint& point : points) {
    total.errors.push_back(point.displacement);
    elastic.errors.push_back(point.deformation);
    costs.include(point.cost);
  }
  costs.widen(3.0, 2.0);
  GnuplotScript script(file, kTradeWidth, kHeight);
  script.add("set multiplot layout 1,2 title " +
             quote(title + ": error over cost") +
             " font 'sans,18' margins 0.085,0.985,0.20,0.86 spacing 0.09,0");
  script.add("set logscale xy");
  script.add("set format xy '%g'");
  script.add("set grid lc rgb '#dddddd' dt 1 lw 0.6");
  script.add("set border lc rgb '#555555' lw 0.7");
  script.add("set tics nomirror");
  script.add("set key at screen 0.5, screen 0.045 center horizontal samplen 2");
  script.add("set xlabel 'wall time per simulated time'");
  script.add("set ylabel 'RMS error [% of the reference]'");
  add_trade_panel(script, 0, total, points, costs, reference_cost, tolerance);
  add_trade_panel(script, 1, elastic, points, costs, reference_cost, tolerance);
  script.add("unset multiplot");
  return script.run();
}

}  // namespace limber::results
