// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/analysis/level_advice.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "limber/dynamics/simulation/simulation.hpp"
#include "limber/dynamics/system/system_builder.hpp"
#include "limber/reduction/reduce.hpp"
#include "verification/body_reference.hpp"

/// The advice on the report's beam, against the true errors of the levels: the
/// largest distance of any node from its position at `coupled`, at any time.
namespace limber::level_advice {
namespace {

using dynamics::Fidelity;
using dynamics::SystemState;

constexpr double kNeglected = 1e-6;  // the report's [m]
constexpr double kEnd = 0.2;         // [s]

/// A spin from the start, and a load on the tip that starts at once.
struct Motion {
  std::string name;
  Vector3 w_B = Vector3::Zero();       ///< [rad/s]
  Vector3 force_B = Vector3::Zero();   ///< [N]
  Vector3 moment_B = Vector3::Zero();  ///< [N m]
  double until = 1.0;                  ///< of the load [s]
};

class AdviceOnBeam : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    flexbody::Recipe recipe = test::beam_recipe("beam579_v41.msh");
    recipe.basis.eigenmodes = 10;
    recipe.interfaces = {
        {"tip", flexbody::BoxNodes{{-1.0, -1.0, 4.99}, {2.0, 2.0, 5.01}}}};
    body_ =
        std::make_shared<const flexbody::ReducedBody>(flexbody::reduce(recipe));
  }
  static void TearDownTestSuite() { body_.reset(); }

  static dynamics::SystemModel make_model(const Motion& motion,
                                          Fidelity level) {
    dynamics::SystemBuilder builder;
    const auto beam = builder.add_flexible_body("beam", body_, level, {});
    const flexbody::InterfaceTable& tip = body_->interfaces.front();
    const auto where = builder.attach_interface("tip", beam, tip,
                                                {Matrix3::Identity(), tip.p_B});
    builder.add_load(
        "push", where, motion.force_B, motion.moment_B,
        dynamics::LoadFrame::body,
        dynamics::Pulse{dynamics::PulseShape::rectangular, 0.0, motion.until});
    return builder.build();
  }

  static std::vector<SystemState> run(const dynamics::SystemModel& model,
                                      const Motion& motion) {
    SystemState state = make_state(model);
    state.bodies[0].w_WB_B = motion.w_B;
    dynamics::SimulationSettings settings;
    settings.integrator = dynamics::IntegratorKind::runge_kutta_4;
    settings.end_time = kEnd;
    settings.step = 5e-5;
    // All levels by the same steps: their difference is the neglected physics.
    settings.exact_modes = false;
    for (int i = 0; i <= 1000; ++i) settings.output_times.push_back(2e-4 * i);
    std::vector<SystemState> states;
    simulate(model, state, settings,
             [&](const SystemState& now, const dynamics::EnergyBalance&) {
               states.push_back(now);
             });
    return states;
  }

  static Matrix3X place_nodes(const SystemState& state) {
    Matrix3X points = body_->rows.x_B;
    if (state.eta.size() > 0)
      points += (body_->rows.Phi_B * state.eta).reshaped(3, points.cols());
    return (state.bodies[0].quat_WB.toRotationMatrix() * points).colwise() +
           state.bodies[0].p_WB;
  }

  static double find_distance(const std::vector<SystemState>& a,
                              const std::vector<SystemState>& b) {
    double largest = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) {
      const Matrix3X apart = place_nodes(a[i]) - place_nodes(b[i]);
      largest = std::max(largest, apart.colwise().norm().maxCoeff());
    }
    return largest;
  }

  /// What a level_observer of a run at `level` finds.
  static dynamics::BodyPeaks survey_run(Fidelity level, const Motion& motion) {
    const dynamics::SystemModel source = make_model(motion, level);
    const dynamics::SystemModel model = make_model(motion, Fidelity::uncoupled);
    dynamics::LevelObserver level_observer(model);
    for (const SystemState& state : run(source, motion))
      level_observer.include(source, state);
    return level_observer.find_peaks().front();
  }

  static dynamics::LevelAdvice advise_after(Fidelity level,
                                            const Motion& motion) {
    dynamics::AdviceSettings settings;
    settings.displacement = kNeglected;
    const dynamics::SystemModel model = make_model(motion, Fidelity::uncoupled);
    return dynamics::advise(model.bodies[0], survey_run(level, motion),
                            dynamics::find_limits(settings, *body_));
  }

  static inline std::shared_ptr<const flexbody::ReducedBody> body_;
};

