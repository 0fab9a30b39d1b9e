// SPDX-License-Identifier: BSD-3-Clause
// What a run does when it gets into trouble.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "limber/common/dense/symmetric_eigen.hpp"
#include "limber/common/errors.hpp"
#include "limber/dynamics/equations/energy.hpp"
#include "limber/dynamics/monitors/energy_growth_observer.hpp"
#include "limber/dynamics/monitors/linear_limit.hpp"
#include "limber/dynamics/simulation/simulation.hpp"
#include "limber/dynamics/stepping/work_budget.hpp"
#include "limber/joints/point_spring.hpp"
#include "support/chain.hpp"
#include "support/point_mass_body.hpp"

namespace limber::dynamics::guard_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using testing::make_point_mass_body;
using testing::PointMassBody;
using testing::share;

struct Scene {
  SystemModel model;
  SystemState state;
};

Scene make_spinning_body(double speed, Fidelity fidelity = Fidelity::coupled) {
  PointMassBody body = make_point_mass_body(24, 4, 4.0, 1.0, 60.0, 42);
  body.reduced.size = {0.3, 0.3, 1.0};
  SystemBuilder builder;
  builder.add_flexible_body("blade", share(body), fidelity, {});
  Scene scene{builder.build(), {}};
  scene.state = make_state(scene.model);
  scene.state.bodies[0].w_WB_B.x() = speed;
  return scene;
}

SimulationSettings make_settings(double end, double step) {
  SimulationSettings settings;
  settings.end_time = end;
  settings.step = step;
  settings.output_times = {0.0, end};
  return settings;
}

std::string run_into_trouble(const Scene& scene,
                             const SimulationSettings& settings) {
  SystemState state = scene.state;
  try {
    simulate(scene.model, state, settings, {});
  } catch (const NumericalError& error) {
    return error.what();
  }
  return "it ended well";
}

// The largest eigenvalue of the centrifugal softening by differences of the
// forces on the modes, without the packed tables that the code under test uses.
double find_critical_speed(const PointMassBody& body, const Vector3& axis) {
  const auto& r = body.reduced;
  const int m = r.mode_count();
  MatrixX B = MatrixX::Zero(m, m);
  const Matrix3 across = Matrix3::Identity() - axis * axis.transpose();
  for (Eigen::Index n = 0; n < body.masses.size(); ++n) {
    const auto phi = r.rows.Phi_B.middleRows<3>(3 * n);
    B += body.masses[n] * phi.transpose() * across * phi;
  }
  const MatrixX Lambda = r.lambda.asDiagonal();
  return 1.0 / std::sqrt(dense::find_eigenpairs(B, Lambda).values.maxCoeff());
}

TEST(Softening, IsOneAtTheCriticalSpeedOfThePointMasses) {
  const PointMassBody body = make_point_mass_body(24, 4, 4.0, 1.0, 60.0, 42);
  const Scene scene = make_spinning_body(0.0);
  for (const Vector3& axis : {Vector3(1.0, 0.0, 0.0), Vector3(0.0, 0.6, 0.8)}) {
    const double critical = find_critical_speed(body, axis);
    EXPECT_NEAR(find_softening(scene.model.bodies[0], critical * axis), 1.0,
                1e-10);
    EXPECT_NEAR(find_softening(scene.model.bodies[0], 2.0 * critical * axis),
                4.0, 1e-9);
  }
}

TEST(Guard, NamesACriticalSpeedThatIsPassed) {
  const PointMassBody body = make_point_mass_body(24, 4, 4.0, 1.0, 60.0, 42);
  const double critical = find_critical_speed(body, Vector3::UnitX());
  Scene scene = make_spinning_body(0.997 * critical);
  SystemState state = scene.state;
  EXPECT_THAT(
      simulate(scene.model, state, make_settings(1e-3, 1e-3), {}).warnings,
      ::testing::Each(::testing::Not(HasSubstr("critical speed"))));
  scene = make_spinning_body(1.003 * critical);
  state = scene.state;
  const auto warnings =
      simulate(scene.model, state, make_settings(1e-3, 1e-3), {}).warnings;
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_THAT(warnings[0], HasSubstr("'blade'"));
  EXPECT_THAT(warnings[0], HasSubstr("critical speed"));
}

