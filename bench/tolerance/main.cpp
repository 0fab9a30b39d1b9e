// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>

#include "cost.hpp"
#include "page.hpp"

/// Whether a tolerance is met on every shipped scene, and its cost compared
/// with fixed steps in scenes with impacts or latches, as a page with pictures.
/// Exit status 1 if a claim of the page fails in this run.
namespace limber::bench::tolerance {
namespace {

constexpr double kLeast = 1e-6;           // of the tolerances [m]
constexpr double kMostOfMotion = 0.1;     // a tolerance that is tried
constexpr double kWithin = 10.0;          // times the tolerance: claimed
constexpr double kShareWithin = 0.95;     // of all cases: claimed
constexpr double kCheaper = 18.0 / 22.0;  // of all cases: claimed
const std::vector<double> kTolerances = {1e-3, 1e-4, 1e-5, kLeast};  // [m]

struct Shipped {
  std::string file;
  bool is_struck;  ///< or latched, or loaded by a jump
};
const std::vector<Shipped> kScenes = {
    {"examples/claw.toml", true},
    {"examples/four_bar.toml", false},
    {"examples/joint_chain.toml", false},
    {"examples/pendulum_chain.toml", false},
    {"examples/report_beam.toml", true},
    {"examples/slew.toml", false},
    {"examples/struck_finger.toml", true},
    {"bench/trade/scenes/complex.toml", true},
    {"bench/trade/scenes/impact.toml", true},
    {"bench/trade/scenes/rotation.toml", false},
    {"bench/trade/scenes/spin.toml", true},
    {"bench/trade/scenes/struck_finger.toml", true}};

/// A scene to one tolerance.
struct Case {
  double tolerance = 0.0;  ///< [m]
  Run run;                 ///< in one pass
  Run verified;
  double error = 0.0;                 ///< true one of `run` [m]
  double verified_error = 0.0;        ///< [m]
  std::optional<Rival> fixed = {};    ///< in uniform steps
  std::optional<Rival> by_hand = {};  ///< in the file's own changing steps
};

struct SceneCases {
  std::string name;
  bool is_struck;
  bool has_own_changes;
  double motion;  ///< [m]
  Reference reference;
  std::vector<Case> cases;
};

// Without underscores, which pictures would set as indices.
std::string shorten(const std::string& file) {
  std::string name = std::filesystem::path(file).stem().string();
  std::replace(name.begin(), name.end(), '_', ' ');
  return (file.rfind("examples", 0) == 0 ? "" : "trade: ") + name;
}

SceneCases study(const Shipped& shipped, const std::filesystem::path& cache) {
  const SceneRuns runs(shipped.file, cache);
  SceneCases scene{shorten(shipped.file),        shipped.is_struck,
                   runs.has_own_changes(),       0.0,
                   find_reference(runs, kLeast), {}};
  scene.motion = runs.measure_motion(scene.reference.run);
  for (const double tolerance : kTolerances) {
    if (tolerance > kMostOfMotion * scene.motion) continue;
    Case one{tolerance, runs.run_to(tolerance, dynamics::TolerancePasses::one),
             runs.run_to(tolerance, dynamics::TolerancePasses::verified)};
    one.error = runs.measure_distance(one.run, scene.reference.run);
    one.verified_error =
        runs.measure_distance(one.verified, scene.reference.run);
    if (shipped.is_struck) {
      one.fixed =
          find_rival(runs, scene.reference, tolerance, one.error, false);
      if (scene.has_own_changes) {
        one.by_hand =
            find_rival(runs, scene.reference, tolerance, one.error, true);
      }
    }
    scene.cases.push_back(std::move(one));
  }
  return scene;
}

void introduce(Page& page) {
  page.text("# What a tolerance means, and what it costs");
  page.text(
      "Written by `bench_tolerance`, including all text; do not edit. "
      "`tolerance` in a scenario's `[time]` is the largest permitted error of "
      "any point's position "
      "([how](../../../docs/theory/time_integration.md#steps-to-a-tolerance)). "
      "Here every shipped scene is run at level `coupled` to 1 mm, 0.1 mm, "
      "0.01 mm and 1 um, except for tolerances above a tenth of its motion. "
      "The *true error* is the largest distance of any point from the "
      "reference at 100 outputs, the same of all runs.");
}

void write_references(Page& page, const std::vector<SceneCases>& scenes) {
  page.heading("References");
  page.text(
      "Two for each scene: uniform steps, halved until a third of the last "
      "difference is below 2e-8 m or a run takes over 1.5 s, and a tolerance "
      "of 2e-8 m. The one with the smaller estimate of its error is used; the "
      "other one checks that estimate.");
  std::vector<std::vector<std::string>> rows;
  for (const SceneCases& scene : scenes) {
    const Reference& r = scene.reference;
    rows.push_back({scene.name, fmt::format("{:.2g}", scene.motion), r.kind,
                    fmt::format("{:.1e}", r.uncertainty),
                    fmt::format("{:.1e}", r.other_uncertainty),
                    fmt::format("{:.1e}", r.from_other)});
  }
  page.table({"scene", "motion [m]", "reference", "its estimate [m]",
              "the other's [m]", "distance of both [m]"},
             rows);
}

template <typename Use>
void for_each_case(const std::vector<SceneCases>& scenes, const Use& use) {
  for (const SceneCases& scene : scenes) {
    for (const Case& one : scene.cases) use(scene, one);
  }
}

void write_accuracy(Page& page, const std::vector<SceneCases>& scenes) {
  page.heading("True error");
  std::vector<std::vector<std::string>> rows;
  int cases = 0;
  int within_one = 0;
  int within_ten = 0;
  int verified_within_one = 0;
  double lowest = INFINITY;
  double highest = 0.0;
  for_each_case(scenes, [&](const SceneCases& scene, const Case& one) {
    const double fraction = one.error / one.tolerance;
    const double verified = one.verified_error / one.tolerance;
    const double of_estimate =
        one.verified_error / one.verified.statistics.estimated_error;
    ++cases;
    within_one += fraction <= 1.0 ? 1 : 0;
    within_ten += fraction <= kWithin ? 1 : 0;
    verified_within_one += verified <= 1.0 ? 1 : 0;
    lowest = std::min(lowest, of_estimate);
    highest = std::max(highest, of_estimate);
    rows.push_back(
        {scene.name, fmt::format("{:g}", one.tolerance),
         fmt::format("{:.2g}", fraction),
         fmt::format("{}", one.run.statistics.steps),
         fmt::format("{}", one.run.statistics.rejected_steps),
         fmt::format("{}", one.run.statistics.newton_iterations),
         fmt::format("{:.2g}", verified), fmt::format("{:.2g}", of_estimate),
         fmt::format("{}", one.verified.statistics.passes),
         fmt::format("{}", one.verified.statistics.newton_iterations)});
  });
  page.check(within_ten >= kShareWithin * cases,
             fmt::format("in one pass, at least 95 % of the cases have an "
                         "error of less than 10 tolerances: {} of {}.",
                         within_ten, cases));
  page.text(fmt::format(
      "In one pass {} of {} are within one tolerance, verified {}. The ratio "
      "of a verified run's true error to its own estimate (`estimated_error`) "
      "is {:.2g} to {:.2g}. Its iterations are those of all passes.",
      within_one, cases, verified_within_one, lowest, highest));
  page.table(
      {"scene", "tolerance [m]", "one pass: true error / tolerance", "steps",
       "rejected", "iterations", "verified: true error / tolerance",
       "true / estimated", "passes", "iterations"},
      rows);
}

void draw_accuracy(Page& page, const std::vector<SceneCases>& scenes) {
  Panel panel{.title = "True error over the tolerance, one mark a case",
              .x_label = "tolerance [m]",
              .y_label = "true error / tolerance",
              .is_log_x = true,
              .is_log_y = true,
              .curves = {},
              .commands = {"set xrange [3e-7:3e-3]", "set yrange [5e-4:30]",
                           "set key outside right top vertical maxrows 20"}};
  // Marks of scenes side by side.
  double shift = 0.62;
  for (const SceneCases& scene : scenes) {
    Curve curve{scene.name, {}, {}, Mark::points, -1};
    for (const Case& one : scene.cases) {
      curve.x.push_back(shift * one.tolerance);
      curve.y.push_back(one.error / one.tolerance);
    }
    curve.mark = panel.curves.size() < 7 ? Mark::points : Mark::line_points;
    panel.curves.push_back(std::move(curve));
    shift *= 1.09;
  }
  panel.curves.push_back(
      {"the tolerance", {3e-7, 3e-3}, {1.0, 1.0}, Mark::dashed, 6});
  panel.curves.push_back(
      {"claimed", {3e-7, 3e-3}, {kWithin, kWithin}, Mark::thin_line, 6});
  page.figure({.panels = {panel}, .panel_width = 760, .panel_height = 460},
              "accuracy", "True errors of all cases");
}

std::vector<std::string> make_cost_row(const SceneCases& scene, const Case& one,
                                       const std::string& kind,
                                       const Rival& rival) {
  const Run& fixed = rival.rung.run;
  return {scene.name,
          fmt::format("{:g}", one.tolerance),
          fmt::format("{:.2g}", one.error),
          kind + (rival.is_coarsest ? ", the coarsest" : ""),
          fmt::format("{:.2g}", rival.rung.error),
          fmt::format("{:.2g}", rival.rung.step),
          fmt::format("{} / {}", fixed.steps(), one.run.steps()),
          fmt::format("{} / {}", fixed.statistics.newton_iterations,
                      one.run.statistics.newton_iterations),
          fmt::format("{:.2f}", rival.times_dearer)};
}

void write_cost(Page& page, const std::vector<SceneCases>& scenes) {
  page.heading("Cost");
  std::vector<std::vector<std::string>> rows;
  int cases = 0;
  int cheaper = 0;
  double best = 0.0;
  double worst = INFINITY;
  std::string names;
  for_each_case(scenes, [&](const SceneCases& scene, const Case& one) {
    if (!scene.is_struck) return;
    if (one.by_hand) {
      rows.push_back(make_cost_row(scene, one, "by hand", *one.by_hand));
    }
    if (!one.fixed) return;
    rows.push_back(make_cost_row(scene, one, "uniform", *one.fixed));
    const double times = one.fixed->times_dearer;
    ++cases;
    cheaper += times >= 1.0 ? 1 : 0;
    best = std::max(best, times);
    worst = std::min(worst, times);
    if (times < 1.0) {
      names += fmt::format("{}{} to {:g} m ({:.2f})", names.empty() ? "" : ", ",
                           scene.name, one.tolerance, times);
    }
  });
  page.check(cheaper >= kCheaper * cases,
             fmt::format("where something is struck or caught, a tolerance in "
                         "one pass costs no more than the best uniform steps "
                         "with the same error in 18 of 22 cases: {} of {}.",
                         cheaper, cases));
  page.text(fmt::format(
      "Uniform steps take {:.2f} to {:.2f} times the time.{}", worst, best,
      names.empty() ? "" : " Less than once: " + names + "."));
  page.text(
      "Time is the processor's, medians of interleaved runs; the best fixed "
      "step is found by halving and interpolation, for the same error. *By "
      "hand*: the file's own changes of the step, all scaled alike. *The "
      "coarsest*: even steps as long as an output interval have at most the "
      "error of the run to the tolerance, so that outputs limit fixed steps, "
      "and both meet the tolerance without effort.");
  page.table(
      {"scene", "tolerance [m]", "true error [m]", "fixed steps",
       "their error [m]", "their longest [s]", "steps, fixed / tolerance",
       "iterations, likewise", "times dearer"},
      rows);
}

void explain(Page& page) {
  page.text(
      "Known reasons: the right fixed step is given at no cost here, whereas a "
      "user finds it by trials that cost as much as a run and do not give its "
      "error. The spun beam and the struck finger's bending vibrate alike for "
      "the whole run, so that steps cannot grow, and a step of a run to a "
      "tolerance takes longer: it estimates its error and keeps its start. "
      "The rigid motion of the struck beams is accurate at any step, so that "
      "outputs limit fixed steps, and vibrations of a hundred nanometres are "
      "resolved for a tolerance of 1 um (`trade: impact`).");
}

void draw_cost(Page& page, const std::vector<SceneCases>& scenes) {
  Plot plot{.panels = {}, .columns = 2};
  for (const SceneCases& scene : scenes) {
    if (!scene.is_struck) continue;
    Panel panel{.title = scene.name,
                .x_label = "true error [m]",
                .y_label = "Newton iterations",
                .is_log_x = true,
                .is_log_y = true,
                .curves = {{"to a tolerance", {}, {}, Mark::line_points, 1},
                           {"uniform steps", {}, {}, Mark::line_points, 0}},
                .commands = {}};
    for (const Case& one : scene.cases) {
      panel.curves[0].x.push_back(one.error);
      panel.curves[0].y.push_back(
          static_cast<double>(one.run.statistics.newton_iterations));
    }
    for (const Rung& rung : scene.reference.ladder) {
      if (!(rung.error > 2.0 * scene.reference.uncertainty)) continue;
      if (!std::isfinite(rung.error)) continue;
      panel.curves[1].x.push_back(rung.error);
      panel.curves[1].y.push_back(
          static_cast<double>(rung.run.statistics.newton_iterations));
    }
    if (scene.has_own_changes) {
      Curve by_hand{"by hand", {}, {}, Mark::line_points, 2};
      for (const Case& one : scene.cases) {
        if (!one.by_hand) continue;
        const Rung& rung = one.by_hand->rung;
        by_hand.x.push_back(rung.error);
        by_hand.y.push_back(
            static_cast<double>(rung.run.statistics.newton_iterations));
      }
      panel.curves.push_back(std::move(by_hand));
    }
    plot.panels.push_back(std::move(panel));
  }
  page.figure(plot, "cost", "Cost over true error, all passes counted");
}

void write_page(Page& page) {
  const std::filesystem::path cache =
      std::filesystem::temp_directory_path() /
      fmt::format("limber-tolerance-{}", getpid());
  std::vector<SceneCases> scenes;
  for (const Shipped& shipped : kScenes) {
    fmt::print("{} ...\n", shipped.file);
    std::fflush(stdout);
    scenes.push_back(study(shipped, cache));
  }
  std::filesystem::remove_all(cache);
  introduce(page);
  write_accuracy(page, scenes);
  draw_accuracy(page, scenes);
  write_cost(page, scenes);
  explain(page);
  draw_cost(page, scenes);
  write_references(page, scenes);
  page.write();
  if (!page.trouble().empty()) fmt::print("warning: {}\n", page.trouble());
}

}  // namespace
}  // namespace limber::bench::tolerance

int main(int argc, char** argv) {
  std::string folder = "out/tolerance";
  CLI::App app("Holds steps to a tolerance against fixed steps");
  app.add_option("--out", folder, "Folder for the page and its pictures");
  CLI11_PARSE(app, argc, argv);
  try {
    limber::bench::Page page(folder);
    limber::bench::tolerance::write_page(page);
    fmt::print("{}/README.md: {} claims checked, {} failed\n", folder,
               page.checks(), page.failures());
    return page.failures() == 0 ? 0 : 1;
  } catch (const std::exception& error) {
    fmt::print(stderr, "bench_tolerance: {}\n", error.what());
    return 3;
  }
}
