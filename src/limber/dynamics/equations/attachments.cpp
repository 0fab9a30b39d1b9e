// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/equations/attachments.hpp"

#include "limber/common/errors.hpp"
#include "limber/common/index.hpp"
#include "limber/dynamics/bodies/body.hpp"

namespace limber::dynamics {

void calc_attachments(const SystemModel& model, const SystemState& state,
                      SystemTerms& terms) {
  for (std::size_t i = 0; i < model.attachments.size(); ++i) {
    const Attachment& a = model.attachments[i];
    AttachmentMotion& motion = terms.attachments[i];
    if (a.body == kWorld) {
      rest_in_world(a, motion);
      continue;
    }
    visit_body(model, index(a.body), [&](const auto& own) {
      own.calc_attachment(a, state, terms, motion);
    });
  }
}

FrameMotion find_frame_motion(const SystemModel& model,
                              const SystemState& state,
                              AttachmentIndex attachment) {
  LIMBER_EXPECT(attachment >= 0 &&
                attachment < static_cast<int>(model.attachments.size()));
  const Attachment& a = model.attachments[index(attachment)];
  if (a.body == kWorld) return {{a.R_BF, a.p_BF}};
  return visit_body(model, index(a.body),
                    [&](const auto& own) { return own.find_frame(a, state); });
}

joints::RelativeMotion find_relative_motion(const SystemModel& model,
                                            const SystemState& state,
                                            CouplerIndex coupler) {
  LIMBER_EXPECT(coupler >= 0 &&
                coupler < static_cast<int>(model.couplers.size()));
  const Coupler& c = model.couplers[index(coupler)];
  return relate(find_frame_motion(model, state, c.frame_F),
                find_frame_motion(model, state, c.frame_M));
}

}  // namespace limber::dynamics
