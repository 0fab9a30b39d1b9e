// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/common/records/fields.hpp"
#include "limber/flexbody/elasticity/modal_elasticity_kind.hpp"

namespace limber::flexbody {

/// Linear elasticity in a basis that does not diagonalise it.
///
/// Equation   V = q' K q / 2
class FullStiffness {
 public:
  struct Parameters {
    /// m x m, finite, symmetric, positive semi-definite [rad^2/s^2].
    MatrixX K;
  };

  /// K is made symmetric to the last digit.
  /// @throws InputError for a matrix that violates these conditions.
  explicit FullStiffness(Parameters parameters);

  [[nodiscard]] const Parameters& parameters() const { return parameters_; }
  [[nodiscard]] Eigen::Index size() const { return parameters_.K.rows(); }

  [[nodiscard]] double energy(const ModesIn& q) const;
  void calc_force(const ModesIn& q, ModesOut force) const;
  void calc_tangent(const ModesIn& q, ModesSquare tangent) const;
  /// Of the mean: V is quadratic.
  void calc_force_over_step(const ModesIn& q0, const ModesIn& q1,
                            ModesOut force) const;
  void calc_tangent_over_step(const ModesIn& q0, const ModesIn& q1,
                              ModesSquare tangent) const;

  [[nodiscard]] static const VectorX* eigenvalues() { return nullptr; }
  [[nodiscard]] static bool is_linear() { return true; }
  [[nodiscard]] const VectorX& rest_stiffness() const { return diagonal_; }
  [[nodiscard]] static bool is_diagonal_at_rest() { return false; }
  [[nodiscard]] double lowest_rest_stiffness() const { return lowest_; }

 private:
  Parameters parameters_;
  VectorX diagonal_;
  double lowest_ = 0.0;
};

constexpr auto fields_of(const FullStiffness::Parameters*) {
  return list_fields("full stiffness", "K [rad^2/s^2]");
}

}  // namespace limber::flexbody
