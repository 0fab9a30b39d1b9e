// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "limber/common/types.hpp"

namespace limber::flexbody {

/// Second-order motion of a frame on a body at level `nonlinear`, unpacked for
/// the inner loops.
///
/// Equation   u = (Phi + P) q / 2, P = Phi + [Phi2 q]; rotation vector r =
///            (Psi + W) q / 2, W = Psi + [Psi2 q]; du = P dq, dr = W dq, where
///            column i of [Phi2 q] is sum_j Phi2_ij q_j for i, j in P
/// Source     docs/theory/nonlinear.md
struct QuadraticFrame {
  std::vector<int> paired;  ///< P, increasing
  MatrixX Phi2;             ///< 3p x p, rows 3i + c [kg^-1 m^-1]
  MatrixX Psi2;             ///< 3p x p, rows 3i + c [kg^-1 m^-2]
};

/// From tables of pairs, 3 x p (p + 1) / 2.
[[nodiscard]] QuadraticFrame make_quadratic_frame(
    const std::vector<int>& paired, const Matrix3X& Phi2, const Matrix3X& Psi2);

/// Of an origin `arm` [m] away, that follows the rotation to second order.
/// @param Psi 3 x m first-order rotation of the frame
[[nodiscard]] QuadraticFrame move_origin(const QuadraticFrame& frame,
                                         const Matrix3X& Psi,
                                         const Vector3& arm);

/// Adds [Phi2 q] to Phi and [Psi2 q] to Psi, both 3 x m.
/// @param q m modal coordinates [kg^1/2 m]
void add_slopes(const QuadraticFrame& frame, const double* q, Matrix3X& Phi,
                Matrix3X& Psi);

/// Adds factor (force . Phi2_ij + twist . Psi2_ij) to K_ij, m x m: the change
/// of the modal force P' force + W' twist by the modes [rad^2/s^2].
void add_contraction(const QuadraticFrame& frame, const Vector3& force,
                     const Vector3& twist, double factor,
                     Eigen::Ref<MatrixX> K);

}  // namespace limber::flexbody
