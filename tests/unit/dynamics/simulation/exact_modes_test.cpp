// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/simulation/exact_modes.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "limber/common/errors.hpp"
#include "limber/dynamics/simulation/modal_loads.hpp"
#include "limber/dynamics/simulation/simulation.hpp"
#include "support/chain.hpp"
#include "support/point_mass_body.hpp"

namespace limber::dynamics::exact_modes_test {
namespace {

using testing::make_interface;
using testing::make_point_mass_body;
using testing::PointMassBody;
using testing::share;

constexpr double kLowest = 50.0;  // first modal frequency [rad/s]

PointMassBody make_body(int modes, bool clamped) {
  PointMassBody body = make_point_mass_body(20, modes, 4.0, 1.0, kLowest, 1);
  body.reduced.clamped = clamped;
  return body;
}

/// One body with loads on an interface.
struct Scene {
  explicit Scene(const PointMassBody& points,
                 Fidelity fidelity = Fidelity::uncoupled,
                 const ModalDamping& damping = {})
      : table(make_interface(points, 0, 6)) {
    body = builder.add_flexible_body("b", share(points), fidelity, damping);
    tip = builder.attach_interface("tip", body, table,
                                   {Matrix3::Identity(), table.p_B});
  }
  void push(const TimeFunction& function, LoadFrame frame = LoadFrame::body) {
    builder.add_load(fmt::format("load {}", ++loads), tip, force, moment, frame,
                     function);
  }
  [[nodiscard]] VectorX modal_force() const {
    return table.Phi_B.transpose() * force + table.Psi_B.transpose() * moment;
  }