TEST(Guard, SaysWhyABodyPastItsCriticalSpeedHasNoAnswer) {
  const std::string text =
      run_into_trouble(make_spinning_body(200.0), make_settings(1.0, 1e-3));
  EXPECT_THAT(text, HasSubstr("body 'blade' at t = "));
  EXPECT_THAT(text, HasSubstr("critical speed"));
  EXPECT_THAT(text, HasSubstr("mode "));
}

TEST(Guard, TellsOnceOfADeformationBeyondATenthOfTheBody) {
  Scene scene = make_spinning_body(0.0);
  const double size = scene.model.bodies[0].reduced->size.maxCoeff();
  const DisplacementMeasure measure(scene.model.bodies[0]);
  scene.state.eta[1] = 0.11 * size / measure.mode_sizes()[1];
  SystemState state = scene.state;
  SimulationSettings settings = make_settings(0.1, 1e-3);
  settings.output_times = {0.0, 0.02, 0.05, 0.1};
  const auto warnings = simulate(scene.model, state, settings, {}).warnings;
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_THAT(warnings[0], HasSubstr("'blade'"));
  EXPECT_THAT(warnings[0], HasSubstr("11 % of its size"));
  scene.state.eta[1] = 0.09 * size / measure.mode_sizes()[1];
  state = scene.state;
  EXPECT_TRUE(simulate(scene.model, state, settings, {}).warnings.empty());
}

TEST(Guard, StopsAtADeformationAsLargeAsTheBody) {
  Scene scene = make_spinning_body(0.0);
  scene.state.eta[0] = 1e3;
  EXPECT_THAT(run_into_trouble(scene, make_settings(0.1, 1e-3)),
              HasSubstr("linear elasticity is not valid there"));
}

// In a period a mode swings to both sides and back to the start: outputs at
// both ends see nothing.
TEST(Guard, LooksAtDeformationsBetweenOutputs) {
  for (const Fidelity fidelity : {Fidelity::coupled, Fidelity::uncoupled}) {
    Scene scene = make_spinning_body(0.0, fidelity);
    const flexbody::ReducedBody& body = *scene.model.bodies[0].reduced;
    const double rate = std::sqrt(body.lambda[1]);
    const double period = 2.0 * std::numbers::pi / rate;
    const double size =
        body.size.maxCoeff() /
        DisplacementMeasure(scene.model.bodies[0]).mode_sizes()[1];
    const SimulationSettings settings = make_settings(period, period / 200.0);
    const auto swing = [&](double fraction) {
      scene.state.etadot[1] = fraction * size * rate;
      SystemState state = scene.state;
      return simulate(scene.model, state, settings, {}).warnings;
    };
    EXPECT_TRUE(swing(0.09).empty());
    const auto warnings = swing(0.12);
    ASSERT_EQ(warnings.size(), 1U);
    EXPECT_THAT(warnings[0], HasSubstr("% of its size"));
    scene.state.etadot[1] = 1.1 * size * rate;
    EXPECT_THAT(run_into_trouble(scene, settings),
                HasSubstr("linear elasticity is not valid there"));
  }
}

// The bounds that save its evaluation leave it out at no speed.
TEST(Guard, FindsTheStepAtWhichASpinBecomesCritical) {
  const PointMassBody body = make_point_mass_body(24, 4, 4.0, 1.0, 60.0, 42);
  const double critical = find_critical_speed(body, Vector3::UnitX());
  Scene scene = make_spinning_body(0.0);
  LinearLimit limit(scene.model);
  std::vector<std::string> warnings;
  for (double fraction = 0.3; fraction < 0.9995; fraction += 1e-3) {
    scene.state.bodies[0].w_WB_B.x() = fraction * critical;
    limit.check(scene.state, warnings);
  }
  EXPECT_TRUE(warnings.empty());
  scene.state.bodies[0].w_WB_B.x() = 1.0001 * critical;
  limit.check(scene.state, warnings);
  EXPECT_EQ(warnings.size(), 1U);
}

