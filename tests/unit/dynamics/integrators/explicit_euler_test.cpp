// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/integrators/explicit_euler.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "limber/dynamics/simulation/simulation.hpp"
#include "support/chain.hpp"
#include "support/point_mass_body.hpp"

namespace limber::dynamics::explicit_euler_test {
namespace {

using testing::make_point_mass_body;
using testing::share;

SystemState run(const SystemModel& model, SystemState state, double end,
                double step) {
  simulate(model, state,
           {.integrator = IntegratorKind::explicit_euler,
            .end_time = end,
            .step = step,
            .output_times = {}},
           {});
  return state;
}

// Torque-free asymmetric top, I = (1, 2, 3), from (0.01, 1, 0): Jacobi
// elliptic functions give Omega(20).
TEST(ExplicitEuler, AsymmetricTopConvergesAtFirstOrderToTheClosedForm) {
  SystemBuilder builder;
  builder.add_rigid_body("top", {2.0, Vector3(1, 2, 3).asDiagonal()});
  const SystemModel model = builder.build();
  const Vector3 expected(0.010964161, -0.999989894, -0.002595690);
  std::vector<double> errors;
  for (const double h : {4e-4, 2e-4, 1e-4}) {
    SystemState state = make_state(model);
    state.bodies[0].w_WB_B = Vector3(0.01, 1.0, 0.0);
    errors.push_back(
        (run(model, state, 20.0, h).bodies[0].w_WB_B - expected).norm());
  }
  EXPECT_NEAR(std::log2(errors[0] / errors[1]), 1.0, 0.1);
  EXPECT_NEAR(std::log2(errors[1] / errors[2]), 1.0, 0.1);
}

// Modes under a constant load, at any step: eta = f (1 - cos(w t)) / w^2.
TEST(ExplicitEuler, IsExactForModesUnderAConstantLoad) {
  const auto body = make_point_mass_body(12, 3, 5.0, 1.0, 50.0, 4);
  SystemBuilder builder;
  const auto b =
      builder.add_flexible_body("b", share(body), Fidelity::uncoupled, {});
  MatrixX forces = MatrixX::Zero(36, 1);
  forces(5, 0) = 700.0;
  const auto load = flexbody::reduce_nodal_load(body.reduced, {0.0}, forces);
  builder.add_nodal_load("f", b, load);
  const SystemModel model = builder.build();
  const double end = 0.37;
  for (const double h : {0.37, 0.05}) {
    const SystemState state = run(model, make_state(model), end, h);
    for (int k = 0; k < 3; ++k) {
      const double lambda = body.reduced.lambda[k];
      const double expected =
          load.modal(k, 0) * (1.0 - std::cos(std::sqrt(lambda) * end)) / lambda;
      EXPECT_NEAR(state.eta[k], expected, 1e-14 + 1e-12 * std::abs(expected));
    }
  }
}

// Constant force: p = F t^2 / (2 m), for any step.
TEST(ExplicitEuler, IsExactForTranslationUnderAConstantForce) {
  SystemBuilder builder;
  builder.add_rigid_body("b", {4.0, Matrix3::Identity()});
  builder.set_gravity({0.0, 0.0, -9.81});
  const SystemModel model = builder.build();
  const SystemState state = run(model, make_state(model), 2.0, 0.25);
  EXPECT_NEAR(state.bodies[0].p_WB.z(), -9.81 * 2.0, 1e-12);
  EXPECT_NEAR(state.bodies[0].v_WB_W.z(), -9.81 * 2.0, 1e-12);
}

}  // namespace
}  // namespace limber::dynamics::explicit_euler_test
