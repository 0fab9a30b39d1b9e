// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <string>

#include "flexbody/reduce.hpp"
#include "verification/body_reference.hpp"

/// The report's beam clamped at its root, 500 N across its tip: the
/// static-deformation mode of the load alone is the whole answer.
namespace limber {
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

}  // namespace
}  // namespace limber
