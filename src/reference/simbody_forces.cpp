// SPDX-License-Identifier: BSD-3-Clause
#include "reference/simbody_forces.hpp"

#include <Eigen/Eigenvalues>
#include <utility>

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

}  // namespace

ChordalBushing::ChordalBushing(const SimbodyFrame& F, const SimbodyFrame& M,
                               const joints::Bushing::Parameters& law)
    : F_(F),
      M_(M),
      Kt_(to_simtk(law.translational_stiffness)),
      Ct_(to_simtk(law.translational_damping)),
      Cr_(to_simtk(law.rotational_damping)) {
  const Matrix3& Kr = law.rotational_stiffness;
  const Eigen::SelfAdjointEigenSolver<Matrix3> principal(
      0.5 * Kr.trace() * Matrix3::Identity() - Kr);
  strength_ = to_simtk(Vector3(principal.eigenvalues()));
  for (int i = 0; i < 3; ++i) {
    axes_[i] = to_simtk(Vector3(principal.eigenvectors().col(i)));
  }
}

void ChordalBushing::calcForce(const State& state,
                               SimTK::Vector_<SpatialVec>& body_forces,
                               SimTK::Vector_<Vec3>& /*particle_forces*/,
                               SimTK::Vector& /*mobility_forces*/) const {
  const Transform X_GF = find_pose(F_, state);
  const Transform X_GM = find_pose(M_, state);
  const Rotation R_FM = ~X_GF.R() * X_GM.R();
  const Vec3 w_F = F_.body.getBodyAngularVelocity(state);
  const Vec3 w = M_.body.getBodyAngularVelocity(state) - w_F;
  // The point of F's body that is at Mo now: its velocity is what M leaves.
  const Vec3 at_F = F_.body.findStationAtGroundPoint(state, X_GM.p());
  const Vec3 v = M_.body.findStationVelocityInGround(state, M_.X_LF.p()) -
                 F_.body.findStationVelocityInGround(state, at_F);

  const Vec3 force_F = -(Kt_ * (~X_GF * X_GM.p())) - Ct_ * (~X_GF.R() * v);
  Vec3 moment_F = -(Cr_ * (~X_GF.R() * w));
  for (int i = 0; i < 3; ++i) {
    moment_F += strength_[i] * SimTK::cross(R_FM * axes_[i], axes_[i]);
  }
  const Vec3 force = X_GF.R() * force_F;
  const Vec3 moment = X_GF.R() * moment_F;
  push(M_.body, state, moment, force, X_GM.p(), body_forces);
  push(F_.body, state, -moment, -force, X_GM.p(), body_forces);
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
