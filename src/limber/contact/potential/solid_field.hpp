// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "limber/contact/potential/convex_solid.hpp"
#include "limber/contact/shapes/straight_line.hpp"

namespace limber::contact {

/// As DepthField, of a half space or polyhedron below all of its faces.
class SolidField {
 public:
  static constexpr std::size_t kMostFaces = 128;

  /// @throws ContractError for more than kMostFaces.
  explicit SolidField(const ConvexSolid& solid);

  [[nodiscard]] const ConvexSolid& solid() const { return solid_; }

  [[nodiscard]] double find_t(const Vector3& x) const;
  [[nodiscard]] Depth find_depth(const Vector3& x, int face) const;
  [[nodiscard]] double find_deepest(const StraightLine& line) const;
  [[nodiscard]] Span cut(const StraightLine& line) const;
  void divide(const StraightLine& line, const Span& part,
              LinePieces& out) const;

 private:
  ConvexSolid solid_;
  std::vector<Plane> planes_;  // of its faces
};

}  // namespace limber::contact