  flexbody::InterfaceTable table;
  SystemBuilder builder;
  int loads = 0;
  BodyIndex body;
  AttachmentIndex tip;
  Vector3 force{30.0, -20.0, 50.0};
  Vector3 moment{2.0, 7.0, -3.0};
};

struct Outcome {
  SystemState state;
  std::vector<SystemState> states;
  std::vector<EnergyBalance> energies;
  SimulationStatistics statistics;
};

Outcome run(const SystemModel& model, const SystemState& start,
            const SimulationSettings& settings) {
  Outcome r;
  r.state = start;
  r.statistics = simulate(model, r.state, settings,
                          [&](const SystemState& s, const EnergyBalance& e) {
                            r.states.push_back(s);
                            r.energies.push_back(e);
                          });
  return r;
}

double audit(const EnergyBalance& e) {
  return e.total() + e.dissipated - e.work;
}

TEST(ExactModes, ClampedBodyUnderAStepLoadHasTheClosedFormWithoutSteps) {
  Scene scene(make_body(3, true));
  scene.push(Constant{});
  const SystemModel model = scene.builder.build();
  const Outcome r = run(
      model, make_state(model),
      {.end_time = 1000.0, .step = 1.0, .output_times = {0.0, 0.3, 1000.0}});
  EXPECT_EQ(r.statistics.steps, 0);
  EXPECT_EQ(r.statistics.exact_modes, 3);
  const VectorX F = scene.modal_force();
  for (const SystemState& s : r.states) {
    for (int k = 0; k < 3; ++k) {
      const double omega = kLowest * (1.0 + 0.5 * k);
      const double scale = std::abs(F[k]) / (omega * omega);
      EXPECT_NEAR(s.eta[k],
                  F[k] / (omega * omega) * (1.0 - std::cos(omega * s.t)),
                  scale * 1e-15 * (10.0 + omega * s.t));
    }
  }
  EXPECT_EQ(r.state.t, 1000.0);
  EXPECT_EQ(r.state.eta, r.states.back().eta);
}

// The modes are evaluated for some of the outputs at a time.
TEST(ExactModes, AtManyOutputsHaveTheClosedFormAndKeepEnergy) {
  Scene scene(make_body(2, true));
  scene.push(Constant{});
  const SystemModel model = scene.builder.build();
  std::vector<double> times;
  for (int i = 0; i < 10000; ++i) times.push_back(1e-3 * i);
  const Outcome r =
      run(model, make_state(model),
          {.end_time = times.back(), .step = 1.0, .output_times = times});
  ASSERT_EQ(r.states.size(), times.size());
  const VectorX F = scene.modal_force();
  double most = 0.0;
  for (std::size_t i = 0; i < times.size(); ++i) {
    ASSERT_EQ(r.states[i].t, times[i]);
    for (int k = 0; k < 2; ++k) {
      const double omega = kLowest * (1.0 + 0.5 * k);
      const double scale = std::abs(F[k]) / (omega * omega);
      ASSERT_NEAR(r.states[i].eta[k],
                  F[k] / (omega * omega) * (1.0 - std::cos(omega * times[i])),
                  scale * 1e-15 * (10.0 + omega * times[i]));
    }
    most = std::max(most, r.energies[i].total());
    ASSERT_NEAR(audit(r.energies[i]), 0.0, 1e-12 * most) << i;
  }
  EXPECT_GT(most, 0.0);
}

// A slow stranger with 1e10 times the energy hid the oscillation of a body.
TEST(ExactModes, AreLookedAtInThePeriodsOfEachBodyThatMoves) {
  constexpr double kTurn = 2.0 * std::numbers::pi;
  Scene scene(make_body(1, true));
  PointMassBody slow = make_point_mass_body(20, 1, 4.0, 1.0, 1e-3 * kLowest, 1);
  slow.reduced.clamped = true;
  scene.builder.add_flexible_body("stranger", share(slow), Fidelity::uncoupled,
                                  {});
  const SystemModel model = scene.builder.build();
  SystemState state = make_state(model);
  state.eta << 1e-3, 1e5;
  const ExactModes exact(model, state);
  EXPECT_NEAR(exact.find_longest_look(1.0), kTurn / kLowest / 10.0, 1e-9);
}

TEST(ExactModes, GravityOnAClampedBodyMakesItSwingAboutItsSag) {
  const PointMassBody points = make_body(2, true);
  Scene scene(points);
  scene.builder.set_gravity({1.0, -3.0, -9.81});
  const SystemModel model = scene.builder.build();
  SystemState start = make_state(model);
  start.bodies[0].quat_WB =
      Quaternion(Eigen::AngleAxisd(0.7, Vector3(1.0, 2.0, 3.0).normalized()));
  const Outcome r =
      run(model, start, {.end_time = 0.2, .step = 1.0, .output_times = {0.2}});
  const VectorX F =
      points.reduced.integrals.P.transpose() *
      (start.bodies[0].quat_WB.conjugate() * Vector3(1.0, -3.0, -9.81));
  ASSERT_GT(std::abs(F[0]), 0.0);
  EXPECT_NEAR(r.state.eta[0], F[0] / 2500.0 * (1.0 - std::cos(kLowest * 0.2)),
              1e-13 * std::abs(F[0]) / 2500.0);
}

// Compared with fine Runge-Kutta steps of the same equations.
TEST(ExactModes, SpinningFreeBodyUnderEveryClosedLoadIsTheLimitOfSmallSteps) {
  Scene scene(make_body(4, false), Fidelity::uncoupled,
              {.rayleigh_mass = 0.8, .ratios = {0.01}});
  scene.push(Constant{.from = 0.01, .until = 0.23});
  scene.push(StepSequence{{0.0, 0.05, 0.17}, {1.0, -2.0, 0.5}});
  scene.push(Pulse{PulseShape::rectangular, 0.02, 0.03});
  scene.push(Pulse{PulseShape::half_sine, 0.10, 0.04});
  scene.push(Sinusoid{.frequency = 9.0, .phase = 0.4, .from = 0.03});
  scene.push(HarmonicSum{.mean = 0.7,
                         .terms = {{40.0, 0.3, -0.2}, {kLowest, 0.0, 0.5}},
                         .from = 0.02,
                         .until = 0.21});
  const SystemModel model = scene.builder.build();
  SystemState start = make_state(model);
  start.bodies[0].w_WB_B = Vector3(2.0, -1.0, 0.5);
  start.eta = VectorX::LinSpaced(4, 1e-3, 4e-3);
  start.etadot = VectorX::LinSpaced(4, 0.2, -0.1);
  SimulationSettings settings = {.integrator = IntegratorKind::runge_kutta_4,
                                 .end_time = 0.3,
                                 .step = 2e-4,
                                 .output_times = {0.07, 0.12, 0.3}};
  const Outcome exact = run(model, start, settings);
  settings.exact_modes = false;
  std::vector<double> errors;
  for (const double h : {2e-3, 1e-3, 2e-4}) {
    settings.step = h;
    const Outcome stepped = run(model, start, settings);
    EXPECT_EQ(stepped.statistics.exact_modes, 0);
    double error = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
      error =
          std::max(error, (stepped.states[i].eta - exact.states[i].eta).norm());
      if (h > 2e-4) continue;
      const EnergyBalance& a = stepped.energies[i];
      const EnergyBalance& b = exact.energies[i];
      EXPECT_NEAR(a.work, b.work, 1e-8 * std::abs(b.work));
      EXPECT_NEAR(a.dissipated, b.dissipated, 1e-8 * b.dissipated);
      EXPECT_NEAR(a.total(), b.total(), 1e-8 * b.total());
      EXPECT_LT(
          (stepped.states[i].bodies[0].p_WB - exact.states[i].bodies[0].p_WB)
              .norm(),
          1e-12);
    }
    errors.push_back(error);
  }
  EXPECT_NEAR(std::log2(errors[0] / errors[1]), 4.0, 0.3);
  EXPECT_LT(errors[2], 1e-6 * exact.state.eta.norm());
}

TEST(ExactModes, StepLoadsOnAnUndampedBodyCloseTheEnergyBalanceToRoundOff) {
  Scene scene(make_body(4, true));
  scene.push(StepSequence{{0.01, 0.02, 0.05, 0.07}, {1.0, -2.0, 3.0, 0.0}});
  const SystemModel model = scene.builder.build();
  SystemState start = make_state(model);
  start.etadot[0] = 1.0;
  const Outcome r = run(model, start,
                        {.end_time = 0.3,
                         .step = 1.0,
                         .output_times = {0.0, 0.015, 0.03, 0.06, 0.1, 0.3}});
  for (const EnergyBalance& e : r.energies) {
    EXPECT_NEAR(audit(e), audit(r.energies.front()), 1e-13 * e.total());
  }
  EXPECT_GT(r.energies.back().work, 0.0);
}

TEST(ExactModes, LeaveTheBodiesThatNeedStepsAlone) {
  // A free uncoupled body beside a hinged chain, which must not notice it.
  testing::Chain with = testing::make_chain({.bodies = 3});
  testing::Chain without = testing::make_chain({.bodies = 3});
  const PointMassBody points = make_body(2, false);
  const auto table = make_interface(points, 0, 6);
  const auto extra = with.builder.add_flexible_body("extra", share(points),
                                                    Fidelity::uncoupled, {});
  const auto tip = with.builder.attach_interface(
      "tip", extra, table, {Matrix3::Identity(), table.p_B});
  with.builder.add_load("push", tip, {1.0, 2.0, 3.0}, Vector3::Zero(),
                        LoadFrame::body, Constant{});
  const SystemModel model = with.builder.build();
  SystemState start = make_state(model);
  for (std::size_t b = 0; b < 3; ++b) {
    start.bodies[b] = with.state.bodies[b];
    start.bodies[b].w_WB_B = Vector3(0.3, 0.1 * static_cast<double>(b), -0.2);
  }
  SystemState alone = without.state;
  for (std::size_t b = 0; b < 3; ++b) alone.bodies[b] = start.bodies[b];
  const SimulationSettings settings = {
      .integrator = IntegratorKind::runge_kutta_4,
      .end_time = 0.02,
      .step = 1e-5,
      .output_times = {0.02}};
  const Outcome a = run(model, start, settings);
  const Outcome b = run(without.builder.build(), alone, settings);
  EXPECT_EQ(a.statistics.exact_modes, 2);
  EXPECT_EQ(a.state.eta.head(18), b.state.eta);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(a.state.bodies[i].p_WB, b.state.bodies[i].p_WB);
  }
  const VectorX F = table.Phi_B.transpose() * Vector3(1.0, 2.0, 3.0);
  EXPECT_NEAR(a.state.eta[18], F[0] / 2500.0 * (1.0 - std::cos(1.0)), 1e-15);
}