TEST(Guard, StopsAnExplicitSchemeThatBlowsUpLongBeforeItOverflows) {
  Scene scene = make_spinning_body(0.0);
  scene.state.eta[3] = 1e-3;
  const double omega = std::sqrt(scene.model.bodies[0].reduced->lambda[3]);
  // Stable up to 2.83 / omega; it would take over a thousand parts.
  SimulationSettings settings = make_settings(1e5 / omega, 4e3 / omega);
  settings.integrator = IntegratorKind::runge_kutta_4;
  EXPECT_THAT(
      run_into_trouble(scene, settings),
      AllOf(HasSubstr("blows up"), HasSubstr("mode 4"), HasSubstr("'blade'"),
            HasSubstr("too long for an explicit scheme")));
  // Stable, but nothing is left of the mode.
  settings = make_settings(10.0, 2.0 / omega);
  settings.integrator = IntegratorKind::runge_kutta_4;
  EXPECT_THAT(run_into_trouble(scene, settings),
              AllOf(HasSubstr("does not balance"), HasSubstr("'blade'")));
  settings.step = 0.1 / omega;
  EXPECT_EQ(run_into_trouble(scene, settings), "it ended well");
}

// Ten damped bodies at rest, metres away from the origin: what their couplers
// store is round-off, and a load that sets in at `from` [s].
Scene make_pushed_chain(double from) {
  testing::Chain chain =
      testing::make_chain({.bodies = 10, .stiffness = 1e5, .damping = 10.0});
  for (BodyState& body : chain.state.bodies) {
    body.p_WB += Vector3(0.1, 0.7, 3.3);
  }
  chain.builder.add_load("push", chain.last_interfaces.back(),
                         Vector3(100.0, 0.0, 0.0), Vector3::Zero(),
                         LoadFrame::world, Constant{.from = from});
  return {chain.builder.build(), chain.state};
}

TEST(Guard, LetsExplicitEulerStartFromRest) {
  constexpr double kStep = 1e-5;
  // The load sets in with the start, and after ten steps.
  for (const double from : {0.0, 10.0 * kStep}) {
    const Scene scene = make_pushed_chain(from);
    const double initial = calc_energy(scene.model, scene.state).total();
    EXPECT_GT(initial, 0.0);
    EXPECT_LT(initial, 1e-15);
    SimulationSettings settings = make_settings(300.0 * kStep, kStep);
    settings.integrator = IntegratorKind::explicit_euler;
    EXPECT_EQ(run_into_trouble(scene, settings), "it ended well");
  }
}

TEST(Guard, StopsExplicitEulerThatBlowsUpFromRest) {
  // At once, and between two looks.
  for (const double step : {1e-2, 1e-3}) {
    SimulationSettings settings = make_settings(1.0, step);
    settings.integrator = IntegratorKind::explicit_euler;
    EXPECT_THAT(run_into_trouble(make_pushed_chain(0.0), settings),
                AllOf(HasSubstr("blows up"),
                      HasSubstr("too long for an explicit scheme")));
  }
}

// A mass on a spring whose line meets its centre: 2 / omega. Where a blow-up
// has turned it, the spring has a lever, and a tenth of that step is stable.
TEST(Guard, TellsTheStableStepOfTheMotionAndNotOfWhatBlewUp) {
  constexpr double kMass = 4.0;
  constexpr double kStiffness = 1e6;
  SystemBuilder builder;
  const BodyIndex mass =
      builder.add_rigid_body("mass", {kMass, 0.01 * Matrix3::Identity()});
  builder.add_coupler(
      "spring",
      joints::PointSpring({.stiffness = kStiffness, .free_length = 1.0}),
      builder.attach_world("ground", {Matrix3::Identity(), {1.5, 0.0, 0.0}}),
      builder.attach_frame("end", mass,
                           {Matrix3::Identity(), {0.5, 0.0, 0.0}}));
  Scene scene{builder.build(), {}};
  scene.state = make_state(scene.model);
  scene.state.bodies[0].p_WB.x() = 1e-5;
  scene.state.bodies[0].w_WB_B = {0.0, 0.2, 0.1};
  const double stable = 2.0 * std::sqrt(kMass / kStiffness);
  SimulationSettings settings = make_settings(100.0 * stable, 10.0 * stable);
  settings.integrator = IntegratorKind::explicit_euler;
  const std::string text = run_into_trouble(scene, settings);
  EXPECT_THAT(text, HasSubstr("blows up"));
  const std::string words = "stable up to about ";
  const std::size_t at = text.find(words);
  ASSERT_NE(at, std::string::npos) << text;
  EXPECT_NEAR(std::stod(text.substr(at + words.size())), stable, 0.01 * stable)
      << text;
}

