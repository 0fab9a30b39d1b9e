// SPDX-License-Identifier: BSD-3-Clause
// Boxes, cylinders and capsules with each other, against FCL and against dense
// samples of directions.
#include <fcl/fcl.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "limber/common/overloaded.hpp"
#include "limber/common/rotation.hpp"
#include "limber/contact/narrow_phase/shape_pair.hpp"
#include "limber/contact/shapes/nearest_point.hpp"
#include "unit/contact/shapes/surfaces.hpp"

namespace limber::contact::convex_pairs_test {
namespace {

using GeometryPointer = std::shared_ptr<fcl::CollisionGeometryd>;

std::vector<ShapeKind> list_kinds() {
  return {Box{{0.3, 0.4, 0.5}}, Cylinder{0.3, 0.5}, Capsule{0.2, 0.5},
          Box{{0.5, 0.02, 0.3}}, Cylinder{0.5, 0.03}};
}

GeometryPointer make_geometry(const ShapeKind& kind) {
  return std::visit(
      Overloaded{[](const Box& box) -> GeometryPointer {
                   return std::make_shared<fcl::Boxd>(2.0 * box.half_size);
                 },
                 [](const Cylinder& c) -> GeometryPointer {
                   return std::make_shared<fcl::Cylinderd>(c.radius,
                                                           2.0 * c.half_length);
                 },
                 [](const Capsule& c) -> GeometryPointer {
                   return std::make_shared<fcl::Capsuled>(c.radius,
                                                          2.0 * c.half_length);
                 },
                 [](const auto&) -> GeometryPointer { return nullptr; }},
      kind);
}

struct Placed {
  Matrix3 R = Matrix3::Identity();
  Vector3 p = Vector3::Zero();

  [[nodiscard]] joints::PairBody body() const { return {.R_WB = R, .p_WB = p}; }
  [[nodiscard]] fcl::Transform3d transform() const {
    fcl::Transform3d X = fcl::Transform3d::Identity();
    X.linear() = R;
    X.translation() = p;
    return X;
  }
};

Placed draw(std::mt19937& random, double distance) {
  return {test::draw_rotation(random),
          distance * test::draw_point(random, 1.0).normalized()};
}

std::vector<Meeting> meet(const ShapePair& pair, const Placed& A,
                          const Placed& B) {
  std::vector<Meeting> out(pair.most_points());
  pair.find({A.body(), B.body()}, 100.0, out);
  return out;
}

const Meeting& find_deepest(const std::vector<Meeting>& all) {
  return *std::max_element(
      all.begin(), all.end(),
      [](const Meeting& a, const Meeting& b) { return a.depth < b.depth; });
}

double find_fcl_distance(const ShapePair& pair, const Placed& A,
                         const Placed& B) {
  fcl::DistanceRequestd request;
  request.gjk_solver_type = fcl::GST_LIBCCD;
  request.distance_tolerance = 1e-9;
  request.enable_nearest_points = true;
  fcl::DistanceResultd result;
  return fcl::distance(make_geometry(pair.A().kind).get(), A.transform(),
                       make_geometry(pair.B().kind).get(), B.transform(),
                       request, result);
}

bool do_collide(const ShapePair& pair, const Placed& A, const Placed& B) {
  fcl::CollisionRequestd request;
  request.gjk_solver_type = fcl::GST_LIBCCD;
  fcl::CollisionResultd result;
  return fcl::collide(make_geometry(pair.A().kind).get(), A.transform(),
                      make_geometry(pair.B().kind).get(), B.transform(),
                      request, result) > 0;
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
          [](const auto&) { return 0.0; }},
      kind);
}

// Of a point above the surface.
double find_height(const ShapeKind& kind, const Vector3& x) {
  return std::visit(
      Overloaded{
          [&](const auto& shape) { return find_nearest(shape, x).distance; },
          [](const std::shared_ptr<const Skin>&) { return 1.0; }},
      kind);
}

// Least way out over directions: those of a dense grid, each followed downhill.
double find_least_way(const ShapePair& pair, const Placed& A, const Placed& B) {
  const auto evaluate = [&](const Vector3& n) {
    return find_reach(pair.A().kind, A.R.transpose() * n) +
           find_reach(pair.B().kind, B.R.transpose() * n) + n.dot(A.p - B.p);
  };
  constexpr int kDirections = 4000;
  std::vector<std::pair<double, Vector3>> all;
  for (int i = 0; i < kDirections; ++i) {
    const double z = 1.0 - (2.0 * i + 1.0) / kDirections;
    const double side = std::sqrt(1.0 - z * z);
    const Vector3 n(side * std::cos(2.4 * i), side * std::sin(2.4 * i), z);
    all.emplace_back(evaluate(n), n);
  }
  std::sort(all.begin(), all.end(),
            [](const auto& a, const auto& b) { return a.first < b.first; });
  double least = std::numeric_limits<double>::infinity();
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  for (std::size_t i = 0; i < 20; ++i) {
    auto [depth, n] = all[i];
    double step = 0.05;
    for (int k = 0; k < 400; ++k) {
      const Vector3 tried =
          (n + step * Vector3(normal(random), normal(random), normal(random)))
              .normalized();
      const double found = evaluate(tried);
      if (found < depth) {
        depth = found;
        n = tried;
        continue;
      }
      step *= 0.96;
    }
    least = std::min(least, depth);
  }
  return least;
}

