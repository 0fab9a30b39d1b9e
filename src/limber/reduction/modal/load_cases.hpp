// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "limber/reduction/modal/elastic_body.hpp"

/// Load cases for the selection of modes. Part of limber_reduction.
namespace limber::flexbody {

/// Distinct loads on a body's free degrees of freedom.
struct LoadCases {
  std::vector<std::string> names;
  MatrixX loads;       ///< free degrees of freedom x k [N]
  VectorX compliance;  ///< f^T K^+ f of each [J]; 0 if it deforms nothing

  [[nodiscard]] Eigen::Index count() const { return loads.cols(); }
};

/// @throws InputError unless there are three rows for each free node.
void check_rows(const NodalForces& nodal, const Support& support);

/// The load cases of a recipe for a measure (AutomaticModes), without those
/// that are multiples of others or zero, with their compliance. For `mass`, the
/// inertia forces M r of a base that moves in x, y or z.
/// @throws InputError if there are none, for nodal forces with a wrong number
/// of rows, and for `mass` of a body that is not clamped.
[[nodiscard]] LoadCases find_load_cases(const ElasticBody& body,
                                        const Recipe& recipe,
                                        ModeMeasure measure);

}  // namespace limber::flexbody
