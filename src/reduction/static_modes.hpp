// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "fem/eigenmodes.hpp"
#include "flexbody/load_modes_record.hpp"
#include "flexbody/reduce_meshed_body.hpp"
#include "flexbody/reduced_basis.hpp"

/// Static answers that enter a basis. Part of limber_reduction.
namespace limber::flexbody {

/// Directions of a file of nodal forces that are as good as found: share of the
/// largest column, and then of the largest static answer in the norm of elastic
/// energy. Above what six printed digits leave, below what matters.
inline constexpr double kForceTolerance = 1e-6;
/// Directions of one file that are answered, and modes that are taken of them.
inline constexpr Eigen::Index kMostForceDirections = 100;
inline constexpr Eigen::Index kMostForceModes = 12;

/// Static-deformation modes of interfaces, load patterns and nodal forces.
///
/// Equation   x_0 = K^+ (F - M q_F), x_n+1 = K^+ M x_n up to n = terms - 1;
///            with more than one term each block is M-orthonormalised against
///            those before, because powers of K^+ M all tend to the lowest mode
/// Source     [@ligterink2005, sections 2 and 5]
struct StaticModes {
  MatrixX vectors;                     ///< free degrees of freedom x k [m]
  std::vector<Matrix6> flexibility;    ///< per interface [m/N, rad/(N m)]
  std::vector<LoadModesRecord> loads;  ///< per file of nodal forces
};

/// @throws InputError for nodal forces of another number of rows.
[[nodiscard]] StaticModes find_static_modes(const MeshedBody& body,
                                            const Recipe& recipe);

/// Eigenmodes and static-deformation modes as one basis.
[[nodiscard]] ReducedBasis join_basis(const MeshedBody& body,
                                      const fem::Eigenmodes& eigenmodes,
                                      const StaticModes& modes,
                                      double drop_tolerance);

}  // namespace limber::flexbody
