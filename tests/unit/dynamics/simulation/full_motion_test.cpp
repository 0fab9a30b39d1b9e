// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "limber/common/dense/linear_solve.hpp"
#include "limber/common/errors.hpp"
#include "limber/common/rotation.hpp"
#include "limber/dynamics/equations/energy.hpp"
#include "limber/dynamics/simulation/simulation.hpp"
#include "limber/dynamics/system/system_builder.hpp"
#include "support/full_lattice.hpp"

/// Motion of one body at level `full`, a network of springs.
namespace limber::dynamics::full_motion_test {
namespace {

using testing::Lattice;
using testing::make_full;
using testing::make_lattice;
using testing::make_reduced;
using testing::SpringNetwork;
using testing::stir;

EnergyBalance run(const SystemModel& model, SystemState& state,
                  const SimulationSettings& settings) {
  EnergyBalance last;
  simulate(model, state, settings,
           [&](const SystemState&, const EnergyBalance& now) { last = now; });
  return last;
}

TEST(FullMotion, FallsFreelyWithoutDeformation) {
  for (const IntegratorKind kind :
       {IntegratorKind::generalized_alpha, IntegratorKind::central_differences,
        IntegratorKind::runge_kutta_4}) {
    Lattice lattice;
    lattice.builder.set_gravity({0.0, 1.0, -9.81});
    const SystemModel model = lattice.builder.build();
    SystemState state = make_state(model);
    state.bodies[0].quat_WB = exp_quaternion(Vector3(2.0, -1.0, 0.5));
    state.bodies[0].v_WB_W = Vector3(1.0, 0.0, 4.0);
    place_nodes(model, {}, {}, state);
    const EnergyBalance before = calc_energy(model, state);
    const EnergyBalance energy = run(model, state,
                                     {.integrator = kind,
                                      .end_time = 0.5,
                                      .step = 1e-3,
                                      .output_times = {0.5}});
    const Vector3 expected(0.5, 0.125, 2.0 - 9.81 * 0.125);
    EXPECT_LT((state.bodies[0].p_WB - expected).norm(), 1e-12);
    EXPECT_LT(energy.elastic, 1e-20);
    EXPECT_NEAR(energy.total() - before.total(), energy.work, 1e-11);
  }
}

TEST(FullMotion, OfAHeavyClampedBodySettlesAtTheStaticDeflection) {
  Lattice lattice({.is_clamped = true});
  const Vector3 gravity(1e-3, 0.0, -2e-3);  // small, so that it is linear
  const Matrix3 turn = exp_rotation(Vector3(0.0, 1.0, 0.0));
  lattice.builder.set_gravity(turn * gravity);
  const SystemModel model = lattice.builder.build();
  SystemState state = make_state(model);
  state.bodies[0].quat_WB = Quaternion(turn);
  place_nodes(model, {}, {}, state);
  run(model, state,
      {.integrator = IntegratorKind::implicit_euler,
       .end_time = 2.0,
       .step = 0.01});
  const auto free = lattice.network.free_dofs();
  const Matrix3X load = gravity * lattice.network.node_mass().transpose();
  const MatrixX K = lattice.network.calc_tangent(0.0 * lattice.network.x_B);
  VectorX expected = VectorX::Zero(load.size());
  const VectorX right = load.reshaped()(free);
  expected(free) = dense::solve(MatrixX(K(free, free)), VectorX(right));
  EXPECT_LT((state.u_H - expected).norm(), 1e-5 * expected.norm());
}

/// A mode's own motion, so small that it is linear to 1e-6.
struct OneMode {
  OneMode(const SystemModel& model, int mode)
      : phi(model.bodies[0].reduced->rows.Phi_B.col(mode) /
            model.bodies[0].reduced->rows.Phi_B.col(mode).norm() * 1e-7),
        omega(std::sqrt(model.bodies[0].reduced->lambda[mode])),
        state(make_state(model)) {
    place_nodes(model, phi, {}, state);
  }
  VectorX phi;
  double omega;
  SystemState state;
};

TEST(FullMotion, OfADampedModeIsTheDampedOscillators) {
  for (const bool is_clamped : {false, true}) {
    constexpr double kRatio = 0.05;
    const Lattice lattice({.is_clamped = is_clamped}, {.ratios = {kRatio}});
    const SystemModel model = lattice.builder.build();
    for (const int mode : {0, 7}) {
      OneMode one(model, mode);
      const double end = 10.0 / one.omega;
      const double before = calc_energy(model, one.state).total();
      const EnergyBalance energy =
          run(model, one.state,
              {.integrator = IntegratorKind::runge_kutta_4,
               .end_time = end,
               .step = 2e-5,
               .output_times = {end}});
      const double root = std::sqrt(1.0 - kRatio * kRatio);
      const double at = one.omega * root * end;
      const double expected = std::exp(-kRatio * one.omega * end) *
                              (std::cos(at) + kRatio / root * std::sin(at));
      EXPECT_LT((one.state.u_H - expected * one.phi).norm(),
                2e-6 * one.phi.norm());
      EXPECT_NEAR(before - energy.total(), energy.dissipated, 1e-6 * before);
    }
  }
}

TEST(FullMotion, DampedKeepsAngularMomentumToRoundOff) {
  const Lattice lattice({}, {.ratios = {0.1}});
  const SystemModel model = lattice.builder.build();
  SystemState state = stir(model);
  const EnergyBalance before = calc_energy(model, state);
  const EnergyBalance after =
      run(model, state,
          {.integrator = IntegratorKind::central_differences,
           .end_time = 0.05,
           .step = 2e-5,
           .output_times = {0.05}});
  EXPECT_GT(after.dissipated, 0.1 * before.total());
  EXPECT_LT((after.angular_momentum - before.angular_momentum).norm(),
            1e-12 * before.angular_momentum.norm());
  EXPECT_LT((after.linear_momentum - before.linear_momentum).norm(),
            1e-12 * before.linear_momentum.norm());
}

// Newton's matrix contains the damping of the modes: strong damping costs no
// more iterations.
TEST(FullMotion, ImplicitStepsConvergeUnderStrongDamping) {
  for (const double ratio : {0.3, 1.0, 2.0}) {
    const Lattice lattice({.is_clamped = true}, {.ratios = {ratio}});
    const SystemModel model = lattice.builder.build();
    for (const double step : {1e-4, 1e-3, 1e-2}) {
      OneMode one(model, 0);
      place_nodes(model, 1e4 * one.phi, {}, one.state);
      const SimulationStatistics statistics = simulate(
          model, one.state, {.end_time = 20.0 * step, .step = step}, {});
      EXPECT_LT(statistics.newton_iterations, 20 * 12);
    }
  }
}

// The start is unstretched, so that the spin stretches it at once, in modes
// that such steps do not resolve.
TEST(FullMotion, TurningByAFifthOfARadianAStepTakesNoHalvingsAndFewIterations) {
  for (const double stiffness : {4e4, 4e6, 4e8}) {
    const Lattice lattice({.layers = 12, .stiffness = stiffness});
    const SystemModel model = lattice.builder.build();
    SystemState state = make_state(model);
    state.bodies[0].w_WB_B = Vector3(1.2, 0.0, 1.6);
    place_nodes(model, {}, {}, state);
    const SimulationStatistics statistics =
        simulate(model, state, {.end_time = 2.0, .step = 0.1}, {});
    EXPECT_EQ(statistics.halved_steps, 0);
    EXPECT_LT(statistics.newton_iterations, 20 * 10);
  }
}

// --- Orders of the integrators ----------------------------------------------

struct SchemeOrder {
  IntegratorKind kind;
  double order;
  double coarse;  ///< omega h
};

class FullOrder : public ::testing::TestWithParam<SchemeOrder> {};

// Against cos(omega t) of the highest mode, where its phase shows.
TEST_P(FullOrder, IsTheSchemesOnAModesOwnMotion) {
  const auto [kind, order, coarse] = GetParam();
  for (const bool is_clamped : {false, true}) {
    const int modes = is_clamped ? 36 : 42;
    const Lattice lattice({.is_clamped = is_clamped}, {}, modes);
    const SystemModel model = lattice.builder.build();
    std::vector<double> errors;
    for (const double fraction : {1.0, 0.5}) {
      OneMode one(model, modes - 1);
      const double end = 4.8 / one.omega;
      run(model, one.state,
          {.integrator = kind,
           .end_time = end,
           .step = fraction * coarse / one.omega,
           .rho_inf = 0.8,
           .newton_tolerance = 1e-13});
      const VectorX exact = std::cos(4.8) * one.phi;
      errors.push_back((one.state.u_H - exact).norm() / one.phi.norm());
    }
    EXPECT_NEAR(std::log2(errors[0] / errors[1]), order, 0.15);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Integrators, FullOrder,
    ::testing::Values(SchemeOrder{IntegratorKind::generalized_alpha, 2.0, 0.1},
                      SchemeOrder{IntegratorKind::central_differences, 2.0,
                                  0.2},
                      SchemeOrder{IntegratorKind::runge_kutta_4, 4.0, 0.3},
                      SchemeOrder{IntegratorKind::implicit_euler, 1.0, 0.02}),
    [](const auto& i) {
      std::string name = to_string(i.param.kind);
      std::replace(name.begin(), name.end(), '-', '_');
      return name;
    });

// --- Failure ----------------------------------------------------------------

TEST(FullFailure, NamesThePartTheBodyAndTheTimeAndKeepsTheLastState) {
  for (const IntegratorKind kind :
       {IntegratorKind::generalized_alpha, IntegratorKind::central_differences,
        IntegratorKind::runge_kutta_4, IntegratorKind::implicit_euler}) {
    SpringNetwork network = make_lattice();
    network.least_stretch = 0.3;
    SystemBuilder builder;
    builder.add_full_body("lattice", make_reduced(network, 3),
                          make_full(network), {});
    builder.set_gravity({0.0, 0.0, -1.0});
    builder.add_load(
        "crush",
        builder.attach_nodes("node", BodyIndex(0),
                             find_node_set(*make_full(network), "node"), {}),
        {0.0, 0.0, -1e5}, Vector3::Zero(), LoadFrame::world,
        Constant{.from = 0.01});
    const SystemModel model = builder.build();
    SystemState state = make_state(model);
    place_nodes(model, {}, {}, state);
    int outputs = 0;
    try {
      simulate(model, state,
               {.integrator = kind,
                .end_time = 0.1,
                .step = 1e-4,
                .output_times = {0.0, 0.005, 0.01, 0.1}},
               [&](const SystemState&, const EnergyBalance&) { ++outputs; });
      FAIL() << "the crushed lattice went on";
    } catch (const NumericalError& error) {
      const std::string text = error.what();
      EXPECT_NE(text.find("spring"), std::string::npos) << text;
      EXPECT_NE(text.find("'lattice' at t = 0.01"), std::string::npos) << text;
    }
    EXPECT_EQ(outputs, 3);
    EXPECT_GE(state.t, 0.01);
    EXPECT_LT(state.t, 0.1);
    EXPECT_TRUE(state.u_H.allFinite());
    // The frame, too, is that of the last state.
    EXPECT_LT(state.bodies[0].p_WB.z(), -0.49 * 0.01 * 0.01);
  }
}

}  // namespace
}  // namespace limber::dynamics::full_motion_test
