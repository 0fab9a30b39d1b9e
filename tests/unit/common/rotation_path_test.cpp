// SPDX-License-Identifier: BSD-3-Clause
#include "limber/common/rotation_path.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "limber/common/rotation.hpp"

namespace limber::rotation_path_test {
namespace {

// Angular velocity that turns in space and in the body [rad/s].
Vector3 find_velocity(double t) {
  return {1.0 + std::sin(2.0 * t), std::cos(3.0 * t), 0.5 * t - 1.0};
}

struct Exact {
  Matrix3 R = Matrix3::Identity();
  Vector3 path = Vector3::Zero();
};

// By Gauss's rule and the commutator-free form of Magnus's series, fourth
// order, in steps far shorter.
Exact integrate(double from, double h, RotationAxes axes) {
  constexpr int kSteps = 2000;
  const double dt = h / kSteps;
  const double shift = dt / std::sqrt(12.0);
  Exact exact;
  for (int i = 0; i < kSteps; ++i) {
    const double middle = from + (i + 0.5) * dt;
    const Vector3 a = find_velocity(middle - shift);
    const Vector3 b = find_velocity(middle + shift);
    const Vector3 mean = 0.5 * dt * (a + b);
    const Vector3 twist = std::sqrt(3.0) / 12.0 * dt * dt * b.cross(a);
    exact.path += mean;
    exact.R = axes == RotationAxes::fixed
                  ? Matrix3(exp_rotation(mean + twist) * exact.R)
                  : Matrix3(exact.R * exp_rotation(mean - twist));
  }
  return exact;
}

double find_error(double h, RotationAxes axes) {
  const double start = 0.3;
  const Exact exact = integrate(start, h, axes);
  const Vector3 path = integrate_rotation(exact.R, find_velocity(start),
                                          find_velocity(start + h), h, axes);
  return (path - exact.path).norm();
}

TEST(RotationPath, HasAnErrorOfTheFifthPowerOfTheStep) {
  for (const RotationAxes axes :
       {RotationAxes::fixed, RotationAxes::rotating}) {
    EXPECT_LT(find_error(0.1, axes), 1e-5);
    EXPECT_NEAR(std::log2(find_error(0.1, axes) / find_error(0.05, axes)), 5.0,
                0.2);
    EXPECT_NEAR(std::log2(find_error(0.05, axes) / find_error(0.025, axes)),
                5.0, 0.2);
  }
}

TEST(RotationPath, IsTheAngleAboutAFixedAxisWhateverTheVelocity) {
  const Vector3 axis = Vector3(1.0, -2.0, 0.5).normalized();
  const Vector3 path =
      integrate_rotation(exp_rotation(2.0 * axis), 9.0 * axis, -4.0 * axis, 0.5,
                         RotationAxes::fixed);
  EXPECT_LT((path - 2.0 * axis).norm(), 1e-14);
}

TEST(RotationPath, IsUnknownBeyondHalfATurn) {
  const Vector3 axis = Vector3::UnitY();
  const Vector3 path =
      integrate_rotation(exp_rotation(5.0 * axis), 5.0 * axis, 5.0 * axis, 1.0,
                         RotationAxes::rotating);
  EXPECT_TRUE(std::isnan(path.x()));
}

}  // namespace
}  // namespace limber::rotation_path_test
