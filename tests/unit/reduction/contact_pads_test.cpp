// SPDX-License-Identifier: BSD-3-Clause

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "limber/common/dense/symmetric_eigen.hpp"
#include "limber/fem/mesh/node_weights.hpp"
#include "limber/reduction/contact_groups.hpp"
#include "limber/reduction/contact_patches.hpp"
#include "limber/reduction/contact_surface.hpp"
#include "limber/reduction/reduce.hpp"
#include "unit/reduction/bar.hpp"

/// Pads at the end of a bar, against the rod's closed form and the uniform
/// pressure on the whole face.
namespace limber::flexbody::contact_pads_test {
namespace {

using testing::Bar;
using testing::make_recipe;

constexpr double kPi = std::numbers::pi;

struct Rod {
  Bar bar{
      .size = {1.0, 0.01, 0.01}, .cells = 40, .material = {210e9, 0.0, 7850.0}};
  MeshedBody body{make_recipe(bar), {}};
  fem::Surface tip = fem::make_surface(
      body.mesh,
      find_contact_groups(body.mesh, {"tip"}, {{210e9, 0.0, 7850.0}})[0].faces);

  [[nodiscard]] ContactPads make_pads(int modes) const {
    const std::vector<int>& nodes = body.support.free_nodes;
    MatrixX fields = MatrixX::Zero(3 * std::ssize(nodes), modes);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      for (int n = 1; n <= modes; ++n)
        fields(3 * static_cast<Eigen::Index>(i), n - 1) =
            std::cos(n * kPi * body.mesh.x(0, nodes[i]));
    }
    const ReducedBasis basis = make_reduced_basis(fields, body.support, 1e-8);
    return make_contact_pads(body, tip, find_normals(body.mesh, tip), basis,
                             basis.Phi, Vector3::Zero());
  }
};

TEST(ContactPads, GiveWayUnderUniformPressureAsTheRodDoes) {
  const Rod rod;
  double expected = 1.0 / 3.0;
  for (int m = 0; m <= 5; ++m) {
    if (m > 0) expected -= 2.0 / (kPi * kPi * m * m);
    const ContactPads pads = rod.make_pads(m);
    const VectorX share = pads.area / pads.area.sum();
    const double R = share.dot(pads.flexibility * share);
    EXPECT_NEAR(R * 210e9 * 1e-4 / expected, 1.0, 1e-3) << m;
  }
}

TEST(ContactPads, ShareTheFaceAndItsUniformPressure) {
  const Rod rod;
  srand(1);
  const MatrixX Phi = MatrixX::Random(3 * rod.body.mesh.x.cols(), 2);
  const ContactPads pads =
      make_contact_pads(rod.body, rod.tip, find_normals(rod.body.mesh, rod.tip),
                        {VectorX(0), MatrixX(3 * rod.body.mesh.x.cols(), 0)},
                        Phi, Vector3::Zero());
  ASSERT_EQ(pads.count(), 4);
  EXPECT_LT((pads.area - VectorX::Constant(4, 0.25e-4)).norm(), 1e-16);
  EXPECT_LT((pads.normal_B - Vector3::UnitX()).norm(), 1e-12);
  const fem::WeightedNodes all = fem::weigh_group(
      rod.body.mesh,
      rod.body.mesh.groups[fem::find_group(rod.body.mesh, "tip")]);
  MatrixX expected = MatrixX::Zero(3, 2);
  for (std::size_t i = 0; i < all.nodes.size(); ++i) {
    expected += all.weights[static_cast<Eigen::Index>(i)] *
                Phi.middleRows<3>(3 * all.nodes[i]);
  }
  MatrixX mean = MatrixX::Zero(3, 2);
  for (Eigen::Index i = 0; i < 4; ++i) {
    mean += pads.area[i] / pads.area.sum() * pads.Phi_B.middleRows<3>(3 * i);
  }
  EXPECT_LT((mean - expected).norm(), 1e-12);
}

// The energy of any load on the pads is what the basis leaves out of it.
TEST(ContactPads, HaveASymmetricFlexibilityWithoutNegativeEnergy) {
  const Rod rod;
  const MatrixX R = rod.make_pads(5).flexibility;
  EXPECT_LT((R - R.transpose()).norm(), 1e-12 * R.norm());
  EXPECT_GT(dense::find_eigenvalues(R)[0], 0.0);
}

TEST(ContactPads, BelongToFlatSurfacesAlone) {
  Recipe recipe = make_recipe({.size = {0.1, 0.04, 0.03}, .cells = 10});
  recipe.basis.eigenmodes = 4;
  recipe.basis.interface_modes = false;
  recipe.contact_groups = {"tip", "skin"};
  const ReducedBody body = reduce(recipe);
  EXPECT_EQ(body.contact_surfaces[0].pads.count(), 4);
  EXPECT_EQ(body.contact_surfaces[0].pads.Phi_B.cols(), 4);
  EXPECT_EQ(body.contact_surfaces[1].pads.count(), 0);
}

}  // namespace
}  // namespace limber::flexbody::contact_pads_test
