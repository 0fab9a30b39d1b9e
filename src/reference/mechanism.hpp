// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "common/pose.hpp"
#include "dynamics/time_function.hpp"
#include "flexbody/nodal_load.hpp"
#include "joints/axis_coordinate.hpp"
#include "joints/bushing.hpp"
#include "joints/point_spring.hpp"
#include "joints/universal_hold.hpp"

/// A tree of rigid bodies in words that any rigid-body program can read:
/// nothing of it is prepared for, or by, our own equations. Plain values.
namespace limber::reference {

/// The ground, as a parent or as the body of a frame.
inline constexpr int kGround = -1;

/// How a body's frame M may move in its parent's frame F.
enum class Mobilizer {
  weld,       ///< not at all
  pin,        ///< turns about z: angle [rad]
  slider,     ///< slides along z: distance [m]
  planar,     ///< x, y [m] along F, then an angle [rad] about z
  universal,  ///< turns about x of F: angle [rad]; about y of M: angle [rad]
  ball,       ///< turns: roll, pitch, yaw [rad]
  free,       ///< x, y, z [m] along F, then roll, pitch, yaw [rad]
};

/// A rigid body, its mass about its own frame, and the joint that it hangs on.
struct MechanismBody {
  std::string name;
  double mass = 0.0;                  ///< [kg]; may be 0 on a weld
  Vector3 p_LBcm = Vector3::Zero();   ///< centre of mass, body axes [m]
  Matrix3 inertia = Matrix3::Zero();  ///< about it, body axes [kg m^2]
  int parent = kGround;               ///< a body before this one
  Mobilizer mobilizer = Mobilizer::weld;
  Pose X_PF;  ///< F on the parent
  Pose X_LM;  ///< M on this body
  /// Coordinates at the start as Mobilizer tells, and their rates; of ball
  /// and free the velocity and the angular velocity of M in F, along F.
  std::vector<double> position;  ///< empty: zero
  std::vector<double> velocity;  ///< empty: zero [m/s, rad/s]
};

struct MechanismFrame {
  int body = kGround;
  Pose X_LF;
};

struct BushingElement {
  MechanismFrame F;
  MechanismFrame M;
  joints::Bushing::Parameters law;  ///< in F
  /// Axes in F along which all of `law` is diagonal; a free rotation is about
  /// its z.
  Matrix3 R_FD = Matrix3::Identity();
  /// Body whose joint this stands for; its joint is free while it acts.
  int joint_of = kGround;
};

/// What a universal joint holds.
struct UniversalElement {
  std::string name;
  MechanismFrame F;
  MechanismFrame M;
  joints::UniversalHold::Parameters law;
  int joint_of = kGround;  ///< as of a BushingElement
};

/// Linear spring and damper along a coordinate of M in F. Whole turns are not
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

/// Force and moment at a point, constant in body or world axes, times c(t).
struct LoadElement {
  int body = 0;
  Vector3 point = Vector3::Zero();   ///< in the body's frame [m]
  Vector3 force = Vector3::Zero();   ///< [N]
  Vector3 moment = Vector3::Zero();  ///< [N m]
  bool in_world = false;
  dynamics::TimeFunction function;
};

/// Force and moment on a body as a nodal load gives them at its frame B.
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
  Vector3 gravity_W = Vector3::Zero();  ///< [m/s^2]
  std::vector<MechanismFrame> watched;  ///< whose motion is asked for
};

}  // namespace limber::reference
