// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/newton/free_rows.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <utility>

#include "limber/common/rotation.hpp"
#include "limber/joints/joint_kind.hpp"

namespace limber::dynamics::free_rows_test {
namespace {

// Stiffness of a joint that has turned, moved along its axis and deflected.
Matrix6 make_stiffness(joints::JointKind kind, const Vector3& axis, double k) {
  const joints::Bushing joint = joints::make_joint_bushing(
      kind, axis, {.translational_stiffness = k, .rotational_stiffness = k});
  joints::RelativeMotion motion;
  motion.R_FM = exp_rotation(Vector3(0.7 * axis)) *
                exp_rotation(Vector3(1e-3, 2e-3, -1e-3));
  motion.p_FM_F = 0.3 * axis + Vector3(1e-4, -2e-4, 3e-4);
  motion.v_FM_F.setZero();
  motion.w_FM_F.setZero();
  return joint.evaluate(motion).stiffness;
}

int count_zero_rows(const Matrix6& K) {
  int count = 0;
  for (int i = 0; i < 6; ++i) count += K.row(i).isZero(0.0) ? 1 : 0;
  return count;
}

Matrix6 make_compliance(std::mt19937& random) {
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  Matrix6 L;
  for (double& x : L.reshaped()) x = uniform(random);
  return 1e-6 * (L * L.transpose() + Matrix6::Identity());
}

// (I + K A)^-1 b by elimination with pivoting, in long double.
Vector6 solve_precisely(const Matrix6& K, const Matrix6& A, const Vector6& b) {
  Eigen::Matrix<long double, 6, 7> rows;
  rows.leftCols<6>().noalias() = K.cast<long double>() * A.cast<long double>();
  rows.diagonal().array() += 1.0L;
  rows.col(6) = b.cast<long double>();
  for (int k = 0; k < 6; ++k) {
    Eigen::Index best = 0;
    rows.col(k).tail(6 - k).cwiseAbs().maxCoeff(&best);
    rows.row(k).swap(rows.row(k + best));
    for (int i = 0; i < 6; ++i) {
      if (i != k) rows.row(i) -= rows(i, k) / rows(k, k) * rows.row(k);
    }
  }
  const Eigen::Matrix<long double, 6, 1> x =
      rows.col(6).cwiseQuotient(rows.leftCols<6>().diagonal());
  return x.cast<double>();
}

const Vector3 kSkew = Vector3(1.0, 2.0, -2.0) / 3.0;
constexpr std::pair<joints::JointKind, int> kJoints[] = {
    {joints::JointKind::revolute, 1},
    {joints::JointKind::prismatic, 1},
    {joints::JointKind::ball, 3},
    {joints::JointKind::fixed, 0}};

TEST(FreeRows, OfAJointAboutAnAxisOfItsFrameStayAsTheyAre) {
  for (const auto& [kind, free] : kJoints) {
    for (int axis = 0; axis < 3; ++axis) {
      const Matrix6 K = make_stiffness(kind, Vector3::Unit(axis), 1e12);
      Matrix6 rows = K;
      EXPECT_EQ(separate_free_rows(rows), Matrix6::Identity());
      EXPECT_EQ(rows, K);
      EXPECT_EQ(count_zero_rows(rows), free);
    }
  }
}

TEST(FreeRows, OfAJointAboutASkewAxisAreTurnedUntilTheFreeOnesVanish) {
  for (const auto& [kind, free] : kJoints) {
    const Matrix6 K = make_stiffness(kind, kSkew, 1e12);
    Matrix6 rows = K;
    const Matrix6 turn = separate_free_rows(rows);
    EXPECT_LT((turn * turn.transpose() - Matrix6::Identity()).norm(), 1e-14);
    EXPECT_LT((turn * K - rows).norm(), 1e-14 * K.norm());
    EXPECT_EQ(count_zero_rows(rows), free);
  }
}

// Large entries on the diagonal, and still a free direction between them.
TEST(FreeRows, AreFoundBetweenAxesOfTheFrame) {
  const Vector3 held = Vector3(0.6, 0.8, 0.0);
  Matrix6 K = Matrix6::Zero();
  K.topLeftCorner<3, 3>() = 1e9 * held * held.transpose();
  K.bottomRightCorner<3, 3>().setIdentity();
  const Matrix6 turn = separate_free_rows(K);
  EXPECT_EQ(count_zero_rows(K), 2);
  EXPECT_NEAR(std::abs(turn.row(0).head<3>().dot(held)), 1.0, 1e-14);
}

// A soft direction beside a stiff one is no round-off.
TEST(FreeRows, KeepASoftDirectionBesideAStiffOne) {
  Matrix6 K = Matrix6::Zero();
  K.diagonal() << 1e12, 1e3, 0.0, 1e10, 0.0, 1e-2;
  const Matrix6 before = K;
  EXPECT_EQ(separate_free_rows(K), Matrix6::Identity());
  EXPECT_EQ(K, before);
}

// (T + T K A) x = T b against (I + K A) x = b in long double.
TEST(FreeRows, SolveAsPreciselyAsTheirNumbersAllowHoweverStiff) {
  std::mt19937 random(7);
  for (const double k : {1e4, 1e9, 1e14}) {
    for (int i = 0; i < 100; ++i) {
      const Matrix6 K =
          make_stiffness(joints::JointKind::revolute, Vector3::Unit(i % 3), k);
      const Matrix6 A = make_compliance(random);
      const Vector6 b = K * Vector6::Constant(1e-3) + Vector6::Ones();
      Matrix6 rows = K;
      const Matrix6 T = separate_free_rows(rows);
      const Matrix6 M = T + rows * A;
      const Vector6 scale = M.cwiseAbs().rowwise().maxCoeff().cwiseInverse();
      const Vector6 x = (scale.asDiagonal() * M).inverse() *
                        Vector6(scale.asDiagonal() * (T * b));
      const Vector6 expected = solve_precisely(K, A, b);
      EXPECT_LT((x - expected).norm(), 1e-11 * expected.norm()) << k;
    }
  }
}

}  // namespace
}  // namespace limber::dynamics::free_rows_test
