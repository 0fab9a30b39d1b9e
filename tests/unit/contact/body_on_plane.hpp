// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>

#include "limber/contact/make_contact.hpp"
#include "limber/dynamics/system/system_builder.hpp"
#include "unit/contact/pair_scene.hpp"

namespace limber::contact::test {

/// A rigid body above a plane, with gravity against its normal unless the plane
/// slopes. F is the frame of the plane, its normal along z.
struct BodyOnPlane {
  ShapeKind shape;
  double mass = 1.0;                          ///< [kg]
  Vector3 moments = Vector3::Constant(1e-3);  ///< [kg m^2]
  SurfaceMaterial material{1e10, 0.3};        ///< the plane is rigid
  ContactParameters parameters = {};
  Vector3 p_F = Vector3::Zero();  ///< [m]
  Vector3 v_F = Vector3::Zero();  ///< [m/s]
  Matrix3 R_FB = Matrix3::Identity();
  Matrix3 R_WF = Matrix3::Identity();
  double slope = 0.0;     ///< down along x [rad]
  bool is_first = false;  ///< whether the body is A

  static constexpr double kGravity = 9.81;  // [m/s^2]

  [[nodiscard]] PairScene make() const {
    constexpr double kFixed = std::numeric_limits<double>::infinity();
    dynamics::SystemBuilder builder;
    const Matrix3 inertia = moments.asDiagonal();
    const auto body = builder.add_rigid_body("body", {mass, inertia});
    const ContactSide own{Shape{shape, {}}, material, mass, inertia};
    const ContactSide plane{
        Shape{HalfSpace{}, {R_WF, Vector3::Zero()}}, {}, kFixed};
    if (is_first) {
      builder.add_pair("p", body, dynamics::kWorld,
                       make_contact(own, plane, parameters));
    } else {
      builder.add_pair("p", dynamics::kWorld, body,
                       make_contact(plane, own, parameters));
    }
    PairScene scene{builder.build(), {}};
    scene.model.gravity_W =
        kGravity * R_WF * Vector3(std::sin(slope), 0.0, -std::cos(slope));
    scene.state = make_state(scene.model);
    scene.body().quat_WB = Quaternion(R_WF * R_FB);
    scene.body().p_WB = R_WF * p_F;
    scene.body().v_WB_W = R_WF * v_F;
    return scene;
  }
};

}  // namespace limber::contact::test
