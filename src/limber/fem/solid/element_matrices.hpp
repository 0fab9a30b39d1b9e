// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "limber/fem/mesh/reference_element.hpp"
#include "limber/fem/solid/hyperelastic.hpp"

namespace limber::fem {

/// Gradients of an element's functions in material coordinates, the measure and
/// the place of each quadrature point of its stiffness.
struct ElementGradients {
  std::vector<Matrix3X> at;  ///< a point: 3 x nodes [1/m]
  VectorX measure;           ///< a point: w det J [m^3]
  Matrix3X x;                ///< 3 x points [m]
};
/// @param x 3 x nodes [m]
[[nodiscard]] ElementGradients calc_gradients(const ReferenceElement& element,
                                              const Matrix3X& x);

/// Consistent scalar mass of one element, nodes x nodes [kg].
///
/// Equation   M_ab = int rho N_a N_b dV
[[nodiscard]] MatrixX calc_element_mass(const ReferenceElement& element,
                                        const Matrix3X& x, double density);

/// Stiffness of one element, 3 nodes x 3 nodes [N/m], or of any functions.
///
/// Equation   K_ab = lambda S_ab + mu S_ab^T + mu tr(S_ab) I,
///            S_ab = int grad N_a grad N_b^T dV; of an anisotropic material
///            K_ab = int B_a^T C B_b dV
/// Source     Hughes, The Finite Element Method, sec. 2.7 and 3.10
[[nodiscard]] MatrixX calc_stiffness(const ElementGradients& gradients,
                                     const ElasticMaterial& material);
[[nodiscard]] MatrixX calc_element_stiffness(const ReferenceElement& element,
                                             const Matrix3X& x,
                                             const ElasticMaterial& material);

/// Tangent stiffness of one element at displacements u, 3 nodes x 3 nodes.
///
/// Equation   K_ab = int (g_a.S g_b) I + lambda p_a p_b^T
///                   + mu ((g_a.A g_b) F A F^T + p_b p_a^T) dV,
///            g_a = grad N_a, p_a = F A g_a, with the moduli
///            C_MJNL = lambda A_MJ A_NL + mu (A_MN A_JL + A_ML A_JN); of an
///            anisotropic material int (g_a.S g_b) I + B_a^T C B_b dV, B_a the
///            derivative of Green's strain by u_a
/// Source     [@bonet2008, sec. 9.4]
/// @param x, u 3 x nodes [m]
[[nodiscard]] MatrixX calc_element_tangent(const ReferenceElement& element,
                                           const Matrix3X& x, const Matrix3X& u,
                                           const ElasticMaterial& material,
                                           Elasticity law);

}  // namespace limber::fem
