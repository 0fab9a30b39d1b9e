// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/common/types.hpp"

namespace limber::dynamics {

/// Derivatives of a body's inertia by its m modes, and the coupling of modes by
/// rotation, packed for the inner loops. Shared by all bodies of the system
/// with the same reduced body, which saves cache.
///
/// Equation   J(eta) = J0 + J1 eta + eta' J2 eta / 2,
///            components (xx, yy, zz, xy, xz, yz);
///            H_l = sum_k eta_k beta_kl
struct ModalInertia {
  template <int Components>
  using Rows =
      Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Components>, 0,
                 Eigen::OuterStride<>>;

  int modes = 0;
  /// 9p x (m + 1), p = m rounded up to four: J1 in column 0 [kg^1/2 m], J2 and
  /// beta of mode k in column k + 1 [-]; zero where no mode stands.
  MatrixX columns;

  /// Row of a component, 0 to 5 of J, 6 to 8 of beta.
  [[nodiscard]] Eigen::Index row(int component, int mode) const {
    return component * stride() + mode;
  }
  [[nodiscard]] Rows<6> J1() const { return rows<6>(0, 0); }  ///< m x 6
  /// m x 6, row l: J2_kl.
  [[nodiscard]] Rows<6> J2(int k) const { return rows<6>(0, k + 1); }
  /// m x 3, row l: beta_kl.
  [[nodiscard]] Rows<3> beta(int k) const { return rows<3>(6, k + 1); }

 private:
  [[nodiscard]] Eigen::Index stride() const { return columns.rows() / 9; }
  template <int Components>
  [[nodiscard]] Rows<Components> rows(int first, Eigen::Index column) const {
    return {columns.data() + column * columns.rows() + first * stride(), modes,
            Components, Eigen::OuterStride<>(stride())};
  }
};

}  // namespace limber::dynamics
