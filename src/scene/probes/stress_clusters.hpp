// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "limber/common/types.hpp"

namespace limber::scene {

/// Finds the point with the largest von Mises stress without evaluating all.
///
/// Equation   |w_p eta| <= |w_c eta| + sum_k r_ck |eta_k| for the points p of
///            a cluster c, with w sigma = von Mises stress in norm, w_c the
///            mean of w_p and r_ck the largest |(w_p - w_c)_k|
/// Limits     exact; the fewer points are evaluated the more localised the
///            stress is
class StressClusters {
 public:
  StressClusters() = default;
  /// @param p_L 3 x p places; @param Sigma_L 6p x m
  StressClusters(const Matrix3X& p_L, const MatrixX& Sigma_L);

  /// Points in the order of clusters: index of each in the arguments.
  [[nodiscard]] const std::vector<int>& order() const { return order_; }
  /// Index of the largest in that order, and its stress.
  /// @param Sigma_L 6p x m, in that order
  /// Allocates in the first call only.
  struct Largest {
    int point = 0;
    double von_mises = -1.0;           ///< [Pa]
    Vector6 stress = Vector6::Zero();  ///< [Pa]
  };
  [[nodiscard]] Largest find(const MatrixX& Sigma_L,
                             const Eigen::Ref<const VectorX>& eta) const;

 private:
  struct Scratch {
    VectorX magnitudes;  // |eta|
    VectorX centers;     // 6c
    VectorX bounds;      // c
    std::vector<int> next;
    VectorX stress;  // of a cluster
  };
  void split(std::vector<int>::iterator first, std::vector<int>::iterator last,
             const Matrix3X& p_L);

  std::vector<int> order_;
  std::vector<int> ends_;  // of each cluster in the order
  MatrixX centers_;        // 6c x m
  MatrixX radii_;          // c x m
  mutable Scratch scratch_;
};

}  // namespace limber::scene
