// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>

#include "limber/dynamics/system/body_model.hpp"
#include "limber/dynamics/system/system_state.hpp"
#include "limber/flexbody/model/mode_products.hpp"

namespace limber::dynamics {

/// A body's modes and, at level nonlinear, their products.
/// @param out count_coordinates(body) [kg^1/2 m; kg m^2]
inline void set_modal_coordinates(const BodyModel& body,
                                  const SystemState& state, double* out) {
  const double* eta = state.eta.data() + body.offset;
  std::copy(eta, eta + body.modes, out);
  flexbody::set_products(paired_of(body), eta, out + body.modes);
}

}  // namespace limber::dynamics
