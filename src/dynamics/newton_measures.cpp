// SPDX-License-Identifier: BSD-3-Clause
#include "dynamics/newton_measures.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace limber::dynamics {
namespace {

// Round-off of a position, relative to its distance from the world origin.
constexpr double kRoundoff = 4.0 * std::numeric_limits<double>::epsilon();
// Forces of a whole mesh are differences of large ones: what round-off makes of
// them moves its soft modes by this factor more.
constexpr double kNodalNoise = 100.0;

double radius_of_gyration_squared(const BodyModel& body) {
  return 0.5 * body.J0.trace() / body.mass;
}

// Of a body's nodes; zero if it is reduced.
double mean_square(const SystemModel& model, const BodyModel& body,
                   const Eigen::Ref<const VectorX>& nodes) {
  if (body.full < 0) return 0.0;
  const FullModel& full =
      model.full_bodies[static_cast<std::size_t>(body.full)];
  return 3.0 * nodes.segment(full.first, full.dofs()).squaredNorm() /
         static_cast<double>(full.dofs());
}

}  // namespace

CorrectionSize measure_correction(const SystemModel& model,
                                  const VectorX& increments) {
  CorrectionSize largest;
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const BodyModel& body = model.bodies[b];
    const double* x =
        increments.data() + 6 * b + static_cast<std::size_t>(body.offset);
    const double squared =
        Eigen::Map<const Vector3>(x).squaredNorm() +
        radius_of_gyration_squared(body) *
            Eigen::Map<const Vector3>(x + 3).squaredNorm() +
        Eigen::Map<const VectorX>(x + 6, body.modes).squaredNorm() / body.mass +
        mean_square(model, body, increments.tail(model.nodal_count));
    if (!(squared <= largest.value)) {
      largest = {squared, b};
      if (!std::isfinite(squared)) break;
    }
  }
  largest.value = std::sqrt(largest.value);
  return largest;
}

double measure_motion(const SystemModel& model, const Rates& motion) {
  double largest = 0.0;
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const BodyModel& body = model.bodies[b];
    const double squared =
        motion.translation[b].squaredNorm() +
        radius_of_gyration_squared(body) * motion.rotation[b].squaredNorm() +
        motion.modes.segment(body.offset, body.modes).squaredNorm() /
            body.mass +
        mean_square(model, body, motion.nodes);
    largest = std::max(largest, squared);
  }
  return std::sqrt(largest);
}

double measure_roundoff(const SystemModel& model, const SystemState& state) {
  double reach = 0.0;
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const BodyModel& body = model.bodies[b];
    if (body.full >= 0) {
      const double noise = kNodalNoise * kNodalNoise;
      reach = std::max(reach, noise * (mean_square(model, body, state.u_H) +
                                       radius_of_gyration_squared(body)));
      continue;
    }
    reach = std::max(reach, state.bodies[b].p_WB.squaredNorm() +
                                radius_of_gyration_squared(body));
  }
  return kRoundoff * std::sqrt(reach);
}

}  // namespace limber::dynamics
