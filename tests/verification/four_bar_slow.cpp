// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "limber/app/options/reducer.hpp"
#include "limber/app/run/run_scene.hpp"
#include "limber/scene/build/load_scene.hpp"
#include "places.hpp"
#include "unit/results/temporary_folder.hpp"
#include "verification/four_bar_closed_form.hpp"

/// examples/four_bar.toml against the closed form of the rigid linkage and
/// formulas for its rod as a beam.
namespace limber::four_bar_slow {
namespace {

using dynamics::Fidelity;
using test::four_bar::Position;

constexpr double kRate = 20.0;      // of the crank at the start [rad/s]
constexpr double kStiff = 1e9;      // of pins [N/m]
constexpr double kInterval = 1e-4;  // of outputs [s]
using Series = std::vector<double>;

/// The example with pins of `stiffness` [N/m], and N m/rad for every square
/// decimetre, and more outputs.
scene::Scene load(Fidelity level, double stiffness) {
  scene::Scene scene = scene::load_scene(
      LIMBER_SOURCE_DIR "/examples/four_bar.toml", {.fidelity = level});
  const auto stiffen = [&](auto& couplers) {
    for (auto& joint : couplers) {
      joint.coupler.translational_stiffness = stiffness;
      joint.coupler.rotational_stiffness = 1e-2 * stiffness;
    }
  };
  stiffen(scene.robot.joints);
  stiffen(scene.robot.loops);
  for (const std::string end : {"root", "tip"}) {
    scene::PointProbeSpec probe;
    probe.where.link = "rod";
    probe.where.interface = end;
    probe.quantity = scene::Quantity::deformation;
    scene.scenario.probes.push_back({"rod_" + end, probe});
  }
  dynamics::SimulationSettings& settings = scene.scenario.settings;
  settings.output_times.clear();
  for (int i = 0; i * kInterval < settings.end_time; ++i) {
    settings.output_times.push_back(i * kInterval);
  }
  return scene;
}

results::History simulate(const scene::Scene& scene) {
  static const results::test::TemporaryFolder cache;  // reduces once
  runs::Run run = runs::simulate_scene(
      scene, {.reductions = app::make_reductions(cache.path(), {})});
  EXPECT_FALSE(run.failure);
  return std::move(run.history);
}

Series read(const results::History& history, const std::string& name) {
  Series values;
  for (std::size_t c = 0; c < history.columns.size(); ++c) {
    if (history.columns[c].name != name) continue;
    for (const auto& row : history.probe_rows) values.push_back(row[c]);
  }
  EXPECT_EQ(values.size(), history.times.size()) << name;
  return values;
}

double find_largest(const Series& values) {
  double largest = 0.0;
  for (const double value : values) {
    largest = std::max(largest, std::abs(value));
  }
  return largest;
}

Series subtract(const Series& a, const Series& b) {
  Series difference;
  for (std::size_t i = 0; i < a.size(); ++i) {
    difference.push_back(a[i] - b[i]);
  }
  return difference;
}

/// The crank's angle beyond that of the closed form, at every output [rad].
Series find_difference(const results::History& history) {
  return subtract(read(history, "crank.q"),
                  test::four_bar::find_angles(history.times, kRate));
}

TEST(FourBar, RigidTurnsItsCrankAsTheClosedForm) {
  EXPECT_LT(
      find_largest(find_difference(simulate(load(Fidelity::rigid, kStiff)))),
      1e-4);
}

TEST(FourBar, WithARodTenThousandTimesStifferTurnsItsCrankAsTheClosedForm) {
  scene::Scene scene = load(Fidelity::coupled, kStiff);
  for (scene::Link& link : scene.robot.links) {
    if (!link.flexible) continue;
    for (auto& region : link.flexible->materials) {
      region.material.youngs_modulus *= 1e4;
    }
  }
  EXPECT_LT(find_largest(find_difference(simulate(scene))), 1e-4);
}

TEST(FourBar, StiffeningItsPinsConvergesToTheClosedFormAtFirstOrder) {
  Series difference;
  for (const double stiffness : {1e6, 1e7, 1e8}) {
    difference.push_back(find_largest(
        find_difference(simulate(load(Fidelity::rigid, stiffness)))));
  }
  EXPECT_NEAR(std::log10(difference[0] / difference[1]), 1.0, 0.1);
  EXPECT_NEAR(std::log10(difference[1] / difference[2]), 1.0, 0.1);
}

/// Shear and rotary inertia lower the first frequency of a beam between pins
/// by (pi r / L)^2 (1 + E / (5/6 G)) / 2, r the radius of gyration [-].
constexpr double kShear = 0.00069;

/// The shipped rod. It is straight at the start, while its inertia would bend
/// it, so it vibrates about that deflection.
class FourBarsRod : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    const results::History history = simulate(load(Fidelity::coupled, kStiff));
    times_ = history.times;
    angles_ = test::four_bar::find_angles(times_, kRate);
    difference_ = find_difference(history);
    const Series middle = read(history, "rod_middle.dz");
    const Series root = read(history, "rod_root.dz");
    const Series tip = read(history, "rod_tip.dz");
    deflection_.clear();
    formula_.clear();
    for (std::size_t i = 0; i < times_.size(); ++i) {
      deflection_.push_back(middle[i] - 0.5 * (root[i] + tip[i]));
      formula_.push_back(test::four_bar::find_deflection(angles_[i], kRate));
    }
  }

