// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

#include "limber/common/stack_array.hpp"
#include "limber/common/types.hpp"
#include "limber/contact/shapes/shape.hpp"

namespace limber::contact {

struct Span {
  double first = 0.0;
  double last = 0.0;

  [[nodiscard]] bool is_empty() const { return !(first < last); }
  [[nodiscard]] double length() const { return last - first; }
  [[nodiscard]] double middle() const { return 0.5 * (first + last); }
};

/// x = origin + v way for v of a span.
struct StraightLine {
  Vector3 origin = Vector3::Zero();
  Vector3 way = Vector3::UnitX();
  Span span;

  [[nodiscard]] Vector3 at(double v) const { return origin + v * way; }
};

/// Of a point within a body.
struct Depth {
  double t = 0.0;                      ///< distance to the surface [m]
  Vector3 gradient = Vector3::Zero();  ///< of t [-]
  /// phi, of which the field phi grad t has the divergence 4 t^3 where t is
  /// smooth: t^4 below a flat [m^4]
  double flux = 0.0;
};

/// Part of a line next to one face of a body, up to `last`.
struct LinePiece {
  int face = 0;
  double last = 0.0;
};
using LinePieces = StackArray<LinePiece, 8>;

/// How deep a point is below the surface of a convex body, in its own frame: a
/// half space, box, cylinder, capsule or ball.
///
/// Equation   t = the least distance to a face, also outside, where it is
///            negative: concave everywhere, along a line the ends of {t > 0}
///            and the changes of the nearest face in closed form
/// Limits     less deep than the middle of the body
class DepthField {
 public:
  /// @throws ContractError for a skin.
  explicit DepthField(const ShapeKind& shape);

  [[nodiscard]] const ShapeKind& shape() const { return shape_; }
  /// Whether all faces are flat.
  [[nodiscard]] bool is_flat() const { return is_flat_; }

  [[nodiscard]] double find_t(const Vector3& x) const;
  [[nodiscard]] Depth find_depth(const Vector3& x) const;
  /// v of the deepest point of a line.
  [[nodiscard]] double find_deepest(const StraightLine& line) const;
  /// The part of a line within the body.
  [[nodiscard]] Span cut(const StraightLine& line) const;
  /// By the nearest face, ascending; the last one ends at part.last.
  void divide(const StraightLine& line, const Span& part,
              LinePieces& out) const;

 private:
  ShapeKind shape_;
  bool is_flat_ = true;
};

}  // namespace limber::contact
