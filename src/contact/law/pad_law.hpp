// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/common/types.hpp"

namespace limber::contact {

/// Elastic forces of the pads of a flat face on a plane, with the displacement
/// that each causes at the others.
///
/// Equation   d = C f where f > 0, d <= C f where f = 0: f maximises
///            d^T f - f^T C f / 2 over f >= 0; V = f^T C f / 2 with dV/dd = f
/// Source     [@kalker1990, ch. 3]; the active set by the primal-dual
///            method, or, where that cycles, one pad at a time [@lawson1974,
///            ch. 23]
/// Limits     linear; at most kMost pads
class PadLaw {
 public:
  static constexpr int kMost = 25;
  using Vector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMost, 1>;
  using Matrix =
      Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kMost, kMost>;

  /// @param compliance k x k, 1 <= k <= kMost, symmetric positive
  /// definite [m/N]
  /// @param common added to all elements of C in uniform_stiffness and
  /// total_stiffness, as in most states [m/N]
  /// @throws InputError if it is not.
  explicit PadLaw(const MatrixX& compliance, double common = 0.0);

  [[nodiscard]] int count() const { return static_cast<int>(C_.rows()); }

  struct Response {
    Vector force;         ///< k, >= 0 [N]
    Matrix stiffness;     ///< k x k, df/dd; zero where a pad is free [N/m]
    double energy = 0.0;  ///< [J]
  };
  /// @param depth of each pad, k, of any sign [m]
  /// @param out filled without allocation
  void evaluate(const Vector& depth, Response& out) const;
  /// The same for C + added. @param added k x k, symmetric positive
  /// semidefinite [m/N]
  void evaluate(const Vector& depth, const Matrix& added, Response& out) const;

  /// df_i/dd of pad i with equal depths of all, at least a hundredth of the
  /// pads' mean [N/m].
  [[nodiscard]] double uniform_stiffness(int i) const { return uniform_[i]; }
  /// Of all pads together [N/m].
  [[nodiscard]] double total_stiffness() const { return total_; }

 private:
  Matrix C_;
  Vector uniform_;
  double total_ = 0.0;
};

/// Mean displacements of pads on a half space under uniform pressure.
///
/// Equation   C_ii = 16 / (3 pi^2 E' a), a = sqrt(A_i / pi), of a circle;
///            C_ij = 1 / (pi E' r), r from place to place
/// Source     [@johnson1985, secs. 3.2 and 3.4]
/// @param places 3 x k [m]; @param area k, > 0 [m^2]
/// @param modulus E' = E / (1 - nu^2) > 0 [Pa]
[[nodiscard]] MatrixX calc_half_space_compliance(const Matrix3X& places,
                                                 const VectorX& area,
                                                 double modulus);

}  // namespace limber::contact