/// Motions on both sides of every boundary.
std::vector<Motion> make_motions() {
  const Vector3 none = Vector3::Zero();
  return {
      {"slow spin", {0.1, 0.0, 0.0}},
      {"across", {0.9, 0.0, 0.0}},
      {"across, near the boundary", {1.4, 0.0, 0.0}},
      {"across, beyond it", {1.8, 0.0, 0.0}},
      {"across, further", {2.2, 0.0, 0.0}},
      {"across, far beyond", {30.0, 0.0, 0.0}},
      {"along", {0.0, 0.0, 12.0}},
      {"oblique", {0.6, 0.5, 0.7}},
      {"tap", none, {2e3, 0.0, 0.0}, none, 0.01},
      {"push", none, {3e4, 0.0, 0.0}},
      {"push along, spinning", {0.3, 0.0, 0.0}, {0.0, 0.0, 3e5}},
      {"push, spinning across", {0.0, 0.3, 0.0}, {3e4, 0.0, 0.0}},
      {"push, spinning along", {0.0, 0.0, 0.3}, {3e4, 0.0, 0.0}},
      {"tap, spinning", {0.0, 0.0, 0.4}, {1e4, 1e4, 0.0}, none, 0.01},
      {"turned faster", none, none, {3e5, 0.0, 0.0}},
  };
}

/// An estimate is no more than this fraction below the truth (the measure of
/// peaks alone is within 1 %), and no more than this factor above it.
constexpr double kBelow = 0.1;
constexpr double kAbove = 5.0;
/// Errors below this fraction of the neglected displacement are ignored.
constexpr double kNoAccount = 1e-3;

void expect_estimate(double estimate, double truth, const std::string& what) {
  if (truth < kNoAccount * kNeglected) return;
  EXPECT_GE(estimate, (1.0 - kBelow) * truth) << what;
  EXPECT_LE(estimate, kAbove * truth) << what;
}

/// The reference here is `coupled`: what is advised beyond it counts as that.
Fidelity lower_to_coupled(Fidelity level) {
  return level == Fidelity::nonlinear ? Fidelity::coupled : level;
}

// Advised from a rigid run, as `limber advise` does, and from runs at other
// levels, as `limber run` does afterwards.
TEST_F(AdviceOnBeam, LeavesOutNoMoreThanTheUserNeglects) {
  std::map<Fidelity, int> advised;
  for (const Motion& motion : make_motions()) {
    const auto coupled = run(make_model(motion, Fidelity::coupled), motion);
    const auto error = [&](Fidelity level) {
      return find_distance(run(make_model(motion, level), motion), coupled);
    };
    for (const Fidelity observed :
         {Fidelity::rigid, Fidelity::uncoupled, Fidelity::coupled}) {
      const dynamics::LevelAdvice advice = advise_after(observed, motion);
      const Fidelity level = lower_to_coupled(advice.level);
      EXPECT_LE(error(level), kNeglected) << motion.name;
      expect_estimate(advice.errors.rigid, error(Fidelity::rigid), motion.name);
      expect_estimate(advice.errors.uncoupled, error(Fidelity::uncoupled),
                      motion.name);
      expect_estimate(advice.errors.one_way, error(Fidelity::one_way),
                      motion.name);
      ++advised[level];
    }
  }
  EXPECT_EQ(advised.size(), 4U);  // every level had its turn
}

TEST_F(AdviceOnBeam, IsCoupledForAFastSpinAndLessForASlowOne) {
  EXPECT_EQ(
      lower_to_coupled(
          advise_after(Fidelity::rigid, {"fast", {30.0, 0.0, 0.0}}).level),
      Fidelity::coupled);
  EXPECT_EQ(advise_after(Fidelity::rigid, {"slow", {0.1, 0.0, 0.0}}).level,
            Fidelity::rigid);
}

// A free bar that turns stretches at each end by rho Omega^2 L^3 / (24 E). Its
// first axial eigenmode alone has 96/pi^4 = 0.986 of that.
TEST_F(AdviceOnBeam, FindsTheStretchOfASpinningBar) {
  constexpr double kOmega = 2.0;    // rad/s
  constexpr double kThick = 0.015;  // what the basis lacks; its sides stretch
  const double stretch =
      8000.0 * kOmega * kOmega * std::pow(5.0, 3) / (24.0 * 200e9);
  const Motion motion{"spin", {kOmega, 0.0, 0.0}};
  const dynamics::BodyPeaks peaks = survey_run(Fidelity::rigid, motion);
  EXPECT_NEAR(peaks.inertial.value / stretch, 1.0, kThick);
  EXPECT_NEAR(peaks.angle, kOmega * kEnd, 1e-9);
  EXPECT_NEAR(peaks.Omega.value, kOmega, 1e-9);
}

// A pull F at one end of a free bar moves that end by F L / (3 E A) from where
// it was in the mean-axis frame; the basis has its static-deformation mode.
TEST_F(AdviceOnBeam, FindsTheStretchOfAPull) {
  constexpr double kForce = 1e5;   // N
  constexpr double kPeak = 0.011;  // PeakDisplacement's 1 %
  const Motion motion{"pull", Vector3::Zero(), {0.0, 0.0, kForce}};
  const double stretch = kForce * 5.0 / (3.0 * 200e9);
  const dynamics::BodyPeaks peaks = survey_run(Fidelity::rigid, motion);
  EXPECT_NEAR(peaks.loads.value / stretch, 1.0, kPeak);
  EXPECT_NEAR(peaks.total.value / (2.0 * stretch), 1.0, kPeak);
}

}  // namespace
}  // namespace limber::level_advice