// Explicit Euler has no stable step without dampers: its own limit does not
// explain this one.
TEST(Guard, BlamesNoSpeedThatOnlyABlowUpReached) {
  testing::Chain chain = testing::make_chain(
      {.bodies = 3, .stiffness = 1e8, .joint = joints::JointKind::revolute});
  Scene scene{chain.builder.build(), chain.state};
  scene.state.bodies[1].w_WB_B.x() = 0.1;
  SimulationSettings settings = make_settings(1.0, 1e-5);
  settings.integrator = IntegratorKind::explicit_euler;
  EXPECT_THAT(run_into_trouble(scene, settings),
              AllOf(HasSubstr("blows up"), ::testing::Not(HasSubstr("speed"))));
}

// A crank of 0.2 m, which the blow-up pulls off its hinge by 0.16 m. A step of
// 1 / omega along that is within the limit of other explicit schemes.
TEST(Guard, BlamesNoJointThatOnlyABlowUpPulledApart) {
  constexpr double kMass = 1.0;
  constexpr double kStiffness = 1e6;
  SystemBuilder builder;
  const BodyIndex crank =
      builder.add_rigid_body("crank", {kMass, 0.01 * Matrix3::Identity()});
  builder.attach_frame("end", crank, {});
  builder.add_coupler(
      "hinge",
      joints::make_joint(
          joints::JointKind::revolute, Vector3::UnitZ(), {},
          {.translational_stiffness = kStiffness, .rotational_stiffness = 1e3}),
      builder.attach_world("ground", {}),
      builder.attach_frame("pin", crank,
                           {Matrix3::Identity(), {-0.2, 0.0, 0.0}}));
  Scene scene{builder.build(), {}};
  scene.state = make_state(scene.model);
  scene.state.bodies[0].p_WB = {0.24, 0.0, 0.0};
  const double step = std::sqrt(kMass / kStiffness);
  SimulationSettings settings = make_settings(100.0 * step, step);
  settings.integrator = IntegratorKind::explicit_euler;
  EXPECT_THAT(
      run_into_trouble(scene, settings),
      AllOf(HasSubstr("blows up"), ::testing::Not(HasSubstr("deflects by"))));
}

TEST(Guard, HalvesAStepThatDoesNotGoThrough) {
  // A chain that turns by 2 rad within a step is too much for four iterations.
  testing::Chain chain = testing::make_chain(
      {.bodies = 3, .modes = 2, .joint = joints::JointKind::revolute});
  Scene scene{chain.builder.build(), chain.state};
  for (BodyState& body : scene.state.bodies) {
    body.w_WB_B.x() = 40.0;
    body.v_WB_W = body.w_WB_B.cross(body.p_WB);
  }
  const auto run = [&](double step) {
    SystemState state = scene.state;
    SimulationSettings settings = make_settings(0.1, step);
    settings.newton_iterations = 4;
    const SimulationStatistics statistics =
        simulate(scene.model, state, settings, {});
    return std::pair{state, statistics};
  };
  const auto [state, statistics] = run(0.05);
  EXPECT_GT(statistics.halved_steps, 0);
  EXPECT_EQ(statistics.steps, 2);
  // The common centre of mass moves on as it did.
  const auto sum = [&](const SystemState& s) {
    Vector3 momentum = Vector3::Zero();
    for (const BodyState& body : s.bodies) momentum += body.v_WB_W;
    return momentum;
  };
  EXPECT_LT((sum(state) - sum(scene.state)).norm(), 1e-9);
}

TEST(Guard, GivesUpHalvingAndSaysSo) {
  Scene scene = make_spinning_body(10.0);
  scene.state.bodies[0].w_WB_B.y() = 1.0;
  SimulationSettings settings = make_settings(0.1, 1e-3);
  settings.newton_iterations = 1;
  settings.newton_tolerance = 1e-15;
  EXPECT_THAT(run_into_trouble(scene, settings),
              AllOf(HasSubstr("'blade'"), HasSubstr("t = "),
                    HasSubstr("halved 10 times")));
}

TEST(Guard, TellsAStartFromWhichNothingMoves) {
  Scene scene = make_spinning_body(std::numeric_limits<double>::quiet_NaN());
  EXPECT_THAT(run_into_trouble(scene, make_settings(0.1, 1e-3)),
              AllOf(HasSubstr("'blade'"), HasSubstr("t = 0 s")));
}

