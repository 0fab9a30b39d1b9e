// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "flexbody/reduce_meshed_body.hpp"

/// Loads that modes are measured against. Part of limber_reduction.
namespace limber::flexbody {

/// Distinct loads on a body's free degrees of freedom.
struct LoadCases {
  std::vector<std::string> names;
  MatrixX loads;       ///< free degrees of freedom x k [N]
  VectorX compliance;  ///< f^T K^+ f of each [J]; 0 where it deforms nothing

  [[nodiscard]] Eigen::Index count() const { return loads.cols(); }
};

/// @throws InputError unless there are three rows for each node that moves.
void check_rows(const NodalForces& nodal, const Support& support);

/// The load cases of a recipe for a measure (AutomaticModes), without those
/// that are multiples of others or zero, with their compliance. With `mass`
/// the inertia forces M r of a base that moves in x, y or z.
/// @throws InputError if there are none, for nodal forces of another number of
/// rows, and for `mass` of a body that is not clamped.
[[nodiscard]] LoadCases find_load_cases(const MeshedBody& body,
                                        const Recipe& recipe,
                                        ModeMeasure measure);

}  // namespace limber::flexbody
