// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/common/records/fields.hpp"
#include "limber/flexbody/elasticity/modal_elasticity_kind.hpp"

namespace limber::flexbody {

/// Linear elasticity in a basis that diagonalises it: that of a reduced body.
///
/// Equation   V = sum_k lambda_k q_k^2 / 2
class DiagonalStiffness {
 public:
  struct Parameters {
    VectorX lambda;  ///< m, finite, >= 0 [rad^2/s^2]
  };

  /// Without modes.
  DiagonalStiffness() = default;
  /// @throws InputError naming the first eigenvalue that is out of range.
  explicit DiagonalStiffness(Parameters parameters);

  [[nodiscard]] const Parameters& parameters() const { return parameters_; }
  [[nodiscard]] Eigen::Index size() const { return parameters_.lambda.size(); }

  [[nodiscard]] double energy(const ModesIn& q) const;
  void calc_force(const ModesIn& q, ModesOut force) const;
  void calc_tangent(const ModesIn& q, ModesSquare tangent) const;
  /// Of the mean: V is quadratic.
  void calc_force_over_step(const ModesIn& q0, const ModesIn& q1,
                            ModesOut force) const;
  void calc_tangent_over_step(const ModesIn& q0, const ModesIn& q1,
                              ModesSquare tangent) const;

  [[nodiscard]] const VectorX* eigenvalues() const {
    return &parameters_.lambda;
  }
  [[nodiscard]] static bool is_linear() { return true; }
  [[nodiscard]] const VectorX& rest_stiffness() const {
    return parameters_.lambda;
  }
  [[nodiscard]] static bool is_diagonal_at_rest() { return true; }
  [[nodiscard]] double lowest_rest_stiffness() const;

 private:
  Parameters parameters_;
};

constexpr auto fields_of(const DiagonalStiffness::Parameters*) {
  return list_fields("diagonal stiffness", "eigenvalues [rad^2/s^2]");
}

}  // namespace limber::flexbody
