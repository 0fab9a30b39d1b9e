// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "limber/common/pose.hpp"
#include "limber/contact/potential/polytope.hpp"
#include "limber/contact/shapes/shape.hpp"

namespace limber::contact {

/// A half space or a convex polyhedron in its own frame, with the part of it
/// that is nearest to each of its faces. Immutable.
class ConvexSolid {
 public:
  /// A plane through the line in which two faces meet.
  struct Bisector {
    int other = 0;  ///< face on its far side
    Plane plane;    ///< inside: nearer to the own face
  };
  struct Face {
    Plane plane;                    ///< n unit
    std::vector<Bisector> nearest;  ///< bound the points nearest to the face
    bool presses = true;  ///< else it only bounds the solid, without depth
  };

  /// @throws ContractError unless is_solid(shape).
  explicit ConvexSolid(const ShapeKind& shape);

  /// What lies up to `depth` below a flat face; that face presses, and those
  /// beside it at the edges of `rim`.
  /// @param corners 3 x k of the face, convex, z = 0, right-hand about z [m]
  /// @param rim edges, by their first corners, < k
  [[nodiscard]] static ConvexSolid make_slab(
      const Matrix3X& corners, const std::vector<std::size_t>& rim,
      double depth);

  [[nodiscard]] const std::vector<Face>& faces() const { return faces_; }
  /// None of a half space.
  [[nodiscard]] const std::vector<Vector3>& corners() const { return corners_; }
  [[nodiscard]] bool is_bounded() const { return !corners_.empty(); }
  /// At a pose; the world's axes, facets with tags tag_of(face, side).
  /// @throws ContractError of a half space.
  [[nodiscard]] Polytope place(const Pose& X_WS, int side) const;
  /// Of facets on a face of a pair's first or second solid, 0 or 1.
  [[nodiscard]] static int tag_of(int face, int side) {
    return -2 - 2 * face - side;
  }

 private:
  ConvexSolid() = default;
  // To all other faces that press.
  void add_bisectors();

  std::vector<Face> faces_;
  std::vector<Vector3> corners_;
  std::vector<std::vector<int>> loops_;  // corners of each face
};

/// A solid in the frame of a body, or of a part of it.
struct PlacedSolid {
  ConvexSolid solid;
  Pose X_BS;
};

/// Whether a shape is a half space or a polyhedron.
[[nodiscard]] bool is_solid(const ShapeKind& shape);

}  // namespace limber::contact
