// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "limber/common/types.hpp"

/// Products of paired modes as additional coordinates p_ij, after the m modes,
/// in which the motion of level `nonlinear` is linear: tables of points and of
/// loads have m + pairs columns.
///
/// Equation   u = Phi q + Theta p,  p_ij = c_ij q_i q_j for i <= j in P,
///            c_ii = 1/2, else 1; Theta's columns are the theta_ij
///            (QuadraticManifold). With J = dp/dq: du = (Phi + Theta J) dq, a
///            force f on p is J' f on q, and J' f changes with q by the
///            symmetric matrix of the f_ij
/// Source     docs/theory/nonlinear.md
namespace limber::flexbody {

/// Calls visit(place of the pair, i, j, is_square) in the order 11, 12, .., 1P,
/// 22, .., i and j modes.
template <typename Visit>
void for_each_product(const std::vector<int>& paired, const Visit& visit) {
  Eigen::Index pair = 0;
  for (std::size_t a = 0; a < paired.size(); ++a) {
    visit(pair++, paired[a], paired[a], true);
    for (std::size_t b = a + 1; b < paired.size(); ++b) {
      visit(pair++, paired[a], paired[b], false);
    }
  }
}

/// p of q. @param out pairs [kg m^2]
inline void set_products(const std::vector<int>& paired, const double* q,
                         double* out) {
  for_each_product(paired,
                   [&](Eigen::Index pair, int i, int j, bool is_square) {
                     out[pair] = (is_square ? 0.5 : 1.0) * q[i] * q[j];
                   });
}

/// J times the rates of q. @param out pairs [kg m^2/s]
inline void set_product_rates(const std::vector<int>& paired, const double* q,
                              const double* qdot, double* out) {
  for_each_product(paired, [&](Eigen::Index pair, int i, int j,
                               bool is_square) {
    out[pair] = is_square ? q[i] * qdot[i] : q[i] * qdot[j] + q[j] * qdot[i];
  });
}

/// Adds J' f to the forces on the modes. @param f pairs [kg^-1 m^-1 N]
inline void add_product_forces(const std::vector<int>& paired, const double* f,
                               const double* q, double* force) {
  for_each_product(paired,
                   [&](Eigen::Index pair, int i, int j, bool is_square) {
                     force[i] += f[pair] * q[j];
                     if (!is_square) force[j] += f[pair] * q[i];
                   });
}

/// Adds Theta J to the modes' columns. @param Theta 3 x pairs
template <typename Columns>
void add_product_columns(const std::vector<int>& paired,
                         const Eigen::Ref<const Matrix3X>& Theta,
                         const double* q, Columns&& modes) {
  for_each_product(paired,
                   [&](Eigen::Index pair, int i, int j, bool is_square) {
                     modes.col(i) += Theta.col(pair) * q[j];
                     if (!is_square) modes.col(j) += Theta.col(pair) * q[i];
                   });
}

/// Adds factor times the matrix of the f_ij to K, m x m.
template <typename Matrix>
void add_product_stiffness(const std::vector<int>& paired, const double* f,
                           double factor, Matrix&& K) {
  for_each_product(paired,
                   [&](Eigen::Index pair, int i, int j, bool is_square) {
                     K(i, j) += factor * f[pair];
                     if (!is_square) K(j, i) += factor * f[pair];
                   });
}

}  // namespace limber::flexbody
