// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "limber/contact/shapes/line_cuts.hpp"
#include "limber/contact/shapes/shape.hpp"

namespace limber::contact {

/// How deep a point is below the surface of a cone, in its own frame: below its
/// disc, or its side t = (h - z) sin a - rho cos a, a half of its tip's angle.
///
/// Equation   flux below the side t^4 (rho + 0.2 t cos a) / rho grad t, which
///            is singular on the axis, or 2/3 t^3 (x - tip), as t is
///            homogeneous about the tip: `by_tip`; they differ by a curl
class ConeField {
 public:
  explicit ConeField(const Cone& shape);

  [[nodiscard]] double find_t(const Vector3& x) const;
  [[nodiscard]] Depth find_depth(const Vector3& x, bool by_tip) const;
  /// v of the deepest point of a line.
  [[nodiscard]] double find_deepest(const StraightLine& line) const;
  [[nodiscard]] Span cut(const StraightLine& line) const;
  /// As DepthField: disc 0, side 1 or 2, by which way the line passes the axis.
  void divide(const StraightLine& line, const Span& part,
              LinePieces& out) const;

 private:
  [[nodiscard]] double find_side(const Vector3& x) const;
  [[nodiscard]] double find_end(const Vector3& x) const;
  // Where side and disc are equally near.
  [[nodiscard]] std::array<double, 2> find_rim_crossings(
      const StraightLine& line) const;

  double half_length_;
  double sine_;
  double cosine_;
};

}  // namespace limber::contact