template <class Use>
void for_each_pair(const Use& use) {
  for (const ShapeKind& a : list_kinds()) {
    for (const ShapeKind& b : list_kinds()) {
      const ShapePair pair({a, {}}, {b, {}});
      SCOPED_TRACE(name_kind(pair.A()) + " with " + name_kind(pair.B()));
      use(pair);
    }
  }
}

// Both points are on the surfaces, so that the distance is at most theirs, and
// a slab between both is as wide, so that it is at least that.
TEST(ConvexPairs, ApartAreAsFarAsASlabBetweenThemIsWide) {
  std::mt19937 random(1);
  int seen = 0;
  for_each_pair([&](const ShapePair& pair) {
    for (int i = 0; i < 40; ++i) {
      const Placed A = draw(random, 0.0);
      const Placed B = draw(random, 1.0);
      const Meeting m = find_deepest(meet(pair, A, B));
      if (!(m.depth < -1e-6)) continue;
      ++seen;
      const double width =
          -(find_reach(pair.A().kind, A.R.transpose() * m.normal_W) +
            find_reach(pair.B().kind, B.R.transpose() * m.normal_W) +
            m.normal_W.dot(A.p - B.p));
      EXPECT_NEAR(-m.depth, width, 1e-6);  // round-off of rims
      EXPECT_NEAR(find_height(pair.A().kind, m.on_A.x_B), 0.0, 1e-8);
      EXPECT_NEAR(find_height(pair.B().kind, m.on_B.x_B), 0.0, 1e-8);
      EXPECT_NEAR(pair.find_clearance({A.body(), B.body()}), -m.depth, 1e-12);
    }
  });
  EXPECT_GT(seen, 500);
}

TEST(ConvexPairs, ApartHaveTheDistanceOfFcl) {
  std::mt19937 random(1);
  int seen = 0;
  for_each_pair([&](const ShapePair& pair) {
    for (int i = 0; i < 20; ++i) {
      const Placed A = draw(random, 0.0);
      const Placed B = draw(random, 1.0);
      const double distance = find_fcl_distance(pair, A, B);
      if (!(distance > 1e-3)) continue;
      ++seen;
      const double own = pair.find_clearance({A.body(), B.body()});
      EXPECT_NEAR(own, distance, 2e-6);
    }
  });
  EXPECT_GT(seen, 200);
}

TEST(ConvexPairs, OverlapByTheLeastWayOut) {
  std::mt19937 random(2);
  int seen = 0;
  for_each_pair([&](const ShapePair& pair) {
    for (int i = 0; i < 6; ++i) {
      const Placed A = draw(random, 0.0);
      const Placed B = draw(random, 0.15 * (i + 1));
      const Meeting deepest = find_deepest(meet(pair, A, B));
      if (!(deepest.depth > 1e-6)) continue;
      ++seen;
      EXPECT_LT(deepest.depth, find_least_way(pair, A, B) + 1e-8);
      EXPECT_EQ(pair.find_clearance({A.body(), B.body()}), 0.0);
      // Shifted by it they part.
      Placed out = B;
      out.p += (deepest.depth + 2e-4) * deepest.normal_W;
      EXPECT_FALSE(do_collide(pair, A, out)) << deepest.depth;
      out.p = B.p + (deepest.depth - 2e-4) * deepest.normal_W;
      EXPECT_TRUE(do_collide(pair, A, out)) << deepest.depth;
    }
  });
  EXPECT_GT(seen, 60);
}

// From apart to overlapping along any way: no jump of the depth, and at touch
// both meet.
TEST(ConvexPairs, DepthGrowsSteadilyThroughTouch) {
  std::mt19937 random(3);
  for_each_pair([&](const ShapePair& pair) {
    for (int i = 0; i < 4; ++i) {
      const Placed A = draw(random, 0.0);
      Placed B = draw(random, 1.0);
      const Vector3 way = -B.p;
      const Vector3 start = B.p;
      double before = 0.0;
      constexpr int kSteps = 500;
      for (int k = 0; k <= kSteps; ++k) {
        B.p = start + way * (1.3 * k / kSteps - 0.5);
        const double depth = find_deepest(meet(pair, A, B)).depth;
        if (k > 0) {
          EXPECT_LT(std::abs(depth - before), 1.0001 * 1.3 / kSteps) << k;
        }
        before = depth;
      }
    }
  });
}

