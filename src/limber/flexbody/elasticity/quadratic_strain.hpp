// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "limber/common/records/fields.hpp"
#include "limber/flexbody/elasticity/modal_elasticity_kind.hpp"

namespace limber::flexbody {

/// Geometrically nonlinear elasticity: modal strains are quadratic in the modal
/// coordinates, and the potential is their sum of squares, never negative.
///
/// Equation   V = sum_r e_r^2 / 2,  e_r = sqrt(lambda_r) q_r +
///            sum_{i <= j} Q_r,ij q_i q_j for r, i, j in P, and without the sum
///            for the other r; self-strains s, which are of no mode, add
///            (sum_{i <= j} self_s,ij q_i q_j)^2 / 2. With D = de/dq: force D'
///            e, tangent D' D + sum_r e_r d^2e_r/dq^2. Over a step D(q_0/2 +
///            q_1/2)' (e_0 + e_1) / 2: e is quadratic, so that D at the middle
///            times the increment is e_1 - e_0 exactly.
/// Source     of the potential: modal strains of a body whose strains are of
///            second degree in its displacements (Green-Lagrange); of the force
///            over a step: [@simo1992], mean stress on the middle's strain
/// Limits     kMostPaired modes in P and self-strains together. Costs as many
///            products as Q and self have entries in connected rows and pairs,
///            twice a force
class QuadraticStrain {
 public:
  static constexpr int kMostPaired = 256;
  struct Parameters {
    VectorX lambda;           ///< m, finite, >= 0 [rad^2/s^2]
    std::vector<int> paired;  ///< P, increasing, each below m
    /// |P| x |P| (|P| + 1) / 2: row r, a column for each pair i <= j of P in
    /// the order 11, 12, .., 1P, 22, .. [kg^-1/2 m^-1 rad/s]
    MatrixX Q;
    MatrixX self = {};  ///< s x the same columns, or none [the same]
  };

  /// @throws InputError for values out of range or a table of wrong size.
  explicit QuadraticStrain(Parameters parameters);

  [[nodiscard]] const Parameters& parameters() const { return parameters_; }
  [[nodiscard]] Eigen::Index size() const { return parameters_.lambda.size(); }

  [[nodiscard]] double energy(const ModesIn& q) const;
  void calc_force(const ModesIn& q, ModesOut force) const;
  void calc_tangent(const ModesIn& q, ModesSquare tangent) const;
  void calc_force_over_step(const ModesIn& q0, const ModesIn& q1,
                            ModesOut force) const;
  void calc_tangent_over_step(const ModesIn& q0, const ModesIn& q1,
                              ModesSquare tangent) const;

  /// Those of modes without Q are not coupled.
  [[nodiscard]] const VectorX* eigenvalues() const {
    return blocks_.empty() ? &parameters_.lambda : nullptr;
  }
  [[nodiscard]] bool is_linear() const { return blocks_.empty(); }
  [[nodiscard]] const VectorX& rest_stiffness() const {
    return parameters_.lambda;
  }
  [[nodiscard]] static bool is_diagonal_at_rest() { return true; }
  [[nodiscard]] double lowest_rest_stiffness() const;

 private:
  using Paired = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMostPaired, 1>;
  /// Rows and pairs that Q connects: for a symmetric body the classes of its
  /// symmetry are separate. All i, j and rows are indices into P; the row of a
  /// self-strain, whose root is zero, is arbitrary.
  struct Block {
    std::vector<int> rows;
    std::vector<int> i, j;  // of each pair
    VectorX roots;          // sqrt(lambda) of each row, or zero
    MatrixX Q;              // pairs x rows: e_r = root q_r + Q_r' (q_i q_j)
  };
  [[nodiscard]] std::vector<Block> find_blocks() const;
  [[nodiscard]] int mode(Eigen::Index place) const {
    return parameters_.paired[static_cast<std::size_t>(place)];
  }
  [[nodiscard]] Paired gather(const ModesIn& q) const;
  // e of a block's rows.
  [[nodiscard]] static Paired find_strains(const Block& block, const Paired& p);
  // Adds D' w, D = de/dq at p.
  static void add_force(const Block& block, const Paired& p, const Paired& w,
                        Paired& force);
  // Adds D_a' D_b + sum_r w_r d^2e_r/dq^2.
  void add_tangent(const Block& block, const Paired& a, const Paired& b,
                   const Paired& w, ModesSquare tangent) const;
  void scatter(const Paired& forces, ModesOut force) const;

  Parameters parameters_;
  VectorX linear_;  // m: lambda, and 0 of modes that have a row in a block
  std::vector<Block> blocks_;
};

constexpr auto fields_of(const QuadraticStrain::Parameters*) {
  return list_fields("quadratic strain", "eigenvalues [rad^2/s^2]",
                     "paired modes", "Q [kg^-1/2 m^-1 rad/s]",
                     "self-strains [kg^-1/2 m^-1 rad/s]");
}

}  // namespace limber::flexbody
