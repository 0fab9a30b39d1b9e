// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <utility>

#include "limber/contact/patches/patch_pair.hpp"
#include "limber/contact/shapes/mesh_surface.hpp"
#include "limber/dynamics/system/system_builder.hpp"
#include "limber/dynamics/system/system_state.hpp"
#include "limber/flexbody/model/contact_surface.hpp"
#include "limber/flexbody/model/reduced_body.hpp"

/// A steel rod of 1 m and 1 cm^2 with the closed form's axial modes and
/// residual flexibility, which strikes with a flat end.
namespace limber::contact::test {

inline constexpr double kPi = std::numbers::pi;
inline constexpr double kLength = 1.0;     // [m]
inline constexpr double kSide = 0.01;      // [m]
inline constexpr double kModulus = 210e9;  // [Pa]
inline constexpr double kDensity = 7850.0;
inline constexpr double kArea = kSide * kSide;
inline constexpr double kMass = kDensity * kArea * kLength;
inline const double kSpeed = std::sqrt(kModulus / kDensity);  // of waves [m/s]
inline const double kForce = kModulus * kArea / kSpeed;       // [N], at 1 m/s
inline const double kDuration = 2.0 * kLength / kSpeed;       // [s]

inline double mode_at(int n, double x) {  // from the end that strikes
  return std::sqrt(2.0 / kMass) * std::cos(n * kPi * x / kLength);
}

/// R = L / (3 E A) - sum 2 L / (n^2 pi^2 E A) at the end.
inline double find_residual(int modes) {
  double sum = 1.0 / 3.0;
  for (int n = 1; n <= modes; ++n) sum -= 2.0 / (n * n * kPi * kPi);
  return sum * kLength / (kModulus * kArea);
}

/// The part of the highest modes that contact has, of N: sqrt(1 - u^4).
inline double roll_off(int n, int modes) {
  return std::sqrt(1.0 - std::pow(n / (modes + 0.5), 4));
}

/// The end as one part.
inline flexbody::ContactPart make_end_part(int modes) {
  flexbody::ContactPart part;
  part.normal_B = -Vector3::UnitX();
  part.centre_B = -0.5 * kLength * Vector3::UnitX();
  part.corners_B.resize(3, 4);
  for (int i = 0; i < 4; ++i) {
    part.corners_B.col(i) << -0.5 * kLength, (i / 2 ? 0.5 : -0.5) * kSide,
        (i % 3 == 0 ? -0.5 : 0.5) * kSide;
  }
  part.motion_B = MatrixX::Zero(6, modes);
  part.rim = {0, 1, 2, 3};
  part.depth = 0.25 * kSide;
  part.residual = part.flexibility = find_residual(modes);
  for (int n = 1; n <= modes; ++n) {
    const double fraction = roll_off(n, modes);
    part.motion_B(0, n - 1) = fraction * mode_at(n, 0.0);
    part.flexibility += (1.0 - fraction * fraction) * 2.0 * kLength /
                        (n * n * kPi * kPi * kModulus * kArea);
  }
  return part;
}

/// The end that strikes: a square at x = -L / 2, of one part.
inline flexbody::ContactSurface make_end(int modes) {
  flexbody::ContactSurface end;
  end.name = "end";
  end.tags = {1, 2, 3, 4};
  end.x_B.resize(3, 4);
  for (int i = 0; i < 4; ++i) {
    end.x_B.col(i) << -0.5 * kLength, (i & 1 ? 0.5 : -0.5) * kSide,
        (i & 2 ? 0.5 : -0.5) * kSide;
  }
  end.Phi_B = MatrixX::Zero(12, modes);
  for (int i = 0; i < 4; ++i) {
    for (int n = 1; n <= modes; ++n) end.Phi_B(3 * i, n - 1) = mode_at(n, 0.0);
  }
  end.residual = VectorX::Constant(4, find_residual(modes));
  end.patch_radius = VectorX::Constant(4, kSide);
  end.faces = {{0, 2, 1, -1, -1, -1}, {1, 2, 3, -1, -1, -1}};
  end.parts = {make_end_part(modes)};
  end.youngs_modulus = kModulus;
  end.poisson_ratio = 0.0;
  return end;
}

/// Second moments of mass, int r r^T dm [kg m^2].
inline Matrix3 make_second_moments() {
  const double side = kMass * kSide * kSide / 12.0;
  return Vector3(kMass * kLength * kLength / 12.0, side, side).asDiagonal();
}

inline std::shared_ptr<const flexbody::ReducedBody> make_rod(int modes) {
  auto rod = std::make_shared<flexbody::ReducedBody>();
  rod->name = "rod";
  rod->mass = kMass;
  rod->integrals.S0 = make_second_moments();
  const auto m = static_cast<std::size_t>(modes);
  rod->integrals.S1.assign(m, Matrix3::Zero());
  rod->integrals.S2.assign(m * m, Matrix3::Zero());
  rod->integrals.P = Matrix3X::Zero(3, modes);
  rod->lambda.resize(modes);
  for (int n = 1; n <= modes; ++n) {
    const auto k = static_cast<std::size_t>(n - 1);
    const double omega = n * kPi * kSpeed / kLength;
    rod->lambda[n - 1] = omega * omega;
    rod->integrals.S1[k](0, 0) = std::sqrt(2.0 * kMass) * kLength /
                                 (n * n * kPi * kPi) *
                                 (std::cos(n * kPi) - 1.0);
    rod->integrals.S2[k * m + k](0, 0) = 1.0;
  }
  const flexbody::ContactSurface end = make_end(modes);
  rod->rows.x_B = end.x_B;
  rod->rows.Phi_B = end.Phi_B;
  rod->rows.tags = end.tags;
  return rod;
}

enum class Target { wall, box, rod };

inline ContactSide make_rod_side(int modes) {
  const Matrix3 S = make_second_moments();
  return {Shape{std::make_shared<const MeshSurface>(make_end(modes)), {}},
          SurfaceMaterial{kModulus, 0.0}, kMass,
          S.trace() * Matrix3::Identity() - S};
}

/// What is struck fills x < 0; the rod comes along -x.
struct RodScene {
  dynamics::SystemModel model;
  dynamics::SystemState state;
};

inline RodScene make_rod_scene(int modes, Target target,
                               const ContactParameters& parameters) {
  constexpr double kFixed = std::numeric_limits<double>::infinity();
  constexpr double kHeavy = 1e9;
  dynamics::SystemBuilder builder;
  const auto rod = builder.add_flexible_body("rod", make_rod(modes),
                                             dynamics::Fidelity::coupled, {});
  const auto add_pair = [&](dynamics::BodyIndex other, ContactSide side) {
    builder.add_pair("other/rod", other, rod,
                     std::make_shared<PatchPair>(
                         std::move(side), make_rod_side(modes), parameters));
  };
  if (target == Target::wall) {
    Pose wall;
    wall.R.col(0) = -Vector3::UnitZ();
    wall.R.col(1) = Vector3::UnitY();
    wall.R.col(2) = Vector3::UnitX();
    add_pair(dynamics::kWorld,
             {Shape{HalfSpace{}, wall}, std::nullopt, kFixed});
  } else if (target == Target::box) {
    const auto box = builder.add_rigid_body(
        "box", {.mass = kHeavy, .inertia = kHeavy * Matrix3::Identity()});
    add_pair(box, {Shape{Box{{0.1, 0.05, 0.04}}, {}}, std::nullopt, kHeavy,
                   kHeavy * Matrix3::Identity()});
  } else {
    const auto other = builder.add_flexible_body(
        "other", make_rod(modes), dynamics::Fidelity::coupled, {});
    add_pair(other, make_rod_side(modes));
  }
  RodScene scene{builder.build(), {}};
  scene.state = dynamics::make_state(scene.model);
  auto& bodies = scene.state.bodies;
  bodies[0].p_WB = {0.5 * kLength + 1e-6, 0.0, 0.0};
  bodies[0].v_WB_W = {-1.0, 0.0, 0.0};
  if (target == Target::box) bodies[1].p_WB = {-0.1, 0.003, 0.002};
  if (target == Target::rod) {
    bodies[0].v_WB_W = {-0.5, 0.0, 0.0};
    bodies[1].quat_WB = Quaternion(0.0, 0.0, 0.0, 1.0);  // half a turn about z
    bodies[1].p_WB = {-0.5 * kLength, 0.0, 0.0};
    bodies[1].v_WB_W = {0.5, 0.0, 0.0};
  }
  return scene;
}

}  // namespace limber::contact::test
