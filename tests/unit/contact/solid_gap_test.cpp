// SPDX-License-Identifier: BSD-3-Clause
#include "limber/contact/patches/solid_gap.hpp"

#include <fcl/fcl.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "limber/common/overloaded.hpp"
#include "limber/contact/shapes/shape_properties.hpp"
#include "unit/contact/shapes/surfaces.hpp"

/// Boxes, round shapes and ellipsoids apart from each other: against FCL, and
/// against the slab between them.
namespace limber::contact::solid_gap_test {
namespace {

using joints::PairBody;

std::vector<ShapeKind> list_kinds() {
  return {Box{{0.3, 0.4, 0.5}},      Cylinder{0.3, 0.5},  Capsule{0.2, 0.5},
          Box{{0.5, 0.02, 0.3}},     Cylinder{0.5, 0.03}, Cone{0.3, 0.4},
          Ellipsoid{{0.2, 0.3, 0.5}}};
}

std::shared_ptr<fcl::CollisionGeometryd> make_geometry(const ShapeKind& kind) {
  using Pointer = std::shared_ptr<fcl::CollisionGeometryd>;
  return std::visit(
      Overloaded{[](const Box& box) -> Pointer {
                   return std::make_shared<fcl::Boxd>(2.0 * box.half_size);
                 },
                 [](const Cylinder& c) -> Pointer {
                   return std::make_shared<fcl::Cylinderd>(c.radius,
                                                           2.0 * c.half_length);
                 },
                 [](const Capsule& c) -> Pointer {
                   return std::make_shared<fcl::Capsuled>(c.radius,
                                                          2.0 * c.half_length);
                 },
                 [](const Cone& c) -> Pointer {
                   return std::make_shared<fcl::Coned>(c.radius,
                                                       2.0 * c.half_length);
                 },
                 [](const Ellipsoid& e) -> Pointer {
                   return std::make_shared<fcl::Ellipsoidd>(e.radii);
                 },
                 [](const auto&) -> Pointer { return nullptr; }},
      kind);
}

// Farthest along a unit vector, from the shape's centre.
double find_reach(const ShapeKind& kind, const Vector3& n_S) {
  const double side = std::hypot(n_S.x(), n_S.y());
  return std::visit(
      Overloaded{
          [&](const Box& box) { return box.half_size.dot(n_S.cwiseAbs()); },
          [&](const Cylinder& c) {
            return c.radius * side + c.half_length * std::abs(n_S.z());
          },
          [&](const Capsule& c) {
            return c.radius + c.half_length * std::abs(n_S.z());
          },
          [&](const Cone& c) {
            return std::max(c.half_length * n_S.z(),
                            c.radius * side - c.half_length * n_S.z());
          },
          [&](const Ellipsoid& e) { return e.radii.cwiseProduct(n_S).norm(); },
          [](const auto&) { return 0.0; }},
      kind);
}

PairBody draw(std::mt19937& random, double distance) {
  return {.R_WB = test::draw_rotation(random),
          .p_WB = distance * test::draw_point(random, 1.0).normalized()};
}

fcl::Transform3d find_transform(const PairBody& body) {
  fcl::Transform3d X = fcl::Transform3d::Identity();
  X.linear() = body.R_WB;
  X.translation() = body.p_WB;
  return X;
}

// Calls it with kinds, bodies and the gap of random pairs that are apart.
template <class Use>
int visit_apart(int count, const Use& use) {
  std::mt19937 random(1);
  int seen = 0;
  for (const ShapeKind& a : list_kinds()) {
    for (const ShapeKind& b : list_kinds()) {
      const PatchPart part_A(PlacedBody{make_body(a), {}});
      const PatchPart part_B(PlacedBody{make_body(b), {}});
      SCOPED_TRACE(name_kind({a, {}}) + " with " + name_kind({b, {}}));
      for (int i = 0; i < count; ++i) {
        const PairBody A = draw(random, 0.0);
        const PairBody B = draw(random, 1.0);
        const SolidGap gap = find_gap(part_A, part_B, {A, B});
        if (!(gap.distance > 1e-3)) continue;
        ++seen;
        use(a, b, A, B, gap);
      }
    }
  }
  return seen;
}

// The distance is at most that of two points of them, and at least the width of
// a slab between both.
TEST(SolidGap, IsAsWideAsASlabBetweenBoth) {
  const int seen = visit_apart(40, [](const ShapeKind& a, const ShapeKind& b,
                                      const PairBody& A, const PairBody& B,
                                      const SolidGap& gap) {
    const Vector3& n = gap.normal_W;
    EXPECT_NEAR(n.norm(), 1.0, 1e-12);
    const double width =
        -(find_reach(a, A.R_WB.transpose() * n) +
          find_reach(b, -(B.R_WB.transpose() * n)) + n.dot(A.p_WB - B.p_WB));
    EXPECT_NEAR(gap.distance, width, 1e-6);  // round-off of rims
    EXPECT_LT((gap.on_B - gap.on_A - gap.distance * n).norm(), 1e-12);
    const double high = n.dot(gap.on_A - A.p_WB);
    EXPECT_NEAR(high, find_reach(a, A.R_WB.transpose() * n), 1e-6);
  });
  EXPECT_GT(seen, 500);
}

TEST(SolidGap, IsTheDistanceOfFcl) {
  const int seen = visit_apart(
      20, [](const ShapeKind& a, const ShapeKind& b, const PairBody& A,
             const PairBody& B, const SolidGap& gap) {
        fcl::DistanceRequestd request;
        request.gjk_solver_type = fcl::GST_LIBCCD;
        request.distance_tolerance = 1e-9;
        fcl::DistanceResultd result;
        const double distance = fcl::distance(
            make_geometry(a).get(), find_transform(A), make_geometry(b).get(),
            find_transform(B), request, result);
        EXPECT_NEAR(gap.distance, distance, 2e-6);
      });
  EXPECT_GT(seen, 200);
}

}  // namespace
}  // namespace limber::contact::solid_gap_test
