// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "limber/fem/solid/elastic_inverse.hpp"
#include "limber/reduction/matrices/matrix_system.hpp"
#include "limber/reduction/matrices/rigid_motion.hpp"

/// The rows of a matrix system that can move. Part of limber_reduction.
namespace limber::flexbody {

/// Rows without those held, null and `clamped` (sorted).
[[nodiscard]] std::vector<int> find_free_rows(const MatrixSystem& system,
                                              const std::vector<int>& clamped);

/// K and M of the rows. @param rows sorted
[[nodiscard]] fem::StructuralMatrices restrict_system(
    const MatrixSystem& system, const std::vector<int>& rows);

/// M-orthonormal rigid modes. @param X rigid motions about the centre of mass
/// of the rows of `matrices`
[[nodiscard]] MatrixX orthonormalise_rigid(
    const fem::StructuralMatrices& matrices, const MatrixX& X);

/// The lowest elastic mode, roughly, and the shift that suits it.
struct FirstMode {
  double lambda =
      0.0;             ///< [rad^2/s^2]; of an estimate from above, to some 1e-3
  VectorX phi;         ///< M-normal
  double shift = 0.0;  ///< of ElasticInverse [rad^2/s^2]
};

/// Inverse iteration from displacements that are quadratic in position, with
/// half their curl for rotations.
///
/// Equation   V <- P (K - s M)^-1 M V, then Rayleigh and Ritz
/// @param rows of the system that `matrices` has @param R as ElasticInverse
/// @throws InputError if K - s M is not positive definite
[[nodiscard]] FirstMode find_first_mode(const MatrixSystem& system,
                                        const std::vector<int>& rows,
                                        const fem::StructuralMatrices& matrices,
                                        const MatrixX& R);

}  // namespace limber::flexbody
