// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "limber/common/pose.hpp"
#include "limber/dynamics/system/time_function.hpp"
#include "limber/flexbody/model/nodal_load.hpp"
#include "limber/joints/bushing.hpp"
#include "limber/joints/coordinates/axis_coordinate.hpp"
#include "limber/joints/point_spring.hpp"
#include "limber/joints/universal_constraint.hpp"

/// A tree of rigid bodies described independently of our equations, for any
/// rigid-body program. Plain values.
namespace limber::reference {

/// The ground, as a parent or as the body of a frame.
inline constexpr int kGround = -1;

/// How a body's frame M may move in its parent's frame F.
enum class Mobilizer {
  weld,       ///< not at all
  pin,        ///< rotates about z: angle [rad]
  slider,     ///< slides along z: distance [m]
  planar,     ///< x, y [m] in F, then an angle [rad] about z
  universal,  ///< rotates about x of F: angle [rad]; about y of M: angle [rad]
  ball,       ///< rotates: roll, pitch, yaw [rad]
  free,       ///< x, y, z [m] in F, then roll, pitch, yaw [rad]
};

/// A rigid body, its mass properties in its own frame, and its inboard joint.
struct MechanismBody {
  std::string name;
  double mass = 0.0;                  ///< [kg]; may be 0 on a weld
  Vector3 p_LBcm = Vector3::Zero();   ///< centre of mass, body frame [m]
  Matrix3 inertia = Matrix3::Zero();  ///< about it, body frame [kg m^2]
  int parent = kGround;               ///< index of a body before this one
  Mobilizer mobilizer = Mobilizer::weld;
  Pose X_PF;  ///< F on the parent
  Pose X_LM;  ///< M on this body
  /// Initial coordinates as listed at Mobilizer, and their rates; for ball and
  /// free the velocity and angular velocity of M in F, expressed in F.
  std::vector<double> position;  ///< empty: zero [m, rad]
  std::vector<double> velocity;  ///< empty: zero [m/s, rad/s]
};

struct MechanismFrame {
  int body = kGround;  ///< index
  Pose X_LF;
};

struct BushingElement {
  MechanismFrame F;
  MechanismFrame M;
  joints::Bushing::Parameters law;  ///< in F
  /// Axes in F in which all of `law` is diagonal; a free rotation is about its
  /// z [-].
  Matrix3 R_FD = Matrix3::Identity();
  /// Index of the body whose joint this element models; that joint is free if
  /// it is used.
  int joint_of = kGround;
};

/// Constraint springs of a universal joint.
struct UniversalElement {
  std::string name;
  MechanismFrame F;
  MechanismFrame M;
  joints::UniversalConstraint::Parameters law;
  int joint_of = kGround;  ///< index, as for a BushingElement
};

/// Linear spring and damper along a coordinate of M in F. Full turns are not
/// counted.
struct CoordinateElement {
  std::string name;
  MechanismFrame F;
  MechanismFrame M;
  joints::AxisCoordinate coordinate;
  double stiffness = 0.0;  ///< [N/m or N m/rad]
  double rest = 0.0;       ///< [m or rad]
  double damping = 0.0;    ///< [N s/m or N m s/rad]
};

struct SpringElement {
  MechanismFrame F;
  MechanismFrame M;
  joints::PointSpring::Parameters law;
};

/// Force and moment at a point, constant in the body or world frame, times
/// c(t).
struct LoadElement {
  int body = 0;                      ///< index
  Vector3 point = Vector3::Zero();   ///< in the body's frame [m]
  Vector3 force = Vector3::Zero();   ///< [N]
  Vector3 moment = Vector3::Zero();  ///< [N m]
  bool in_world = false;
  dynamics::TimeFunction function;
};

/// Force and moment of a nodal load on a body, at its frame B.
struct HistoryElement {
  MechanismFrame B;
  flexbody::NodalLoad history;
};

struct Mechanism {
  std::vector<MechanismBody> bodies;
  std::vector<BushingElement> bushings;
  std::vector<UniversalElement> universals;
  std::vector<CoordinateElement> coordinates;
  std::vector<SpringElement> springs;
  std::vector<LoadElement> loads;
  std::vector<HistoryElement> histories;
  Vector3 gravity_W = Vector3::Zero();   ///< [m/s^2]
  std::vector<MechanismFrame> observed;  ///< whose motion is reported
};

}  // namespace limber::reference
