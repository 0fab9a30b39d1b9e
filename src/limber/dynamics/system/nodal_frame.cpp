// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/system/nodal_frame.hpp"

#include <cmath>
#include <numeric>

#include "limber/common/dense/singular_values.hpp"
#include "limber/common/dense/symmetric_eigen.hpp"
#include "limber/common/errors.hpp"
#include "limber/common/rotation.hpp"

namespace limber::dynamics {
namespace {

constexpr double kThin = 1e-6;  // of the body's size

// Principal second moments of a set, the smallest first, and their axes.
dense::Eigenpairs3 find_moments(const Matrix3X& d, const Matrix3X& y) {
  const Matrix3 S = y * d.transpose();
  return dense::find_eigenpairs(Matrix3(0.5 * (S + S.transpose())));
}

double find_size(const flexbody::FullBody& body) {
  return (body.x_B.rowwise().maxCoeff() - body.x_B.rowwise().minCoeff())
      .maxCoeff();
}

// The frame rotates with all nodes of the body, or about a line with them.
void turn_with_body(const flexbody::FullBody& body, NodalFrame& frame) {
  frame.rotates = true;
  frame.turning.resize(static_cast<std::size_t>(body.node_count()));
  std::iota(frame.turning.begin(), frame.turning.end(), 0);
  frame.d_B = body.x_B.colwise() - frame.mean_B;
  frame.y_B = body.first_moment;
}

// sum (p_i - p) y_i^T, with p_i - p = d_i + u_i - u
Matrix3 find_correlation(const NodalFrame& frame, const ConstNodes& u_H,
                         const Vector3& u) {
  Matrix3 A = Matrix3::Zero();
  for (std::size_t i = 0; i < frame.turning.size(); ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    const Vector3 arm = frame.d_B.col(k) + u_H.col(frame.turning[i]) - u;
    A += arm * frame.y_B.col(k).transpose();
  }
  return A;
}

// sum lever_i x_i of a nodal field; levers sum to zero.
Vector3 find_line_vector(const NodalFrame& frame, const ConstNodes& x) {
  Vector3 sum = Vector3::Zero();
  for (std::size_t i = 0; i < frame.nodes.size(); ++i) {
    sum += frame.lever[static_cast<Eigen::Index>(i)] * x.col(frame.nodes[i]);
  }
  return sum;
}

// The rotation nearest to the correlation A among those that map `line` to t.
Matrix3 find_line_rotation(const Matrix3& A, const Vector3& line,
                           const Vector3& t) {
  const Matrix3 mean = find_polar_rotation(A);
  const Matrix3 R =
      Quaternion::FromTwoVectors(mean * line, t).toRotationMatrix() * mean;
  const Matrix3 B = R * A.transpose();
  const double angle =
      std::atan2((skew(t) * B).trace(), B.trace() - t.dot(B * t));
  return exp_rotation(angle * t) * R;
}

// Rotation of a set that defines it, and the map of a moment to its nodes.
void calc_rotation(const NodalFrame& frame, const ConstNodes& u_H,
                   const Vector3& u, NodalFrameMotion& motion) {
  const Matrix3 A = find_correlation(frame, u_H, u);
  if (!frame.is_line()) {
    motion.R_HB = find_polar_rotation(A);
    const Matrix3 S = motion.R_HB * A.transpose();
    motion.spread = (S.trace() * Matrix3::Identity() - S).inverse();
    return;
  }
  const Vector3 L = frame.line_B + find_line_vector(frame, u_H);
  const Vector3 t = L.normalized();
  motion.R_HB = find_line_rotation(A, frame.line_B, t);
  const Matrix3 S = motion.R_HB * A.transpose();
  const Vector3 k = S.trace() * t - S * t;
  const double inertia = k.dot(t);
  motion.spread = t * t.transpose() / inertia;
  motion.line_spread =
      (Matrix3::Identity() - t * k.transpose() / inertia) * skew(t) / L.norm();
}

}  // namespace

Matrix3 find_polar_rotation(const Matrix3& A) {
  auto [values, U, V] = dense::find_singular_form(A);
  if (U.determinant() * V.determinant() < 0.0) U.col(2) = -U.col(2);
  return U * V.transpose();
}

NodalFrame make_nodal_frame(const flexbody::FullBody& body,
                            const flexbody::NodeSet& set,
                            const Vector3& origin_B) {
  LIMBER_EXPECT(!set.nodes.empty() &&
                set.weights.size() == std::ssize(set.nodes) &&
                set.moments.cols() == std::ssize(set.nodes));
  NodalFrame frame;
  frame.nodes = set.nodes;
  frame.weights = set.weights;
  frame.d_B = body.x_B(Eigen::all, set.nodes);
  frame.mean_B = frame.d_B * set.weights;
  frame.d_B.colwise() -= frame.mean_B;
  frame.arm_B = origin_B - frame.mean_B;
  const dense::Eigenpairs3 moments = find_moments(frame.d_B, set.moments);
  const double thin = std::pow(kThin * find_size(body), 2);
  if (moments.values[1] > thin) {
    frame.rotates = true;
    frame.turning = frame.nodes;
    frame.y_B = set.moments;
  } else if (moments.values[2] > thin) {
    const Vector3 line = moments.vectors.col(2);
    frame.lever = set.moments.transpose() * line;
    frame.line_B = frame.d_B * frame.lever;
    turn_with_body(body, frame);
  } else if (!body.is_clamped()) {
    turn_with_body(body, frame);
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
  motion.line_spread.setZero();
  if (frame.rotates) {
    calc_rotation(frame, u_H, u, motion);
    Vector3 moment = Vector3::Zero();
    for (std::size_t i = 0; i < frame.turning.size(); ++i) {
      const Vector3 y_H =
          motion.R_HB * frame.y_B.col(static_cast<Eigen::Index>(i));
      const Vector3 velocity = udot_H.col(frame.turning[i]);
      moment += y_H.cross(velocity);
    }
    motion.w_H = motion.spread * moment;
    if (frame.is_line()) {
      motion.w_H += motion.line_spread * find_line_vector(frame, udot_H);
    }
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
  const Vector3 moment_at_mean = moment_H + motion.arm_H.cross(force_H);
  const Vector3 rotation = motion.spread * moment_at_mean;
  const Vector3 rotation_B = motion.R_HB.transpose() * rotation;
  for (std::size_t i = 0; i < frame.turning.size(); ++i) {
    const Vector3 y = frame.y_B.col(static_cast<Eigen::Index>(i));
    force.col(frame.turning[i]) += motion.R_HB * rotation_B.cross(y);
  }
  if (!frame.is_line()) return;
  const Vector3 pull = motion.line_spread.transpose() * moment_at_mean;
  for (std::size_t i = 0; i < frame.nodes.size(); ++i) {
    force.col(frame.nodes[i]) +=
        frame.lever[static_cast<Eigen::Index>(i)] * pull;
  }
}

}  // namespace limber::dynamics
