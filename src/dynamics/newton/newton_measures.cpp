// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/newton/newton_measures.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "limber/dynamics/equations/pair_forces.hpp"
#include "limber/dynamics/system/unknowns.hpp"

namespace limber::dynamics {
namespace {

// Round-off of a position, relative to its distance from the world origin.
constexpr double kRoundoff = 4.0 * std::numeric_limits<double>::epsilon();
// Forces of a whole mesh are differences of large ones: their round-off moves
// soft modes by this factor more.
constexpr double kNodalNoise = 100.0;

double radius_of_gyration_squared(const BodyModel& body) {
  return 0.5 * body.J0.trace() / body.mass;
}

// Mean square over a body's nodes; zero if it is reduced.
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
    const double* x = increments.data() + first_row(body, b);
    const double rigid =
        Eigen::Map<const Vector3>(x).squaredNorm() +
        radius_of_gyration_squared(body) *
            Eigen::Map<const Vector3>(x + 3).squaredNorm() +
        mean_square(model, body, increments.tail(model.nodal_count));
    const double modal =
        Eigen::Map<const VectorX>(x + 6, body.modes).squaredNorm() / body.mass;
    largest.rigid = std::max(largest.rigid, rigid);
    largest.modal = std::max(largest.modal, modal);
    if (!(rigid + modal <= largest.value)) {
      largest.value = rigid + modal;
      largest.body = b;
      if (!std::isfinite(largest.value)) break;
    }
  }
  largest.value = std::sqrt(largest.value);
  largest.rigid = std::sqrt(largest.rigid);
  largest.modal = std::sqrt(largest.modal);
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

Roundoff measure_roundoff(const SystemModel& model, const SystemState& state) {
  double reach = 0.0;
  double bend = 0.0;
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
    bend = std::max(
        bend,
        state.eta.segment(body.offset, body.modes).squaredNorm() / body.mass);
  }
  return {kRoundoff * std::sqrt(reach), kRoundoff * std::sqrt(bend)};
}

void find_roundoff_gaps(const SystemModel& model, const SystemTerms& terms,
                        double velocity, std::vector<Vector6>& gaps) {
  const auto motion_of = [&](AttachmentIndex i) -> const AttachmentMotion& {
    return terms.attachments[static_cast<std::size_t>(i)];
  };
  gaps.resize(model.couplers.size() + model.transmissions.size());
  for (std::size_t c = 0; c < model.couplers.size(); ++c) {
    const AttachmentMotion& F = motion_of(model.couplers[c].frame_F);
    const AttachmentMotion& M = motion_of(model.couplers[c].frame_M);
    const joints::CouplerResponse& response = terms.couplers[c].response;
    // Alternating signs, so that neighbours do not cancel.
    const double sign = c % 2 == 0 ? kRoundoff : -kRoundoff;
    const double p = sign * (F.p_WF.norm() + F.arm_B.norm() + M.arm_B.norm());
    const double v = sign * (F.v_WF_W.norm() + M.v_WF_W.norm());
    const double w = sign * (F.w_WF_W.norm() + M.w_WF_W.norm());
    Vector6 position;
    Vector6 rate;
    position << p, -p, p, -sign, sign, sign;
    rate << v, -v, v, -w, w, w;
    gaps[c] = (response.stiffness + velocity * response.damping) * position +
              response.damping * rate;
  }
  for (std::size_t i = 0; i < model.transmissions.size(); ++i) {
    const TransmissionTerms& t = terms.transmissions[i];
    gaps[model.couplers.size() + i]
        << kRoundoff * (t.response.stiffness * t.motion.z +
                        t.response.damping * t.motion.rate),
        0.0, 0.0, 0.0, 0.0, 0.0;
  }
}

void calc_pair_roundoff(const SystemModel& model, const SystemState& state,
                        const SystemTerms& terms, double velocity,
                        VectorX& residual) {
  residual.setZero();
  for (std::size_t i = 0; i < model.pairs.size(); ++i) {
    if (terms.pairs.responses[i].points().empty()) continue;
    const Pair& pair = model.pairs[i];
    double reach = 0.0;
    for (const BodyIndex b : {pair.body_A, pair.body_B}) {
      if (b == kWorld) continue;
      reach += state.bodies[static_cast<std::size_t>(b)].p_WB.norm();
    }
    double sign = 1.0;  // alternating, so that points do not cancel
    for (const joints::PairPoint& point : terms.pairs.responses[i].points()) {
      const double p = sign * kRoundoff *
                       (reach + point.acting.A.norm() + point.acting.B.norm());
      const Vector3 force =
          (point.stiffness + velocity * point.damping) * Vector3(p, -p, p);
      add_residual(model, pair, point, force, terms, residual);
      sign = -sign;
    }
  }
}

}  // namespace limber::dynamics
