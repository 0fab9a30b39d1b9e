// SPDX-License-Identifier: BSD-3-Clause
#include "limber/common/rotation.hpp"

#include <cmath>

namespace limber {
namespace {

// Below this squared angle the series to the second term is exact in double.
constexpr double kSmallAngleSquared = 1e-8;

// sum + factor theta theta'; skew(theta)^2 is theta theta' - theta^2 I.
Matrix3 add_square(Matrix3 sum, double factor, const Vector3& theta) {
  const Vector3 scaled = factor * theta;
  for (int j = 0; j < 3; ++j) sum.col(j) += theta[j] * scaled;
  return sum;
}

}  // namespace

Matrix3 skew(const Vector3& a) {
  Matrix3 m;
  m << 0.0, -a.z(), a.y(), a.z(), 0.0, -a.x(), -a.y(), a.x(), 0.0;
  return m;
}

Quaternion exp_quaternion(const Vector3& theta) {
  const double angle2 = theta.squaredNorm();
  double half_sinc = 0.5;  // sin(angle / 2) / angle
  double w = 1.0;
  if (angle2 < kSmallAngleSquared) {
    half_sinc = 0.5 - angle2 / 48.0;
    w = 1.0 - angle2 / 8.0;
  } else {
    const double angle = std::sqrt(angle2);
    half_sinc = std::sin(0.5 * angle) / angle;
    w = std::cos(0.5 * angle);
  }
  const Vector3 v = half_sinc * theta;
  return {w, v.x(), v.y(), v.z()};
}

Matrix3 exp_rotation(const Vector3& theta) {
  return exp_quaternion(theta).toRotationMatrix();
}

Vector3 log_rotation(const Quaternion& rotation) {
  // The half-angle form has no cancellation anywhere on (-pi, pi].
  const double sign = rotation.w() < 0.0 ? -1.0 : 1.0;
  const Vector3 v = sign * rotation.vec();
  const double w = sign * rotation.w();
  const double s = v.norm();
  if (s < 1e-8) return (2.0 / w) * v;
  return (2.0 * std::atan2(s, w) / s) * v;
}

Vector3 log_rotation(const Matrix3& rotation) {
  return log_rotation(Quaternion(rotation).normalized());
}

Matrix3 left_jacobian(const Vector3& theta) {
  const double angle2 = theta.squaredNorm();
  double a = 0.5;        // (1 - cos) / angle^2
  double b = 1.0 / 6.0;  // (angle - sin) / angle^3
  if (angle2 < 1e-4) {
    a = 0.5 - angle2 / 24.0 + angle2 * angle2 / 720.0;
    b = 1.0 / 6.0 - angle2 / 120.0 + angle2 * angle2 / 5040.0;
  } else {
    const double angle = std::sqrt(angle2);
    const double half = std::sin(0.5 * angle);
    a = 2.0 * half * half / angle2;
    b = (angle - std::sin(angle)) / (angle2 * angle);
  }
  return add_square((1.0 - b * angle2) * Matrix3::Identity() + a * skew(theta),
                    b, theta);
}

Matrix3 left_jacobian_derivative(const Vector3& theta,
                                 const Vector3& direction) {
  // J_l = 1 + a S + b S S with a = (1 - cos) / angle^2, b = (angle - sin) /
  // angle^3; derivatives are with respect to angle^2, times two.
  const double x = theta.squaredNorm();
  double a = 0.0;
  double b = 0.0;
  double a_slope = 0.0;
  double b_slope = 0.0;
  if (x < 0.1) {  // cancellation in the closed forms: 1e-11
    a = 0.5 - x / 24.0 * (1.0 - x / 30.0 * (1.0 - x / 56.0 * (1.0 - x / 90.0)));
    b = 1.0 / 6.0 -
        x / 120.0 * (1.0 - x / 42.0 * (1.0 - x / 72.0 * (1.0 - x / 110.0)));
    a_slope =
        -1.0 / 12.0 *
        (1.0 - x / 15.0 * (1.0 - 1.5 * x / 56.0 * (1.0 - 4.0 * x / 270.0)));
    b_slope =
        -1.0 / 60.0 *
        (1.0 - x / 21.0 * (1.0 - 1.5 * x / 72.0 * (1.0 - 4.0 * x / 330.0)));
  } else {
    const double angle = std::sqrt(x);
    const double sine = std::sin(angle);
    const double half = std::sin(0.5 * angle);
    a = 2.0 * half * half / x;
    b = (angle - sine) / (x * angle);
    a_slope = (sine / angle - 2.0 * a) / x;
    b_slope = (a - 3.0 * b) / x;
  }
  const Matrix3 s = skew(theta);
  const Matrix3 d = skew(direction);
  const double along = theta.dot(direction);
  return a * d + b * (s * d + d * s) + along * (a_slope * s + b_slope * s * s);
}

Matrix3 right_jacobian(const Vector3& theta) { return left_jacobian(-theta); }

Matrix3 right_jacobian_inverse(const Vector3& theta) {
  const double angle2 = theta.squaredNorm();
  double c = 1.0 / 12.0;
  if (angle2 < 1e-4) {
    c = 1.0 / 12.0 + angle2 / 720.0 + angle2 * angle2 / 30240.0;
  } else {
    const double angle = std::sqrt(angle2);
    c = 1.0 / angle2 -
        std::cos(0.5 * angle) / (2.0 * angle * std::sin(0.5 * angle));
  }
  return add_square(
      (1.0 - c * angle2) * Matrix3::Identity() + 0.5 * skew(theta), c, theta);
}

}  // namespace limber
