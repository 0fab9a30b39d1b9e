// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/common/stack_array.hpp"
#include "limber/common/types.hpp"

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

/// Part of a line next to one face of a body, up to `last`.
struct LinePiece {
  int face = 0;
  double last = 0.0;
};
using LinePieces = StackArray<LinePiece, 128>;

/// Of a point within a body.
struct Depth {
  double t = 0.0;                      ///< distance to the surface [m]
  Vector3 gradient = Vector3::Zero();  ///< of t [-]
  /// A field of the divergence 4 t^3 where t is smooth, which is 0 on the
  /// surface: t^4 grad t below a flat [m^4]
  Vector3 flux = Vector3::Zero();
};

}  // namespace limber::contact
