// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <variant>

#include "limber/contact/potential/body_kind.hpp"
#include "limber/contact/potential/solid_field.hpp"

namespace limber::contact {

/// How deep a point is below the surface of a convex body, in its own frame.
///
/// Equation   t = the least distance to a face, also outside, where it is
///            negative: concave everywhere, along a line the ends of {t > 0}
///            and the changes of the nearest face in closed form
/// Limits     of round bodies less deep than their middle
class DepthField {
 public:
  using Kind =
      std::variant<Sphere, Capsule, Cylinder, SolidField, Cone, Ellipsoid>;

  /// @throws ContractError for a solid of more than SolidField::kMostFaces.
  explicit DepthField(const BodyKind& body);

  [[nodiscard]] const Kind& kind() const { return kind_; }
  /// Whether all faces are flat.
  [[nodiscard]] bool is_flat() const;

  /// Of an ellipsoid EllipsoidField::find_bound.
  [[nodiscard]] double find_t(const Vector3& x) const;
  /// @param face nearest to x, of a LinePiece
  /// @param by_tip see ConeField
  [[nodiscard]] Depth find_depth(const Vector3& x, int face,
                                 bool by_tip = false) const;
  /// v of the deepest point of a line, by find_t.
  [[nodiscard]] double find_deepest(const StraightLine& line) const;
  /// The part of a line within the body.
  [[nodiscard]] Span cut(const StraightLine& line) const;
  /// By the nearest face, ascending; the last one ends at part.last.
  void divide(const StraightLine& line, const Span& part,
              LinePieces& out) const;
  /// The least and the largest n . x of its points, n unit; infinite ones of a
  /// half space.
  [[nodiscard]] Span find_extent(const Vector3& n) const;

 private:
  Kind kind_;
};

}  // namespace limber::contact
