// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <string>

#include "limber/common/errors.hpp"
#include "limber/fem/mesh/mesh_reader.hpp"
#include "limber/fem/mesh/node_weights.hpp"
#include "limber/fem/solid/static_solid.hpp"
#include "verification/body_reference.hpp"

/// The beam clamped at its root and bent by a fifth of its length: 4e8 N of
/// dead traction across its tip. tests/data/beam/static.csv, nlgeom.
namespace limber::solid_static_slow {
namespace {

struct Bent {
  Vector3 tip = Vector3::Zero();     ///< mean displacement over its area [m]
  Vector3 corner = Vector3::Zero();  ///< of (0, 0, 5) [m]
};

Bent bend(const std::string& file, double force, int load_steps) {
  const fem::Mesh mesh = fem::read_mesh(test::beam_file(file));
  const auto& root = mesh.groups[fem::find_group(mesh, "root")];
  const fem::WeightedNodes tip =
      fem::weigh_group(mesh, mesh.groups[fem::find_group(mesh, "tip")]);
  Matrix3X load = Matrix3X::Zero(3, mesh.x.cols());
  for (std::size_t i = 0; i < tip.nodes.size(); ++i) {
    load(0, tip.nodes[i]) = force * tip.weights[static_cast<Eigen::Index>(i)];
  }
  const fem::StaticSolution solution = fem::solve_static(
      mesh, {{200e9, 0.0, 8000.0}}, fem::Elasticity::st_venant_kirchhoff, load,
      root.nodes, {.load_steps = load_steps});
  Bent bent;
  for (std::size_t i = 0; i < tip.nodes.size(); ++i) {
    bent.tip += tip.weights[static_cast<Eigen::Index>(i)] *
                Vector3(solution.u.col(tip.nodes[i]));
  }
  bent.corner = solution.u.col(fem::find_nearest_node(mesh, {0.0, 0.0, 5.0}));
  return bent;
}

TEST(SolidStatic, BendsByAFifthOfItsLengthAsTheReferenceDoes) {
  const Bent bent = bend("beam579_v41.msh", 4e8, 8);
  const Vector3 tip(0.985989683796, -1.20123498922e-06, -0.118222457447);
  const Vector3 corner(1.00755363446, 4.70524153495e-06, 0.0256867792947);
  EXPECT_LT((bent.tip - tip).norm(), 1e-9);
  EXPECT_LT((bent.corner - corner).norm(), 1e-9);
}

TEST(SolidStatic, AgreesWithTheReferenceOnAFinerMeshWhateverTheLoadSteps) {
  const Vector3 tip(0.986767706894, 4.82438522614e-07, -0.118375274806);
  EXPECT_LT((bend("beam5k_v41.msh", 4e8, 6).tip - tip).norm(), 1e-9);
}

TEST(SolidStatic, ASmallLoadHasTheLinearAnswer) {
  // own, lin; the quadratic fraction of 500 N is some 1e-6 of it.
  EXPECT_NEAR(bend("beam579_v41.msh", 500.0, 1).tip.x(), 1.27901468831e-06,
              2e-6 * 1.279e-6);
}

TEST(SolidStatic, ALoadBeyondAllReasonEndsWithTheShareReached) {
  try {
    (void)bend("beam579_v41.msh", 1e13, 2);
    FAIL() << "1e13 N were borne";
  } catch (const NumericalError& error) {
    EXPECT_NE(std::string(error.what()).find("of the load"), std::string::npos);
  }
}

}  // namespace
}  // namespace limber::solid_static_slow
