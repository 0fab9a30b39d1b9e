// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "limber/common/types.hpp"
#include "limber/flexbody/model/section_modes.hpp"

namespace limber::flexbody {

/// Stress of a reduced body at its rows, for linear isotropic materials.
///
/// Equation   sigma = Sigma_B eta, components (xx, yy, zz, xy, yz, xz), frame
///            B; at level `nonlinear` Sigma_B [eta; p], p the products of
///            paired modes (mode_products.hpp): second Piola-Kirchhoff stress,
///            of Green's strain to second order;
///            Hooke's law at quadrature points, fitted over each element and
///            averaged at nodes over the elements of one material
/// Source     [@hinton1974]; docs/theory/stress.md
/// Limits     small strain; lacks the stress of truncated modes
struct StressModes {
  /// p: rows of the points, increasing. A node at a border of materials has a
  /// point for each of them. Of shells and beams those of the places that are
  /// drawn on their faces, where these are kept, and of nodes.
  std::vector<std::size_t> rows;
  std::vector<int> materials;   ///< p: column of `constants`
  std::vector<int> on_surface;  ///< p: 1 on the body's boundary, else 0
  /// 6p x m [kg^1/2 m^-2 s^-2], then as many columns as there are products
  /// [m^-3 s^-2], or none.
  MatrixX Sigma_B;
  /// m x m: integral of (averaged - element's stress) C^-1 (the same), whose
  /// fraction of lambda is the square of the averaging's error in the energy
  /// norm
  /// [@zienkiewicz1987] [rad^2/s^2]. Of beams and shells none, 0 x 0.
  MatrixX averaging;
  /// 2 x materials: Young's modulus [Pa], Poisson's ratio; of anisotropic ones
  /// those of the mean over all directions.
  MatrixX constants;
  /// Rows of the nodes of each interface, in the body's order of interfaces.
  std::vector<std::vector<std::size_t>> interface_rows;
  /// 9 x p: axes 1, 2, 3 of each point in B, column by column: of a solid those
  /// of its material, of a shell along the fibre, across it, normal, of a beam
  /// x, y, z. Zero where a material is isotropic; 9 x 0: of such solids alone.
  MatrixX axes = MatrixX(9, 0);
  SectionModes sections;  ///< of beams and shells
};

/// Von Mises stress of components (xx, yy, zz, xy, yz, xz) [Pa].
[[nodiscard]] double calc_von_mises(const Vector6& stress);

/// Largest principal stress, tension positive [Pa].
[[nodiscard]] double calc_max_principal(const Vector6& stress);

/// The components in axes of a frame L. @param R_BL axes of L in B
[[nodiscard]] Vector6 rotate_stress(const Vector6& stress_B,
                                    const Matrix3& R_BL);

/// Error estimate of a deformation's stress by averaging over elements, in the
/// energy norm [-]. Zero without deformation.
///
/// Equation   sqrt(eta^T averaging eta / eta^T diag(lambda) eta)
/// Source     [@zienkiewicz1987]
[[nodiscard]] double find_averaging_error(const StressModes& modes,
                                          const VectorX& lambda,
                                          const VectorX& eta);

}  // namespace limber::flexbody
