// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "limber/fem/mesh/mesh.hpp"
#include "limber/fem/solid/hyperelastic.hpp"

namespace limber::fem {

/// Hooke's law at a point, in mesh axes.
struct Hooke {
  Hooke(const ElasticMaterial& material, const Vector3& x);

  LameConstants<double> lame;
  std::optional<Matrix6> C;  ///< replaces them [Pa]

  /// @param strain symmetric
  [[nodiscard]] Matrix3 calc_stress(const Matrix3& strain) const;
  /// The same of Green's strain of F = I + H: second Piola-Kirchhoff stress of
  /// St. Venant-Kirchhoff's law if there is C.
  [[nodiscard]] Matrix3 calc_stress(Elasticity law, const Matrix3& H) const;
};

/// The law at each of the points x (columns) [m].
[[nodiscard]] std::vector<Hooke> list_laws(const ElasticMaterial& material,
                                           const Matrix3X& x);

/// Derivatives by nodal displacements of Green's strain of F, components (xx,
/// yy, zz, 2 xy, 2 yz, 2 xz): 6 x 3 nodes. F = I: of small strain.
/// @param g 3 x nodes gradients [1/m]
[[nodiscard]] Eigen::Matrix<double, 6, Eigen::Dynamic> make_strain_rows(
    const Matrix3& F, const Matrix3X& g);

[[nodiscard]] bool has_anisotropy(
    const std::vector<ElasticMaterial>& materials);

/// @throws InputError if a material is anisotropic and the law is not St.
/// Venant-Kirchhoff's.
void require_law(const Mesh& mesh,
                 const std::vector<ElasticMaterial>& materials, Elasticity law);

}  // namespace limber::fem
