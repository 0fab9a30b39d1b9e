// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/flexbody/model/reduced_body.hpp"

namespace limber::metamorphic {

/// Adds made-up second-order tables, for level nonlinear, to a body and its
/// interfaces: where modes are at 0.3 sqrt(mass) `length`, about as large as
/// the linear ones. The same `variant` gives the same tables, in any unit of
/// length.
/// @param reflection of the body, as its other tables are [-]
/// @param length of the body [m]
void add_second_order(flexbody::ReducedBody& body, const Matrix3& reflection,
                      double length, unsigned variant);

}  // namespace limber::metamorphic