TEST(ExactModes, AreNotUsedWhereALoadDependsOnTheMotion) {
  const PointMassBody points = make_body(2, false);
  const auto is_exact = [](const Scene& scene) {
    return has_closed_modal_loads(scene.builder.build(), scene.body);
  };
  Scene plain(points);
  plain.push(Constant{});
  EXPECT_TRUE(is_exact(plain));

  Scene world(points);
  world.push(Constant{}, LoadFrame::world);
  EXPECT_FALSE(is_exact(world));  // turns through the body

  Scene held(make_body(2, true));
  held.push(Constant{}, LoadFrame::world);
  EXPECT_TRUE(is_exact(held));  // which here does not turn

  for (const Fidelity fidelity : {Fidelity::one_way, Fidelity::coupled}) {
    EXPECT_FALSE(is_exact(Scene(points, fidelity)));
  }
  for (const TimeFunction& function :
       std::vector<TimeFunction>{Table{{0.0, 1.0}, {0.0, 1.0}},
                                 Pulse{PulseShape::triangular, 0.0, 0.1}}) {
    Scene sloped(points);
    sloped.push(function);
    EXPECT_FALSE(is_exact(sloped));
  }
  Scene tied(points);
  const auto wall = tied.builder.attach_world("wall", {});
  tied.builder.add_coupler(
      "spring",
      joints::make_joint_bushing(joints::JointKind::fixed, Vector3::UnitX(),
                                 {.translational_stiffness = 1e3,
                                  .rotational_stiffness = 1e3,
                                  .translational_damping = 0.0,
                                  .rotational_damping = 0.0}),
      wall, tied.tip);
  EXPECT_FALSE(is_exact(tied));
}

