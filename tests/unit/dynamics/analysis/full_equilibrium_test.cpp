// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>

#include "limber/dynamics/analysis/equilibrium.hpp"
#include "limber/dynamics/simulation/simulation.hpp"
#include "support/lattice_chain.hpp"

/// Equilibria of a body at level `full` that nothing but a joint holds.
namespace limber::dynamics::full_equilibrium_test {
namespace {

using testing::LatticeChain;

/// A lattice of 0.3 m along z on a joint, pulled across at its far end.
struct HeldLattice {
  HeldLattice(Fidelity level, double stiffness, const Vector3& force,
              double damping = 0.0) {
    LatticeChain chain;
    chain.add(level, testing::kAllModes, {.ratios = {damping}});
    chain.join_world(stiffness, damping > 0.0 ? 0.01 * stiffness : 0.0);
    tip = chain.last_end();
    chain.builder.add_load("pull", tip, force, Vector3::Zero(),
                           LoadFrame::world, TimeFunction{});
    model = chain.build();
    start = make_state(model);
    place_nodes(model, {}, {}, start);
  }
  [[nodiscard]] Vector3 find_tip(const SystemState& state) const {
    return find_frame_motion(model, state, tip).X_WF.p;
  }
  [[nodiscard]] Vector3 find_deflection(
      const EquilibriumSettings& settings = {}) const {
    return find_tip(find_equilibrium(model, start, settings).state) -
           find_tip(start);
  }
  AttachmentIndex tip;
  SystemModel model;
  SystemState start;
};

constexpr double kStiffest = 1e10;

// All modes leave nothing out: what differs is of second order in the bending.
TEST(FullEquilibrium, OnAJointOfAnyStiffnessIsThatOfAllModesAtSmallLoads) {
  for (const double stiffness : {10.0, 1e4, 1e7, kStiffest}) {
    for (const double force : {1e-6, 1e-3}) {
      const Vector3 pull(force, 0.3 * force, 0.2 * force);
      const Vector3 full =
          HeldLattice(Fidelity::full, stiffness, pull).find_deflection();
      const Vector3 modes =
          HeldLattice(Fidelity::coupled, stiffness, pull).find_deflection();
      EXPECT_GT(modes.norm(), 1e-5 * force);
      // Of a position, to round-off of a joint's wrench; and the bend's.
      const double limit = 1e-15 + (1e-7 + 30.0 * modes.norm()) * modes.norm();
      EXPECT_LT((full - modes).norm(), limit) << stiffness << ' ' << force;
    }
  }
}

TEST(FullEquilibrium, OnAJointIsTheSameByBothMethods) {
  const HeldLattice lattice(Fidelity::full, 1e6, {20.0, 10.0, 0.0});
  EquilibriumSettings relaxation;
  relaxation.method = EquilibriumMethod::relaxation;
  relaxation.relaxation_steps = 1000;
  const Vector3 a = lattice.find_deflection();
  EXPECT_GT(a.norm(), 1e-3);
  EXPECT_LT((a - lattice.find_deflection(relaxation)).norm(), 1e-9 * a.norm());
}

// Implicit Euler's steps with dampers end where the equations of motion have
// no velocity left; a bend of a third of the length, pulled in compression.
TEST(FullEquilibrium, FarAwayIsWhereADampedMotionEnds) {
  for (const double along : {-60.0, 0.0, 200.0}) {
    const HeldLattice lattice(Fidelity::full, 1e4, {300.0, 120.0, along}, 0.5);
    SystemState state = lattice.start;
    simulate(lattice.model, state,
             {.integrator = IntegratorKind::implicit_euler,
              .end_time = 4.0,
              .step = 2e-3},
             {});
    ASSERT_LT(state.udot_H.norm(), 1e-9);
    const Vector3 settled =
        lattice.find_tip(state) - lattice.find_tip(lattice.start);
    EXPECT_GT(settled.norm(), 0.05);
    EXPECT_LT((lattice.find_deflection() - settled).norm(),
              1e-7 * settled.norm())
        << along;
  }
}

}  // namespace
}  // namespace limber::dynamics::full_equilibrium_test
