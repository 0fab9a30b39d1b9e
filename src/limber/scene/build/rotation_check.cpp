// SPDX-License-Identifier: BSD-3-Clause
#include "limber/scene/build/rotation_check.hpp"

#include "limber/scene/text/error_context.hpp"

namespace limber::scene {

void check_rotation(const AttachmentSite& site,
                    const RequiredRotations& required_F) {
  if (!site.anchor.table) return;
  const Matrix3& R_BF = site.X_BF.R;
  with_context("link '" + site.link + "'", [&] {
    check_rotation(*site.anchor.table, R_BF * required_F * R_BF.transpose());
  });
}

}  // namespace limber::scene
