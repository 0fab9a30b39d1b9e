// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "limber/common/types.hpp"

namespace limber::dynamics {

/// Why this inertia about the centre of mass is not physical, with the
/// principal moments; empty if it is. The moments of a mass are positive and
/// obey I1 + I2 >= I3, with equality for flat bodies; rounding of printed
/// digits may violate it by 1e-3 of the largest.
/// @param inertia symmetric [kg m^2]
[[nodiscard]] std::string find_inertia_problem(const Matrix3& inertia);

}  // namespace limber::dynamics
