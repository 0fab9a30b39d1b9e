// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/equations/coupler_forces.hpp"

#include <fmt/format.h>

#include "limber/common/index.hpp"
#include "limber/dynamics/bodies/body.hpp"
#include "limber/dynamics/equations/transmission.hpp"

namespace limber::dynamics {
namespace {

void apply_coupler(const SystemModel& model, const Coupler& coupler,
                   const joints::CouplerMemory& memory,
                   const EvaluationTime& now, WrenchSource source,
                   SystemTerms& terms, CouplerTerms& out) {
  out.motion = relate(frame_motion(terms.attachments[index(coupler.frame_F)]),
                      frame_motion(terms.attachments[index(coupler.frame_M)]));
  out.response = joints::evaluate(coupler.law, out.motion, memory, now);
  if (out.ideal >= 0) {
    terms.constraints[index(out.ideal)] =
        joints::find_constraint_gap(coupler.law, out.motion);
  }
  if (source == WrenchSource::law) out.applied = out.response.wrench;
  add_coupler_wrench(model, coupler, out.applied, out.motion.p_FM_F, terms);
  out.received = -out.applied.head<3>().dot(out.motion.v_FM_F) -
                 out.applied.tail<3>().dot(out.motion.w_FM_F);
}

void apply_transmission(const SystemModel& model, const SystemState& state,
                        const Transmission& transmission,
                        const joints::CouplerMemory& memory,
                        const EvaluationTime& now, WrenchSource source,
                        SystemTerms& terms, TransmissionTerms& out) {
  calc_coordinate(model, state, transmission, terms, out);
  out.response = evaluate_laws(transmission, out.motion, memory, now);
  if (source == WrenchSource::law) out.applied = out.response.force;
  out.received = -out.applied * out.motion.rate;
  if (const auto* path =
          std::get_if<PathCoordinate>(&transmission.coordinate)) {
    for (std::size_t i = 0; i < path->points.size(); ++i) {
      add_wrench(model, path->points[i],
                 out.applied * out.gradients[i].head<3>(), Vector3::Zero(),
                 terms);
    }
    return;
  }
  const auto& sum = std::get<JointSum>(transmission.coordinate);
  for (std::size_t i = 0; i < sum.terms.size(); ++i) {
    const auto c = index(sum.terms[i].coupler);
    add_coupler_wrench(model, model.couplers[c], out.applied * out.gradients[i],
                       terms.couplers[c].motion.p_FM_F, terms);
  }
}

}  // namespace

void throw_named(const std::string& name, double t,
                 const NumericalError& error) {
  throw NumericalError(
      fmt::format("coupler '{}' at t = {:.9g} s: {}", name, t, error.what()));
}

void add_wrench(const SystemModel& model, AttachmentIndex attachment,
                const Vector3& force_W, const Vector3& moment_W,
                SystemTerms& terms) {
  const Attachment& a = model.attachments[index(attachment)];
  if (a.body == kWorld) return;
  visit_body(model, index(a.body), [&](const auto& own) {
    own.add_wrench(a, terms.attachments[index(attachment)], force_W, moment_W,
                   terms);
  });
}

void add_coupler_wrench(const SystemModel& model, const Coupler& coupler,
                        const Vector6& wrench_F, const Vector3& p_FM_F,
                        SystemTerms& terms) {
  const Matrix3& R_WF = terms.attachments[index(coupler.frame_F)].R_WF;
  const Vector3 force_F = wrench_F.head<3>();
  const Vector3 force = R_WF * force_F;
  const Vector3 moment = R_WF * wrench_F.tail<3>();
  const Vector3 shift = R_WF * p_FM_F.cross(force_F);
  add_wrench(model, coupler.frame_M, force, moment, terms);
  add_wrench(model, coupler.frame_F, -force, -moment - shift, terms);
}

void apply_couplers(const SystemModel& model, const SystemState& state,
                    const EvaluationTime& now, WrenchSource source,
                    SystemTerms& terms) {
  for (std::size_t c = 0; c < model.couplers.size(); ++c) {
    name_coupler(model.couplers[c].name, now.t, [&] {
      apply_coupler(model, model.couplers[c], state.memory[c], now, source,
                    terms, terms.couplers[c]);
    });
  }
  for (std::size_t i = 0; i < model.transmissions.size(); ++i) {
    name_coupler(model.transmissions[i].name, now.t, [&] {
      apply_transmission(model, state, model.transmissions[i],
                         state.memory[model.couplers.size() + i], now, source,
                         terms, terms.transmissions[i]);
    });
  }
}

}  // namespace limber::dynamics
