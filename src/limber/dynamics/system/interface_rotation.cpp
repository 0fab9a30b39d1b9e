// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/system/interface_rotation.hpp"

#include <fmt/format.h>

#include <cmath>
#include <string>

#include "limber/common/dense/singular_values.hpp"
#include "limber/common/dense/symmetric_eigen.hpp"
#include "limber/common/errors.hpp"

namespace limber::dynamics {
namespace {

using flexbody::InterfaceTable;

/// Directions below this fraction of the largest are not required.
constexpr double kNothing = 1e-12;
/// Directions this near to each other are the same [rad]: URDF files round
/// their angles, 1.5708 for pi / 2.
constexpr double kTilt = 1e-4;

/// Orthonormal basis of the directions in which `matrix`, symmetric and
/// positive semi-definite, is not zero.
Matrix3X find_range(const Matrix3& matrix) {
  const auto eigen = dense::find_eigenpairs(matrix);
  const double largest = eigen.values[2];
  Matrix3X range(3, 0);
  for (int k = 0; k < 3; ++k) {
    if (!(eigen.values[k] > kNothing * largest)) continue;
    range.conservativeResize(3, range.cols() + 1);
    range.rightCols<1>() = eigen.vectors.col(k);
  }
  return range;
}

/// The directions in the span of `missing` that `required` contains.
Matrix3X find_required(const Matrix3X& missing, const Matrix3X& required) {
  if (missing.cols() == 0 || required.cols() == 0) return Matrix3X(3, 0);
  const MatrixX overlap = required.transpose() * missing;
  const auto svd = dense::find_singular_form(overlap);
  const Eigen::Index count = (svd.values.array() > kTilt).count();
  return missing * svd.V.leftCols(count);
}

/// A direction, normalised in sign and rounded.
std::string format_direction(const Vector3& direction) {
  Eigen::Index largest = 0;
  direction.cwiseAbs().maxCoeff(&largest);
  const Vector3 e = direction[largest] < 0.0 ? Vector3(-direction) : direction;
  const auto cut = [](double x) { return std::abs(x) < 1e-6 ? 0.0 : x; };
  return fmt::format("({:.3g}, {:.3g}, {:.3g})", cut(e[0]), cut(e[1]),
                     cut(e[2]));
}

Matrix3X find_complement(const Matrix3X& directions) {
  return find_range(
      Matrix3(Matrix3::Identity() - directions * directions.transpose()));
}

std::string describe_nodes(const InterfaceTable& table) {
  if (table.rotation_rank() == 2) {
    return fmt::format(
        "its {} nodes are on one line along {}", table.node_count,
        format_direction(find_complement(table.rotation_axes).leftCols<1>()));
  }
  if (table.node_count == 1) return "it is one node";
  return fmt::format("its {} nodes are at one point", table.node_count);
}

std::string describe_directions(const Matrix3X& directions) {
  if (directions.cols() == 3) return "any direction";
  if (directions.cols() == 1) return format_direction(directions.col(0));
  return "directions normal to " +
         format_direction(find_complement(directions).leftCols<1>());
}

}  // namespace

void check_rotation(const InterfaceTable& table,
                    const joints::RequiredRotations& required_B) {
  if (table.rotation_rank() == 3) return;
  const Matrix3X required = find_required(find_complement(table.rotation_axes),
                                          find_range(required_B));
  if (required.cols() == 0) return;
  throw InputError(fmt::format(
      "interface '{}': {}, so it has no rotation about {} (mesh axes), which "
      "is required. Choose nodes that span a surface, or require no rotation "
      "about {}",
      table.name, describe_nodes(table), describe_directions(required),
      required.cols() == 1 ? "that direction" : "them"));
}

}  // namespace limber::dynamics
