// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/common/index.hpp"
#include "limber/dynamics/terms/system_terms.hpp"

namespace limber::dynamics {

/// Adds a load, `factor` times, where its attachment is, and its power; needs
/// the attachment's motion.
/// @param body a kind (body_kind.hpp)  @param t its terms
template <typename Kind>
void add_load_on_frame(const Kind& body, const SystemModel& model,
                       const Load& load, double factor, SystemTerms& terms,
                       BodyTerms& t) {
  const Attachment& attachment = model.attachments[index(load.where)];
  AttachmentMotion& motion = terms.attachments[index(load.where)];
  const Vector3 force = factor * load.force;
  const Vector3 moment = factor * load.moment;
  const Vector3 force_W = load.in_world ? force : t.R_WB * force;
  const Vector3 moment_W = load.in_world ? moment : t.R_WB * moment;
  body.add_wrench(attachment, motion, force_W, moment_W, terms);
  t.supplied += force_W.dot(motion.v_WF_W) + moment_W.dot(motion.w_WF_W);
}

}  // namespace limber::dynamics
