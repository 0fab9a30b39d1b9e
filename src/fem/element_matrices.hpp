// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fem/material.hpp"
#include "fem/reference_element.hpp"

namespace limber::fem {

/// Consistent scalar mass of one element, nodes x nodes [kg].
///
/// Equation   M_ab = int rho N_a N_b dV
[[nodiscard]] MatrixX calc_element_mass(const ReferenceElement& element,
                                        const Matrix3X& x, double density);

/// Stiffness of one element, 3 nodes x 3 nodes [N/m].
///
/// Equation   K_ab = lambda S_ab + mu S_ab^T + mu tr(S_ab) I,
///            S_ab = int grad N_a grad N_b^T dV
/// Source     Hughes, The Finite Element Method, sec. 2.7 and 3.10
[[nodiscard]] MatrixX calc_element_stiffness(const ReferenceElement& element,
                                             const Matrix3X& x,
                                             const ElasticMaterial& material);

}  // namespace limber::fem
