// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <limits>
#include <memory>
#include <numbers>

#include "limber/contact/make_contact.hpp"
#include "limber/dynamics/system/system_builder.hpp"
#include "limber/dynamics/system/system_state.hpp"

/// A steel ball that flies against a steel floor.
namespace limber::contact::test {

inline constexpr double kBallRadius = 0.01;  // [m]
inline constexpr double kBallMass = 7800.0 * 4.0 / 3.0 * std::numbers::pi *
                                    kBallRadius * kBallRadius *
                                    kBallRadius;  // [kg]
inline constexpr SurfaceMaterial kSteel{2.1e11, 0.3};

/// k = 4/3 E* sqrt(R) of both [N/m^1.5].
inline double hertz_stiffness() {
  return 4.0 / 3.0 * 2.1e11 / (2.0 * (1.0 - 0.09)) * std::sqrt(kBallRadius);
}

/// The floor is z < 0, the ball 1 um above it at the start.
struct BallOnFloor {
  dynamics::SystemModel model;
  dynamics::SystemState state;

  BallOnFloor(const ContactParameters& parameters, const Vector3& velocity) {
    dynamics::SystemBuilder builder;
    const auto ball = builder.add_rigid_body(
        "ball", {kBallMass, 0.4 * kBallMass * kBallRadius * kBallRadius *
                                Matrix3::Identity()});
    constexpr double kFixed = std::numeric_limits<double>::infinity();
    builder.add_pair(
        "floor/ball", dynamics::kWorld, ball,
        make_contact(
            ContactSide{Shape{HalfSpace{}, {}}, kSteel, kFixed},
            ContactSide{Shape{Sphere{kBallRadius}, {}}, kSteel, kBallMass},
            parameters));
    model = builder.build();
    state = dynamics::make_state(model);
    state.bodies[0].p_WB = {0.0, 0.0, kBallRadius + 1e-6};
    state.bodies[0].v_WB_W = velocity;
  }
};

}  // namespace limber::contact::test
