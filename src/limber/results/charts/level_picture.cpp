// SPDX-License-Identifier: BSD-3-Clause
#include "limber/results/charts/level_picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "limber/flexbody/modal/decision_boundary.hpp"
#include "limber/results/gnuplot.hpp"

namespace limber::results {
namespace {

using dynamics::RotationPoint;
using flexbody::InertialDisplacementBound;

// Palette for colour-blind readers (Okabe and Ito, 2008).
constexpr std::array<const char*, 6> kLevelColours = {
    "#0072B2", "#D55E00", "#CC79A7", "#000000", "#56B4E9", "#009E73"};
constexpr int kLevelWidth = 1100;
constexpr int kLevelPanelHeight = 640;
constexpr int kSamples = 200;  // of a curve

/// Bodies of one shape and equal limits.
struct LevelPanel {
  std::vector<const RotationTrack*> tracks;
  double report = 0.0;  ///< |alpha| + |Omega|^2 [1/s^2]
  double report_linear = 0.0;
  double slow = 0.0;  ///< Omega at alpha = 0 [rad/s]
  double sudden = 0.0;
  double linear = 0.0;
  double least_Omega = 0.0;  ///< of the axes
  double most_Omega = 0.0;
  double least_alpha = 0.0;
  double most_alpha = 0.0;
};

RotationPoint find_peak(const RotationTrack& track) {
  RotationPoint peak;
  for (const RotationPoint& point : track.points) {
    peak.alpha = std::max(peak.alpha, point.alpha);
    peak.Omega = std::max(peak.Omega, point.Omega);
  }
  return peak;
}

double decade_below(double value) {
  return std::pow(10.0, std::floor(std::log10(value)));
}

double decade_above(double value) {
  return std::pow(10.0, std::ceil(std::log10(value)));
}

/// Both boundaries, and three decades of each track below its peak.
void set_axes(LevelPanel& panel) {
  constexpr double kTail = 1e-3;
  constexpr double kNothing = 1e-12;  // of a boundary: negligible
  panel.least_Omega = 0.1 * panel.sudden;
  panel.most_Omega = 3.0 * panel.linear;
  panel.least_alpha = 0.1 * panel.report;
  panel.most_alpha = 3.0 * panel.report_linear;
  const auto widen = [&](double peak, double& least, double& most) {
    if (peak < kNothing * most) return;
    least = std::min(least, kTail * peak);
    most = std::max(most, 3.0 * peak);
  };
  for (const RotationTrack* track : panel.tracks) {
    const RotationPoint peak = find_peak(*track);
    widen(peak.Omega, panel.least_Omega, panel.most_Omega);
    widen(peak.alpha, panel.least_alpha, panel.most_alpha);
  }
  panel.least_Omega = decade_below(panel.least_Omega);
  panel.most_Omega = decade_above(panel.most_Omega);
  panel.least_alpha = decade_below(panel.least_alpha);
  panel.most_alpha = decade_above(panel.most_alpha);
}

std::vector<LevelPanel> find_panels(const std::vector<RotationTrack>& tracks) {
  std::vector<LevelPanel> panels;
  for (const RotationTrack& track : tracks) {
    const flexbody::ReducedBody& body = *track.reduced;
    if (body.clamped || !(body.levers.displacement > 0.0)) continue;
    const auto same = std::find_if(
        panels.begin(), panels.end(), [&](const LevelPanel& panel) {
          const RotationTrack& other = *panel.tracks.front();
          return other.reduced == track.reduced &&
                 other.displacement == track.displacement &&
                 other.linear_limit == track.linear_limit;
        });
    if (same != panels.end()) {
      same->tracks.push_back(&track);
      continue;
    }
    const InertialDisplacementBound slow(body);
    const InertialDisplacementBound sudden(body, flexbody::Onset::sudden);
    LevelPanel panel;
    panel.tracks = {&track};
    panel.report = track.displacement / body.levers.displacement;
    panel.report_linear = track.linear_limit / body.levers.displacement;
    panel.slow = slow.find_omega(0.0, track.displacement);
    panel.sudden = sudden.find_omega(0.0, track.displacement);
    panel.linear = sudden.find_omega(0.0, track.linear_limit);
    if (std::isfinite(panel.slow)) panels.push_back(std::move(panel));
  }
  for (LevelPanel& panel : panels) set_axes(panel);
  return panels;
}

void add_track(GnuplotScript& script, const std::string& block,
               const LevelPanel& panel, const RotationTrack& track) {
  script.add(fmt::format("${} << EOD", block));
  for (const RotationPoint& point : track.points) {
    // Zero has no place on a logarithmic axis: drawn on the edge.
    script.add(fmt::format("{:.6g} {:.6g}",
                           std::max(point.Omega, panel.least_Omega),
                           std::max(point.alpha, panel.least_alpha)));
  }
  script.add("EOD");
}

/// |alpha| + |Omega|^2 = limit.
void add_report_curve(GnuplotScript& script, const std::string& block,
                      const LevelPanel& panel, double limit) {
  script.add(fmt::format("${} << EOD", block));
  const double end = std::sqrt(limit);
  for (int i = 0; i < kSamples; ++i) {
    const double Omega = panel.least_Omega * std::pow(end / panel.least_Omega,
                                                      i / double(kSamples - 1));
    const double alpha = limit - Omega * Omega;
    script.add(fmt::format("{:.6g} {:.6g}", Omega,
                           std::max(alpha, 0.1 * panel.least_alpha)));
  }
  script.add("EOD");
}

/// A region of the plane, from its left edge to its right one.
void add_region(GnuplotScript& script, double from, double to,
                const char* colour) {
  script.add(fmt::format(
      "set object rectangle from {:.6g}, graph 0 to {:.6g}, graph 1 behind "
      "fs solid noborder fc rgb '{}'",
      from, to, colour));
}

void add_line(GnuplotScript& script, double Omega, const char* style) {
  script.add(
      fmt::format("set arrow from {:.6g}, graph 0 to {:.6g}, graph 1 nohead "
                  "back {}",
                  Omega, Omega, style));
}

void add_level_panel(GnuplotScript& script, std::size_t p,
                     const LevelPanel& panel) {
  script.add("unset object; unset arrow");
  script.add(fmt::format("set xrange [{:g}:{:g}]", panel.least_Omega,
                         panel.most_Omega));
  script.add(fmt::format("set yrange [{:g}:{:g}]", panel.least_alpha,
                         panel.most_alpha));
  add_region(script, panel.least_Omega, panel.sudden, "#dff0dc");
  add_region(script, panel.sudden, panel.linear, "#fff5cc");
  add_region(script, panel.linear, panel.most_Omega, "#f6d5cf");
  add_line(script, panel.sudden, "lc rgb '#2e7d32' lw 1.6");
  add_line(script, panel.slow, "lc rgb '#2e7d32' lw 1.2 dt 3");
  add_line(script, panel.linear, "lc rgb '#b23b2a' lw 1.6");
  std::string plot = fmt::format(
      "plot $r{0} using 1:2 with lines lc rgb '#555555' dt 2 lw 1.6 title "
      "{1}, $l{0} using 1:2 with lines lc rgb '#b23b2a' dt 2 lw 1.6 title {2}, "
      "NaN with lines lc rgb '#2e7d32' lw 1.6 title {3}, NaN with lines lc rgb "
      "'#2e7d32' dt 3 lw 1.2 title {4}, NaN with lines lc rgb '#b23b2a' lw 1.6 "
      "title {5}",
      p,
      quote("report, " +
            fmt::format("{:.2g} m", panel.tracks.front()->displacement)),
      quote("report, linear range"), quote("bound, sudden spin"),
      quote("bound, slow spin"), quote("bound, linear range"));
  for (std::size_t t = 0; t < panel.tracks.size(); ++t) {
    const char* colour = kLevelColours[t % kLevelColours.size()];
    plot += fmt::format(
        ", $t{}_{} using 1:2 with linespoints pt 7 ps 0.35 lw 0.8 lc rgb '{}' "
        "title {}",
        p, t, colour, quote(panel.tracks[t]->name));
  }
  script.add(plot);
}

}  // namespace

std::string draw_rotation_plane(const std::filesystem::path& file,
                                const std::string& title,
                                const std::vector<RotationTrack>& tracks) {
  const std::vector<LevelPanel> panels = find_panels(tracks);
  if (panels.empty()) return {};
  const int count = static_cast<int>(panels.size());
  GnuplotScript script(file, kLevelWidth, 60 + kLevelPanelHeight * count);
  for (std::size_t p = 0; p < panels.size(); ++p) {
    const LevelPanel& panel = panels[p];
    add_report_curve(script, fmt::format("r{}", p), panel, panel.report);
    add_report_curve(script, fmt::format("l{}", p), panel, panel.report_linear);
    for (std::size_t t = 0; t < panel.tracks.size(); ++t) {
      add_track(script, fmt::format("t{}_{}", p, t), panel, *panel.tracks[t]);
    }
  }
  script.add(fmt::format("set multiplot layout {},1 title {} font 'sans,18'",
                         count, quote(title + ": rotation and its limits")));
  script.add("set logscale xy");
  script.add("set format xy '%g'");
  script.add("set grid lc rgb '#cccccc' lw 0.5 front");
  script.add("set key outside right top samplen 2");
  script.add("set xlabel 'angular velocity [rad/s]'");
  script.add("set ylabel 'angular acceleration [rad/s^2]'");
  for (std::size_t p = 0; p < panels.size(); ++p) {
    add_level_panel(script, p, panels[p]);
  }
  script.add("unset multiplot");
  return script.run();
}

}  // namespace limber::results