  /// Low-pass at about 50 Hz: weights of a raised cosine over two periods of
  /// the vibration. The ends, a period each, are omitted.
  static Series smooth(const Series& values) {
    constexpr std::size_t kHalf = 108;
    Series smoothed;
    for (std::size_t i = kHalf; i + kHalf < values.size(); ++i) {
      double sum = 0.0;
      double weights = 0.0;
      for (std::size_t j = 0; j <= 2 * kHalf; ++j) {
        const double x = static_cast<double>(j) / kHalf - 1.0;
        const double weight = 1.0 + std::cos(std::numbers::pi * x);
        sum += weight * values[i - kHalf + j];
        weights += weight;
      }
      smoothed.push_back(sum / weights);
    }
    return smoothed;
  }
  static Series find_fast(const Series& values) {
    const Series slow = smooth(values);
    const auto cut =
        static_cast<std::ptrdiff_t>((values.size() - slow.size()) / 2);
    return subtract({values.begin() + cut, values.end() - cut}, slow);
  }

  static inline Series times_;       ///< [s]
  static inline Series angles_;      ///< of the rigid linkage's crank [rad]
  static inline Series difference_;  ///< of the crank from it [rad]
  static inline Series deflection_;  ///< of the rod's middle [m]
  static inline Series formula_;     ///< of that, without ringing [m]
};

// The formula neglects the fraction (Omega / omega)^2 of terms that change at
// Omega: a hundredth at three times the crank's rate. And the rod's loss factor
// of 0.01 makes it softer by that, at rest.
TEST_F(FourBarsRod, BendsOnAverageAsABeamUnderItsOwnInertia) {
  const double off =
      find_largest(subtract(smooth(deflection_), smooth(formula_)));
  EXPECT_LT(off, 0.03 * find_largest(formula_));
}

TEST_F(FourBarsRod, RingsAtTheFrequencyOfABeamBetweenPinsThatTheLinksCarry) {
  const Series ringing = subtract(deflection_, formula_);
  Series zeros;
  for (std::size_t i = 1; i < ringing.size(); ++i) {
    const double a = ringing[i - 1];
    const double b = ringing[i];
    if ((a < 0.0) == (b < 0.0)) continue;
    zeros.push_back(times_[i - 1] + kInterval * a / (a - b));
  }
  double predicted = 0.0;
  int count = 0;
  for (std::size_t i = 0; i < times_.size(); ++i) {
    if (times_[i] < zeros.front() || times_[i] > zeros.back()) continue;
    predicted += test::four_bar::find_frequency(
        test::four_bar::find_position(angles_[i]));
    ++count;
  }
  predicted /= count;
  const double measured = 0.5 * static_cast<double>(zeros.size() - 1) /
                          (zeros.back() - zeros.front());
  EXPECT_NEAR(measured, (1.0 - kShear) * predicted, 0.001 * predicted);
  // What the linkage adds to pins that hold still is above that tolerance.
  EXPECT_GT(measured, 1.01 * test::four_bar::find_pinned_frequency());
}

// d(theta) = -c dw / I. Higher modes shake the crank too, by some percent.
TEST_F(FourBarsRod, ShakesTheCrankByTheMomentumThatItSharesWithIt) {
  Series expected{0.0};
  for (std::size_t i = 1; i < times_.size(); ++i) {
    const Position p =
        test::four_bar::find_position(0.5 * (angles_[i - 1] + angles_[i]));
    const double step = deflection_[i] - deflection_[i - 1];
    expected.push_back(expected.back() -
                       test::four_bar::find_shared_inertia(p) / p.inertia *
                           step);
  }
  const Series fast = find_fast(difference_);
  const Series predicted = find_fast(expected);
  EXPECT_LT(find_largest(subtract(fast, predicted)),
            0.1 * find_largest(predicted));
}

// An estimate: neglects higher modes, and rotations of the crank of the order
// of c w / I that do not accumulate.
TEST_F(FourBarsRod, SlowsTheCrankByTheEnergyOfItsBending) {
  Series lag{0.0};
  for (std::size_t i = 1; i < times_.size(); ++i) {
    const double angle = 0.5 * (angles_[i - 1] + angles_[i]);
    lag.push_back(lag.back() -
                  kInterval * test::four_bar::find_slowing(angle, kRate));
  }
  const Series measured = smooth(difference_);
  EXPECT_LT(find_largest(subtract(measured, smooth(lag))),
            0.2 * find_largest(measured));
}

}  // namespace
}  // namespace limber::four_bar_slow
