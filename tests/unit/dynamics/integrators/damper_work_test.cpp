// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/integrators/damper_work.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "limber/dynamics/equations/energy.hpp"
#include "limber/dynamics/equations/equations.hpp"
#include "limber/dynamics/simulation/simulation.hpp"
#include "limber/dynamics/system/system_builder.hpp"
#include "limber/joints/joint_kind.hpp"
#include "support/point_mass_body.hpp"

namespace limber::dynamics::damper_work_test {
namespace {

struct Balance {
  double dissipated = 0.0;
  double open = 0.0;  ///< stored + dissipated - work since the start
};

Balance run(const SystemModel& model, SystemState state,
            const SimulationSettings& settings) {
  std::vector<EnergyBalance> energies;
  simulate(model, state, settings,
           [&](const SystemState&, const EnergyBalance& e) {
             energies.push_back(e);
           });
  const EnergyBalance& first = energies.front();
  const EnergyBalance& last = energies.back();
  return {last.dissipated,
          last.total() + last.dissipated - last.work - first.total()};
}

SimulationSettings make_settings(double end, double step, double rho_inf) {
  SimulationSettings settings;
  settings.end_time = end;
  settings.step = step;
  settings.output_times = {0.0, end};
  settings.rho_inf = rho_inf;
  return settings;
}

/// A clamped body of one mode of 50 rad/s, with this damping ratio.
SystemModel make_mode(double ratio) {
  testing::PointMassBody body =
      testing::make_point_mass_body(20, 1, 4.0, 1.0, 50.0, 1);
  body.reduced.clamped = true;
  SystemBuilder builder;
  builder.add_flexible_body("b", testing::share(body), Fidelity::coupled,
                            {.ratios = {ratio}});
  return builder.build();
}

// Change of the coordinate and rates at both ends of a step of 0.1 s -> what is
// added to the trapezoidal rule, over the damper's coefficient.
double find_addition(double change, double v0, double v1) {
  const SystemModel model = make_mode(0.2);
  SystemState from = make_state(model);
  from.etadot[0] = v0;
  SystemState to = from;
  to.eta[0] = change;
  to.etadot[0] = v1;
  SystemTerms terms = make_terms(model);
  calc_terms(model, from, Side::right, terms);
  DamperWork work(model);
  work.start(terms);
  calc_terms(model, to, Side::left, terms);
  VectorX losses = VectorX::Zero(1);
  work.advance(from, to, terms, 0.1, losses);
  return losses[0] / model.bodies[0].damping[0];
}

// mean(v) dz - h mean(v^2)
TEST(DamperWork, IsThatOfTheMeanForceAlongThePath) {
  EXPECT_NEAR(find_addition(0.2, 2.0, 2.0), 0.0, 1e-15);
  EXPECT_NEAR(find_addition(0.2, 1.0, 3.0), 2.0 * 0.2 - 0.1 * 5.0, 1e-15);
  // It swings to and fro and comes nowhere: nothing is taken.
  EXPECT_NEAR(find_addition(0.0, 2.0, -2.0), -0.1 * 4.0, 1e-15);
  EXPECT_NEAR(find_addition(1e-9, 2.0, 2.0), 2e-9 - 0.1 * 4.0, 1e-15);
  // Dampers give nothing back.
  EXPECT_NEAR(find_addition(-0.2, 2.0, 2.0), -0.1 * 4.0, 1e-15);
}

// Two bodies that turn fast together about a skew axis, on a bushing whose
// dampers act within far less than a step: the scheme leaves rates that differ
// by O(h^2), of which D v . v is far more than the energy there is.
TEST(DamperWork, OfStiffDampersOnTurningBodiesIsNoMoreThanTheyTake) {
  SystemBuilder builder;
  const Matrix3 J = Vector3(1.0, 2.0, 2.5).asDiagonal();
  const auto a = builder.add_rigid_body("a", {1.0, J});
  const auto b = builder.add_rigid_body("b", {2.0, 0.5 * J});
  builder.add_coupler(
      "weld",
      joints::make_joint_bushing(joints::JointKind::fixed, Vector3::UnitX(),
                                 {.translational_stiffness = 1e13,
                                  .rotational_stiffness = 1e13,
                                  .translational_damping = 1e8,
                                  .rotational_damping = 1e8}),
      builder.attach_frame("a", a, {Matrix3::Identity(), {0.5, 0, 0}}),
      builder.attach_frame("b", b, {Matrix3::Identity(), {-0.5, 0, 0}}));
  const SystemModel model = builder.build();
  SystemState state = make_state(model);
  const Vector3 spin(2.0, 3.0, 1.0);
  state.bodies[1].p_WB = Vector3(1, 0, 0);
  for (BodyState& body : state.bodies) {
    body.w_WB_B = spin;
    body.v_WB_W = spin.cross(body.p_WB);
  }
  const double energy = calc_energy(model, state).total();
  const Balance balance = run(model, state, make_settings(0.2, 0.01, 0.5));
  // As one rigid body, they lose nothing.
  EXPECT_GE(balance.dissipated, 0.0);
  EXPECT_LT(balance.dissipated, 0.01 * energy);
  EXPECT_LT(std::abs(balance.open), 0.01 * energy);
}

}  // namespace
}  // namespace limber::dynamics::damper_work_test
