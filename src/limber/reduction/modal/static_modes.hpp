// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "limber/fem/solid/eigenmodes.hpp"
#include "limber/flexbody/modal/reduced_basis.hpp"
#include "limber/flexbody/model/load_modes_record.hpp"
#include "limber/reduction/modal/elastic_body.hpp"

/// Static responses that enter a basis. Part of limber_reduction.
namespace limber::flexbody {

/// Tolerance for directions of a file of nodal forces, relative to the largest
/// column and then to the largest static response in the norm of elastic
/// energy [-]. Above the rounding of six printed digits, and negligible.
inline constexpr double kForceTolerance = 1e-6;
/// Largest number of directions of one file that are solved for, and of modes
/// used.
inline constexpr Eigen::Index kMostForceDirections = 100;
inline constexpr Eigen::Index kMostForceModes = 12;

/// Static-deformation modes of interfaces, load patterns and nodal forces.
///
/// Equation   x_0 = K^+ (F - M q_F), x_n+1 = K^+ M x_n up to n = terms - 1;
///            with more than one term each block is M-orthonormalised against
///            those before, because powers of K^+ M tend to the lowest mode
/// Source     [@ligterink2005, sections 2 and 5]
struct StaticModes {
  MatrixX vectors;                     ///< free degrees of freedom x k [m]
  std::vector<Matrix6> flexibility;    ///< per interface [m/N, rad/(N m)]
  std::vector<LoadModesRecord> loads;  ///< per file of nodal forces
};

/// @param known modes of the body, any or none
/// @throws InputError for nodal forces with a wrong number of rows.
[[nodiscard]] StaticModes find_static_modes(const ElasticBody& body,
                                            const Recipe& recipe,
                                            const fem::Eigenmodes& known);

/// For Recipe::is_estimate: three steps of inverse iteration from the unit
/// forces and moments of the interfaces, with the factor's shift s. In their
/// span the responses to these miss (s / lambda_1)^3 of the first mode, 1e-6.
///
/// Equation   [Y, A Y, A^2 Y], A = (K - s M)^-1 M, Y = (K - s M)^-1 F
[[nodiscard]] StaticModes estimate_static_modes(const ElasticBody& body);

/// Eigenmodes and static-deformation modes as one basis.
/// @param drop_tolerance as for orthonormalise() [-]
[[nodiscard]] ReducedBasis join_basis(const ElasticBody& body,
                                      const fem::Eigenmodes& eigenmodes,
                                      const StaticModes& modes,
                                      double drop_tolerance);

}  // namespace limber::flexbody
