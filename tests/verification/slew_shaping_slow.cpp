// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>

#include "limber/app/options/reducer.hpp"
#include "limber/app/run/run_scene.hpp"
#include "limber/dynamics/analysis/natural_frequencies.hpp"
#include "limber/scene/build/build_system.hpp"
#include "limber/scene/build/load_scene.hpp"
#include "places.hpp"
#include "unit/results/temporary_folder.hpp"

/// examples/slew.toml: the hub is driven through half a turn by a trapezoidal
/// rate, as it is and shaped at the first natural frequency; and
/// examples/damped_slew.toml, the same with feedback.
namespace limber::slew_shaping_slow {
namespace {

using joints::ShaperKind;

constexpr double kDampingRatio = 0.002;  // of the beam in models/slew_arm.urdf

class Slew : public ::testing::Test {
 protected:
  /// Of the arm at rest, held by its drive [Hz].
  static double find_first_frequency() {
    const scene::BuiltScene built =
        scene::build_system(load(), app::make_reducer({}), cache());
    return dynamics::find_natural_modes(built.model, built.initial)
        .modes.at(0)
        .frequency();
  }

  /// How far the tip swings after the last command, across where the arm has
  /// arrived, peak to peak [m]; shaped for `frequency` [Hz].
  static double find_residual(std::optional<ShaperKind> kind = {},
                              double frequency = 0.0) {
    scene::Scene scene = load();
    joints::Signal& signal = scene.scenario.drives.at(0).drive.signal;
    if (kind) {
      signal.shaper = joints::make_shaper(*kind, frequency, kDampingRatio);
    }
    return find_swing(scene, "tip_path.y", kArrived);
  }

  /// How far a column moves from a time on, peak to peak.
  static double find_swing(const scene::Scene& scene, const std::string& name,
                           double from) {
    const runs::Run run = runs::simulate_scene(
        scene, {.reductions = app::make_reductions(cache(), {})});
    EXPECT_FALSE(run.failure);
    const auto& columns = run.history.columns;
    const auto column =
        std::find_if(columns.begin(), columns.end(),
                     [&](const auto& c) { return c.name == name; }) -
        columns.begin();
    double lowest = INFINITY;
    double highest = -INFINITY;
    for (std::size_t i = 0; i < run.history.times.size(); ++i) {
      if (run.history.times[i] < from) continue;
      const double y =
          run.history.probe_rows[i].at(static_cast<std::size_t>(column));
      lowest = std::min(lowest, y);
      highest = std::max(highest, y);
    }
    return highest - lowest;
  }

  /// The ramp ends at 0.7 s, a zvd shaper a period of 0.125 s later; at a
  /// frequency 10 % too low, 0.139 s [s].
  static constexpr double kArrived = 0.85;

  static scene::Scene load(const char* name = "slew.toml") {
    return scene::load_scene(
        std::filesystem::path(LIMBER_SOURCE_DIR "/examples") / name);
  }

 private:
  static const std::filesystem::path& cache() {
    static const results::test::TemporaryFolder folder;  // reduces once
    return folder.path();
  }
};

TEST_F(Slew, ShapedAtTheComputedFrequencyLeavesLessThanATenthOfTheVibration) {
  const double frequency = find_first_frequency();
  const double plain = find_residual();
  EXPECT_GT(plain, 1e-2);
  for (const ShaperKind kind : {ShaperKind::zv, ShaperKind::zvd}) {
    EXPECT_LT(find_residual(kind, frequency), 0.1 * plain);
  }
}

// The formulas are for one undamped mode; what the others leave of the plain
// ramp's vibration is what zv leaves at the right frequency, 0.0018.
TEST_F(Slew, ShapedForAFrequencyTenPercentWrongLeavesWhatTheFormulasSay) {
  const double frequency = find_first_frequency();
  const double plain = find_residual();
  for (const double ratio : {0.9, 1.1}) {
    const double left = std::abs(std::cos(0.5 * std::numbers::pi * ratio));
    const auto fraction = [&](ShaperKind kind) {
      return find_residual(kind, frequency / ratio) / plain;
    };
    EXPECT_NEAR(fraction(ShaperKind::zv), left, 0.003);
    EXPECT_NEAR(fraction(ShaperKind::zvd), left * left, 0.003);
  }
}

TEST_F(Slew, WithFeedbackLeavesLessThanATenthOfTheVibration) {
  scene::Scene scene = load("damped_slew.toml");
  const double damped = find_swing(scene, "tip.dy", 1.6);
  scene.scenario.drives.at(1).drive.signal.base = joints::ConstantSignal{0.0};
  const double plain = find_swing(scene, "tip.dy", 1.6);
  EXPECT_GT(plain, 5e-3);
  EXPECT_LT(damped, 0.1 * plain);
}

}  // namespace
}  // namespace limber::slew_shaping_slow
