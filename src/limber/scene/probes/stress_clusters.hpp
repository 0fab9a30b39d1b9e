// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "limber/common/types.hpp"

namespace limber::scene {

/// Finds the point with the largest von Mises stress without evaluating all.
///
/// Equation   |w_p eta| <= M_c + sum_k r_ck |(eta - eta_c)_k| for the points p
///            of a cluster c, with w sigma = von Mises stress in norm, r_ck the
///            largest |(w_p)_k|, and M_c = max |w_p eta_c| of the eta_c at
///            which the cluster was evaluated last, at first zero
/// Limits     exact; few points are evaluated where eta changes little from one
///            call to the next, as between the steps of a run
class StressClusters {
 public:
  StressClusters() = default;
  /// @param p_L 3 x p places; @param Sigma_L 6p x m
  StressClusters(const Matrix3X& p_L, const MatrixX& Sigma_L);

  /// Points in the order of clusters: index of each in the arguments.
  [[nodiscard]] const std::vector<int>& order() const { return order_; }
  /// Index of the largest in that order, of equal ones the first, and its
  /// stress. It depends on the arguments alone.
  /// @param Sigma_L 6p x m, in that order, the same in all calls
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
    MatrixX references;  // c x m: eta_c
    VectorX largest;     // c: M_c [Pa]
    VectorX bounds;      // c [Pa]
    VectorX stress;      // of a cluster
    std::vector<int> next;
    int last = 0;  // the cluster that had the largest
  };
  void split(std::vector<int>::iterator first, std::vector<int>::iterator last,
             const Matrix3X& p_L);
  void calc_bounds(const Eigen::Ref<const VectorX>& eta) const;
  void evaluate(int cluster, const MatrixX& Sigma_L,
                const Eigen::Ref<const VectorX>& eta, Largest& found) const;

  std::vector<int> order_;
  std::vector<int> ends_;      // of each cluster in the order
  MatrixX radii_;              // c x m: r_ck
  Eigen::RowVectorXd widest_;  // m: the largest of all clusters
  mutable Scratch scratch_;
};

}  // namespace limber::scene
