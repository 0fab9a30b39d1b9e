// SPDX-License-Identifier: BSD-3-Clause
#include "dynamics/simulation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <tuple>

#include "common/errors.hpp"
#include "common/rotation.hpp"
#include "support/chain.hpp"
#include "support/point_mass_body.hpp"

namespace limber::dynamics {
namespace {

using joints::JointKind;
using testing::Chain;
using testing::make_chain;

struct Outcome {
  SystemState state;
  std::vector<EnergyBalance> energies;
  std::vector<SystemState> states;
  SimulationStatistics statistics;
};

Outcome run(const SystemModel& model, SystemState state,
            const SimulationSettings& settings) {
  Outcome r;
  r.statistics = simulate(model, state, settings,
                          [&](const SystemState& s, const EnergyBalance& e) {
                            r.states.push_back(s);
                            r.energies.push_back(e);
                          });
  r.state = state;
  return r;
}

std::vector<double> sample(double end, int count) {
  std::vector<double> times;
  for (int i = 0; i <= count; ++i) times.push_back(end * i / count);
  return times;
}

void stir(SystemState& state, double speed, double spin, double modal) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (BodyState& b : state.bodies) {
    for (int a = 0; a < 3; ++a) {
      b.v_WB_W[a] = speed * uniform(random);
      b.w_WB_B[a] = spin * uniform(random);
    }
  }
  for (double& x : state.etadot) x = modal * uniform(random);
}

SystemModel rigid_body(const Matrix3& inertia, double mass = 2.0) {
  SystemBuilder builder;
  builder.add_rigid_body("top", {mass, inertia});
  return builder.build();
}

// --- Closed forms -----------------------------------------------------------

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
  const int ball =
      builder.add_rigid_body("ball", {1.0, own * Matrix3::Identity()});
  const int pivot = builder.attach_world("pivot", {});
  const int arm =
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
  // ball is back: where its height peaks tells the period.
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
    const int b = builder.add_flexible_body("b", testing::share(body),
                                            Fidelity::coupled, {});
    const auto interface = testing::make_interface(body, 0, 6);
    const int tip = builder.attach_interface(
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
    const int b = builder.add_flexible_body("b", testing::share(body),
                                            Fidelity::coupled, {});
    const int tip = builder.attach_interface(
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

// --- Conservation -----------------------------------------------------------

TEST(Simulation, FreeChainKeepsItsLinearMomentumToRoundOff) {
  Chain chain = make_chain({.bodies = 10});
  stir(chain.state, 1.0, 2.0, 1.0);
  const SystemModel model = chain.builder.build();
  const Outcome r =
      run(model, chain.state,
          {.end_time = 0.5, .step = 1e-3, .output_times = sample(0.5, 50)});
  double absolute = 0.0;
  for (const BodyState& b : chain.state.bodies) {
    absolute += model.bodies[0].mass * b.v_WB_W.norm();
  }
  for (const EnergyBalance& e : r.energies) {
    EXPECT_LT((e.linear_momentum - r.energies[0].linear_momentum).norm(),
              1e-12 * absolute);
  }
}

TEST(Simulation, AngularMomentumOfAFreeChainIsKeptToSecondOrder) {
  Chain chain = make_chain({.bodies = 10, .stiffness = 1e3, .lowest = 20.0});
  stir(chain.state, 0.2, 1.0, 0.2);
  const SystemModel model = chain.builder.build();
  std::vector<double> errors;
  for (const double h : {4e-4, 2e-4, 1e-4}) {
    const Outcome r =
        run(model, chain.state,
            {.end_time = 0.1, .step = h, .output_times = {0.0, 0.1}});
    errors.push_back(
        (r.energies[1].angular_momentum - r.energies[0].angular_momentum)
            .norm() /
        r.energies[0].angular_momentum.norm());
  }
  EXPECT_GT(std::log2(errors[0] / errors[1]), 1.8);
  EXPECT_GT(std::log2(errors[1] / errors[2]), 1.8);
}

TEST(RungeKutta4, TumblingFlexibleBodyKeepsMomentumAndEnergyAtFourthOrder) {
  const testing::PointMassBody body =
      testing::make_point_mass_body(30, 6, 4.0, 1.0, 40.0, 9);
  SystemBuilder builder;
  builder.add_flexible_body("b", testing::share(body), Fidelity::coupled, {});
  const SystemModel model = builder.build();
  SystemState state = make_state(model);
  state.bodies[0].w_WB_B = Vector3(5, 1, 2);
  std::vector<double> energy;
  std::vector<double> momentum;
  for (const double h : {2e-3, 1e-3, 5e-4}) {
    const Outcome r = run(model, state,
                          {.integrator = IntegratorKind::runge_kutta_4,
                           .end_time = 1.0,
                           .step = h,
                           .output_times = {0.0, 1.0}});
    energy.push_back(std::abs(r.energies[1].total() - r.energies[0].total()) /
                     r.energies[0].total());
    momentum.push_back(
        (r.energies[1].angular_momentum - r.energies[0].angular_momentum)
            .norm() /
        r.energies[0].angular_momentum.norm());
  }
  // RK4 loses the energy of an oscillator at fifth order, the rest at fourth.
  EXPECT_GT(std::log2(energy[0] / energy[1]), 3.8);
  EXPECT_GT(std::log2(energy[1] / energy[2]), 3.8);
  EXPECT_GT(std::log2(momentum[0] / momentum[1]), 3.8);
}

// The promise for the default scheme: without damping and with rho_inf = 1 the
// energy of a tumbling flexible body stays within a band that does not grow,
// over 1e5 steps of 1/20 of its shortest period.
TEST(GeneralizedAlpha, EnergyDriftOfATumblingBodyIsBoundedWithoutTrend) {
  const testing::PointMassBody body =
      testing::make_point_mass_body(30, 10, 4.0, 1.0, 40.0, 9);
  SystemBuilder builder;
  builder.add_flexible_body("b", testing::share(body), Fidelity::coupled, {});
  const SystemModel model = builder.build();
  SystemState state = make_state(model);
  state.bodies[0].w_WB_B = Vector3(5, 1, 2);
  const double shortest = 2.0 * std::numbers::pi / (40.0 * 5.5);
  const double h = shortest / 20.0;
  const double end = 1e5 * h;
  const Outcome r = run(model, state,
                        {.end_time = end,
                         .step = h,
                         .output_times = sample(end, 1000),
                         .rho_inf = 1.0});
  ASSERT_GE(r.statistics.steps, 100000);
  const auto band = [&](std::size_t from, std::size_t to) {
    double low = 1e300;
    double high = -1e300;
    for (std::size_t i = from; i < to; ++i) {
      low = std::min(low, r.energies[i].total());
      high = std::max(high, r.energies[i].total());
    }
    return std::pair{low, high};
  };
  const double total = r.energies[0].total();
  const auto [low1, high1] = band(0, 200);
  const auto [low2, high2] = band(800, 1000);
  EXPECT_LT(high1 - low1, 0.02 * total);
  // No trend: the last fifth stays in the first fifth's band, half a band
  // wider.
  const double slack = 0.5 * (high1 - low1);
  EXPECT_GT(low2, low1 - slack);
  EXPECT_LT(high2, high1 + slack);
}

TEST(Simulation, EnergyAuditClosesAtSecondOrderWithLoadsAndDampers) {
  Chain chain = make_chain({.bodies = 3,
                            .stiffness = 1e4,
                            .damping = 5.0,
                            .joint = JointKind::revolute});
  chain.builder.add_load("push", chain.last_interfaces.back(), {0, 5, 0},
                         {0.3, 0, 0}, LoadFrame::body,
                         Sinusoid{.frequency = 3.0});
  chain.builder.set_gravity({0, 0, -1.0});
  const SystemModel model = chain.builder.build();
  std::vector<double> errors;
  for (const double h : {2e-3, 1e-3, 5e-4}) {
    const Outcome r =
        run(model, chain.state,
            {.end_time = 0.5, .step = h, .output_times = {0.0, 0.5}});
    const EnergyBalance& e = r.energies.back();
    const double gap =
        e.total() - r.energies[0].total() - e.work + e.dissipated;
    EXPECT_GT(e.dissipated, 0.0);
    errors.push_back(std::abs(gap) / std::abs(e.work));
  }
  EXPECT_GT(std::log2(errors[0] / errors[1]), 1.7);
  EXPECT_GT(std::log2(errors[1] / errors[2]), 1.7);
  EXPECT_LT(errors[2], 1e-4);
}

// --- Stiffness --------------------------------------------------------------

class StiffCouplers : public ::testing::TestWithParam<double> {};

TEST_P(StiffCouplers, DoNotDictateTheStep) {
  Chain chain = make_chain(
      {.bodies = 4, .stiffness = GetParam(), .joint = JointKind::revolute});
  chain.builder.add_load("hit", chain.last_interfaces.back(), {0, 100, 10},
                         Vector3::Zero(), LoadFrame::world,
                         Pulse{PulseShape::rectangular, 0.1, 0.01});
  const SystemModel model = chain.builder.build();
  const Outcome r = run(model, chain.state,
                        {.end_time = 1.0, .step = 1e-3, .output_times = {1.0}});
  EXPECT_LE(static_cast<double>(r.statistics.newton_iterations),
            4.0 * static_cast<double>(r.statistics.steps));
  const Vector3 impulse = 0.01 * Vector3(0, 100, 10);
  EXPECT_LT((r.energies.back().linear_momentum - impulse).norm(),
            1e-6 * impulse.norm());
  // Energy cannot exceed what the load put in.
  EXPECT_LT(r.energies.back().total(), 1.01 * r.energies.back().work);
}

INSTANTIATE_TEST_SUITE_P(FromSoftToRigid, StiffCouplers,
                         ::testing::Values(1e5, 1e7, 1e9, 1e11, 1e13));

TEST(Simulation, HingesConvergeAtFirstOrderInCompliance) {
  // Tip position after a fixed time tends to a limit as 1/k.
  std::vector<Vector3> tips;
  for (const double k : {1e6, 1e7, 1e8}) {
    Chain chain = make_chain({.bodies = 3,
                              .stiffness = k,
                              .joint = JointKind::revolute,
                              .fidelity = Fidelity::rigid});
    chain.builder.add_load("push", chain.last_interfaces.back(), {0, 4, 1},
                           Vector3::Zero(), LoadFrame::world,
                           Pulse{PulseShape::half_sine, 0.0, 0.5});
    const SystemModel model = chain.builder.build();
    SystemState state = chain.state;
    simulate(model, state, {.end_time = 1.0, .step = 1e-3, .output_times = {}},
             {});
    tips.push_back(state.bodies[2].p_WB);
  }
  const double ratio = (tips[1] - tips[0]).norm() / (tips[2] - tips[1]).norm();
  EXPECT_NEAR(std::log10(ratio), 1.0, 0.1);
}

// --- Bookkeeping ------------------------------------------------------------

TEST(Simulation, OutputTimesAreMetExactly) {
  Chain chain = make_chain({.bodies = 2});
  const SystemModel model = chain.builder.build();
  const std::vector<double> times = {0.0, 0.0105, 0.02, 0.0333};
  const Outcome r =
      run(model, chain.state,
          {.end_time = 0.04, .step = 1e-3, .output_times = times});
  ASSERT_EQ(r.states.size(), times.size());
  for (std::size_t i = 0; i < times.size(); ++i) {
    EXPECT_EQ(r.states[i].t, times[i]);
  }
  EXPECT_EQ(r.state.t, 0.04);
}

TEST(Simulation, AHalfSineShorterThanAStepGivesItsImpulse) {
  constexpr double kMass = 2.0;        // [kg]
  constexpr double kForce = 30.0;      // [N]
  constexpr double kDuration = 1e-4;   // [s]
  constexpr double kSixteenth = 4e-3;  // the trapezoidal rule's error is 0.3 %
  const double speed = 2.0 / std::numbers::pi * kForce * kDuration / kMass;
  for (const std::string& name : integrator_names()) {
    SystemBuilder builder;
    const int body =
        builder.add_rigid_body("ball", {kMass, Matrix3::Identity()});
    const int centre = builder.attach_frame("centre", body, {});
    builder.add_load("blow", centre, kForce * Vector3::UnitX(), Vector3::Zero(),
                     LoadFrame::world,
                     Pulse{PulseShape::half_sine, 0.002, kDuration});
    const SystemModel model = builder.build();
    for (const double step : {1e-3, 1.0}) {
      SystemState state = make_state(model);
      simulate(model, state,
               {.integrator = parse_integrator(name),
                .end_time = 1.0,
                .step = step,
                .output_times = {}},
               {});
      EXPECT_NEAR(state.bodies[0].v_WB_W[0] / speed, 1.0, kSixteenth)
          << name << ", steps of " << step << " s";
    }
  }
}

TEST(Simulation, SameRunTwiceIsTheSameToTheBit) {
  Chain chain = make_chain({.bodies = 4});
  stir(chain.state, 1.0, 1.0, 1.0);
  const SystemModel model = chain.builder.build();
  const SimulationSettings settings{
      .end_time = 0.1, .step = 1e-3, .output_times = {}};
  const Outcome a = run(model, chain.state, settings);
  const Outcome b = run(model, chain.state, settings);
  EXPECT_EQ(a.state.eta, b.state.eta);
  EXPECT_EQ(a.state.bodies[3].p_WB, b.state.bodies[3].p_WB);
}

TEST(Simulation, StepsChangeWhereTheyAreToldTo) {
  const SystemModel model = rigid_body(Matrix3::Identity());
  const Outcome r = run(model, make_state(model),
                        {.end_time = 1.0,
                         .step = 0.01,
                         .step_changes = {{0.1, 0.3}, {0.7, 0.05}},
                         .output_times = {}});
  EXPECT_EQ(r.statistics.steps, 10 + 2 + 6);
}

TEST(Simulation, UnevenStepsKeepTheSecondOrder) {
  // Torque-free asymmetric top; the reference takes steps of its own.
  const SystemModel model =
      rigid_body(Vector3(1.0, 2.0, 3.0).asDiagonal().toDenseMatrix());
  SystemState start = make_state(model);
  start.bodies[0].w_WB_B = Vector3(0.5, 1.0, 0.2);
  const Outcome reference = run(model, start,
                                {.integrator = IntegratorKind::runge_kutta_4,
                                 .end_time = 4.0,
                                 .step = 1e-3,
                                 .output_times = {}});
  std::vector<double> errors;
  for (const double h : {0.02, 0.01, 0.005}) {
    SimulationSettings settings = {
        .end_time = 4.0, .step = h, .output_times = {}};
    for (int i = 1; i < 40; ++i) {  // long and short in turn, a factor of five
      settings.step_changes.push_back({0.1 * i, i % 2 == 0 ? h : 0.2 * h});
    }
    const Outcome r = run(model, start, settings);
    errors.push_back(
        (r.state.bodies[0].w_WB_B - reference.state.bodies[0].w_WB_B).norm());
  }
  EXPECT_NEAR(std::log2(errors[0] / errors[1]), 2.0, 0.1);
  EXPECT_NEAR(std::log2(errors[1] / errors[2]), 2.0, 0.1);
}

TEST(Simulation, SettingsOutOfRangeAreRefused) {
  const SystemModel model = rigid_body(Matrix3::Identity());
  const auto refuse = [&](const SimulationSettings& settings) {
    SystemState state = make_state(model);
    EXPECT_THROW(simulate(model, state, settings, {}), InputError);
  };
  refuse({.end_time = 0.0, .step = 1e-3, .output_times = {}});
  refuse({.end_time = 1.0, .step = 0.0, .output_times = {}});
  refuse({.end_time = 1.0, .step = 0.1, .step_changes = {{0.5, -0.1}}});
  refuse(
      {.end_time = 1.0, .step = 0.1, .step_changes = {{0.5, 0.1}, {0.5, 0.2}}});
  refuse({.end_time = 1.0, .step = 1e-3, .output_times = {}, .rho_inf = 1.5});
}

TEST(Simulation, BlowUpEndsWithTheBodyAndTheTimeAndKeepsTheLastGoodState) {
  Chain chain = make_chain({.bodies = 2, .stiffness = 1e16});
  stir(chain.state, 1.0, 1.0, 1.0);
  const SystemModel model = chain.builder.build();
  SystemState state = chain.state;
  int observed = 0;
  try {
    simulate(model, state,
             {.integrator = IntegratorKind::runge_kutta_4,
              .end_time = 10.0,
              .step = 0.01,
              .output_times = sample(10.0, 1000)},
             [&](const SystemState&, const EnergyBalance&) { ++observed; });
    FAIL() << "an unstable explicit step was called a success";
  } catch (const NumericalError& error) {
    EXPECT_NE(std::string(error.what()).find("link"), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("t = "), std::string::npos);
  }
  EXPECT_GT(observed, 0);
  EXPECT_TRUE(state.eta.allFinite());
}

TEST(Simulate, RefusesAStateFromBeforeItsModelGotAPath) {
  Chain chain = make_chain({.bodies = 2});
  chain.builder.add_path("rubbed",
                         {chain.last_interfaces[0], chain.last_interfaces[1]},
                         {joints::Friction({.coulomb = 0.5, .speed = 0.01})});
  const SystemModel model = chain.builder.build();
  SystemState state = chain.state;
  EXPECT_THROW(simulate(model, state, {.end_time = 0.1, .step = 0.01}, {}),
               ContractError);
}

}  // namespace
}  // namespace limber::dynamics
