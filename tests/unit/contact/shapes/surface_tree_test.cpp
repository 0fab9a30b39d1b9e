// SPDX-License-Identifier: BSD-3-Clause
#include "limber/contact/shapes/surface_tree.hpp"

#include <gtest/gtest.h>

#include <random>
#include <set>

#include "limber/contact/shapes/mesh_surface.hpp"
#include "unit/contact/shapes/surfaces.hpp"

namespace limber::contact::surface_tree_test {
namespace {

// Points of every face, as deformed, by the sum of nodes itself.
TEST(SurfaceTree, BoxesHoldTheirFacesHoweverTheyDeform) {
  auto surface = test::make_ball_surface(0.8, 1, true);
  test::set_modes(surface, test::make_fields());
  const SurfaceTree tree(surface.faces, surface.x_B, surface.Phi_B);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> draw(-1.0, 1.0);
  for (int trial = 0; trial < 5; ++trial) {
    VectorX eta(4);
    for (double& value : eta) value = draw(random);
    const MatrixX x =
        surface.x_B + (surface.Phi_B * eta).reshaped(3, surface.x_B.cols());
    std::set<int> seen;
    std::vector<int> nodes = {0};
    while (!nodes.empty()) {
      const int i = nodes.back();
      nodes.pop_back();
      const SurfaceTree::Box box = tree.find_box(i, test::view(eta));
      for (const int f : tree.find_faces(tree.node(i))) {
        if (tree.node(i).is_leaf()) seen.insert(f);
        for (double u = 0.0; u <= 1.0; u += 0.125) {
          for (double v = 0.0; u + v <= 1.0; v += 0.125) {
            const auto weights = find_shape_functions({u, v}, false);
            Vector3 p = Vector3::Zero();
            for (std::size_t k = 0; k < 6; ++k) {
              p += weights[k] * x.col(surface.faces[index(f)][k]);
            }
            EXPECT_EQ(box.find_square_distance(p), 0.0);
          }
        }
      }
      if (tree.node(i).is_leaf()) continue;
      nodes.push_back(i + 1);
      nodes.push_back(tree.node(i).right);
    }
    EXPECT_EQ(seen.size(), surface.faces.size());
  }
}

TEST(SurfaceTree, BoxesOfAWholeDeformationAreTight) {
  auto surface = test::make_ball_surface(1.0, 1, false);
  test::set_modes(surface, {[](const Vector3&) { return Vector3(1, 2, 3); }});
  const SurfaceTree tree(surface.faces, surface.x_B, surface.Phi_B);
  const VectorX eta = VectorX::Constant(1, 10.0);
  const VectorX still = VectorX::Zero(1);
  const auto box = tree.find_box(0, test::view(eta));
  const auto before = tree.find_box(0, test::view(still));
  EXPECT_LT((box.centre - before.centre - Vector3(10, 20, 30)).norm(), 1e-12);
  EXPECT_LT((box.half - before.half).norm(), 1e-9);
}

}  // namespace
}  // namespace limber::contact::surface_tree_test
