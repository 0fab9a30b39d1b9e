// SPDX-License-Identifier: BSD-3-Clause
#include "limber/contact/potential/hertz_pair.hpp"

#include <cmath>
#include <variant>

#include "limber/common/errors.hpp"
#include "limber/common/rotation.hpp"
#include "limber/contact/law/materials.hpp"

namespace limber::contact {
namespace {

double find_curvature(const BodyKind& shape) {
  const auto* ball = std::get_if<Sphere>(&shape);
  return ball == nullptr ? 0.0 : 1.0 / ball->radius;
}

// Two surfaces that face each other, a and b from the place to the centres of A
// and B, infinite of a half space.
struct Facing {
  Vector3 normal = Vector3::Zero();  // from A to B
  double depth = 0.0;
  Vector3 place = Vector3::Zero();  // midway
  double turning = 0.0;             // 1 / (a + b) [1/m]
  double arm = 0.0;                 // a b / (a + b) [m]
  double lean = 0.0;                // (a - b) / (a + b)
};

Facing face_balls(const Vector3& p_A, double r_A, const Vector3& p_B,
                  double r_B) {
  const Vector3 way = p_B - p_A;
  const double L = way.norm();
  if (!(L > 0.0)) return {};
  const double depth = r_A + r_B - L;
  const double a = r_A - 0.5 * depth;
  const double b = r_B - 0.5 * depth;
  const Vector3 n = way / L;
  return {.normal = n,
          .depth = depth,
          .place = p_A + a * n,
          .turning = 1.0 / L,
          .arm = a * b / L,
          .lean = (a - b) / L};
}

// Of a half space A.
Facing face_plane(const Pose& X_plane, const Vector3& p, double r) {
  const Vector3 n = X_plane.R.col(2);
  const double depth = r - n.dot(p - X_plane.p);
  const double b = r - 0.5 * depth;
  return {
      .normal = n, .depth = depth, .place = p - b * n, .arm = b, .lean = 1.0};
}

Facing swap_sides(Facing at) {
  at.normal = -at.normal;
  at.lean = -at.lean;
  return at;
}

Facing face(const Pose& X_A, double curvature_A, const Pose& X_B,
            double curvature_B) {
  if (curvature_A == 0.0) return face_plane(X_A, X_B.p, 1.0 / curvature_B);
  if (curvature_B == 0.0)
    return swap_sides(face_plane(X_B, X_A.p, 1.0 / curvature_A));
  return face_balls(X_A.p, 1.0 / curvature_A, X_B.p, 1.0 / curvature_B);
}

}  // namespace

bool HertzPair::suits(const BodyKind& A, const BodyKind& B) {
  const auto is_ball = [](const BodyKind& shape) {
    return std::holds_alternative<Sphere>(shape);
  };
  const auto is_plane = [](const BodyKind& shape) {
    const auto* solid = std::get_if<ConvexSolid>(&shape);
    return solid != nullptr && !solid->is_bounded();
  };
  return (is_ball(A) && (is_ball(B) || is_plane(B))) ||
         (is_plane(A) && is_ball(B));
}

HertzPair::HertzPair(const BodyKind& A, const BodyKind& B, double modulus)
    : curvature_A_(find_curvature(A)),
      curvature_B_(find_curvature(B)),
      radius_(1.0 / (curvature_A_ + curvature_B_)),
      stiffness_(find_hertz_stiffness(modulus, radius_)) {
  LIMBER_EXPECT(suits(A, B));
}

// By a motion (u, theta) of B about the place the depth changes by -n . u -
// (|P u|^2 / L + lean n . (theta x u) - arm |P theta|^2) / 2, P across n.
Patch HertzPair::evaluate(const Pose& X_A, const Pose& X_B) const {
  const Facing at = face(X_A, curvature_A_, X_B, curvature_B_);
  Patch out;
  if (!(at.depth > 0.0) || !std::isfinite(at.depth)) return out;
  const Vector3& n = at.normal;
  const double d = at.depth;
  const double N = stiffness_ * d * std::sqrt(d);
  const Matrix3 across = Matrix3::Identity() - n * n.transpose();
  out.touches = true;
  out.exponent = 1.5;
  out.depth = d;
  out.energy = 0.4 * N * d;
  out.centre_W = at.place;
  out.gradient_W.head<3>() = -N * n;
  out.spread_W = 0.2 * radius_ * d * across;
  Matrix6& K = out.hessian_W;
  K.topLeftCorner<3, 3>() =
      1.5 * N / d * n * n.transpose() - N * at.turning * across;
  K.topRightCorner<3, 3>() = -0.5 * N * at.lean * skew(n);
  K.bottomLeftCorner<3, 3>() = K.topRightCorner<3, 3>().transpose();
  K.bottomRightCorner<3, 3>() = N * at.arm * across;
  return out;
}

}  // namespace limber::contact
