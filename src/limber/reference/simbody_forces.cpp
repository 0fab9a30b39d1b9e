// SPDX-License-Identifier: BSD-3-Clause
#include "limber/reference/simbody_forces.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "limber/common/dense/symmetric_eigen.hpp"
#include "limber/common/errors.hpp"

namespace limber::reference {
namespace {

using SimTK::Rotation;
using SimTK::SpatialVec;
using SimTK::State;
using SimTK::Transform;
using SimTK::Vec3;

Transform find_pose(const SimbodyFrame& frame, const State& state) {
  return frame.body.getBodyTransform(state) * frame.X_LF;
}

/// Adds a moment and a force that acts at the world point `at` to a body.
void push(const SimTK::MobilizedBody& body, const State& state,
          const Vec3& moment, const Vec3& force, const Vec3& at,
          SimTK::Vector_<SpatialVec>& body_forces) {
  const Vec3 arm = at - body.getBodyOriginLocation(state);
  body_forces[body.getMobilizedBodyIndex()] +=
      SpatialVec(moment + SimTK::cross(arm, force), force);
}

/// Motion of M in F, world frame.
struct Motion {
  Transform X_GF;
  Transform X_GM;
  Vec3 w;
  Vec3 v;  ///< of Mo relative to the coincident point of F's body
};

Motion find_relative_motion(const SimbodyFrame& F, const SimbodyFrame& M,
                            const State& state) {
  Motion motion;
  motion.X_GF = find_pose(F, state);
  motion.X_GM = find_pose(M, state);
  const Vec3 at_F = F.body.findStationAtGroundPoint(state, motion.X_GM.p());
  motion.w = M.body.getBodyAngularVelocity(state) -
             F.body.getBodyAngularVelocity(state);
  motion.v = M.body.findStationVelocityInGround(state, M.X_LF.p()) -
             F.body.findStationVelocityInGround(state, at_F);
  return motion;
}

/// A moment and a force at Mo on M, expressed in the world frame, and their
/// reaction on F.
void push_apart(const SimbodyFrame& F, const SimbodyFrame& M,
                const State& state, const Vec3& moment, const Vec3& force,
                SimTK::Vector_<SpatialVec>& body_forces) {
  const Vec3 at = find_pose(M, state).p();
  push(M.body, state, moment, force, at, body_forces);
  push(F.body, state, -moment, -force, at, body_forces);
}

}  // namespace

ChordalBushing::ChordalBushing(const SimbodyFrame& F, const SimbodyFrame& M,
                               const joints::Bushing::Parameters& law)
    : F_(F),
      M_(M),
      Kt_(to_simtk(law.translational_stiffness)),
      Ct_(to_simtk(law.translational_damping)),
      Cr_(to_simtk(law.rotational_damping)) {
  const Matrix3& Kr = law.rotational_stiffness;
  const auto principal = dense::find_eigenpairs(
      Matrix3(0.5 * Kr.trace() * Matrix3::Identity() - Kr));
  strength_ = to_simtk(principal.values);
  for (int i = 0; i < 3; ++i) {
    axes_[i] = to_simtk(Vector3(principal.vectors.col(i)));
  }
}

void ChordalBushing::calcForce(const State& state,
                               SimTK::Vector_<SpatialVec>& body_forces,
                               SimTK::Vector_<Vec3>& /*particle_forces*/,
                               SimTK::Vector& /*mobility_forces*/) const {
  const Motion motion = find_relative_motion(F_, M_, state);
  const Transform& X_GF = motion.X_GF;
  const Rotation R_FM = ~X_GF.R() * motion.X_GM.R();

  const Vec3 force_F =
      -(Kt_ * (~X_GF * motion.X_GM.p())) - Ct_ * (~X_GF.R() * motion.v);
  Vec3 moment_F = -(Cr_ * (~X_GF.R() * motion.w));
  for (int i = 0; i < 3; ++i) {
    moment_F += strength_[i] * SimTK::cross(R_FM * axes_[i], axes_[i]);
  }
  push_apart(F_, M_, state, X_GF.R() * moment_F, X_GF.R() * force_F,
             body_forces);
}

SimTK::Real ChordalBushing::calcPotentialEnergy(const State& state) const {
  const Transform X_FM = ~find_pose(F_, state) * find_pose(M_, state);
  double energy = 0.5 * SimTK::dot(X_FM.p(), Kt_ * X_FM.p());
  for (int i = 0; i < 3; ++i) {
    // 1 - d . R d = |R d - d|^2 / 2, without cancellation.
    energy += 0.5 * strength_[i] * (X_FM.R() * axes_[i] - axes_[i]).normSqr();
  }
  return energy;
}

CrossBushing::CrossBushing(const SimbodyFrame& F, const SimbodyFrame& M,
                           const joints::UniversalConstraint::Parameters& law)
    : F_(F), M_(M), law_(law) {}

void CrossBushing::calcForce(const State& state,
                             SimTK::Vector_<SpatialVec>& body_forces,
                             SimTK::Vector_<Vec3>& /*particle_forces*/,
                             SimTK::Vector& /*mobility_forces*/) const {
  const Motion motion = find_relative_motion(F_, M_, state);
  const Vec3 gap = motion.X_GM.p() - motion.X_GF.p();
  const Vec3 a = motion.X_GF.R() * to_simtk(law_.axis_F);
  const Vec3 b = motion.X_GM.R() * to_simtk(law_.axis_M);
  const Vec3 normal = SimTK::cross(b, a);
  const double moment = law_.rotational_stiffness * SimTK::dot(a, b) +
                        law_.rotational_damping * SimTK::dot(motion.w, normal);
  push_apart(F_, M_, state, -moment * normal,
             -law_.translational_stiffness * gap -
                 law_.translational_damping * motion.v,
             body_forces);
}

SimTK::Real CrossBushing::calcPotentialEnergy(const State& state) const {
  const Transform X_GF = find_pose(F_, state);
  const Transform X_GM = find_pose(M_, state);
  const double h = SimTK::dot(X_GF.R() * to_simtk(law_.axis_F),
                              X_GM.R() * to_simtk(law_.axis_M));
  return 0.5 * law_.translational_stiffness * (X_GM.p() - X_GF.p()).normSqr() +
         0.5 * law_.rotational_stiffness * h * h;
}

CoordinateSpring::CoordinateSpring(const SimbodyFrame& F, const SimbodyFrame& M,
                                   CoordinateElement element)
    : F_(F), M_(M), element_(std::move(element)) {}

bool CoordinateSpring::is_angle() const {
  return element_.coordinate.kind == joints::AxisCoordinate::Kind::angle;
}

double CoordinateSpring::find_extension(const State& state) const {
  const Transform X_FM = ~find_pose(F_, state) * find_pose(M_, state);
  const Vec3 e = to_simtk(element_.coordinate.axis);
  if (!is_angle()) return SimTK::dot(e, X_FM.p()) - element_.rest;
  const SimTK::Quaternion q = X_FM.R().convertRotationToQuaternion();
  const double z = 2.0 * std::atan2(SimTK::dot(e, q.getSubVec<3>(1)), q[0]);
  const double wound = std::remainder(z - element_.rest, 2.0 * SimTK::Pi);
  constexpr double kNearlyHalfTurn = 3.0;
  if (element_.stiffness > 0.0 && std::abs(wound) > kNearlyHalfTurn) {
    throw NumericalError(
        fmt::format("a spring of joint '{}' is wound by {:.3g} rad; "
                    "Simbody's angle is valid up to {:g} rad",
                    element_.name, std::abs(wound), kNearlyHalfTurn));
  }
  return wound;
}

void CoordinateSpring::calcForce(const State& state,
                                 SimTK::Vector_<SpatialVec>& body_forces,
                                 SimTK::Vector_<Vec3>& /*particle_forces*/,
                                 SimTK::Vector& /*mobility_forces*/) const {
  const Motion motion = find_relative_motion(F_, M_, state);
  const Vec3 e = to_simtk(element_.coordinate.axis);
  Vec3 along = e;  // dz/dt is the rate along this
  if (is_angle()) {
    const SimTK::Quaternion q = Rotation(~motion.X_GF.R() * motion.X_GM.R())
                                    .convertRotationToQuaternion();
    const Vec3& v = q.getSubVec<3>(1);
    const double c = q[0];
    const double s = SimTK::dot(e, v);
    along = (c * (c * e + SimTK::cross(v, e)) + s * v) / (c * c + s * s);
  }
  along = motion.X_GF.R() * along;
  const double rate = SimTK::dot(along, is_angle() ? motion.w : motion.v);
  const Vec3 pull =
      -(element_.stiffness * find_extension(state) + element_.damping * rate) *
      along;
  push_apart(F_, M_, state, is_angle() ? pull : Vec3(0),
             is_angle() ? Vec3(0) : pull, body_forces);
}

SimTK::Real CoordinateSpring::calcPotentialEnergy(const State& state) const {
  const double extension = find_extension(state);
  return 0.5 * element_.stiffness * extension * extension;
}

TimedLoad::TimedLoad(const SimTK::MobilizedBody& body, const LoadElement& load,
                     const Interval& interval)
    : body_(body), load_(load), interval_(interval) {}

void TimedLoad::calcForce(const State& state,
                          SimTK::Vector_<SpatialVec>& body_forces,
                          SimTK::Vector_<Vec3>& /*particle_forces*/,
                          SimTK::Vector& /*mobility_forces*/) const {
  const double t = state.getTime();
  const double factor =
      dynamics::evaluate(load_.function, t, interval_.side(t));
  const Rotation& R = body_.getBodyRotation(state);
  Vec3 force = factor * to_simtk(load_.force);
  Vec3 moment = factor * to_simtk(load_.moment);
  if (!load_.in_world) {
    force = R * force;
    moment = R * moment;
  }
  push(body_, state, moment, force,
       body_.findStationLocationInGround(state, to_simtk(load_.point)),
       body_forces);
}

SteppedLoad::SteppedLoad(const SimbodyFrame& B, flexbody::NodalLoad history,
                         const Interval& interval)
    : B_(B), history_(std::move(history)), interval_(interval) {}

void SteppedLoad::calcForce(const State& state,
                            SimTK::Vector_<SpatialVec>& body_forces,
                            SimTK::Vector_<Vec3>& /*particle_forces*/,
                            SimTK::Vector& /*mobility_forces*/) const {
  const double t = state.getTime();
  const bool left = interval_.side(t) == Side::left;
  Eigen::Index column = -1;
  for (const double start : history_.times) {
    if (start < t || (start == t && !left)) ++column;
  }
  if (column < 0) return;
  const Transform X_GB = find_pose(B_, state);
  push(B_.body, state,
       X_GB.R() * to_simtk(Vector3(history_.moment.col(column))),
       X_GB.R() * to_simtk(Vector3(history_.force.col(column))), X_GB.p(),
       body_forces);
}

}  // namespace limber::reference
