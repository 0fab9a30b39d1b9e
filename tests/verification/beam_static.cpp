// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "limber/dynamics/simulation/simulation.hpp"
#include "limber/dynamics/system/system_builder.hpp"
#include "limber/reduction/reduce.hpp"
#include "verification/body_reference.hpp"

/// The report's beam clamped at its root, 500 N across its tip: the
/// static-deformation mode of the load alone is the exact solution.
namespace limber::beam_static {
namespace {

/// Displacement of the tip's area mean along x per 500 N.
double deflect(const std::string& mesh, int eigenmodes) {
  flexbody::Recipe recipe = test::beam_recipe(mesh, true);
  recipe.basis.eigenmodes = eigenmodes;
  recipe.interfaces = {{"tip", flexbody::GroupNodes{"tip"},
                        flexbody::Weighting::uniform, false}};
  recipe.load_patterns = {{"tip", Vector3::UnitX(), Vector3::Zero()}};
  const auto body = flexbody::reduce(recipe);
  EXPECT_EQ(body.lambda.size(), eigenmodes + 1);
  const VectorX f = 500.0 * body.interfaces[0].Phi_B.row(0).transpose();
  const VectorX eta = f.cwiseQuotient(body.lambda);
  return body.interfaces[0].Phi_B.row(0).dot(eta);
}

// tests/data/beam/static.csv, "own", lin, areamean_ux.
TEST(ClampedBeam, DeflectsAsTheWholeFiniteElementModelDoes) {
  EXPECT_NEAR(deflect("beam579_v41.msh", 0), 1.27901468831e-06, 1e-8 * 1.3e-6);
  EXPECT_NEAR(deflect("beam579_v41.msh", 10), 1.27901468831e-06, 1e-8 * 1.3e-6);
  EXPECT_NEAR(deflect("beam5k_v41.msh", 0), 1.28003370433e-06, 1e-8 * 1.3e-6);
}

/// The beam under its own weight across its length, critically damped until
/// it rests: deflection of the tip along gravity.
double sag(double gravity) {
  flexbody::Recipe recipe = test::beam_recipe("beam579_v41.msh", true);
  recipe.interfaces = {{"tip", flexbody::GroupNodes{"tip"},
                        flexbody::Weighting::uniform, false}};
  const auto body =
      std::make_shared<const flexbody::ReducedBody>(flexbody::reduce(recipe));
  dynamics::SystemBuilder builder;
  builder.add_flexible_body(
      "beam", body, dynamics::Fidelity::coupled,
      {.rayleigh_mass = 0.0, .rayleigh_stiffness = 0.0, .ratios = {1.0}});
  builder.set_gravity({gravity, 0.0, 0.0});
  const dynamics::SystemModel model = builder.build();
  dynamics::SystemState state = make_state(model);
  simulate(model, state, {.end_time = 0.5, .step = 1e-3, .output_times = {}},
           {});
  return body->interfaces[0].Phi_B.row(0).dot(state.eta);
}

// Timoshenko: q L^4 / (8 E I) + q L^2 / (2 kappa G A), kappa = 5/6, good to a
// few tenths of a per cent for a beam as thick as this.
TEST(ClampedBeam, SagsUnderItsWeightAsTimoshenkosTheorySays) {
  const double q = 8000.0 * 9.81;
  const double expected =
      q * 625.0 / (8.0 * 200e9 / 12.0) + q * 25.0 / (2.0 * (5.0 / 6.0) * 100e9);
  EXPECT_NEAR(sag(9.81), expected, 0.005 * expected);
}

}  // namespace
}  // namespace limber::beam_static
