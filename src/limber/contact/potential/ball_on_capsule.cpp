// SPDX-License-Identifier: BSD-3-Clause
#include "limber/contact/potential/ball_on_capsule.hpp"

#include <algorithm>
#include <cmath>
#include <variant>

#include "limber/common/errors.hpp"
#include "limber/common/rotation.hpp"
#include "limber/contact/law/blend.hpp"
#include "limber/contact/law/materials.hpp"
#include "limber/contact/potential/hertz_ellipse.hpp"

namespace limber::contact {
namespace {

template <typename Kind>
const Kind& pick(const BodyKind& A, const BodyKind& B) {
  const auto* first = std::get_if<Kind>(&A);
  return first != nullptr ? *first : std::get<Kind>(B);
}

}  // namespace

struct BallOnCapsule::Stiffness {
  double k = 0.0;
  double k_z = 0.0;
  double k_d = 0.0;
  double k_zz = 0.0;
  double k_zd = 0.0;
  double k_dd = 0.0;
};

bool BallOnCapsule::suits(const BodyKind& A, const BodyKind& B) {
  const auto is_such = [](const BodyKind& ball, const BodyKind& rod) {
    return std::holds_alternative<Sphere>(ball) &&
           std::holds_alternative<Capsule>(rod);
  };
  return is_such(A, B) || is_such(B, A);
}

BallOnCapsule::BallOnCapsule(const BodyKind& A, const BodyKind& B,
                             double modulus)
    : is_ball_first_(std::holds_alternative<Sphere>(A)) {
  LIMBER_EXPECT(suits(A, B));
  ball_ = pick<Sphere>(A, B);
  capsule_ = pick<Capsule>(A, B);
  const double along = ball_.radius;
  radius_ = 1.0 / (1.0 / ball_.radius + 1.0 / capsule_.radius);
  flatness_ = std::sqrt(radius_ * along);
  of_end_ = find_hertz_stiffness(modulus, radius_);
  of_side_ = find_hertz_stiffness(modulus, flatness_) *
             find_ellipse_factor(0.5 * (radius_ + along) / flatness_).value;
}

// x = (z - L) / sqrt(R_e d), and the same of the other end
BallOnCapsule::Stiffness BallOnCapsule::find_stiffness(double z,
                                                       double d) const {
  const double width = std::sqrt(radius_ * d);
  const double rise = of_end_ - of_side_;
  Stiffness out{.k = of_side_};
  for (const double end : {-1.0, 1.0}) {
    const double x = (end * z - capsule_.half_length) / width;
    const Blend b = blend(x);
    const double x_z = end / width;
    const double x_d = -0.5 * x / d;
    out.k += rise * b.value;
    out.k_z += rise * b.slope * x_z;
    out.k_d += rise * b.slope * x_d;
    out.k_zz += rise * b.bend * x_z * x_z;
    out.k_zd += rise * (b.bend * x_z * x_d - b.slope * 0.5 * x_z / d);
    out.k_dd += rise * (b.bend * x_d * x_d + b.slope * 0.75 * x / (d * d));
  }
  return out;
}

// W(z, d) of the ball's centre; motions as exp of (u, theta) about the place.
Patch BallOnCapsule::press(const Pose& X_capsule, const Vector3& p) const {
  const Vector3 axis = X_capsule.R.col(2);
  const double z = axis.dot(p - X_capsule.p);
  const double L = capsule_.half_length;
  const Vector3 on_axis = X_capsule.p + std::clamp(z, -L, L) * axis;
  const Vector3 way = p - on_axis;
  const double length = way.norm();
  const double d = capsule_.radius + ball_.radius - length;
  Patch out;
  if (!(d > 0.0) || !(length > 0.0)) return out;
  const Vector3 n = way / length;
  const Stiffness s = find_stiffness(z, d);
  const double d15 = d * std::sqrt(d);
  const double d25 = d * d15;
  const double W_d = s.k * d15 + 0.4 * d25 * s.k_d;
  const double W_z = 0.4 * d25 * s.k_z;
  const double W_dd =
      1.5 * s.k * std::sqrt(d) + 2.0 * d15 * s.k_d + 0.4 * d25 * s.k_dd;
  const double W_zd = d15 * s.k_z + 0.4 * d25 * s.k_zd;
  const double W_zz = 0.4 * d25 * s.k_zz;
  Matrix3 across = Matrix3::Identity() - n * n.transpose();
  Matrix3 turning = across;
  if (std::abs(z) < L) turning -= axis * axis.transpose();
  const Vector3 f = W_z * axis - W_d * n;
  const Matrix3 H = W_dd * n * n.transpose() -
                    W_zd * (n * axis.transpose() + axis * n.transpose()) +
                    W_zz * axis * axis.transpose() - W_d / length * turning;
  const Vector3 r = (ball_.radius - 0.5 * d) * n;
  const Matrix3 arm = skew(r);
  out.touches = true;
  out.exponent = 1.5;
  out.depth = d;
  out.energy = 0.4 * s.k * d25;
  out.centre_W = p - r;
  out.gradient_W << f, r.cross(f);
  // The area's a^2 / d, which passes from the side to an end as k does.
  const double rise = of_end_ - of_side_;
  const double fraction = rise != 0.0 ? (s.k - of_side_) / rise : 0.0;
  const double a2_by_d = flatness_ + fraction * (radius_ - flatness_);
  out.spread_W = 0.2 * a2_by_d * d * across;
  Matrix6& K = out.hessian_W;
  K.topLeftCorner<3, 3>() = H;
  K.topRightCorner<3, 3>() = -H * arm + 0.5 * skew(f);
  K.bottomLeftCorner<3, 3>() = K.topRightCorner<3, 3>().transpose();
  K.bottomRightCorner<3, 3>() = arm.transpose() * H * arm +
                                0.5 * (f * r.transpose() + r * f.transpose()) -
                                f.dot(r) * Matrix3::Identity();
  return out;
}

Patch BallOnCapsule::evaluate(const Pose& X_A, const Pose& X_B) const {
  if (!is_ball_first_) return press(X_A, X_B.p);
  Patch out = press(X_B, X_A.p);
  out.gradient_W = -out.gradient_W;
  return out;
}

}  // namespace limber::contact
