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
  };

  /// @throws ContractError unless is_solid(shape).
  explicit ConvexSolid(const ShapeKind& shape);

  [[nodiscard]] const std::vector<Face>& faces() const { return faces_; }
  /// None of a half space.
  [[nodiscard]] const std::vector<Vector3>& corners() const { return corners_; }
  [[nodiscard]] bool is_bounded() const { return !corners_.empty(); }
  /// At a pose; the world's axes. @throws ContractError of a half space.
  [[nodiscard]] Polytope place(const Pose& X_WS) const;

 private:
  std::vector<Face> faces_;
  std::vector<Vector3> corners_;
  std::vector<std::vector<int>> loops_;  // corners of each face
};

/// Whether a shape is a half space or a polyhedron.
[[nodiscard]] bool is_solid(const ShapeKind& shape);

}  // namespace limber::contact
