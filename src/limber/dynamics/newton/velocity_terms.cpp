// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/newton/velocity_terms.hpp"

#include <algorithm>
#include <variant>

#include "limber/common/index.hpp"
#include "limber/dynamics/equations/transmission.hpp"
#include "limber/dynamics/newton/link_rows.hpp"
#include "limber/dynamics/system/state_increments.hpp"
#include "limber/dynamics/system/unknowns.hpp"

namespace limber::dynamics {
namespace {

// Largest rate at which frames, or the lines between points of paths, turn
// [rad/s].
double find_largest_rate(const SystemModel& model, const SystemState& state) {
  double largest = 0.0;
  for (const Coupler& coupler : model.couplers) {
    for (const AttachmentIndex frame : {coupler.frame_F, coupler.frame_M}) {
      largest = std::max(largest,
                         find_frame_motion(model, state, frame).w_WF_W.norm());
    }
  }
  for (const Transmission& transmission : model.transmissions) {
    const auto* path = std::get_if<PathCoordinate>(&transmission.coordinate);
    if (path == nullptr) continue;
    for (std::size_t i = 0; i + 1 < path->points.size(); ++i) {
      const FrameMotion a = find_frame_motion(model, state, path->points[i]);
      const FrameMotion b =
          find_frame_motion(model, state, path->points[i + 1]);
      const double speed = (b.v_WF_W - a.v_WF_W).norm();
      const double length = (b.X_WF.p - a.X_WF.p).norm();
      if (length > 0.0) largest = std::max(largest, speed / length);
    }
  }
  return largest;
}

// Relative velocities of all links.
std::vector<Vector6> find_velocities(const SystemModel& model,
                                     const SystemState& state) {
  std::vector<Vector6> velocities;
  for (CouplerIndex c(0); c < std::ssize(model.couplers); ++c) {
    const joints::RelativeMotion motion = find_relative_motion(model, state, c);
    Vector6& velocity = velocities.emplace_back();
    velocity << motion.v_FM_F, motion.w_FM_F;
  }
  for (const Transmission& transmission : model.transmissions) {
    velocities.emplace_back(Vector6::Unit(0) *
                            find_motion(model, state, transmission).rate);
  }
  return velocities;
}

}  // namespace

std::vector<Vector6> find_velocity_terms(const SystemModel& model,
                                         const SystemState& state) {
  constexpr double kAngle = 1e-4;
  std::vector<Vector6> terms(model.couplers.size() + model.transmissions.size(),
                             Vector6::Zero());
  const double rate = find_largest_rate(model, state);
  if (!(rate > 0.0)) return terms;
  const double time = kAngle / rate;
  VectorX v = make_unknowns(model);
  get_velocities(model, state, v);
  SystemState before = state;
  SystemState after = state;
  displace(model, v, -time, before);
  displace(model, v, time, after);
  const std::vector<Vector6> first = find_velocities(model, before);
  const std::vector<Vector6> last = find_velocities(model, after);
  for (std::size_t i = 0; i < terms.size(); ++i) {
    terms[i] = (last[i] - first[i]) / (2.0 * time);
  }
  return terms;
}

void add_velocity_terms(const SystemTerms& terms,
                        const std::vector<Vector6>& velocity_terms,
                        double acceleration, double velocity,
                        std::vector<Vector6>& gaps) {
  for (std::size_t i = 0; i < gaps.size(); ++i) {
    const Vector6 motion = velocity_terms[i] / acceleration;
    const Vector6 force = find_link_stiffness(terms, i, velocity) * motion;
    const joints::ConstraintGap* constraint = find_constraint(terms, i);
    if (constraint == nullptr) {
      gaps[i] -= force;
    } else {
      gaps[i] -= constraint->directions * motion +
                 remove_constrained(*constraint, force);
    }
  }
}

}  // namespace limber::dynamics
