// SPDX-License-Identifier: BSD-3-Clause
// Not built under sanitizers (support/allocation_count.hpp).
#include <gtest/gtest.h>

#include "limber/contact/shapes/shape_pair.hpp"
#include "limber/contact/shapes/skin.hpp"
#include "support/allocation_count.hpp"
#include "unit/contact/shapes/surfaces.hpp"

namespace limber::contact {
namespace {

TEST(Allocation, OfContactIsCounted) {
  const long before = limber::testing::allocations;
  const Skin skin(testing::make_ball_surface(1.0, 0, true));
  EXPECT_GT(limber::testing::allocations - before, 10);
}

TEST(Allocation, FindingWhereShapesMeetMakesNone) {
  auto surface = testing::make_ball_surface(1.0, 2, true);
  testing::set_modes(surface, testing::make_fields());
  const Shape skin{std::make_shared<const Skin>(surface), {}};
  const Shape capsule{Capsule{0.4, 0.5}, {}};
  const VectorX eta = VectorX::Constant(4, 0.05);
  const joints::PairBody A{.p_WB = {0, 0, 0.9}, .modes = 4, .eta = eta.data()};
  const joints::PairBody B;
  Matrix3X Phi(3, 4);
  for (const ShapePair& pair :
       {ShapePair(skin, {Sphere{0.3}, {}}), ShapePair(skin, {HalfSpace{}, {}}),
        ShapePair(capsule, capsule)}) {
    std::vector<Meeting> out(pair.most_points());
    double deepest = -1e9;
    double clearance = 1e9;
    const long before = limber::testing::allocations;
    pair.find({A, B}, 0.1, out);
    for (const Meeting& m : out) {
      if (m.depth > deepest) set_shape_functions(pair.A(), m.on_A, Phi);
      deepest = std::max(deepest, m.depth);
    }
    clearance = pair.find_clearance({A, B}) + 0.0 * find_extent(pair.A(), A);
    EXPECT_EQ(limber::testing::allocations - before, 0);
    EXPECT_GT(deepest, -0.2);
    EXPECT_LT(clearance, 0.2);
  }
}

}  // namespace
}  // namespace limber::contact
