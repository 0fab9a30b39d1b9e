// SPDX-License-Identifier: BSD-3-Clause
#include "limber/contact/patches/nodal_motion.hpp"

#include <gtest/gtest.h>

#include "limber/common/dense/linear_solve.hpp"
#include "limber/common/rotation.hpp"

/// A piece of a surface that moves with the nodes of a mesh.
namespace limber::contact::nodal_motion_test {
namespace {

constexpr Eigen::Index kMeshNodes = 20;
const std::vector<int> kNodes = {3, 4, 7, 11, 12, 19};

// Least squares over its nodes, which differ in weight.
flexbody::NodalPiece make_piece() {
  srand(3);
  const auto count = std::ssize(kNodes);
  flexbody::NodalPiece piece{kNodes, Matrix3X::Random(3, count),
                             MatrixX(6, 3 * count)};
  MatrixX H = MatrixX::Zero(6, 6);
  for (Eigen::Index i = 0; i < count; ++i) {
    const double weight = 1.0 + static_cast<double>(i);
    Eigen::Matrix<double, 3, 6> J;
    J << Matrix3::Identity(), -skew(piece.x_P.col(i));
    piece.motion.middleCols<3>(3 * i) = weight * J.transpose();
    H += weight * J.transpose() * J;
  }
  piece.motion = dense::solve(H, piece.motion);
  return piece;
}

// Displacements of all nodes by a pose, then deformed.
VectorX move(const flexbody::NodalPiece& piece, const Pose& X,
             double deformation) {
  VectorX u = deformation * VectorX::Random(3 * kMeshNodes);
  for (std::size_t i = 0; i < kNodes.size(); ++i) {
    const Vector3 x = piece.x_P.col(static_cast<Eigen::Index>(i));
    u.segment<3>(3 * kNodes[i]) += X * x - x;
  }
  return u;
}

TEST(NodalMotion, IsTheRigidMotionOfItsNodesHoweverLarge) {
  const flexbody::NodalPiece piece = make_piece();
  const NodalMotion motion(piece);
  EXPECT_EQ(motion.least_coordinates(), 3 * kMeshNodes);
  for (const double angle : {1e-6, 0.3, 1.0, 2.0}) {
    const Pose X{exp_rotation(angle * Vector3(0.6, 0.0, -0.8)),
                 Vector3(0.5, -2.0, 1.0)};
    const VectorX u = move(piece, X, 0.0);
    const NodalMotion::State state = motion.find_state(u.data());
    EXPECT_LT((state.X.R - X.R).norm(), 1e-13) << angle;
    EXPECT_LT((state.X.p - X.p).norm(), 1e-13) << angle;
  }
}

TEST(NodalMotion, OfSmallDisplacementsIsTheirFit) {
  const flexbody::NodalPiece piece = make_piece();
  const NodalMotion motion(piece);
  const VectorX u = move(piece, {}, 1e-6);
  Vector6 fit = Vector6::Zero();
  for (std::size_t i = 0; i < kNodes.size(); ++i) {
    fit += piece.motion.middleCols<3>(3 * static_cast<Eigen::Index>(i)) *
           u.segment<3>(3 * kNodes[i]);
  }
  const NodalMotion::State state = motion.find_state(u.data());
  EXPECT_LT((state.X.p - fit.head<3>()).norm(), 1e-10);
  EXPECT_LT((state.X.R - exp_rotation(fit.tail<3>())).norm(), 1e-10);
}

// By differences of the pose, of a piece that is turned and deformed.
TEST(NodalMotion, RatesAndRowsAreDerivativesOfItsPose) {
  const flexbody::NodalPiece piece = make_piece();
  const NodalMotion motion(piece);
  const Pose X{exp_rotation(Vector3(0.3, 0.7, -0.2)), Vector3(0.1, 0.2, 0.3)};
  const VectorX u = move(piece, X, 0.1);
  const VectorX udot = VectorX::Random(u.size());
  constexpr double kStep = 1e-6;
  const VectorX after = u + kStep * udot;
  const VectorX before = u - kStep * udot;
  const NodalMotion::State state = motion.find_state(u.data());
  const Pose X_1 = motion.find_state(after.data()).X;
  const Pose X_0 = motion.find_state(before.data()).X;
  const Vector6 rate = motion.find_rate(state, udot.data());
  const Vector3 v = state.X.R.transpose() * (X_1.p - X_0.p) / (2.0 * kStep);
  const Vector3 w = log_rotation(X_0.R.transpose() * X_1.R) / (2.0 * kStep);
  EXPECT_LT((rate.head<3>() - v).norm(), 1e-8);
  EXPECT_LT((rate.tail<3>() - w).norm(), 1e-8);
  const Vector3 x_P(0.4, -0.3, 0.2);
  Matrix3X rows(3, u.size());
  motion.set_rows(state, x_P, rows);
  const Vector3 point = (X_1 * x_P - X_0 * x_P) / (2.0 * kStep);
  EXPECT_LT((rows * udot - point).norm(), 1e-8);
}

}  // namespace
}  // namespace limber::contact::nodal_motion_test
