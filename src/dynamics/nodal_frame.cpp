// SPDX-License-Identifier: BSD-3-Clause
#include "dynamics/nodal_frame.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/SVD>
#include <cmath>
#include <numeric>

#include "common/errors.hpp"

namespace limber::dynamics {
namespace {

// Second moments of a set that is no point and no line.
bool spans_a_plane(const Matrix3X& d, const VectorX& weights, double size) {
  constexpr double kThin = 1e-6;  // of the body's size
  const Matrix3 S = d * weights.asDiagonal() * d.transpose();
  const Vector3 moments =
      Eigen::SelfAdjointEigenSolver<Matrix3>(S, Eigen::EigenvaluesOnly)
          .eigenvalues();
  return moments[1] > std::pow(kThin * size, 2);
}

}  // namespace

Matrix3 find_polar_rotation(const Matrix3& A) {
  const Eigen::JacobiSVD<Matrix3> svd(
      A, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Matrix3 U = svd.matrixU();
  const Matrix3& V = svd.matrixV();
  if (U.determinant() * V.determinant() < 0.0) U.col(2) = -U.col(2);
  return U * V.transpose();
}

NodalFrame make_nodal_frame(const flexbody::FullBody& body,
                            const flexbody::NodeSet& set,
                            const Vector3& origin_B) {
  LIMBER_EXPECT(!set.nodes.empty() &&
                set.weights.size() == std::ssize(set.nodes));
  NodalFrame frame;
  frame.nodes = set.nodes;
  frame.weights = set.weights;
  frame.d_B = body.x_B(Eigen::all, set.nodes);
  frame.mean_B = frame.d_B * set.weights;
  frame.d_B.colwise() -= frame.mean_B;
  frame.arm_B = origin_B - frame.mean_B;
  const double size =
      (body.x_B.rowwise().maxCoeff() - body.x_B.rowwise().minCoeff())
          .maxCoeff();
  if (spans_a_plane(frame.d_B, frame.weights, size)) {
    frame.turns = true;
    frame.turning = frame.nodes;
    frame.y_B = frame.d_B * frame.weights.asDiagonal();
    return frame;
  }
  frame.turns = !body.is_clamped();
  if (frame.turns) {
    frame.turning.resize(static_cast<std::size_t>(body.node_count()));
    std::iota(frame.turning.begin(), frame.turning.end(), 0);
    frame.d_B = body.x_B.colwise() - frame.mean_B;
    frame.y_B = body.first_moment;
  }
  return frame;
}

void calc_nodal_frame(const NodalFrame& frame, const ConstNodes& u_H,
                      const ConstNodes& udot_H, NodalFrameMotion& motion) {
  Vector3 u = Vector3::Zero();
  Vector3 v = Vector3::Zero();
  for (std::size_t i = 0; i < frame.nodes.size(); ++i) {
    const double weight = frame.weights[static_cast<Eigen::Index>(i)];
    u += weight * u_H.col(frame.nodes[i]);
    v += weight * udot_H.col(frame.nodes[i]);
  }
  motion.R_HB.setIdentity();
  motion.w_H.setZero();
  motion.spread.setZero();
  if (frame.turns) {
    // sum (p_i - p) y_i^T, with p_i - p = d_i + u_i - u
    Matrix3 A = Matrix3::Zero();
    for (std::size_t i = 0; i < frame.turning.size(); ++i) {
      const auto k = static_cast<Eigen::Index>(i);
      const Vector3 arm = frame.d_B.col(k) + u_H.col(frame.turning[i]) - u;
      A += arm * frame.y_B.col(k).transpose();
    }
    motion.R_HB = find_polar_rotation(A);
    const Matrix3 S = motion.R_HB * A.transpose();
    motion.spread = (S.trace() * Matrix3::Identity() - S).inverse();
    Vector3 moment = Vector3::Zero();
    for (std::size_t i = 0; i < frame.turning.size(); ++i) {
      const Vector3 y_H =
          motion.R_HB * frame.y_B.col(static_cast<Eigen::Index>(i));
      const Vector3 velocity = udot_H.col(frame.turning[i]);
      moment += y_H.cross(velocity);
    }
    motion.w_H = motion.spread * moment;
  }
  motion.arm_H = motion.R_HB * frame.arm_B;
  motion.p_H = frame.mean_B + u + motion.arm_H;
  motion.v_H = v + motion.w_H.cross(motion.arm_H);
}

void add_nodal_wrench(const NodalFrame& frame, const NodalFrameMotion& motion,
                      const Vector3& force_H, const Vector3& moment_H,
                      Eigen::Ref<Matrix3X> force) {
  for (std::size_t i = 0; i < frame.nodes.size(); ++i) {
    force.col(frame.nodes[i]) +=
        frame.weights[static_cast<Eigen::Index>(i)] * force_H;
  }
  const Vector3 turn = motion.spread * (moment_H + motion.arm_H.cross(force_H));
  const Vector3 turn_B = motion.R_HB.transpose() * turn;
  for (std::size_t i = 0; i < frame.turning.size(); ++i) {
    const Vector3 y = frame.y_B.col(static_cast<Eigen::Index>(i));
    force.col(frame.turning[i]) += motion.R_HB * turn_B.cross(y);
  }
}

}  // namespace limber::dynamics
