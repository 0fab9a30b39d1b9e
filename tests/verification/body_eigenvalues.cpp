// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "limber/reduction/reduce.hpp"
#include "places.hpp"
#include "verification/body_reference.hpp"

namespace limber::body_eigenvalues {
namespace {

/// The reference's printed digits and both programs' roundoff.
constexpr double kSameMesh = 1e-8;
/// The allowance for a mesh whose inner nodes sit elsewhere.
constexpr double kOtherMesh = 0.0025;

void expect_eigenvalues(const flexbody::ReducedBody& body,
                        const std::vector<double>& expected, std::size_t count,
                        double tolerance) {
  ASSERT_GE(expected.size(), count);
  ASSERT_GE(static_cast<std::size_t>(body.lambda.size()), count);
  for (std::size_t i = 0; i < count; ++i)
    EXPECT_NEAR(body.lambda[static_cast<Eigen::Index>(i)] / expected[i], 1.0,
                tolerance)
        << "mode " << i + 1;
}

struct Case {
  std::string file;
  std::string mesh;
};
void PrintTo(const Case& c, std::ostream* out) { *out << c.file; }
class BodyEigenvalues : public ::testing::TestWithParam<Case> {};

TEST_P(BodyEigenvalues, MatchTheIndependentProgramFree) {
  const auto body = flexbody::reduce(test::beam_recipe(GetParam().file));
  EXPECT_NEAR(body.mass, 40000.0, 1e-5);
  expect_eigenvalues(body,
                     test::reference_eigenvalues(GetParam().mesh, "free", 5),
                     20, kSameMesh);
}

TEST_P(BodyEigenvalues, MatchTheIndependentProgramClamped) {
  const auto body = flexbody::reduce(test::beam_recipe(GetParam().file, true));
  EXPECT_TRUE(body.clamped);
  expect_eigenvalues(body,
                     test::reference_eigenvalues(GetParam().mesh, "clamped", 5),
                     20, kSameMesh);
}

INSTANTIATE_TEST_SUITE_P(Beam, BodyEigenvalues,
                         ::testing::Values(Case{"beam579_v41.msh", "beam579"},
                                           Case{"beam579_v22.msh", "beam579"},
                                           Case{"beam5k_v41.msh", "beam5k"}),
                         [](const auto& named) {
                           const std::string& file = named.param.file;
                           const std::string stem =
                               file.substr(0, file.find('.'));
                           return stem.substr(0, stem.find('_')) +
                                  stem.substr(stem.find('_') + 1);
                         });

TEST(BodyOfBox, MeshedBySizeHasTheReportsCountsAndTable) {
  for (const std::string support : {"free", "clamped"}) {
    flexbody::Recipe recipe = test::beam_recipe("", support == "clamped");
    recipe.mesh.file = std::string(LIMBER_SOURCE_DIR) + "/meshes/box/box.geo";
    recipe.mesh.size = 0.55;
    recipe.mesh.order = 2;
    const auto body = flexbody::reduce(recipe);
    EXPECT_EQ(body.mesh_nodes, 579U);
    EXPECT_EQ(body.mesh_elements, 254U);
    EXPECT_EQ(body.mesh_boundary_nodes, 426U);
    const auto table = test::reference_eigenvalues("beam579", support, 8);
    ASSERT_FALSE(table.empty());
    expect_eigenvalues(body, table, table.size(), kOtherMesh);
  }
}

TEST(BodyBasis, IsOrthonormalAndFreeOfRigidMotion) {
  flexbody::Recipe recipe = test::beam_recipe("beam579_v41.msh");
  recipe.rows = flexbody::parse_rows({"all"});
  recipe.interfaces = {{"root", flexbody::GroupNodes{"root"}},
                       {"tip", flexbody::GroupNodes{"tip"}}};
  const auto body = flexbody::reduce(recipe);
  ASSERT_EQ(body.mode_count(), 32);
  constexpr double kRoundoff = 1e-10;
  const auto& S = body.integrals;
  for (std::size_t k = 0; k < 32; ++k) {
    // No angular momentum about the mean-axis frame: S1 is symmetric.
    const double scale = std::sqrt(S.S0.trace());
    EXPECT_LT((S.S1[k] - S.S1[k].transpose()).norm() / scale, kRoundoff);
    for (std::size_t l = 0; l < 32; ++l)
      EXPECT_NEAR(S.S2[k * 32 + l].trace(), k == l ? 1.0 : 0.0, kRoundoff);
  }
}

}  // namespace
}  // namespace limber::body_eigenvalues
