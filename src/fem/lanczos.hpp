// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <random>

#include "fem/elastic_inverse.hpp"

namespace limber::fem {

/// An M-orthonormal basis that grows by blocks A Q, A = (K - s M)^-1 M, and
/// the Ritz pairs of A in it.
class BlockLanczos {
 public:
  explicit BlockLanczos(const ElasticInverse& inverse);

  /// Adds one block; false when the space is exhausted.
  bool extend();
  /// Makes the next block random: a fresh look at the whole space.
  void restart_direction();

  [[nodiscard]] Eigen::Index size() const { return used_; }
  /// Ritz values theta = 1 / (lambda - s), descending [s^2].
  [[nodiscard]] const VectorX& theta() const { return theta_; }
  /// |A x - theta x|_M / theta of each Ritz pair.
  [[nodiscard]] const VectorX& residuals() const { return residuals_; }
  /// The first `count` Ritz vectors.
  [[nodiscard]] MatrixX vectors(Eigen::Index count) const;

 private:
  MatrixX random_block();
  void orthogonalise(MatrixX& block, MatrixX& coefficients) const;
  /// M-orthonormal Q and R with block = Q R; dependent columns are dropped.
  MatrixX factor_block(const MatrixX& block, MatrixX& R) const;
  void update_ritz(const MatrixX& R);

  const ElasticInverse& inverse_;
  std::mt19937_64 random_{20};
  Eigen::Index limit_;
  Eigen::Index used_ = 0;
  MatrixX Q_;     // basis, M-orthonormal; first used_ columns
  MatrixX MQ_;    // M Q
  MatrixX T_;     // Q^T M A Q
  MatrixX next_;  // next block, M-orthonormal to Q
  VectorX theta_;
  VectorX residuals_;
  MatrixX S_;
};

}  // namespace limber::fem