TEST(ConvexPairs, TurnWithTheBodies) {
  std::mt19937 random(4);
  for_each_pair([&](const ShapePair& pair) {
    for (int i = 0; i < 4; ++i) {
      const Placed A = draw(random, 0.0);
      const Placed B = draw(random, 0.5 + 0.1 * i);
      const auto at = meet(pair, A, B);
      const Placed X = draw(random, 3.0);
      const auto turned = meet(pair, {X.R * A.R, X.p + X.R * A.p},
                               {X.R * B.R, X.p + X.R * B.p});
      for (std::size_t k = 0; k < at.size(); ++k) {
        if (!(at[k].depth > 1e-9)) continue;
        EXPECT_NEAR(turned[k].depth, at[k].depth, 1e-6);
        EXPECT_NEAR(turned[k].share, at[k].share, 1e-5);
        EXPECT_LT((turned[k].normal_W - X.R * at[k].normal_W).norm(), 1e-6);
        EXPECT_LT((turned[k].on_A.x_B - at[k].on_A.x_B).norm(), 1e-4);
      }
    }
  });
}

TEST(ConvexPairs, ABoxOnALargeOneStandsOnItsCorners) {
  const ShapePair pair({Box{{2, 2, 0.5}}, {}}, {Box{{0.1, 0.2, 0.3}}, {}});
  const Matrix3 R = exp_rotation(Vector3(1e-4, -2e-4, 0.7));
  const auto at = meet(pair, {}, {R, {0.1, 0.2, 0.799}});
  int count = 0;
  for (const Meeting& m : at) {
    if (!(m.depth > 0.0)) continue;
    ++count;
    EXPECT_NEAR(m.share, 1.0, 1e-6);
    EXPECT_LT((m.on_B.x_B.cwiseAbs() - Vector3(0.1, 0.2, 0.3)).norm(), 2e-3);
    const Vector3 corner =
        R * m.on_B.x_B.cwiseSign().cwiseProduct(Vector3(0.1, 0.2, 0.3));
    EXPECT_NEAR(m.depth, 0.5 - (0.799 + corner.z()), 1e-7);
  }
  EXPECT_EQ(count, 4);
}

// The face that overhangs pushes at the edge of the other, and the force is
// continuous as it slides off.
TEST(ConvexPairs, AFaceThatSlidesOffAnotherKeepsItsForce) {
  const ShapePair pair({Box{{0.5, 0.5, 0.5}}, {}}, {Box{{0.5, 0.4, 0.5}}, {}});
  double before = 4.0;
  for (double x = 0.0; x < 0.95; x += 0.001) {
    const Matrix3 R = exp_rotation(Vector3(0, 0, 0.3));
    double sum = 0.0;
    double moment = 0.0;
    for (const Meeting& m : meet(pair, {}, {R, {x, 0.2, 0.999}})) {
      if (!(m.depth > 0.0)) continue;
      sum += m.share;
      moment += m.share * m.p_W.x();
      EXPECT_NEAR(m.depth, 1e-3, 1e-12);
      EXPECT_LE(m.p_W.x(), 0.5 + 1e-12);
    }
    EXPECT_NEAR(sum, 4.0, 1e-9) << x;
    if (x > 0.0) {
      EXPECT_NEAR(moment, before, 8e-3) << x;
    }
    before = moment;
  }
}

TEST(ConvexPairs, ACapsuleLiesOnABoxWithBothEnds) {
  const Matrix3 R = exp_rotation(Vector3(0.5 * M_PI, 0, 0));
  const ShapePair pair({Box{{1, 1, 1}}, {}},
                       {Capsule{0.2, 0.5}, {R, Vector3::Zero()}});
  std::vector<Meeting> touching;
  for (const Meeting& m :
       meet(pair, {}, {Matrix3::Identity(), {0, 0.3, 1.19}})) {
    if (m.depth > 0.0) touching.push_back(m);
  }
  ASSERT_EQ(touching.size(), 2u);
  for (const Meeting& m : touching) {
    EXPECT_NEAR(m.depth, 0.01, 1e-12);
    EXPECT_NEAR(std::abs(m.p_W.y() - 0.3), 0.5, 1e-12);
    EXPECT_NEAR(m.curvature, 0.5 / 0.2, 1e-12);
  }
}

}  // namespace
}  // namespace limber::contact::convex_pairs_test
