// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/equations/relative_energy.hpp"

#include <algorithm>
#include <limits>

namespace limber::dynamics {
namespace {

void include(BodyIndex body, JoinedBodies& bodies) {
  if (std::find(bodies.begin(), bodies.end(), body) == bodies.end()) {
    bodies.push_back(body);
  }
}

BodyIndex body_of(const SystemModel& model, AttachmentIndex attachment) {
  return model.attachments[static_cast<std::size_t>(attachment)].body;
}

// A rigid motion, by its velocity field.
struct Drift {
  Vector3 p_W = Vector3::Zero();  // a point [m]
  Vector3 v_W = Vector3::Zero();  // and its velocity [m/s]
  Vector3 w_W = Vector3::Zero();  // [rad/s]
};

Drift find_drift(const SystemState& state, BodyIndex reference) {
  if (reference == kWorld) return {};
  const BodyState& body = state.bodies[static_cast<std::size_t>(reference)];
  return {body.p_WB, body.v_WB_W, body.quat_WB * body.w_WB_B};
}

double find_kinetic(const SystemModel& model, const SystemState& state,
                    BodyIndex b, const Drift& drift) {
  const BodyModel& body = model.bodies[static_cast<std::size_t>(b)];
  const BodyState& now = state.bodies[static_cast<std::size_t>(b)];
  const Vector3 v =
      now.v_WB_W - drift.v_W - drift.w_W.cross(now.p_WB - drift.p_W);
  const Vector3 w = now.w_WB_B - now.quat_WB.conjugate() * drift.w_W;
  return 0.5 * (body.mass * v.squaredNorm() + w.dot(body.J0 * w) +
                state.etadot.segment(body.offset, body.modes).squaredNorm());
}

}  // namespace

JoinedBodies find_joined_bodies(const SystemModel& model,
                                const Coupler& coupler) {
  JoinedBodies bodies{body_of(model, coupler.frame_F)};
  include(body_of(model, coupler.frame_M), bodies);
  return bodies;
}

JoinedBodies find_joined_bodies(const SystemModel& model,
                                const Transmission& transmission) {
  JoinedBodies bodies;
  if (const auto* path =
          std::get_if<PathCoordinate>(&transmission.coordinate)) {
    for (const AttachmentIndex point : path->points) {
      include(body_of(model, point), bodies);
    }
    return bodies;
  }
  for (const JointSum::Term& term :
       std::get<JointSum>(transmission.coordinate).terms) {
    const Coupler& joint =
        model.couplers[static_cast<std::size_t>(term.coupler)];
    for (const BodyIndex b : find_joined_bodies(model, joint)) {
      include(b, bodies);
    }
  }
  return bodies;
}

JoinedBodies find_joined_bodies(const Pair& pair) {
  JoinedBodies bodies{pair.body_A};
  include(pair.body_B, bodies);
  return bodies;
}

double find_relative_kinetic(const SystemModel& model, const SystemState& state,
                             const JoinedBodies& bodies) {
  const bool has_world =
      std::find(bodies.begin(), bodies.end(), kWorld) != bodies.end();
  double least = std::numeric_limits<double>::infinity();
  for (const BodyIndex reference : bodies) {
    if (has_world && reference != kWorld) continue;
    const Drift drift = find_drift(state, reference);
    double sum = 0.0;
    for (const BodyIndex b : bodies) {
      if (b != kWorld) sum += find_kinetic(model, state, b, drift);
    }
    least = std::min(least, sum);
  }
  return least;
}

}  // namespace limber::dynamics
