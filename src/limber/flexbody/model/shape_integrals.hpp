// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Sparse>

#include "limber/flexbody/model/reduced_body.hpp"

namespace limber::flexbody {

/// S0, S1, S2 and P of a basis.
/// @param M_s N x N nodal mass, both triangles [kg]
/// @param x_B 3 x N undeformed positions relative to the centre of mass [m]
/// @param Phi_B 3N x m mode shapes [kg^-1/2]
[[nodiscard]] InertiaShapeIntegrals calc_shape_integrals(
    const Eigen::SparseMatrix<double>& M_s, const Matrix3X& x_B,
    const MatrixX& Phi_B);

}  // namespace limber::flexbody
