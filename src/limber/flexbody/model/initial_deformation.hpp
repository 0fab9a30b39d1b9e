// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Sparse>
#include <optional>
#include <string>
#include <vector>

#include "limber/common/types.hpp"

namespace limber::flexbody {

/// A nodal field projected on the modes, with the parts that this omits.
///
/// Equation   u = R R^T M u + Phi eta + rest,  eta = Phi^T M u
/// Source     R and Phi are M-orthonormal and M-orthogonal to each other, so
///            the three parts are orthogonal in M and eta is the best fit
struct ProjectedField {
  VectorX eta;  ///< m [kg^1/2 m, or that a second]
  /// |R R^T M u|_M / |u|_M: rigid motion, which belongs to the body's frame,
  /// not to its modes [-].
  double rigid_fraction = 0.0;
  /// |rest|_M / |u - R R^T M u|_M: deformation outside the basis [-].
  double missed_fraction = 0.0;
  std::string key;  ///< find_field_key of the field
};

/// Initial deformation, stored with the body, which may not contain all rows.
struct InitialDeformation {
  std::optional<ProjectedField> displacement;
  std::optional<ProjectedField> velocity;
};

/// @param u 3N; @param Phi 3N x m; @param M_s N x N, both triangles [kg]
/// @param R 3N x 6, or 3N x 0 of a clamped body
[[nodiscard]] ProjectedField project_field(
    const VectorX& u, const MatrixX& Phi,
    const Eigen::SparseMatrix<double>& M_s, const MatrixX& R);

/// Digest of a field's values.
[[nodiscard]] std::string find_field_key(const VectorX& u);

/// A text for each fraction above 1 %, with its value.
/// @param what the field is, e.g. "initial velocity"
[[nodiscard]] std::vector<std::string> describe_losses(
    const ProjectedField& field, const std::string& what);

}  // namespace limber::flexbody
