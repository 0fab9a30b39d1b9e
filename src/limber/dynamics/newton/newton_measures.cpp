// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/newton/newton_measures.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "limber/common/index.hpp"
#include "limber/dynamics/bodies/body.hpp"
#include "limber/dynamics/equations/pair_forces.hpp"
#include "limber/dynamics/newton/link_rows.hpp"
#include "limber/dynamics/system/linked_groups.hpp"
#include "limber/dynamics/system/unknowns.hpp"

namespace limber::dynamics {
namespace {

// Round-off of a position, relative to its distance from the world origin.
constexpr double kRoundoff = 4.0 * std::numeric_limits<double>::epsilon();
// Of what contacts do to a body, relative to its radius of gyration: resting
// boxes do not come closer.
constexpr double kContactRoundoff = 1e-14;

}  // namespace

void measure_correction(const SystemModel& model, const MotionGroups& groups,
                        const VectorX& increments,
                        std::vector<CorrectionSize>& sizes) {
  sizes.assign(groups.count(), {});
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const BodyModel& body = model.bodies[b];
    double rigid = 0.0;  // rather than modal
    double modal = 0.0;
    for (const UnknownRange& range : list_unknowns(model, b)) {
      double& part = range.kind == UnknownKind::modes ? modal : rigid;
      part += range.mass / body.mass *
              increments.segment(range.row, range.size).squaredNorm();
    }
    CorrectionSize& largest = sizes[groups.of(b)];
    if (!std::isfinite(largest.value)) continue;
    largest.rigid = std::max(largest.rigid, rigid);
    largest.modal = std::max(largest.modal, modal);
    if (rigid + modal <= largest.value) continue;
    largest.value = rigid + modal;
    largest.body = b;
  }
  for (CorrectionSize& size : sizes) {
    size.value = std::sqrt(size.value);
    size.rigid = std::sqrt(size.rigid);
    size.modal = std::sqrt(size.modal);
  }
}

bool Reversal::is_backward() const {
  return both < -0.5 * std::sqrt(now * before);
}

void measure_reversal(const SystemModel& model, const MotionGroups& groups,
                      const VectorX& now, const VectorX& before,
                      std::vector<Reversal>& reversals) {
  reversals.assign(groups.count(), {});
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    Reversal& sum = reversals[groups.of(b)];
    for (const UnknownRange& range : list_unknowns(model, b)) {
      const auto x = now.segment(range.row, range.size);
      const auto y = before.segment(range.row, range.size);
      sum.both += range.mass * x.dot(y);
      sum.now += range.mass * x.squaredNorm();
      sum.before += range.mass * y.squaredNorm();
    }
  }
}

void measure_roundoff(const SystemModel& model, const MotionGroups& groups,
                      const SystemState& state, const VectorX& motion,
                      std::vector<Roundoff>& roundoffs) {
  roundoffs.assign(groups.count(), {});
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const BodyModel& body = model.bodies[b];
    Roundoff& largest = roundoffs[groups.of(b)];
    const double reach = visit_body(model, b, [&](const auto& own) {
      return own.find_rounded_square(state);
    });
    const double step = kRoundoff * translation_rows(body, motion).norm();
    const double bend =
        state.eta.segment(body.offset, body.modes).squaredNorm() / body.mass;
    largest.step = std::max(largest.step, step);
    largest.rigid =
        std::max({largest.rigid, largest.step, kRoundoff * std::sqrt(reach)});
    largest.modal = std::max(largest.modal, kRoundoff * std::sqrt(bend));
  }
}

void raise_roundoff_in_contact(const SystemModel& model,
                               const MotionGroups& groups,
                               const SystemTerms& terms,
                               std::vector<Roundoff>& roundoffs) {
  for (std::size_t i = 0; i < model.pairs.size(); ++i) {
    if (terms.pairs.responses[i].points().empty()) continue;
    for (const BodyIndex b : {model.pairs[i].body_A, model.pairs[i].body_B}) {
      if (b == kWorld) continue;
      double& rigid = roundoffs[groups.of(index(b))].rigid;
      rigid = std::max(
          rigid, kContactRoundoff * radius_of_gyration(model.bodies[index(b)]));
    }
  }
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
    if (const auto* constraint = find_constraint(terms, c)) {
      gaps[c] = remove_constrained(*constraint, gaps[c]) +
                constraint->directions * position;
    }
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
