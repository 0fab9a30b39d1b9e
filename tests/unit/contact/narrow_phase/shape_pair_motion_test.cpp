// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "limber/common/rotation.hpp"
#include "limber/contact/narrow_phase/shape_pair.hpp"
#include "limber/contact/shapes/skin.hpp"
#include "unit/contact/shapes/surfaces.hpp"

namespace limber::contact::shape_pair_motion_test {
namespace {

constexpr int kModes = 4;

// A body with its coordinates.
struct Moved {
  Matrix3 R = Matrix3::Identity();
  Vector3 p = Vector3::Zero();
  VectorX eta = VectorX::Zero(kModes);

  [[nodiscard]] joints::PairBody body() const {
    return {.R_WB = R, .p_WB = p, .modes = kModes, .eta = eta.data()};
  }
};

Moved draw_body(std::mt19937& random, double distance) {
  Moved moved;
  moved.R = test::draw_rotation(random);
  moved.p = distance * test::draw_point(random, 1.0).normalized();
  moved.eta = VectorX::NullaryExpr(kModes, [&random] {
    return std::uniform_real_distribution<double>(-0.05, 0.05)(random);
  });
  return moved;
}

Shape make_skin() {
  auto surface = test::make_ball_surface(0.6, 1, true);
  test::set_modes(surface, test::make_fields());
  return {std::make_shared<const Skin>(surface), {}};
}

Shape put(const ShapeKind& kind) {
  return {kind, {exp_rotation(Vector3(0.3, -0.4, 0.5)), {0.1, -0.2, 0.05}}};
}

// Both orders of every rule.
std::vector<ShapePair> list_pairs() {
  const Shape capsule = put(Capsule{0.3, 0.5});
  const Shape sphere = put(Sphere{0.4});
  const Shape plane = put(HalfSpace{});
  std::vector<ShapePair> pairs;
  for (const Shape& other : {capsule, make_skin(), put(Sphere{0.2}), plane}) {
    pairs.emplace_back(sphere, other);
    pairs.emplace_back(other, sphere);
  }
  pairs.emplace_back(plane, make_skin());
  pairs.emplace_back(make_skin(), plane);
  return pairs;
}

std::string name(const ShapePair& pair) {
  return name_kind(pair.A()) + " with " + name_kind(pair.B());
}

std::vector<Meeting> meet(const ShapePair& pair, const Moved& A,
                          const Moved& B) {
  std::vector<Meeting> out(pair.most_points());
  pair.find({A.body(), B.body()}, 100.0, out);
  return out;
}

Vector3 find_position(const Shape& shape, const SurfacePlace& at,
                      const Moved& body) {
  Matrix3X Phi(3, kModes);
  set_shape_functions(shape, at, Phi);
  return body.p + body.R * (at.x_B + Phi * body.eta);
}

TEST(ShapePairMotion, BothPlacesAreADepthApartAlongTheNormal) {
  std::mt19937 random(1);
  for (const ShapePair& pair : list_pairs()) {
    for (int trial = 0; trial < 5; ++trial) {
      const Moved A = draw_body(random, 0.0);
      const Moved B = draw_body(random, 1.0);
      for (const Meeting& m : meet(pair, A, B)) {
        if (!std::isfinite(m.depth)) continue;
        const Vector3 on_A = find_position(pair.A(), m.on_A, A);
        const Vector3 on_B = find_position(pair.B(), m.on_B, B);
        EXPECT_LT((on_A - on_B - m.depth * m.normal_W).norm(), 1e-14)
            << name(pair);
        EXPECT_LT((0.5 * (on_A + on_B) - m.p_W).norm(), 1e-14) << name(pair);
        EXPECT_NEAR(m.normal_W.norm(), 1.0, 1e-14) << name(pair);
        EXPECT_GE(m.curvature, 0.0) << name(pair);
      }
    }
  }
}

TEST(ShapePairMotion, DepthChangesAsTheMaterialPointsMoveAlongTheNormal) {
  constexpr double kStep = 1e-6;
  std::mt19937 random(2);
  for (const ShapePair& pair : list_pairs()) {
    for (int trial = 0; trial < 10; ++trial) {
      const Moved A = draw_body(random, 0.0);
      const Moved B = draw_body(random, 0.9);
      const Vector3 turn_A = test::draw_point(random, 1.0);
      const Vector3 turn_B = test::draw_point(random, 1.0);
      const Vector3 way_B = test::draw_point(random, 1.0);
      const Moved rates = draw_body(random, 0.0);
      const auto move = [&](double t, Moved a, Moved b) {
        a.R *= exp_rotation(t * turn_A);
        b.R *= exp_rotation(t * turn_B);
        b.p += t * way_B;
        a.eta += t * rates.eta;
        b.eta -= t * rates.eta;
        return std::pair(a, b);
      };
      const auto [A0, B0] = move(-kStep, A, B);
      const auto [A1, B1] = move(kStep, A, B);
      const auto before = meet(pair, A0, B0);
      const auto now = meet(pair, A, B);
      const auto after = meet(pair, A1, B1);
      for (std::size_t i = 0; i < now.size(); ++i) {
        const Meeting& m = now[i];
        const Vector3 way_A_of_point = find_position(pair.A(), m.on_A, A1) -
                                       find_position(pair.A(), m.on_A, A0);
        const Vector3 way_B_of_point = find_position(pair.B(), m.on_B, B1) -
                                       find_position(pair.B(), m.on_B, B0);
        const double error = (after[i].depth - before[i].depth -
                              m.normal_W.dot(way_A_of_point - way_B_of_point)) /
                             (2.0 * kStep);
        EXPECT_LT(std::abs(error), 1e-7) << name(pair);
      }
    }
  }
}

TEST(ShapePairMotion, ACommonRigidMotionChangesNothingElse) {
  std::mt19937 random(3);
  for (const ShapePair& pair : list_pairs()) {
    for (int trial = 0; trial < 5; ++trial) {
      const Moved A = draw_body(random, 0.0);
      const Moved B = draw_body(random, 0.9);
      const Pose X{test::draw_rotation(random), test::draw_point(random, 10.0)};
      const auto move = [&X](Moved body) {
        body.p = X * body.p;
        body.R = X.R * body.R;
        return body;
      };
      const auto still = meet(pair, A, B);
      const auto moved = meet(pair, move(A), move(B));
      for (std::size_t i = 0; i < still.size(); ++i) {
        EXPECT_NEAR(moved[i].depth, still[i].depth, 1e-13) << name(pair);
        EXPECT_LT((moved[i].normal_W - X.R * still[i].normal_W).norm(), 1e-11)
            << name(pair);
        EXPECT_LT((moved[i].on_A.x_B - still[i].on_A.x_B).norm(), 1e-11)
            << name(pair);
        EXPECT_LT((moved[i].on_B.x_B - still[i].on_B.x_B).norm(), 1e-11)
            << name(pair);
        EXPECT_NEAR(moved[i].curvature, still[i].curvature, 1e-9) << name(pair);
      }
    }
  }
}

TEST(ShapePairMotion, ClearanceIsTheDistanceOfTheNearestFeature) {
  std::mt19937 random(4);
  for (const ShapePair& pair : list_pairs()) {
    for (const double distance : {0.3, 1.0, 1.5}) {
      const Moved A = draw_body(random, 0.0);
      const Moved B = draw_body(random, distance);
      double depth = -1e9;
      for (const Meeting& m : meet(pair, A, B)) {
        depth = std::max(depth, m.depth);
      }
      EXPECT_NEAR(pair.find_clearance({A.body(), B.body()}),
                  std::max(0.0, -depth), 1e-13)
          << name(pair);
    }
  }
}

}  // namespace
}  // namespace limber::contact::shape_pair_motion_test
