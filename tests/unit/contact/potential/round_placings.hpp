// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "limber/common/rotation.hpp"
#include "limber/contact/shapes/shape.hpp"

/// Cylinders, cones, capsules, balls, ellipsoids and boxes that touch.
namespace limber::contact::round_placings {

inline constexpr double kModulus = 1e9;  // [Pa]
inline constexpr double kPi = std::numbers::pi;
inline const Cylinder kRod{0.02, 0.1};
inline const Capsule kPill{0.02, 0.1};
inline const Cylinder kLog{0.05, 0.6};
inline const Sphere kBall{0.05};
inline const Box kBox{Vector3(0.03, 0.02, 0.05)};
inline const HalfSpace kPlane{};
inline const Cone kCone{0.04, 0.05};
inline const Ellipsoid kEgg{Vector3(0.02, 0.03, 0.06)};

inline Matrix3 turn(double x, double y, double z) {
  return exp_rotation(Vector3(x, y, z));
}

struct Placing {
  std::string name;
  ShapeKind A;  // at the origin
  ShapeKind B;
  Pose X_WB;
  // Of the gradient: the factor leaves out the turn of the resultant, of the
  // order of depth over radius.
  double slack = 2e-6;
  // Of the Hessian by rotations: the second derivative of the factor.
  double turning = 0.03;
};

// Lowest point d below z = 0.
inline Pose lower(const ShapeKind& shape, const Matrix3& R, double d) {
  double reach = 0.0;
  if (const auto* box = std::get_if<Box>(&shape)) {
    reach = (R.transpose() * Vector3::UnitZ()).cwiseAbs().dot(box->half_size);
  } else if (const auto* ball = std::get_if<Sphere>(&shape)) {
    reach = ball->radius;
  } else if (const auto* pill = std::get_if<Capsule>(&shape)) {
    reach = pill->radius + pill->half_length * std::abs(R(2, 2));
  } else if (const auto* rod = std::get_if<Cylinder>(&shape)) {
    reach = rod->half_length * std::abs(R(2, 2)) +
            rod->radius * std::hypot(R(2, 0), R(2, 1));
  } else if (const auto* egg = std::get_if<Ellipsoid>(&shape)) {
    reach = (R.transpose() * Vector3::UnitZ()).cwiseProduct(egg->radii).norm();
  } else if (const auto* cone = std::get_if<Cone>(&shape)) {
    reach = std::max(-cone->half_length * R(2, 2),
                     cone->half_length * R(2, 2) +
                         cone->radius * std::hypot(R(2, 0), R(2, 1)));
  }
  return {R, Vector3(0.01, -0.02, reach - d)};
}

// A corner of the box 0.1 from the middle of the log, straight down on it.
inline Pose stand_on_log(double d) {
  const Matrix3 R = turn(0, 0, 0.2) * turn(0.3, 0.6, 0);
  Vector3 corner = Vector3::Zero();
  for (int i = 0; i < 8; ++i) {
    const Vector3 signs((i & 1) != 0 ? 1 : -1, (i & 2) != 0 ? 1 : -1,
                        (i & 4) != 0 ? 1 : -1);
    const Vector3 x = R * kBox.half_size.cwiseProduct(signs);
    if (x.x() < corner.x()) corner = x;
  }
  return {R, Vector3(kLog.radius - d, 0, 0.1) - corner};
}

inline std::vector<Placing> make_placings() {
  const double d = 1e-4;
  const auto on_plane = [&](std::string name, const ShapeKind& B,
                            const Matrix3& R) {
    return Placing{std::move(name), kPlane, B, lower(B, R, d)};
  };
  const auto on_log = [](std::string name, const ShapeKind& B, const Matrix3& R,
                         const Vector3& p) {
    return Placing{std::move(name), kLog, B, Pose{R, p}};
  };
  const double R = kLog.radius;
  return {
      on_plane("rod lying", kRod, turn(kPi / 2, 0, 0)),
      on_plane("rod nearly lying", kRod, turn(kPi / 2 + 1e-3, 0, 0)),
      on_plane("rim on plane", kRod, turn(0.3, 0.1, 0)),
      on_plane("rod tilted by little", kRod, turn(1e-2, 0, 0)),
      on_plane("pill lying", kPill, turn(kPi / 2, 0, 0)),
      on_plane("pill nearly lying", kPill, turn(kPi / 2 - 1e-3, 0.2, 0)),
      {"box corner on log", kLog, kBox, stand_on_log(d)},
      on_log("box face on log", kBox, turn(0, 0, 0),
             {R + kBox.half_size.x() - d, 0, 0.1}),
      on_log("box edge across log", kBox, turn(0, kPi / 4, 0),
             {R + 0.08 / std::sqrt(2.0) - d, 0, 0.1}),
      on_log("rod across log", kRod, turn(kPi / 2, 0, 0),
             {R + kRod.radius - d, 0, 0.1}),
      on_log("rod askew over log's end", kRod, turn(1e-3, 2e-4, 0),
             {R + kRod.radius - d, 0, 0.55}),
      on_log("rod's rim on log's end", kRod, turn(0.2, 0.1, 0),
             {0.01, 0, 0.6 + 0.1 * 0.975 + 0.02 * 0.223 - d}),
      on_log("pill across log", kPill, turn(0.7, 0, 0), {R + 0.02 - d, 0, 0.1}),
      on_log("ball on log", kBall, turn(0, 0, 0), {R + 0.05 - d, 0, 0.1}),
      {"ball on box's edge",
       kBox,
       kBall,
       {turn(0, 0, 0), {0.079, 0.021, 0.02}},
       5e-5},
      {"pill on box's edge",
       kBox,
       kPill,
       {turn(0, 0, 0.3), {0.04, 0.03, 0.1}},
       5e-4},
      on_plane("tip on plane", kCone, turn(kPi, 0, 0)),
      on_plane("tip askew on plane", kCone, turn(kPi - 0.5, 0.2, 0)),
      on_plane("cone lying", kCone,
               turn(kPi / 2 + std::atan2(0.04, 0.1), 0, 0)),
      on_plane("cone standing askew", kCone, turn(0.1, 0.05, 0)),
      on_plane("cone standing nearly", kCone, turn(0.01, 0, 0)),
      {"tip on box",
       kBox,
       kCone,
       {turn(0, kPi / 2 + 0.3, 0),
        Vector3(-0.03 + d, 0, 0.01) -
            0.05 * (turn(0, kPi / 2 + 0.3, 0) * Vector3::UnitZ())}},
      {"box's edge on cone",
       kCone,
       kBox,
       {turn(0, kPi / 4, 0),
        {0.02 + 0.08 / std::sqrt(2.0) - d, 0, 0.02 / std::sqrt(2.0)}},
       2e-4,
       0.05},
      {"cone's tip on log",
       kLog,
       kCone,
       {turn(0, -kPi / 2, 0), {R + 0.05 - d, 0, 0.1}}},
      {"cone's side across log",
       kLog,
       kCone,
       {turn(kPi / 2, 0, 0), {R * std::sqrt(1.16) + 0.02 - d, 0, 0.1}}},
      {"ball on cone",
       kCone,
       kBall,
       {turn(0, 0, 0),
        Vector3(0.02, 0, 0) + (0.05 - d) * Vector3(0.1, 0, 0.04).normalized()}},
      {"egg on box's edge",
       kBox,
       kEgg,
       {turn(0.2, 0.3, 0.4), {0.049, 0.0305, 0.02}},
       5e-4},
      {"egg on box's face",
       kBox,
       kEgg,
       {turn(0, 0, 0), {0.03 + 0.02 - d, 0.0, 0.01}}},
      {"egg on log", kLog, kEgg, {turn(0, 0, 0), {R + 0.02 - d, 0, 0.1}}},
      {"egg on tip", kCone, kEgg, {turn(0, 0, 0), {0, 0, 0.05 + 0.06 - d}}},
      {"rod over box's edge",
       kBox,
       kRod,
       {turn(1e-3, 2e-4, 0), {0.025, 0.005, 0.15 - d}}},
  };
}

}  // namespace limber::contact::round_placings
