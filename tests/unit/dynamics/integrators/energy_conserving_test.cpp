// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/integrators/energy_conserving.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "limber/common/errors.hpp"
#include "limber/common/rotation.hpp"
#include "limber/dynamics/equations/energy.hpp"
#include "limber/dynamics/newton/cayley.hpp"
#include "limber/dynamics/simulation/simulation.hpp"
#include "limber/dynamics/system/body_model.hpp"
#include "support/chain.hpp"
#include "support/elastic_kinds.hpp"
#include "support/free_chain.hpp"
#include "support/linked_bodies.hpp"
#include "support/point_mass_body.hpp"

namespace limber::dynamics::energy_conserving_test {
namespace {

using testing::FreeChain;
using testing::make_free_chain;

// --- A free chain -----------------------------------------------------------

constexpr double kTwentyTimes = 20.0;  // the explicit limit of its modes

TEST(EnergyConserving, KeepsAFreeChainsEnergyAtTwentyTimesTheExplicitLimit) {
  const FreeChain chain = make_free_chain(1e7, 1.0, 0.1);
  const testing::KeptDrift drift = testing::find_energy_conserving_drift(
      chain, kTwentyTimes * chain.shortest, 2000);
  EXPECT_LT(drift.energy, 1e-11);
  EXPECT_LT(drift.linear, 1e-14);
  EXPECT_LT(drift.angular, 1e-12);
}

// What round-off of positions, times the hinges' force, leaves.
TEST(EnergyConserving, KeepsAFreeChainsEnergyWhateverItsHingesStiffness) {
  for (const double stiffness : {1e5, 1e9, 1e11, 1e13}) {
    const FreeChain chain = make_free_chain(stiffness, 1.0, 0.1);
    const testing::KeptDrift drift =
        testing::find_energy_conserving_drift(chain, 1e-3, 200);
    EXPECT_LT(drift.energy, 1e-15 * std::sqrt(stiffness) * std::sqrt(200.0))
        << stiffness;
    EXPECT_LT(drift.linear, 1e-14) << stiffness;
    EXPECT_LT(drift.angular, 1e-12) << stiffness;
  }
}

// --- Every law --------------------------------------------------------------

struct Gap {
  double energy;   ///< of the audit, relative to the energy at the start
  double angular;  ///< change of the angular momentum, relative
  double dissipated;
};

// Switches stand as the motion has them; the balance across an event is that of
// the event's time.
Gap find_gap(const SystemModel& model, SystemState state, double h, int steps) {
  // Joints that turn fast under large forces take many.
  EnergyConserving scheme(model, {.max_iterations = 60});
  const EnergyBalance start = calc_energy(model, state);
  double work = 0.0;
  double dissipated = 0.0;
  for (int i = 0; i < steps; ++i) {
    const StepResult step = scheme.step(state, h, state.t + h);
    work += step.load_work;
    dissipated += step.dissipated;
    for (std::size_t c = 0; c < model.couplers.size(); ++c) {
      const auto& coordinates = coordinates_of(model.couplers[c].law);
      for (std::size_t k = 0; k < coordinates.size(); ++k) {
        double& near = state.memory[c].near[k];
        near = find_position(coordinates[k], scheme.terms().couplers[c].motion,
                             near);
      }
    }
  }
  const EnergyBalance end = calc_energy(model, state);
  return {(end.total() - start.total() + dissipated - work) / start.total(),
          (end.angular_momentum - start.angular_momentum).norm() /
              start.angular_momentum.norm(),
          dissipated};
}

class EnergyConservingLink : public ::testing::TestWithParam<std::size_t> {};

TEST_P(EnergyConservingLink, ClosesTheBalanceAndKeepsMomentumToRoundOff) {
  for (const double damping : {0.0, 0.5}) {
    const auto link = testing::make_all_links(damping).at(GetParam());
    for (const std::array<bool, 3> flexible :
         {std::array{true, true, true}, std::array{false, true, false}}) {
      const auto bodies = testing::make_linked_bodies(link, flexible, 3, 1.0);
      const Gap gap = find_gap(bodies.model, bodies.state, 0.004, 45);
      EXPECT_LT(std::abs(gap.energy), 1e-12) << damping;
      EXPECT_LT(gap.angular, 1e-12) << damping;
      if (damping > 0.0) {
        EXPECT_GT(gap.dissipated, 0.0);
      }
    }
  }
}

long count_iterations(const testing::LinkedBodies& bodies, double h,
                      int steps) {
  EnergyConserving scheme(bodies.model, {});
  SystemState state = bodies.state;
  long count = 0;
  for (int i = 0; i < steps; ++i) {
    count += scheme.step(state, h, state.t + h).iterations;
  }
  return count;
}

// As the other implicit schemes do: without the last step as a prediction it is
// seven to ten.
TEST_P(EnergyConservingLink, TakesFiveIterationsAStepAtMost) {
  const auto link = testing::make_all_links(0.5).at(GetParam());
  const auto bodies =
      testing::make_linked_bodies(link, std::array{true, true, true}, 3, 1.0);
  constexpr int kSteps = 200;
  EXPECT_LE(count_iterations(bodies, 2e-4, kSteps), 5 * kSteps);
}

// Interfaces and inertia of second order in the modes.
TEST_P(EnergyConservingLink, ClosesTheBalanceOfNonlinearBodies) {
  const auto link = testing::make_all_links(0.5).at(GetParam());
  auto bodies =
      testing::make_linked_bodies(link, std::array{true, false, true}, 3, 1.0);
  testing::bend(bodies.model, 3.0 * bodies.state.eta.cwiseAbs().maxCoeff());
  const Gap gap = find_gap(bodies.model, bodies.state, 0.004, 45);
  EXPECT_LT(std::abs(gap.energy), 1e-12);
  EXPECT_LT(gap.angular, 1e-12);
  EXPECT_GT(gap.dissipated, 0.0);
}

INSTANTIATE_TEST_SUITE_P(
    All, EnergyConservingLink,
    ::testing::Range<std::size_t>(0, testing::make_all_links(0.0).size()),
    [](const auto& i) { return testing::make_all_links(0.0)[i.param].name; });

// --- Loads and losses -------------------------------------------------------

TEST(EnergyConserving, AuditOfLoadsDampersAndFrictionClosesToRoundOff) {
  testing::Chain chain =
      testing::make_chain({.bodies = 3,
                           .stiffness = 1e4,
                           .damping = 5.0,
                           .joint = joints::JointKind::revolute});
  chain.builder.add_load("push", chain.last_interfaces.back(), {0, 5, 0},
                         {0.3, 0, 0}, LoadFrame::body,
                         Sinusoid{.frequency = 3.0});
  chain.builder.add_load("pull", chain.last_interfaces.front(), {1, 0, 2},
                         {0, 0.2, 0}, LoadFrame::world, Constant{});
  chain.builder.add_path(
      "rubbed", {chain.last_interfaces[0], chain.last_interfaces[2]},
      {joints::Friction({.coulomb = 0.5, .viscous = 0.1, .speed = 0.01})});
  chain.builder.set_gravity({0, 0, -1.0});
  const SystemModel model = chain.builder.build();
  SystemState state = make_state(model);  // with the path's memory
  state.bodies = chain.state.bodies;
  for (BodyState& body : state.bodies) body.w_WB_B = Vector3(1.0, 0.2, 0.1);
  std::vector<EnergyBalance> energies;
  simulate(model, state,
           {.integrator = IntegratorKind::energy_conserving,
            .end_time = 0.5,
            .step = 2e-3,
            .output_times = {0.0, 0.1, 0.2, 0.3, 0.4, 0.5}},
           [&](const SystemState&, const EnergyBalance& energy) {
             energies.push_back(energy);
           });
  ASSERT_EQ(energies.size(), 6U);
  for (const EnergyBalance& e : energies) {
    EXPECT_NEAR(e.total() - energies[0].total() - e.work + e.dissipated, 0.0,
                1e-12 * (energies[0].total() + std::abs(e.work)));
  }
  EXPECT_GT(energies.back().dissipated, 1e-3);
}

// Forces on products of modes, and moments that follow both, included.
TEST(EnergyConserving, AuditOfNodalLoadsOnABodyOfSecondOrderClosesToRoundOff) {
  auto bodies =
      testing::make_linked_bodies(testing::make_all_links(0.5).at(0),
                                  std::array{true, false, true}, 3, 1.0);
  testing::bend(bodies.model, 3.0 * bodies.state.eta.cwiseAbs().maxCoeff());
  BodyModel& body = bodies.model.bodies[0];
  auto reduced = std::make_shared<flexbody::ReducedBody>(*body.reduced);
  flexbody::QuadraticManifold table;
  table.paired = {1, 3};
  reduced->manifold = table;
  body.reduced = reduced;
  const auto wave = [](double size, Eigen::Index rows, Eigen::Index columns) {
    return MatrixX(MatrixX::NullaryExpr(
        rows, columns, [size](Eigen::Index i, Eigen::Index j) {
          return size * std::sin(1.3 * static_cast<double>(i + 3 * j) + 0.4);
        }));
  };
  const int count = count_coordinates(body);
  ASSERT_EQ(count, body.modes + 3);
  BodyLoad load;
  load.body = BodyIndex(0);
  load.history = {{0.0},
                  wave(3.0, 3, 1),
                  wave(0.5, 3, 1),
                  wave(0.5, 3, count),
                  wave(2.0, count, 1)};
  const Gap alone = find_gap(bodies.model, bodies.state, 0.004, 45);
  bodies.model.body_loads.push_back(load);
  const Gap gap = find_gap(bodies.model, bodies.state, 0.004, 45);
  EXPECT_LT(std::abs(gap.energy), 1e-12);
  EXPECT_NE(gap.dissipated, alone.dissipated);
}

// --- Failures ---------------------------------------------------------------

// --- Large turns ------------------------------------------------------------

TEST(EnergyConserving, TurnsChangeAsCayleysTransformDoes) {
  const Vector3 c(1.1, -2.3, 0.7);
  const auto cayley = [](const Vector3& of) {
    return Quaternion(1.0, 0.5 * of.x(), 0.5 * of.y(), 0.5 * of.z())
        .normalized();
  };
  constexpr double kSmall = 1e-5;
  Matrix3 differences;
  for (int i = 0; i < 3; ++i) {
    const auto turned = [&](double by) {
      const Quaternion q = cayley(c) * exp_quaternion(by * Vector3::Unit(i));
      return Vector3(2.0 / q.w() * q.vec());
    };
    differences.col(i) = (turned(kSmall) - turned(-kSmall)) / (2.0 * kSmall);
  }
  EXPECT_LT((cayley_jacobian_inverse(c) - differences).norm(), 1e-9);
}

// A free top, whose exact derivative the factors have. (With the derivative of
// the exponential map 1 rad took 20 iterations and 2 rad failed.)
TEST(EnergyConserving, ConvergesOnATopThatTurnsByRadiansAStep) {
  SystemBuilder builder;
  builder.add_rigid_body("top", {2.0, Vector3(1, 2, 2.5).asDiagonal()});
  const SystemModel model = builder.build();
  for (const double turn : {0.3, 1.0, 2.0}) {
    SystemState state = make_state(model);
    state.bodies[0].w_WB_B = Vector3(0.6, 0.5, 0.6) * turn;
    EnergyConserving scheme(model, {});
    const double energy = calc_energy(model, state).total();
    for (int i = 0; i < 5; ++i) {
      scheme.refresh();
      EXPECT_LE(scheme.step(state, 1.0, state.t + 1.0).iterations, 14) << turn;
    }
    EXPECT_NEAR(calc_energy(model, state).total(), energy, 1e-13 * energy);
  }
}

// A diverging rotation increment hardly changes the rotation, which must not be
// mistaken for convergence.
TEST(EnergyConserving, KeepsEnergyInEveryStepThatItCallsASuccess) {
  int successes = 0;
  for (const double stiffness : {1e3, 1e6, 1e9}) {
    for (const double turn : {0.3, 1.0, 3.0, 10.0, 100.0, 1e4}) {
      const FreeChain chain = make_free_chain(stiffness, turn, 0.1);
      SystemState state = chain.state;
      const double energy = calc_energy(chain.model, state).total();
      EnergyConserving scheme(chain.model, {});
      try {
        for (int i = 0; i < 5; ++i) {
          scheme.step(state, 1.0, state.t + 1.0);
          ++successes;
        }
      } catch (const NumericalError&) {  // NOLINT(bugprone-empty-catch)
        // An error is acceptable, a wrong result is not.
      }
      EXPECT_NEAR(calc_energy(chain.model, state).total(), energy,
                  1e-8 * energy)
          << stiffness << " " << turn;
    }
  }
  EXPECT_GT(successes, 0);
}

// Lengths decide when Newton's method ends; a mode's are over the root of its
// mass.
TEST(EnergyConserving, KeepsTheEnergyOfTheLightestBody) {
  for (const double mass : {1e-12, 4.0, 1e9}) {
    const auto cloud =
        testing::make_point_mass_body(24, 4, mass, 1.0, 60.0, 42);
    SystemBuilder builder;
    builder.add_flexible_body("cloud", testing::share(cloud), Fidelity::coupled,
                              {});
    const SystemModel model = builder.build();
    SystemState state = make_state(model);
    state.bodies[0].w_WB_B = Vector3(3.0, 1.0, -2.0);
    state.eta << 0.02, -0.01, 0.03, 0.01;
    state.etadot << 0.5, 0.3, -0.4, 1.0;
    state.eta *= std::sqrt(mass);
    state.etadot *= std::sqrt(mass);
    const double energy = calc_energy(model, state).total();
    EnergyConserving scheme(model, {});
    for (int i = 1; i <= 100; ++i) scheme.step(state, 0.02, 0.02 * i);
    EXPECT_NEAR(calc_energy(model, state).total() / energy, 1.0, 1e-12) << mass;
  }
}

// The first correction of a step does not tell whether corrections shrink: at
// 1e6 m one of 1e-8 m was called round-off.
TEST(EnergyConserving, VibratesAlikeWhereverTheBodyIs) {
  const auto vibrate = [](double place) {
    const auto cloud = testing::make_point_mass_body(24, 4, 4.0, 1.0, 60.0, 42);
    SystemBuilder builder;
    builder.add_flexible_body("cloud", testing::share(cloud), Fidelity::coupled,
                              {});
    const SystemModel model = builder.build();
    SystemState state = make_state(model);
    state.bodies[0].p_WB.x() = place;
    state.bodies[0].w_WB_B = Vector3(0.3, 0.1, -0.2);
    state.etadot << 0.01, -0.02, 0.01, 0.03;
    EnergyConserving scheme(model, {});
    for (int i = 1; i <= 100; ++i) scheme.step(state, 1e-4, 1e-4 * i);
    return state;
  };
  const SystemState near = vibrate(0.0);
  const SystemState far = vibrate(1e6);
  EXPECT_GT(near.eta.norm(), 1e-5);
  EXPECT_LT((far.eta - near.eta).norm(), 1e-12 * near.eta.norm());
  EXPECT_LT((far.etadot - near.etadot).norm(), 1e-12 * near.etadot.norm());
}

TEST(EnergyConserving, LeavesTheStateAsItWasWhenNewtonFails) {
  const FreeChain chain = make_free_chain(1e7, 1.0, 0.1);
  SystemState state = chain.state;
  EnergyConserving scheme(chain.model, {.max_iterations = 2});
  try {
    scheme.step(state, 0.5, 0.5);
    FAIL() << "two iterations were called enough";
  } catch (const NumericalError& error) {
    EXPECT_NE(std::string(error.what()).find("body 'link"), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("t = 0.5 s"), std::string::npos);
  }
  EXPECT_EQ(state.t, 0.0);
  EXPECT_EQ(state.etadot, chain.state.etadot);
  EXPECT_EQ(state.bodies[1].p_WB, chain.state.bodies[1].p_WB);
}

}  // namespace
}  // namespace limber::dynamics::energy_conserving_test
