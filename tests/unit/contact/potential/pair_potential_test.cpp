// SPDX-License-Identifier: BSD-3-Clause
#include "limber/contact/potential/pair_potential.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "limber/common/rotation.hpp"
#include "limber/contact/patches/series_potential.hpp"
#include "unit/contact/potential/patch_differences.hpp"

/// Against closed forms of flats and corners, and against differences.
namespace limber::contact::pair_potential_test {
namespace {

using test::evaluate;
using test::expect_same_patch;
using test::find_gradient;
using test::find_hessian;
using test::move;

constexpr double kModulus = 1e9;  // [Pa]
const Vector3 kHalf(0.05, 0.04, 0.03);

struct Placing {
  std::string name;
  ShapeKind A;
  Pose X_WB;  // of a box; A at the origin
  ShapeKind B = Box{kHalf};
};

Pose turn(const Vector3& by, const Vector3& p) { return {exp_rotation(by), p}; }

// The lowest corner of a turned box is d below z = 0.
Pose lower(const Vector3& by, double d) {
  const Matrix3 R = exp_rotation(by);
  const double reach = (R.transpose() * Vector3::UnitZ()).cwiseAbs().dot(kHalf);
  return {R, Vector3(0.01, -0.02, reach - d)};
}

// Of a box's corners.
Vector3 find_lowest(const Pose& X) {
  Vector3 lowest = X.p;
  for (int k = 0; k < 3; ++k) {
    lowest -= std::copysign(kHalf[k], X.R(2, k)) * X.R.col(k);
  }
  return lowest;
}

std::vector<Placing> make_placings() {
  const double d = 1e-4;
  const Box table{Vector3(0.2, 0.3, 0.1)};
  const auto on_top = [](Pose X) {
    X.p.z() += 0.1;
    return X;
  };
  std::vector<Placing> all{
      {"flat on plane", HalfSpace{}, lower({0, 0, 0.3}, d)},
      {"tilted on plane", HalfSpace{}, lower({1e-4, -2e-4, 0.3}, d)},
      {"edge on plane", HalfSpace{}, lower({0.6, 0, 0}, d)},
      {"corner on plane", HalfSpace{}, lower({0.6, 0.4, 0.2}, d)},
      {"flat on box", table, on_top(lower({0, 0, 0.3}, d))},
      {"corner on box", table, on_top(lower({0.6, 0.4, 0.2}, d))},
      {"flat over a rim", table, on_top(lower({3e-4, 1e-4, 0.3}, d))}};
  all.back().X_WB.p.x() = 0.19;
  // Two edges that cross: of the table along y, of the box along its x.
  Pose crossed = turn({0, 0, 0}, Vector3::Zero());
  crossed.R = exp_rotation(Vector3(0, std::numbers::pi / 4, 0)) *
              exp_rotation(Vector3(0, 0, 0.3)) *
              exp_rotation(Vector3(std::numbers::pi / 4, 0, 0));
  const Vector3 out = Vector3(1, 0, 1).normalized();
  const double reach = (crossed.R.transpose() * out).cwiseAbs().dot(kHalf);
  crossed.p = Vector3(0.2, 0.03, 0.1) + (reach - d) * out;
  all.push_back({"edge across edge", table, crossed});
  return all;
}

PairPotential make_potential(const Placing& placing) {
  return {Shape{placing.A, {}}, Shape{placing.B, {}}, kModulus};
}

// A square of 2 a below z = 0, with these edges on a rim: 0 at y = -a, then
// right-hand about z.
PlacedBody make_slab(double a, const std::vector<std::size_t>& rim) {
  Matrix3X corners(3, 4);
  corners << -a, a, a, -a, -a, -a, a, a, 0, 0, 0, 0;
  return {ConvexSolid::make_slab(corners, rim, 0.02), {}};
}

TEST(PairPotential, OfAFlatIsThatOfARoundPunchOfItsArea) {
  for (const double d : {1e-9, 1e-6, 1e-4}) {
    const Placing flat{"flat", HalfSpace{}, lower({0, 0, 0.4}, d)};
    const Patch patch = evaluate(make_potential(flat), {}, flat.X_WB);
    const double area = 4.0 * kHalf.x() * kHalf.y();
    const double k = 2.0 * kModulus * std::sqrt(area / std::numbers::pi);
    // Next to its rim the nearest face of the box is another one.
    const double rim = 25.0 * d + 1e-7;
    ASSERT_TRUE(patch.touches);
    EXPECT_NEAR(patch.gradient_W[2] / (-k * d), 1.0, rim);
    EXPECT_NEAR(patch.energy / (0.5 * k * d * d), 1.0, rim);
    EXPECT_NEAR(patch.hessian_W(2, 2) / k, 1.0, rim);
    EXPECT_LT((patch.centre_W.head<2>() - flat.X_WB.p.head<2>()).norm(), 1e-9);
    EXPECT_NEAR(patch.spread_W.trace(),
                (kHalf.x() * kHalf.x() + kHalf.y() * kHalf.y()) / 3.0,
                0.05 * d + 1e-9);
  }
}

// int 4 t^3 of a cube's corner along its diagonal, depth below the plane:
// sqrt(3) d^6 / 10; below the cube's faces by another program: 0.44 in W.
TEST(PairPotential, OfACornerIsItsClosedForm) {
  const Box cube{Vector3::Constant(0.05)};
  const Vector3 axis = Vector3(1, 1, 1).normalized();
  Matrix3 R;
  R = Quaternion::FromTwoVectors(-axis, -Vector3::UnitZ()).toRotationMatrix();
  const double d = 1e-3;
  const Pose X{R, Vector3(0, 0, 0.05 * std::sqrt(3.0) - d)};
  const Patch patch =
      evaluate({Shape{HalfSpace{}, {}}, Shape{cube, {}}, kModulus}, {}, X);
  const double c = kModulus / std::sqrt(std::numbers::pi);
  const double soft_plane = c * std::sqrt(std::sqrt(3.0) / 10.0) * d * d * d;
  EXPECT_NEAR(patch.energy / (0.5 * soft_plane * 1.44), 1.0, 3e-3);
}

TEST(PairPotential, HasTheGradientOfItsEnergy) {
  for (const Placing& placing : make_placings()) {
    SCOPED_TRACE(placing.name);
    const PairPotential potential = make_potential(placing);
    const Patch patch = evaluate(potential, {}, placing.X_WB);
    ASSERT_TRUE(patch.touches);
    const auto energy = [&](const Pose& X) {
      return evaluate(potential, {}, X).energy;
    };
    const Vector6 found = find_gradient(placing.X_WB, patch.centre_W, energy);
    for (int i = 0; i < 6; ++i) {
      EXPECT_NEAR(found[i], patch.gradient_W[i],
                  1e-6 * patch.gradient_W.head<3>().norm())
          << i;
    }
  }
}

// About a point of the world: the wrench moves with the place of contact, half
// with each body, which the Hessian leaves out, by up to the force times the
// size of the overlap.
TEST(PairPotential, HasTheHessianOfItsEnergy) {
  for (const Placing& placing : make_placings()) {
    SCOPED_TRACE(placing.name);
    const PairPotential potential = make_potential(placing);
    const Patch patch = evaluate(potential, {}, placing.X_WB);
    const Matrix6 found = find_hessian(potential, placing.X_WB, patch.centre_W);
    const Matrix6& K = patch.hessian_W;
    const auto size = [](const Matrix6& m, int i, int j) {
      const Matrix3 block = m.block<3, 3>(3 * i, 3 * j);
      return block.norm();
    };
    const double k = size(K, 0, 0);
    const double turn = size(K, 1, 1);
    const double force = patch.gradient_W.head<3>().norm();
    const Matrix6 rest = found - K;
    EXPECT_LT(size(rest, 0, 0), 1e-5 * k);
    EXPECT_LT(size(rest, 1, 1),
              1e-5 * turn + patch.gradient_W.tail<3>().norm() + 1e-4 * force);
    EXPECT_LT(size(rest, 0, 1),
              1.01 * std::sqrt(2.0) * force + 1e-5 * std::sqrt(k * turn));
    EXPECT_LT((K - K.transpose()).norm(), 1e-9 * K.norm());
  }
}

TEST(PairPotential, IsTheSameWithNamesSwapped) {
  for (const Placing& placing : make_placings()) {
    SCOPED_TRACE(placing.name);
    const Patch one = evaluate(make_potential(placing), {}, placing.X_WB);
    const Patch other =
        evaluate({Shape{placing.B, {}}, Shape{placing.A, {}}, kModulus},
                 placing.X_WB, {});
    expect_same_patch(one, other, 1e-10, 1e-7);
  }
}

TEST(PairPotential, IsTheSameElsewhereAndTurned) {
  const Pose X = turn({0.3, -1.0, 2.0}, {1e3, -2e3, 5e2});
  for (const Placing& placing : make_placings()) {
    SCOPED_TRACE(placing.name);
    const PairPotential potential = make_potential(placing);
    const Patch here = evaluate(potential, {}, placing.X_WB);
    const Patch there = evaluate(potential, X, X * placing.X_WB);
    EXPECT_NEAR(there.energy / here.energy, 1.0, 1e-7);
    EXPECT_LT(
        (there.gradient_W.head<3>() - X.R * here.gradient_W.head<3>()).norm(),
        1e-7 * here.gradient_W.head<3>().norm());
  }
}

// A box beyond the edge x = a of a slab, which ends there or goes on.
TEST(PairPotential, OfAPartHasTheGradientOfItsEnergy) {
  for (const std::size_t edges : {0U, 4U}) {
    const std::vector<std::size_t> all{0, 1, 2, 3};
    const PlacedBody slab =
        make_slab(0.2, {all.begin(), all.begin() + static_cast<long>(edges)});
    for (const Vector3& tilt : {Vector3(0, 0, 0.3), Vector3(3e-4, 1e-4, 0.3),
                                Vector3(0.6, 0.4, 0.2)}) {
      Pose X = lower(tilt, 1e-4);
      // The lowest corner next to the edge, or a side over it.
      X.p.x() += 0.2 - 3e-5 - find_lowest(X).x();
      if (tilt.norm() < 0.5) X.p.x() -= 0.01;
      const PlacedBody box{ConvexSolid(Box{kHalf}), {}};
      for (const bool is_swapped : {false, true}) {
        SCOPED_TRACE(::testing::Message() << edges << ", " << tilt.transpose()
                                          << (is_swapped ? ", swapped" : ""));
        const PairPotential potential =
            is_swapped ? PairPotential(box, slab, kModulus)
                       : PairPotential(slab, box, kModulus);
        const auto find = [&](const Pose& X_WB) {
          return is_swapped ? evaluate(potential, X_WB, {})
                            : evaluate(potential, {}, X_WB);
        };
        const Patch patch = find(X);
        ASSERT_TRUE(patch.touches);
        const auto energy = [&](const Pose& at) { return find(at).energy; };
        const Vector6 found = find_gradient(X, patch.centre_W, energy);
        for (int i = 0; i < 6; ++i) {
          EXPECT_NEAR(found[i], (is_swapped ? -1.0 : 1.0) * patch.gradient_W[i],
                      1e-6 * patch.gradient_W.head<3>().norm())
              << i;
        }
      }
    }
  }
}

TEST(PairPotential, OfAPartWithItsRimIsThatOfABox) {
  const Box thick{Vector3(0.2, 0.2, 0.01)};
  const PairPotential of_box(
      Shape{thick, {Matrix3::Identity(), Vector3(0, 0, -0.01)}},
      Shape{Box{kHalf}, {}}, kModulus);
  const PairPotential of_part(make_slab(0.2, {0, 1, 2, 3}),
                              {ConvexSolid(Box{kHalf}), {}}, kModulus);
  Pose X = lower({0.3, 0.2, 0.3}, 1e-4);
  for (const double x : {0.0, 0.15, 0.19, 0.23}) {
    X.p.x() = x;
    EXPECT_NEAR(evaluate(of_part, {}, X).energy, evaluate(of_box, {}, X).energy,
                1e-12 * evaluate(of_box, {}, X).energy + 1e-20);
  }
}

Matrix3 along_z(double R) { return Vector3(0.0, 0.0, R).asDiagonal(); }

TEST(SeriesPotential, OfAFlatIsItsSpringInSeriesWithTheLayer) {
  const PlacedBody slab = make_slab(0.2, {0, 1, 2, 3});
  const PlacedBody plane{ConvexSolid(HalfSpace{}), {}};
  const double k = 2.0 * kModulus * std::sqrt(0.16 / std::numbers::pi);
  for (const double R : {0.0, 0.1 / k, 1.0 / k, 1e3 / k}) {
    const SeriesPotential potential(plane, slab, kModulus, Matrix3::Zero(),
                                    along_z(R));
    const double d = 1e-6;
    // The slab's face looks down.
    const joints::PairBody B{exp_rotation({std::numbers::pi, 0, 0}),
                             Vector3(0, 0, -d)};
    const Patch patch = potential.evaluate({{}, B}, true);
    const double series = 1.0 / (1.0 / k + R);
    EXPECT_NEAR(patch.energy / (0.5 * series * d * d), 1.0, 1e-3);
    EXPECT_NEAR(patch.load() / (series * d), 1.0, 1e-3);
    EXPECT_NEAR(patch.hessian_W(2, 2) / series, 1.0, 1e-3);
  }
}

TEST(SeriesPotential, HasTheGradientOfItsEnergy) {
  const PlacedBody slab = make_slab(0.05, {0, 1, 2, 3});
  const PlacedBody table{ConvexSolid(Box{Vector3(0.2, 0.3, 0.1)}),
                         {Matrix3::Identity(), Vector3(0, 0, -0.1)}};
  for (const double R : {1e-12, 1e-10, 1e-8}) {
    const SeriesPotential potential(slab, table, kModulus, along_z(R),
                                    Matrix3::Zero());
    for (const Vector3& tilt : {Vector3(1e-4, 0, 0), Vector3(0.2, 0.1, 0)}) {
      const Matrix3 R_WA =
          exp_rotation(tilt) * exp_rotation({std::numbers::pi, 0, 0});
      const double reach = 0.05 * (std::abs(R_WA(2, 0)) + std::abs(R_WA(2, 1)));
      const Pose X{R_WA, Vector3(0.0, 0.0, reach - 1e-5)};
      const auto find = [&](const Pose& X_WA) {
        return potential.evaluate({{X_WA.R, X_WA.p}, {}}, true);
      };
      const Patch patch = find(X);
      ASSERT_TRUE(patch.touches);
      for (int i = 0; i < 3; ++i) {
        const auto energy = [&](double s) {
          return find(move(X, s * 1e-9 * Vector6::Unit(i), patch.centre_W))
              .energy;
        };
        EXPECT_NEAR((energy(1) - energy(-1)) / 2e-9, -patch.gradient_W[i],
                    1e-5 * patch.load())
            << R << ", " << i;
      }
    }
  }
}

// Layers that give way along all axes and turn with their bodies: the wrench is
// the gradient by motions and turns of either body.
TEST(SeriesPotential, HasTheGradientOfItsEnergyWithLayersOfAllAxes) {
  const PlacedBody box{ConvexSolid(Box{Vector3(0.05, 0.04, 0.03)}), {}};
  const PlacedBody table{ConvexSolid(Box{Vector3(0.2, 0.3, 0.1)}),
                         {Matrix3::Identity(), Vector3(0, 0, -0.1)}};
  Matrix3 R_A;
  R_A << 3, 1, 0.5, 1, 2, -0.7, 0.5, -0.7, 1;
  const Matrix3 R_B = Vector3(1, 5, 2).asDiagonal();
  for (const double size : {1e-12, 1e-10, 1e-8}) {
    const SeriesPotential potential(box, table, kModulus, size * R_A,
                                    size * R_B);
    const Matrix3 R_WA = exp_rotation({0.5, 0.4, 0.2});
    double reach = 0.0;
    for (const Vector3& x : std::get<ConvexSolid>(box.kind).corners()) {
      reach = std::max(reach, -(R_WA * x).z());
    }
    const Pose X_WA{R_WA, Vector3(0.01, 0.02, reach - 1e-4)};
    const auto find = [&](const Pose& X_A, const Pose& X_B) {
      return potential.evaluate({{X_A.R, X_A.p}, {X_B.R, X_B.p}}, true);
    };
    const Patch patch = find(X_WA, {});
    ASSERT_TRUE(patch.touches);
    const auto by_B = find_gradient(Pose{}, patch.centre_W, [&](const Pose& X) {
      return find(X_WA, X).energy;
    });
    const auto by_A = find_gradient(X_WA, patch.centre_W, [&](const Pose& X) {
      return find(X, {}).energy;
    });
    EXPECT_LT((by_B - patch.gradient_W).norm(), 2e-5 * patch.load()) << size;
    EXPECT_LT((by_A + patch.gradient_W).norm(), 2e-5 * patch.load()) << size;
  }
}

TEST(PairPotential, IsNothingApart) {
  const Placing apart{"apart", HalfSpace{}, lower({0.2, 0.3, 0.1}, -1e-9)};
  EXPECT_FALSE(evaluate(make_potential(apart), {}, apart.X_WB).touches);
}

}  // namespace
}  // namespace limber::contact::pair_potential_test
