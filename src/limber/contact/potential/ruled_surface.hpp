// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "limber/common/pose.hpp"
#include "limber/contact/shapes/straight_line.hpp"

namespace limber::contact {

using FlatOutline = std::span<const Eigen::Vector2d>;

/// A part of a surface, or a sheet within a body on which it is integrated as
/// well, as straight lines v along which a coordinate u is constant. A copy
/// shares its outline.
struct RuledSurface {
  enum class Kind {
    kPlane,    ///< square: u along e1, v along e2
    kPolygon,  ///< convex: u along e1, v along e2
    kDisc,     ///< u an angle: at radius sin u along e1, v along e2
    kSide,     ///< of a cylinder or cone: u the angle from e1 to e2, v along
               ///< e3, towards its tip
    kRim       ///< sheet of its rim, e3 outward; v the depth
  };
  Kind kind = Kind::kPlane;
  Vector3 centre = Vector3::Zero();
  Vector3 e1 = Vector3::UnitX();
  Vector3 e2 = Vector3::UnitY();
  Vector3 e3 = Vector3::UnitZ();  ///< outward normal of a flat or disc
  double radius = 0.0;            ///< of a disc, side (half way) or rim [m]
  double sine = 0.0;    ///< of half of the angle at the tip, 0 of a cylinder
  Span u;               ///< of its lines [m or rad]
  double half_v = 0.0;  ///< |v|, or the largest v of a rim [m]
  double reach = 0.0;   ///< of a ball about the centre [m]

  /// Corners of a polygon, counterclockwise about e3, from the centre [m].
  FlatOutline outline;
  /// e2 in the axes of the outline.
  Eigen::Vector2d row = Eigen::Vector2d::UnitY();

  /// Of a flat sheet: that of t^4 in the flux, and t = depth + slope v.
  double density = 0.0;
  double depth = 0.0;
  double slope = 0.0;

  [[nodiscard]] bool is_flat() const {
    return kind == Kind::kPlane || kind == Kind::kPolygon;
  }
  [[nodiscard]] bool has_one_normal() const {
    return is_flat() || kind == Kind::kDisc;
  }
  /// Whether u is an angle over a full circle.
  [[nodiscard]] bool is_closed() const {
    return kind == Kind::kSide || kind == Kind::kRim;
  }
  [[nodiscard]] StraightLine find_line(double u) const;
  /// Outward normal times the area by du dv at v = 0; of a flat or disc.
  [[nodiscard]] Vector3 find_area(double u) const;
  /// Of a side, both. @param area gets that of its line
  [[nodiscard]] StraightLine find_line(double u, Vector3& area) const;
  /// The area at v, over that at v = 0.
  [[nodiscard]] double find_width(double v) const {
    return narrows() ? 1.0 - v * sine / radius : 1.0;
  }
  /// Whether lines meet in a tip.
  [[nodiscard]] bool narrows() const {
    return kind == Kind::kSide && sine > 0.0;
  }
  /// Of a sheet, over a span of a line: Depth::flux out of the cells beside
  /// it, by du. @param by_tip see ConeField
  [[nodiscard]] double find_flux(const Span& span, bool by_tip) const;
  /// At least that of a point of the line, by du.
  [[nodiscard]] double find_speed() const;
  /// (u, v) of a corner of the outline.
  [[nodiscard]] Eigen::Vector2d find_corner(std::size_t i) const;
  [[nodiscard]] Vector3 at(const Eigen::Vector2d& uv) const {
    return centre + uv[0] * e1 + uv[1] * e2;
  }

  [[nodiscard]] RuledSurface place(const Pose& X) const;
  /// Rows along a way, or any if it is zero, of a polygon along an edge that is
  /// nearly along it; no change of a side or rim. @param way in the plane
  void turn_rows(const Vector3& way);
};

/// A polygon by its corners, counterclockwise about `normal`; `outline` gets
/// what it shares with its copies and must outlive them.
/// @param way of its rows, normal to `normal`, unit
[[nodiscard]] RuledSurface make_polygon(std::span<const Vector3> corners,
                                        const Vector3& normal,
                                        const Vector3& way,
                                        std::vector<Eigen::Vector2d>& outline);

}  // namespace limber::contact