TEST(ExactModes, AreThereAtTheLastGoodTimeAfterTheRestBlewUp) {
  testing::Chain chain = testing::make_chain({.bodies = 2, .stiffness = 1e16});
  const PointMassBody points = make_body(1, true);
  const auto table = make_interface(points, 0, 6);
  const auto extra = chain.builder.add_flexible_body("held", share(points),
                                                     Fidelity::uncoupled, {});
  const auto tip = chain.builder.attach_interface(
      "tip", extra, table, {Matrix3::Identity(), table.p_B});
  chain.builder.add_load("push", tip, {1.0, 2.0, 3.0}, Vector3::Zero(),
                         LoadFrame::body, Constant{});
  const SystemModel model = chain.builder.build();
  SystemState state = make_state(model);
  for (std::size_t b = 0; b < 2; ++b) {
    state.bodies[b] = chain.state.bodies[b];
    state.bodies[b].w_WB_B = Vector3(1.0, -1.0, 0.5);
  }
  EXPECT_THROW(simulate(model, state,
                        {.integrator = IntegratorKind::runge_kutta_4,
                         .end_time = 10.0,
                         .step = 0.01,
                         .output_times = {}},
                        {}),
               NumericalError);
  EXPECT_GT(state.t, 0.0);
  const double F = table.Phi_B.col(0).dot(Vector3(1.0, 2.0, 3.0));
  EXPECT_NEAR(state.eta[12], F / 2500.0 * (1.0 - std::cos(kLowest * state.t)),
              1e-13);
}

}  // namespace
}  // namespace limber::dynamics::exact_modes_test