TEST(EnergyGrowthObserver, LooksAwayFromWhatLoadsSupplied) {
  EnergyGrowthObserver observer(1.0, false);
  EXPECT_FALSE(observer.is_blown_up(9.0));
  observer.add(5.0);
  EXPECT_FALSE(observer.is_blown_up(50.0));
  observer.add(-5.0);
  EXPECT_FALSE(observer.is_blown_up(100.0));
}

TEST(EnergyGrowthObserver, SeesGrowthWithoutASourceAtTheSecondLook) {
  EnergyGrowthObserver observer(1.0, false);
  EXPECT_FALSE(observer.is_blown_up(20.0));
  EXPECT_FALSE(observer.is_blown_up(19.0));  // it falls again
  EXPECT_TRUE(observer.is_blown_up(30.0));
}

TEST(EnergyGrowthObserver, SeesWhatIsStillTooMuchAtTheEndThoughItFalls) {
  EnergyGrowthObserver observer(1.0, false);
  EXPECT_FALSE(observer.is_blown_up(200.0));
  EXPECT_FALSE(observer.is_blown_up(199.0));
  EXPECT_TRUE(observer.is_blown_up(198.0, true));
  EnergyGrowthObserver calmed(1.0, false);
  EXPECT_FALSE(calmed.is_blown_up(200.0));
  EXPECT_FALSE(calmed.is_blown_up(2.0, true));
  // A first step from rest, whose work is not yet counted.
  EXPECT_FALSE(EnergyGrowthObserver(0.0, false).is_blown_up(5.0, true));
}

TEST(EnergyGrowthObserver, SeesWhatIsNoNumberAndWhatIsFarOffAtOnce) {
  EXPECT_TRUE(EnergyGrowthObserver(1.0, false).is_blown_up(std::nan("")));
  EXPECT_TRUE(EnergyGrowthObserver(1.0, false).is_blown_up(2000.0));
}

TEST(EnergyGrowthObserver, TakesNoiseForNothing) {
  EnergyGrowthObserver observer(0.0, false);
  EXPECT_FALSE(observer.is_blown_up(1e-15, false, 2e-15));
  EXPECT_FALSE(observer.is_blown_up(1.5e-15, true, 2e-15));
  EXPECT_FALSE(observer.is_blown_up(3e-15, false, 2e-15));
  EXPECT_TRUE(observer.is_blown_up(4e-15, false, 2e-15));
}

TEST(EnergyGrowthObserver, WaitsForASecondLookWhereWorkLags) {
  EnergyGrowthObserver observer(1e-24, true);
  observer.add(0.0);
  EXPECT_FALSE(observer.is_blown_up(1.0));
  EXPECT_TRUE(observer.is_too_much(1.0));
  observer.add(2.0);
  EXPECT_FALSE(observer.is_blown_up(4.0));
  EXPECT_FALSE(observer.is_too_much(4.0));
  EnergyGrowthObserver grows(1e-24, true);
  EXPECT_FALSE(grows.is_blown_up(1.0));
  EXPECT_TRUE(grows.is_blown_up(4.0));
  EXPECT_TRUE(grows.is_blown_up(std::nan("")));
}

TEST(Guard, RunToAToleranceEndsAfterMostSteps) {
  const Scene scene = make_spinning_body(20.0);
  SimulationSettings settings = make_settings(0.1, 0.1);
  settings.tolerance = 1e-9;
  settings.most_steps = 50;
  EXPECT_THAT(run_into_trouble(scene, settings),
              AllOf(HasSubstr("most_steps"), HasSubstr("body 'blade'")));
}

TEST(WorkBudget, GrowsWithStepsAndIsSharedByBodies) {
  const WorkBudget one(1);
  EXPECT_TRUE(one.allows_solves(1'000'000, 0));
  EXPECT_FALSE(one.allows_solves(1'000'001, 0));
  EXPECT_TRUE(one.allows_solves(1'000'300, 1));
  const WorkBudget thousand(999);
  EXPECT_TRUE(thousand.allows_solves(2000, 0));
  EXPECT_FALSE(thousand.allows_solves(2001, 0));
}

}  // namespace
}  // namespace limber::dynamics::guard_test
