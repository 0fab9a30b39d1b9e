// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/contact/law/bristle_friction.hpp"

namespace limber::testing {

/// @param stiffness [N/m] @param damping [N s/m]
inline contact::BristleFriction make_friction(double mu, double stiffness,
                                              double damping) {
  return contact::BristleFriction(
      {.limit = {.sliding = mu}, .stiffness = stiffness, .damping = damping});
}

}  // namespace limber::testing
