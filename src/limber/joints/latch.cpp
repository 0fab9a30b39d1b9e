// SPDX-License-Identifier: BSD-3-Clause
#include "limber/joints/latch.hpp"

#include <fmt/format.h>

#include <cmath>

#include "limber/common/errors.hpp"

namespace limber::joints {

Latch::Latch(const Parameters& parameters)
    : parameters_(parameters), bushing_(parameters.bushing) {
  const Parameters& p = parameters;
  if (!(p.reach > 0.0) || !std::isfinite(p.reach)) {
    throw InputError(
        fmt::format("latch: its reach is {:g} m; expected > 0", p.reach));
  }
  if (!(p.release_force > 0.0)) {
    throw InputError(fmt::format(
        "latch: its release force is {:g} N; expected > 0", p.release_force));
  }
  if (!(p.release_time > -kNever)) {
    throw InputError(fmt::format(
        "latch: its release time is {:g} s; expected a time", p.release_time));
  }
}

CouplerResponse Latch::evaluate(const RelativeMotion& motion,
                                const CouplerMemory& memory) const {
  if (memory.latch != LatchStatus::closed) return {};
  RelativeMotion from_rest = motion;
  from_rest.R_FM = motion.R_FM * memory.X_FM.R.transpose();
  from_rest.p_FM_F = motion.p_FM_F - memory.X_FM.p;
  return bushing_.evaluate(from_rest);
}

RequiredSides Latch::find_required_rotations() const {
  if (bushing_.find_required_rotations().F.isZero()) return {};
  return {Matrix3::Identity(), Matrix3::Identity()};
}

SwitchValue Latch::find_switch(int index, const RelativeMotion& motion,
                               const CouplerMemory& memory, double t) const {
  constexpr SwitchValue kOff{-1.0, 0.0};
  if (memory.latch == LatchStatus::released) return kOff;
  if (index == 1) {
    return std::isfinite(parameters_.release_time)
               ? SwitchValue{t - parameters_.release_time, 1.0}
               : kOff;
  }
  if (memory.latch == LatchStatus::open) {
    // Quadratic in a straight motion, also through zero distance.
    const double reach = parameters_.reach;
    return {0.5 * (reach - motion.p_FM_F.squaredNorm() / reach),
            -motion.p_FM_F.dot(motion.v_FM_F) / reach};
  }
  if (!std::isfinite(parameters_.release_force)) return kOff;
  // The elastic part: the damper's initial force does not release the latch.
  const Matrix3& K = parameters_.bushing.translational_stiffness;
  const Vector3 force = K * (motion.p_FM_F - memory.X_FM.p);
  const double most = parameters_.release_force;
  return {0.5 * (force.squaredNorm() / most - most),
          force.dot(K * motion.v_FM_F) / most};
}

std::optional<EventKind> Latch::find_event(int index, bool rises,
                                           const CouplerMemory& memory) {
  if (!rises) return std::nullopt;
  return index == 0 && memory.latch == LatchStatus::open ? EventKind::latched
                                                         : EventKind::released;
}

void Latch::update(int index, const RelativeMotion& motion,
                   CouplerMemory& memory) const {
  if (index == 0 && memory.latch == LatchStatus::open) {
    memory.latch = LatchStatus::closed;
    memory.X_FM = {motion.R_FM, motion.p_FM_F};
    return;
  }
  memory.latch = LatchStatus::released;
}

}  // namespace limber::joints
