// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>

#include "limber/dynamics/equations/node_motion.hpp"
#include "limber/dynamics/simulation/simulation.hpp"
#include "support/lattice_chain.hpp"

/// Level `full` against the coupled equations for the same body.
namespace limber::dynamics::full_against_coupled_test {
namespace {

using testing::kAllModes;
using testing::LatticeChain;

/// Motion of the tip, its other end held by the world, struck there for 5 ms.
std::vector<Vector3> strike(Fidelity fidelity, int modes, double force) {
  LatticeChain chain;
  chain.add(fidelity, modes);
  chain.join_world(1e6, 0.0);
  const AttachmentIndex tip = chain.last_end();
  chain.builder.add_load("strike", tip, {force, 0.5 * force, 0.0},
                         {0.0, 0.0, 0.01 * force}, LoadFrame::world,
                         Pulse{PulseShape::half_sine, 0.0, 0.005});
  const SystemModel model = chain.build();
  SystemState state = make_state(model);
  place_nodes(model, {}, {}, state);
  std::vector<double> times;
  for (int i = 0; i <= 40; ++i) times.push_back(5e-4 * i);
  std::vector<Vector3> tips;
  simulate(model, state,
           {.end_time = 0.02, .step = 1e-4, .output_times = times},
           [&](const SystemState& now, const EnergyBalance&) {
             tips.push_back(find_frame_motion(model, now, tip).X_WF.p);
           });
  const Vector3 start = tips.front();
  for (Vector3& p : tips) p -= start;
  return tips;
}

double find_difference(const std::vector<Vector3>& a,
                       const std::vector<Vector3>& b) {
  double worst = 0.0;
  double largest = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    worst = std::max(worst, (a[i] - b[i]).norm());
    largest = std::max(largest, a[i].norm());
  }
  return worst / largest;
}

TEST(FullAgainstCoupled, SmallMotionIsThatOfManyModes) {
  constexpr double kForce = 0.1;  // [N]: displacements of some micrometres
  const std::vector<Vector3> full = strike(Fidelity::full, 3, kForce);
  std::vector<double> errors;
  for (const int modes : {3, 12, kAllModes}) {
    errors.push_back(
        find_difference(full, strike(Fidelity::coupled, modes, kForce)));
  }
  EXPECT_GT(errors[0], 0.02);
  EXPECT_LT(errors[1], 0.5 * errors[0]);
  EXPECT_LT(errors[2], 1e-4);  // strains are some 1e-5
}

TEST(FullAgainstCoupled, AllModesLeaveADifferenceThatFallsWithTheLoad) {
  std::vector<double> errors;
  for (const double force : {1.0, 0.1}) {
    errors.push_back(
        find_difference(strike(Fidelity::full, 3, force),
                        strike(Fidelity::coupled, kAllModes, force)));
  }
  EXPECT_NEAR(std::log10(errors[0] / errors[1]), 1.0, 0.2);
}

// Large rotation, small deformation: the coupled equations against the nodes.
// Deformation grows with the spin squared, what is not linear in it with its
// fourth power.
TEST(FullAgainstCoupled, TumblesAsItDoesWithAllModes) {
  std::vector<double> turns;
  std::vector<double> deformations;
  for (const double spin : {20.0, 10.0}) {
    std::vector<SystemState> ends;
    MatrixX u_B(48, 2);
    for (const Fidelity fidelity : {Fidelity::full, Fidelity::coupled}) {
      LatticeChain chain;
      chain.add(fidelity);
      const SystemModel model = chain.build();
      SystemState state =
          chain.place(model, 0.0, spin * Vector3(1.0, 0.1, 0.25), 0.0);
      simulate(model, state,
               {.integrator = IntegratorKind::runge_kutta_4,
                .end_time = 0.04,
                .step = 2e-5},
               {});
      const bool is_full = fidelity == Fidelity::full;
      calc_node_deformations(model, BodyIndex(0), {&state, 1},
                             u_B.col(is_full ? 0 : 1));
      ends.push_back(state);
    }
    deformations.push_back((u_B.col(0) - u_B.col(1)).norm());
    turns.push_back(
        ends[0].bodies[0].quat_WB.angularDistance(ends[1].bodies[0].quat_WB));
    EXPECT_GT(u_B.col(1).norm(), 1e-7 * spin * spin);
    EXPECT_LT(deformations.back(), 0.05 * u_B.col(1).norm());
  }
  EXPECT_NEAR(std::log2(deformations[0] / deformations[1]), 4.0, 0.5);
  EXPECT_GT(std::log2(turns[0] / turns[1]), 4.0);
}

}  // namespace
}  // namespace limber::dynamics::full_against_coupled_test
