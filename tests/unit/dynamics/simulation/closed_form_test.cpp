// SPDX-License-Identifier: BSD-3-Clause
// Simulations of systems whose motion is known in closed form.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <tuple>
#include <vector>

#include "limber/joints/joint_kind.hpp"
#include "support/point_mass_body.hpp"
#include "unit/dynamics/simulation/simulation_outcome.hpp"

namespace limber::dynamics::closed_form_test {
namespace {

using joints::JointKind;
using test::Outcome;
using test::rigid_body;
using test::run;

// Torque-free asymmetric top, I = (1, 2, 3), from (0.01, 1, 0): Jacobi
// elliptic functions give Omega(20), tests/data/closed_forms.md.
TEST(GeneralizedAlpha, AsymmetricTopConvergesAtSecondOrderToTheClosedForm) {
  const SystemModel model = rigid_body(Vector3(1, 2, 3).asDiagonal());
  const Vector3 expected(0.010964161, -0.999989894, -0.002595690);
  std::vector<double> errors;
  for (const double h : {0.02, 0.01, 0.005}) {
    SystemState state = make_state(model);
    state.bodies[0].w_WB_B = Vector3(0.01, 1.0, 0.0);
    const Outcome r = run(model, state,
                          {.end_time = 20.0,
                           .step = h,
                           .output_times = {},
                           .rho_inf = 1.0,
                           .newton_tolerance = 1e-14});
    errors.push_back((r.state.bodies[0].w_WB_B - expected).norm());
  }
  EXPECT_NEAR(std::log2(errors[0] / errors[1]), 2.0, 0.1);
  EXPECT_NEAR(std::log2(errors[1] / errors[2]), 2.0, 0.1);
  EXPECT_LT(errors[2], 1e-4);
}

TEST(RungeKutta4, AsymmetricTopMeetsTheClosedForm) {
  const SystemModel model = rigid_body(Vector3(1, 2, 3).asDiagonal());
  SystemState state = make_state(model);
  state.bodies[0].w_WB_B = Vector3(0.01, 1.0, 0.0);
  const Outcome r = run(model, state,
                        {.integrator = IntegratorKind::runge_kutta_4,
                         .end_time = 20.0,
                         .step = 0.005,
                         .output_times = {}});
  const Vector3 expected(0.010964161, -0.999989894, -0.002595690);
  EXPECT_LT((r.state.bodies[0].w_WB_B - expected).norm(), 2e-9);
}

// Pendulum L = 1 m released horizontally, g = 9.81: period 2.367841948 s
// (4 sqrt(L/g) K(sin 45 deg)). A point mass on a stiff hinge: a small ball, its
// own inertia made negligible, corrected by the compound pendulum's length.
TEST(Simulation, PendulumOnAStiffHingeHasTheClosedFormPeriod) {
  const double own = 1e-4;  // inertia of the ball [kg m^2]
  SystemBuilder builder;
  const auto ball =
      builder.add_rigid_body("ball", {1.0, own * Matrix3::Identity()});
  const auto pivot = builder.attach_world("pivot", {});
  const auto arm =
      builder.attach_frame("arm", ball, {Matrix3::Identity(), {-1.0, 0, 0}});
  builder.add_coupler(
      "hinge",
      joints::make_joint_bushing(
          JointKind::revolute, Vector3::UnitY(),
          {.translational_stiffness = 1e10, .rotational_stiffness = 1e10}),
      pivot, arm);
  builder.set_gravity({0, 0, -9.81});
  const SystemModel model = builder.build();
  SystemState state = make_state(model);
  state.bodies[0].p_WB = Vector3(1, 0, 0);
  // After one period of the compound pendulum (length 1 + own / (m L)) the
  // ball is back: the peak of its height gives the period.
  const double period = 2.367841948 * std::sqrt(1.0 + own);
  const Outcome r =
      run(model, state, {.end_time = period, .step = 1e-3, .output_times = {}});
  // Near the turning point x = 1 - (g (t - T))^2 / 2...: z = -g (t-T)^2 / 2.
  EXPECT_NEAR(r.state.bodies[0].p_WB.x(), 1.0, 1e-6);
  EXPECT_NEAR(r.state.bodies[0].v_WB_W.z(), 0.0, 9.81 * 2e-5);
}

TEST(Simulation, FreeFallIsExact) {
  const testing::PointMassBody body =
      testing::make_point_mass_body(20, 3, 4.0, 1.0, 50.0, 1);
  SystemBuilder builder;
  builder.add_flexible_body("b", testing::share(body), Fidelity::coupled, {});
  builder.set_gravity({0.0, 0.0, -9.81});
  const SystemModel model = builder.build();
  const Outcome r =
      run(model, make_state(model),
          {.end_time = 1.0, .step = 0.01, .output_times = {0.0, 1.0}});
  EXPECT_NEAR(r.state.bodies[0].p_WB.z(), -0.5 * 9.81, 1e-12);
  EXPECT_EQ(r.state.eta.norm(), 0.0);
  EXPECT_NEAR(r.energies.back().work, 0.5 * 4.0 * 9.81 * 9.81, 1e-10);
}

class PulseImpulse
    : public ::testing::TestWithParam<std::tuple<double, IntegratorKind>> {};

TEST_P(PulseImpulse, IsThePulsesAreaWhateverTheStep) {
  const auto [step, integrator] = GetParam();
  const testing::PointMassBody body =
      testing::make_point_mass_body(20, 3, 4.0, 1.0, 50.0, 1);
  for (const double start : {0.0, 0.1, 0.00137}) {
    SystemBuilder builder;
    const auto b = builder.add_flexible_body("b", testing::share(body),
                                             Fidelity::coupled, {});
    const auto interface = testing::make_interface(body, 0, 6);
    const auto tip = builder.attach_interface(
        "tip", b, interface, {Matrix3::Identity(), interface.p_B});
    builder.add_load("hit", tip, {100, 0, 10}, Vector3::Zero(),
                     LoadFrame::world,
                     Pulse{PulseShape::rectangular, start, 0.01});
    const SystemModel model = builder.build();
    const Outcome r = run(model, make_state(model),
                          {.integrator = integrator,
                           .end_time = 0.15,
                           .step = step,
                           .output_times = {0.15}});
    // Steps land on both edges, and the rules are exact for constant forces.
    const Vector3 impulse = 0.01 * Vector3(100, 0, 10);
    EXPECT_LT((r.energies.back().linear_momentum - impulse).norm(),
              1e-9 * impulse.norm())
        << "start " << start;
  }
}

INSTANTIATE_TEST_SUITE_P(
    Steps, PulseImpulse,
    ::testing::Combine(::testing::Values(1e-3, 3.1e-3, 0.5e-3, 0.7e-4),
                       ::testing::Values(IntegratorKind::generalized_alpha,
                                         IntegratorKind::runge_kutta_4,
                                         IntegratorKind::energy_conserving,
                                         IntegratorKind::splitting)));

// One mode of a clamped body under a step load: eta = F/w^2 (1 - cos w t).
TEST(Simulation, ClampedModeUnderAStepLoadConvergesToTheClosedForm) {
  testing::PointMassBody body =
      testing::make_point_mass_body(20, 1, 4.0, 1.0, 50.0, 1);
  body.reduced.clamped = true;
  const auto interface = testing::make_interface(body, 0, 6);
  const Vector3 force(3.0, -2.0, 5.0);
  const double F = interface.Phi_B.col(0).dot(force);
  std::vector<double> errors;
  for (const double h : {2e-3, 1e-3, 5e-4}) {
    SystemBuilder builder;
    const auto b = builder.add_flexible_body("b", testing::share(body),
                                             Fidelity::coupled, {});
    const auto tip = builder.attach_interface(
        "tip", b, interface, {Matrix3::Identity(), interface.p_B});
    builder.add_load("step", tip, force, Vector3::Zero(), LoadFrame::body,
                     Constant{});
    const SystemModel model = builder.build();
    const Outcome r = run(model, make_state(model),
                          {.end_time = 0.3, .step = h, .output_times = {}});
    const double exact = F / 2500.0 * (1.0 - std::cos(50.0 * 0.3));
    errors.push_back(std::abs(r.state.eta[0] - exact));
    EXPECT_EQ(r.state.bodies[0].p_WB.norm(), 0.0);
  }
  EXPECT_NEAR(std::log2(errors[0] / errors[1]), 2.0, 0.15);
  EXPECT_NEAR(std::log2(errors[1] / errors[2]), 2.0, 0.15);
  EXPECT_LT(errors[2], 5e-3 * std::abs(F) / 2500.0);
}

TEST(Simulation, DampedModeLosesEnergyAtTheClosedFormRate) {
  testing::PointMassBody body =
      testing::make_point_mass_body(20, 1, 4.0, 1.0, 50.0, 1);
  body.reduced.clamped = true;
  SystemBuilder builder;
  builder.add_flexible_body("b", testing::share(body), Fidelity::coupled,
                            {.ratios = {0.02}});
  const SystemModel model = builder.build();
  SystemState state = make_state(model);
  state.etadot[0] = 1.0;
  const double wd = 50.0 * std::sqrt(1.0 - 0.02 * 0.02);
  const double t = 10.0 * 2.0 * std::numbers::pi / wd;  // ten damped periods
  const Outcome r = run(model, state,
                        {.end_time = t,
                         .step = t / 4000.0,
                         .output_times = {0.0, t},
                         .rho_inf = 1.0});
  EXPECT_NEAR(r.state.etadot[0], std::exp(-0.02 * 50.0 * t), 1e-4);
  const double rule = std::pow(2.0 * wd * t / 4000.0, 2) / 12.0;
  EXPECT_NEAR(r.energies.back().dissipated, 0.5 - r.energies.back().total(),
              0.5 * rule);  // of the trapezoidal rule
}

}  // namespace
}  // namespace limber::dynamics::closed_form_test
