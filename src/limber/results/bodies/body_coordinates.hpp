// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "limber/flexbody/model/reduced_body.hpp"

/// A free reduced body in physical coordinates, as programs of finite elements
/// have it. Its motion z is six rigid coordinates (translations and rotations
/// about the axes of the centre of mass) and its modes.
namespace limber::results {

/// A node of a body: a stored one, or an interface, whose mean motion it has.
struct BodyNode {
  std::size_t tag = 0;
  std::string interface;          ///< name, empty for a stored node
  Vector3 x_B = Vector3::Zero();  ///< from the centre of mass [m]
  MatrixX rows;  ///< 3 or 6 x (6 + m): translation and rotation per z
};

/// Its stored nodes, then its interfaces with new numbers.
[[nodiscard]] std::vector<BodyNode> list_nodes(
    const flexbody::ReducedBody& body);

/// Interfaces alone. @throws InputError for one whose nodes do not determine a
/// rotation
[[nodiscard]] std::vector<BodyNode> list_frames(
    const flexbody::ReducedBody& body);

/// A body in coordinates q, z = T q.
struct BodyMatrices {
  MatrixX T;
  MatrixX K;  ///< [N/m, N, N m; modes 1/s^2]
  MatrixX M;
  MatrixX D;  ///< damping of the modes
  /// int u_a u_b dm, xx, yy, zz, xy, xz, yz
  std::array<MatrixX, 6> S;
};

/// @param coordinates rows of q in z, square
/// @param ratio of damping of each mode [-]
/// @throws NumericalError if they are dependent
[[nodiscard]] BodyMatrices transform(const flexbody::ReducedBody& body,
                                     const MatrixX& coordinates, double ratio);

/// Places, scaled so that all columns of a motion are of about one size.
[[nodiscard]] VectorX find_scales(const flexbody::ReducedBody& body);

/// @throws InputError for a body that is clamped, which has no rigid motion
void require_free(const flexbody::ReducedBody& body);

}  // namespace limber::results
