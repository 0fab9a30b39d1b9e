// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <numbers>
#include <optional>

#include "limber/app/options/reducer.hpp"
#include "limber/app/run/run_scene.hpp"
#include "limber/common/errors.hpp"
#include "limber/dynamics/analysis/natural_frequencies.hpp"
#include "limber/scene/build/build_system.hpp"
#include "limber/scene/build/load_scene.hpp"
#include "page.hpp"

/// Slews the arm of examples/slew.toml by a trapezoidal rate, as it is and
/// shaped at the first natural frequency, and draws the vibration that is left.
namespace limber::bench {
namespace {

using joints::ShaperKind;

constexpr double kDampingRatio = 0.002;  // of the beam in models/slew_arm.urdf
// No command moves after it: the ramp ends at 0.7 s, and a zvd shaper for the
// lowest frequency tried here takes 0.163 s more [s].
constexpr double kArrived = 0.87;
const std::vector<double> kRatios = {0.8, 0.85, 0.9, 0.95, 1.0, 1.05,
                                     1.1, 1.15, 1.2, 1.25, 1.3};

/// A run and its plotted data; an entry an output time.
struct Slew {
  std::vector<double> times;      ///< [s]
  std::vector<double> command;    ///< [deg]
  std::vector<double> deviation;  ///< of the tip, across the command [mm]
  double residual = 0.0;          ///< peak to peak after kArrived [mm]
  double largest = 0.0;           ///< deviation [mm]
  double moment = 0.0;            ///< largest of the motor [N m]
  double arrival = 0.0;           ///< of the command [s]
};

class Study {
 public:
  Study()
      : scene_(scene::load_scene(LIMBER_SOURCE_DIR "/examples/slew.toml")),
        cache_(std::filesystem::temp_directory_path() /
               fmt::format("limber-slew-{}", getpid())) {
    const scene::BuiltScene built =
        scene::build_system(scene_, app::make_reducer({}), cache_);
    frequency_ =
        dynamics::find_natural_frequencies(built.model, built.initial)[0];
  }
  ~Study() {
    std::error_code ignored;
    std::filesystem::remove_all(cache_, ignored);
  }
  Study(const Study&) = delete;
  Study& operator=(const Study&) = delete;

  /// First natural frequency of the arm held by its drive [Hz].
  [[nodiscard]] double frequency() const { return frequency_; }

  /// @param ratio of the arm's frequency to that of the shaper [-]
  [[nodiscard]] Slew simulate(std::optional<ShaperKind> kind = {},
                              double ratio = 1.0) const {
    scene::Scene scene = scene_;
    joints::Signal& signal = scene.scenario.drives.at(0).drive.signal;
    if (kind) {
      signal.shaper =
          joints::make_shaper(*kind, frequency_ / ratio, kDampingRatio);
    }
    const runs::Run run = runs::simulate_scene(
        scene, {.reductions = app::make_reductions(cache_, {})});
    if (run.failure) std::rethrow_exception(run.failure);
    return measure(run.history, signal);
  }

 private:
  static std::size_t find_column(const results::History& history,
                                 const std::string& name) {
    const auto& columns = history.columns;
    const auto found =
        std::find_if(columns.begin(), columns.end(),
                     [&](const auto& column) { return column.name == name; });
    if (found == columns.end()) throw InputError("no probe '" + name + "'");
    return static_cast<std::size_t>(found - columns.begin());
  }

