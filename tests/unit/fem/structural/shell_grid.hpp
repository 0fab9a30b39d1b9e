// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>

#include "limber/fem/structural/assemble_structure.hpp"

/// Regular meshes of shells, and their static deflection.
namespace limber::fem::structural_test {

enum class Corners {
  four,
  three,       ///< all diagonals alike
  three_mixed  ///< diagonals of both directions in turn
};

struct Grid {
  Structure structure;
  int columns = 0;  ///< elements along u
  int rows = 0;     ///< elements along v

  /// Node at u = i / columns, v = j / rows.
  [[nodiscard]] int node(int i, int j) const { return j * (columns + 1) + i; }
  /// A node's fraction of what is spread over u and v, of the area 1.
  [[nodiscard]] double fraction(int i, int j) const;
};

/// @param place of the node at u, v in [0, 1]
[[nodiscard]] Grid make_grid(
    int columns, int rows, const Laminate& laminate, Corners corners,
    const std::function<Vector3(double u, double v)>& place);

/// One isotropic ply about the nodes' surface.
[[nodiscard]] Laminate make_plate(double E, double nu, double thickness,
                                  double density = 1.0);

/// Whether a component (0 to 5) of the node at x is held.
using IsHeld = std::function<bool(const Vector3& x, int component)>;

/// Displacements and rotations, 6 x nodes. @param forces 6 x nodes
[[nodiscard]] Matrix6X solve_static(const Structure& structure,
                                    const Matrix6X& forces,
                                    const IsHeld& is_held);

/// Stress and section forces. @param u as solve_static
[[nodiscard]] SectionStress recover(const Structure& structure,
                                    const Matrix6X& u);

/// Stress at a node [xx, yy, zz, xy, yz, xz], of the first such point.
/// @param u as solve_static @param face on which @param ply as StressPoint
[[nodiscard]] Vector6 find_stress(const Structure& structure, const Matrix6X& u,
                                  int node, SectionFace face, int ply = 0);

/// Lowest frequencies [Hz] of a structure, ascending, those of rigid motions
/// first. @param shift > 0 where there are some, added to the eigenvalues of
/// the problem that is solved [rad^2/s^2]
[[nodiscard]] VectorX find_frequencies(const Structure& structure, int count,
                                       const IsHeld& is_held,
                                       double shift = 0.0);

/// Unit translations and rotations of nodes, 6 n x 6.
[[nodiscard]] MatrixX make_rigid(const Matrix3X& x);

}  // namespace limber::fem::structural_test
