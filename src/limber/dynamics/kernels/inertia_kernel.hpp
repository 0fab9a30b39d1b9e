// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>

namespace limber::dynamics::kernels {

/// Constants of a body's inertia, m modes; p is m rounded up to four.
struct InertiaColumns {
  /// 9p x (m + 1), columns contiguous: component c of mode k in row c p + k,
  /// J1 in column 0 and of J2 and beta what mode l contributes in column l + 1
  /// (ModalInertia); zero from row c p + m on.
  const double* columns = nullptr;
  std::size_t modes = 0;
};

/// Sums over the modes, components (xx, yy, zz, xy, xz, yz).
struct InertiaSums {
  std::array<double, 6> J{};     ///< change of the inertia by eta [kg m^2]
  std::array<double, 6> Jdot{};  ///< its derivative by time [kg m^2/s]
  std::array<double, 3> h{};     ///< H etadot [kg m^2/s]
};

/// Inertia of the deformed body and its forces on the modes, at m coordinates
/// `eta` and rates `etadot`, in O(m^2).
///
/// Equation   dJ = J1 + J2 eta, H = beta eta, J = (J1 + dJ) eta / 2,
///            bias += 2 w . beta etadot - half_square(w) . dJ
/// @param w angular velocity, body frame [rad/s]
/// @param half_square of it, 6 (body_model.hpp)
/// @param products 12p: components of dJ, H and beta etadot, each of p modes
/// @param bias m, added to
[[nodiscard]] InertiaSums calc_inertia(const InertiaColumns& inertia,
                                       const double* eta, const double* etadot,
                                       const double* w,
                                       const double* half_square,
                                       double* products, double* bias);

}  // namespace limber::dynamics::kernels