  static Slew measure(const results::History& history,
                      const joints::Signal& signal) {
    const std::size_t x = find_column(history, "tip_path.x");
    const std::size_t y = find_column(history, "tip_path.y");
    const std::size_t effort = find_column(history, "motor.effort");
    Slew slew;
    slew.times = history.times;
    slew.arrival = joints::break_times(signal).back();
    double lowest = INFINITY;
    double highest = -INFINITY;
    for (std::size_t i = 0; i < history.times.size(); ++i) {
      const std::vector<double>& row = history.probe_rows[i];
      const double angle = joints::evaluate(signal, {history.times[i]}).value;
      const double across =
          1e3 * (row[y] * std::cos(angle) - row[x] * std::sin(angle));
      slew.command.push_back(angle * 180.0 / std::numbers::pi);
      slew.deviation.push_back(across);
      slew.largest = std::max(slew.largest, std::abs(across));
      slew.moment = std::max(slew.moment, std::abs(row[effort]));
      if (history.times[i] < kArrived) continue;
      lowest = std::min(lowest, across);
      highest = std::max(highest, across);
    }
    slew.residual = highest - lowest;
    return slew;
  }

  scene::Scene scene_;
  std::filesystem::path cache_;
  double frequency_ = 0.0;
};

/// Residual vibration over frequency, relative to the plain ramp's.
struct Robustness {
  std::vector<double> zv;
  std::vector<double> zvd;
};

double find_left(double ratio) {
  return std::abs(std::cos(0.5 * std::numbers::pi * ratio));
}

Robustness find_robustness(const Study& study, const Slew& plain) {
  Robustness left;
  for (const double ratio : kRatios) {
    left.zv.push_back(study.simulate(ShaperKind::zv, ratio).residual /
                      plain.residual);
    left.zvd.push_back(study.simulate(ShaperKind::zvd, ratio).residual /
                       plain.residual);
  }
  return left;
}

Panel draw_command(const std::vector<const Slew*>& slews,
                   const std::vector<std::string>& names) {
  Panel panel{
      .title = "Commanded angle",
      .x_label = "time [s]",
      .y_label = "angle [deg]",
      .curves = {},
      .commands = {"set xrange [0:1]", "set yrange [0:190]", "set ytics 45"}};
  for (std::size_t i = 0; i < slews.size(); ++i) {
    panel.curves.push_back({names[i], slews[i]->times, slews[i]->command});
  }
  return panel;
}

Panel draw_deviation(const std::vector<const Slew*>& slews,
                     const std::vector<std::string>& names) {
  Panel panel{.title = "Tip, across the commanded direction",
              .x_label = "time [s]",
              .y_label = "deviation [mm]",
              .curves = {},
              .commands = {}};
  for (std::size_t i = 0; i < slews.size(); ++i) {
    panel.curves.push_back({names[i], slews[i]->times, slews[i]->deviation});
  }
  return panel;
}

Panel draw_residual(const std::vector<const Slew*>& slews,
                    const std::vector<std::string>& names) {
  Panel panel{.title = "The shaped ones after arrival, magnified",
              .x_label = "time [s]",
              .y_label = "deviation [mm]",
              .curves = {},
              .commands = {fmt::format("set xrange [{}:1.6]", kArrived),
                           "set yrange [-0.2:0.2]"}};
  for (std::size_t i = 1; i < slews.size(); ++i) {
    panel.curves.push_back({names[i], slews[i]->times, slews[i]->deviation,
                            Mark::line, static_cast<int>(i)});
  }
  return panel;
}

Panel draw_robustness(const Robustness& left) {
  std::vector<double> ratios;
  std::vector<double> zv;
  std::vector<double> zvd;
  for (int i = 0; i <= 100; ++i) {
    ratios.push_back(0.8 + 0.005 * i);
    zv.push_back(find_left(ratios.back()));
    zvd.push_back(zv.back() * zv.back());
  }
  return {.title = "Left at a wrong frequency, of the trapezoid's",
          .x_label = "frequency of the arm / of the shaper",
          .y_label = "residual / trapezoid's",
          .curves = {{"|cos(πr/2)|", ratios, zv, Mark::line, 1},
                     {"cos²(πr/2)", ratios, zvd, Mark::line, 2},
                     {"zv", kRatios, left.zv, Mark::points, 1},
                     {"zvd", kRatios, left.zvd, Mark::points, 2}},
          .commands = {"set yrange [0:0.5]"}};
}

std::vector<std::string> make_row(const std::string& name, const Slew& slew,
                                  const Slew& plain) {
  return {name,
          fmt::format("{:.3f}", slew.arrival),
          fmt::format("{:.0f}", slew.largest),
          fmt::format("{:.0f}", slew.moment),
          fmt::format("{:.3g}", slew.residual),
          fmt::format("{:.0f}", plain.residual / slew.residual)};
}

double find_worst(const std::vector<double>& left, int power) {
  double worst = 0.0;
  for (std::size_t i = 0; i < left.size(); ++i) {
    worst = std::max(
        worst, std::abs(left[i] - std::pow(find_left(kRatios[i]), power)));
  }
  return worst;
}

void write_page(Page& page) {
  const Study study;
  const Slew plain = study.simulate();
  const Slew zv = study.simulate(ShaperKind::zv);
  const Slew zvd = study.simulate(ShaperKind::zvd);
  const Robustness left = find_robustness(study, plain);
  page.text("# A slew, and its residual vibration");
  page.text(fmt::format(
      "Written by `bench_slew`, including all text; do not edit. A motor turns "
      "a flexible arm of 1 m by half a turn in 0.6 s "
      "([scenario](../../../examples/slew.toml)). The command's rate is a "
      "trapezoid, or the same shaped (`shaper` of a `[[drive]]`) at the first "
      "natural frequency of the arm held by its motor, {:.3f} Hz, which "
      "`limber frequencies` finds, with the beam's damping ratio of {}. The "
      "deviation is that of the tip across the commanded direction; the "
      "residual vibration is measured peak to peak from {} s on, when all "
      "commands are constant.",
      study.frequency(), kDampingRatio, kArrived));
  page.table({"command", "arrives [s]", "largest deviation [mm]",
              "largest moment [N m]", "left [mm]", "times less"},
             {make_row("trapezoid", plain, plain), make_row("`zv`", zv, plain),
              make_row("`zvd`", zvd, plain)});
  page.check(10.0 * std::max(zv.residual, zvd.residual) <= plain.residual,
             "both shapers leave less than a tenth of the vibration.");
  const double worst =
      std::max(find_worst(left.zv, 1), find_worst(left.zvd, 2));
  page.check(worst < 0.02,
             fmt::format("at 0.8 to 1.3 times the frequency they leave what "
                         "[their formulas](../../../docs/reference/joints.md#"
                         "drives-and-limits) say, to {:.1g} of the "
                         "trapezoid's.",
                         worst));
  page.figure(
      {.panels = {draw_command({&plain, &zv, &zvd}, {"trapezoid", "zv", "zvd"}),
                  draw_deviation({&plain, &zv, &zvd},
                                 {"trapezoid", "zv", "zvd"}),
                  draw_residual({&plain, &zv, &zvd},
                                {"trapezoid", "zv", "zvd"}),
                  draw_robustness(left)},
       .columns = 2},
      "slew", "Command, deviation and residual vibration");
  page.text(
      "[With feedback of the strain](feedback.md) the vibration is damped, "
      "too, "
      "whatever caused it.");
  page.write();
  if (!page.trouble().empty()) fmt::print("warning: {}\n", page.trouble());
}

}  // namespace
}  // namespace limber::bench

int main(int argc, char** argv) {
  std::string folder = "out/slew_study";
  CLI::App app("Slews an arm with and without input shaping");
  app.add_option("--out", folder, "Folder for the page and its picture");
  CLI11_PARSE(app, argc, argv);
  try {
    limber::bench::Page page(folder);
    limber::bench::write_page(page);
    fmt::print("{}/README.md: {} claims checked, {} failed\n", folder,
               page.checks(), page.failures());
    return page.failures() == 0 ? 0 : 1;
  } catch (const std::exception& error) {
    fmt::print(stderr, "bench_slew: {}\n", error.what());
    return 3;
  }
}
