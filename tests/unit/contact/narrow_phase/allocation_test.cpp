// SPDX-License-Identifier: BSD-3-Clause
// Not built under sanitizers (support/allocation_count.hpp).
#include <gtest/gtest.h>

#include <limits>

#include "limber/contact/contact_pair.hpp"
#include "limber/contact/narrow_phase/shape_pair.hpp"
#include "limber/contact/shapes/skin.hpp"
#include "support/allocation_count.hpp"
#include "unit/contact/shapes/surfaces.hpp"

namespace limber::contact::allocation_test {
namespace {

TEST(Allocation, OfContactIsCounted) {
  const long before = limber::testing::allocations;
  const Skin skin(test::make_ball_surface(1.0, 0, true));
  EXPECT_GT(limber::testing::allocations - before, 10);
}

TEST(Allocation, FindingWhereShapesMeetMakesNone) {
  auto surface = test::make_ball_surface(1.0, 2, true);
  test::set_modes(surface, test::make_fields());
  const Shape skin{std::make_shared<const Skin>(surface), {}};
  const VectorX eta = VectorX::Constant(4, 0.05);
  const joints::PairBody A{.p_WB = {0, 0, 0.9}, .modes = 4, .eta = eta.data()};
  const joints::PairBody B;
  Matrix3X Phi(3, 4);
  for (const ShapePair& pair :
       {ShapePair(skin, {Sphere{0.3}, {}}), ShapePair(skin, {HalfSpace{}, {}}),
        ShapePair(skin, {Box{{0.3, 0.3, 0.3}}, {}})}) {
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

// A plane under a ball of more nodes than it may meet, and under the pads of a
// flat sheet.
TEST(Allocation, EvaluatingASkinOnAPlaneMakesNone) {
  auto ball = test::make_ball_surface(1.0, 2, true);
  auto sheet = test::make_sheet_surface(1.0, 4, false,
                                        [](double, double) { return 0.0; });
  for (flexbody::ContactSurface* surface : {&ball, &sheet}) {
    test::set_modes(*surface, test::make_fields());
  }
  sheet.pads.normal_B = -Vector3::UnitZ();
  sheet.pads.x_B = sheet.x_B;
  sheet.pads.Phi_B = sheet.Phi_B;
  sheet.pads.area = VectorX::Constant(sheet.x_B.cols(), 0.16);
  sheet.pads.flexibility = 1e-9 * MatrixX::Identity(25, 25);
  const VectorX eta = VectorX::Constant(4, 0.001);
  const joints::PairBody plane;
  for (const auto& surface : {ball, sheet}) {
    const ContactSide above{Shape{std::make_shared<const Skin>(surface), {}},
                            SurfaceMaterial{2e11, 0.3}, 1.0};
    const ContactSide below{Shape{HalfSpace{}, {}}, std::nullopt,
                            std::numeric_limits<double>::infinity()};
    const ContactPair pair(below, above, {.friction = {.sliding = 0.3}});
    joints::PairResponse out(pair.most_points(), 0, 4, pair.couples_points());
    std::vector<double> memory(pair.memory_size(), 0.0);
    const joints::PairBody body{
        .p_WB = {0.0, 0.0, surface.pads.count() > 0 ? -0.05 : 0.8},
        .modes = 4,
        .eta = eta.data(),
        .etadot = eta.data()};
    const joints::PairBodies bodies{plane, body};
    const long before = limber::testing::allocations;
    pair.begin_touch(bodies, 0.0, memory, out);
    pair.commit(bodies, 0.0, memory, out);
    out.clear();
    pair.evaluate(bodies, {.t = 1e-3}, memory, out);
    const std::size_t points = out.points().size();
    out.clear();
    pair.evaluate_over_step({bodies, bodies, bodies, {}}, memory, out);
    EXPECT_EQ(limber::testing::allocations - before, 0) << surface.name;
    EXPECT_GT(points, 3U) << surface.name;
  }
}

}  // namespace
}  // namespace limber::contact::allocation_test
