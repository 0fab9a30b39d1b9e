// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cstdio>
#include <exception>

#include "page.hpp"
#include "pulse.hpp"

/// Krylov vectors against eigenmodes on the report's beam under smooth pulses,
/// as a page with a picture. Exit status 1 if a claim of the page does not
/// hold in this run.
namespace limber::bench::departure {
namespace {

constexpr std::array<double, 3> kDrawn = {10.0, 1.0, 0.1};  // first periods
constexpr std::array<double, 7> kDurations = {10.0, 3.0,  1.0, 0.3,
                                              0.1,  0.03, 0.01};
constexpr int kVectors = 4;  // of the table

struct Case {
  double duration;  ///< of the first period [-]
  Errors errors;
  [[nodiscard]] double at(Source source, int count) const {
    return errors(static_cast<Eigen::Index>(source), count - 1);
  }
  [[nodiscard]] bool eigenmodes_win(int count) const {
    return at(Source::eigenmodes, count) < at(Source::krylov, count);
  }
};

struct Beam {
  std::string name;
  double first_period;  ///< [s]
  Eigen::Index mode_count;
  std::vector<Case> cases;  ///< in the order of kDurations
  [[nodiscard]] const Case& find(double duration) const {
    return *std::find_if(cases.begin(), cases.end(), [&](const Case& known) {
      return known.duration == duration;
    });
  }
};

Beam study(const std::string& name, bool is_clamped) {
  const PushedBeam pushed(is_clamped);
  Beam beam{name, pushed.first_period(), pushed.mode_count(), {}};
  for (const double duration : kDurations)
    beam.cases.push_back(
        {duration, pushed.find_errors(duration * beam.first_period)});
  return beam;
}

/// As "1-2, 4-10".
std::string list_ranges(const std::vector<int>& counts) {
  std::string text;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    const std::size_t first = i;
    while (i + 1 < counts.size() && counts[i + 1] == counts[i] + 1) ++i;
    text += fmt::format("{}{}", text.empty() ? "" : ", ", counts[first]);
    if (i > first) text += fmt::format("-{}", counts[i]);
  }
  return text;
}

/// Of Krylov and eigenmodes; the picture says it.
std::string describe_winner(const Case& one) {
  std::vector<int> wins;
  for (int n = 1; n <= kMostVectors; ++n)
    if (one.eigenmodes_win(n)) wins.push_back(n);
  if (wins.empty()) return "Krylov beats eigenmodes at every n";
  if (std::ssize(wins) == kMostVectors) return "EIGENMODES win at every n";
  return fmt::format("EIGENMODES win at n = {}, Krylov at others",
                     list_ranges(wins));
}

Panel make_panel(const Beam& beam, const Case& one) {
  Panel panel{
      .title = fmt::format("{} beam, pulse of {:g} first period{}", beam.name,
                           one.duration, one.duration == 1.0 ? "" : "s"),
      .x_label = "vectors n",
      .y_label = "error of the tip, rms [-]",
      .is_log_y = true,
      .curves = {},
      .commands = {"set xtics 1", "set yrange [*:100]",
                   "set label 1 '" + describe_winner(one) +
                       "' at graph 0.98, graph 0.95 right font 'sans,11'"}};
  for (const Source source : kSources) {
    Curve curve{.name = to_string(source),
                .x = {},
                .y = {},
                .mark = Mark::line_points,
                .colour = static_cast<int>(source)};
    for (int n = 1; n <= kMostVectors; ++n) {
      curve.x.push_back(n);
      curve.y.push_back(one.at(source, n));
    }
    panel.curves.push_back(curve);
  }
  return panel;
}

void draw_errors(Page& page, const std::vector<Beam>& beams) {
  Plot plot{.panels = {}, .columns = static_cast<int>(kDrawn.size())};
  for (const Beam& beam : beams)
    for (const double duration : kDrawn)
      plot.panels.push_back(make_panel(beam, beam.find(duration)));
  page.figure(plot, "pulse",
              "Error of n vectors against all modes, for pulses of 10, 1 and "
              "0.1 first periods");
}

void write_table(Page& page, const std::vector<Beam>& beams) {
  std::vector<std::vector<std::string>> rows;
  for (const Beam& beam : beams) {
    for (const Case& one : beam.cases) {
      std::vector<std::string> row = {beam.name,
                                      fmt::format("{:g}", one.duration)};
      for (const Source source : kSources)
        row.push_back(fmt::format("{:.2g}", one.at(source, kVectors)));
      row.push_back(
          fmt::format("{:.2g}", one.at(Source::eigenmodes, kVectors) /
                                    one.at(Source::krylov, kVectors)));
      rows.push_back(row);
    }
  }
  page.text(
      fmt::format("The same with {} vectors. *Gain* is the eigenmodes' error "
                  "over that of Krylov vectors: below 1 eigenmodes are better.",
                  kVectors));
  page.table({"beam", "pulse [first periods]", "Krylov", "eigenmodes", "mixed",
              "gain"},
             rows);
}

void introduce(Page& page, const std::vector<Beam>& beams) {
  page.text("# A smooth pulse on the report's beam");
  page.text(fmt::format(
      "Written by `bench_departure`, including all text; do not edit. Theory: "
      "[operating "
      "states](../../../docs/theory/operating_states.md#departures). Beam of 1 "
      "x 1 x 5 m, `meshes/beam579.msh`, E = 200 GPa, Poisson's ratio 0, 8000 "
      "kg/m^3, undamped; free, or clamped at z = 0. A force along x, spread "
      "evenly over the face z = 5 m, varies as sin^4(pi t / T). First periods: "
      "{:.4g} ms free, {:.4g} ms clamped.",
      1e3 * beams[0].first_period, 1e3 * beams[1].first_period));
  page.text(fmt::format(
      "The full linear model is all {} (free) and {} (clamped) elastic modes "
      "of the mesh by a dense solver. It and every choice of n vectors are "
      "solved exactly in time, so that errors are due to the vectors only. "
      "*Error*: distance of the deformation from the full model's, root mean "
      "square over the nodes of the face z = 5 m and over time, from the start "
      "of the pulse to ten first periods after its end, relative to the root "
      "mean square of the deformation there. *Krylov*: K^+ F, then (K^+ M)^k "
      "K^+ F. *Eigenmodes*: the lowest. *Mixed*: n / 2 eigenmodes, the rest "
      "Krylov.",
      beams[0].mode_count, beams[1].mode_count));
}

void check_claims(Page& page, const std::vector<Beam>& beams) {
  for (const Beam& beam : beams) {
    const Case& slow = beam.find(10.0);
    const double eigenmodes = slow.at(Source::eigenmodes, kVectors);
    page.check(
        10.0 * slow.at(Source::krylov, kVectors) < eigenmodes &&
            10.0 * slow.at(Source::mixed, kVectors) < eigenmodes,
        fmt::format("{}, ten first periods, {} vectors: Krylov and mixed are "
                    "ten times better than eigenmodes and more.",
                    beam.name, kVectors));
    page.check(beam.find(0.1).eigenmodes_win(kVectors),
               fmt::format("{}, a tenth of the first period, {} vectors: "
                           "eigenmodes are better.",
                           beam.name, kVectors));
  }
}

int write_page(const std::string& folder) {
  Page page(folder);
  const std::vector<Beam> beams = {study("free", false),
                                   study("clamped", true)};
  introduce(page, beams);
  draw_errors(page, beams);
  write_table(page, beams);
  page.text(
      "The response to a slow pulse is the static deformation and its "
      "corrections, which are the Krylov vectors; n eigenmodes lack the "
      "contribution of all others, however slow the pulse is. A short pulse "
      "leaves the beam ringing in its modes: eigenmodes have the right "
      "frequencies, and Krylov vectors those of the lowest modes only once "
      "there are enough of them. The error of eigenmodes decreases in steps, "
      "because half the bending modes, and all of torsion, are not excited.");
  check_claims(page, beams);
  page.write();
  if (!page.trouble().empty()) fmt::print("warning: {}\n", page.trouble());
  fmt::print("{}/README.md: {} claims checked, {} failed\n", folder,
             page.checks(), page.failures());
  return page.failures() == 0 ? 0 : 1;
}

}  // namespace
}  // namespace limber::bench::departure

int main(int argc, char** argv) {
  std::string folder = "out/departure";
  CLI::App app("Krylov vectors against eigenmodes under smooth pulses");
  app.add_option("--out", folder, "Folder for the page and its picture");
  CLI11_PARSE(app, argc, argv);
  try {
    return limber::bench::departure::write_page(folder);
  } catch (const std::exception& error) {
    fmt::print(stderr, "bench_departure: {}\n", error.what());
    return 3;
  }
}
