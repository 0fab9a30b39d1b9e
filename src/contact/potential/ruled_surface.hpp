// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/common/pose.hpp"
#include "limber/contact/potential/depth_field.hpp"

namespace limber::contact {

/// A part of a surface, or a sheet within a body whose points are equally near
/// to two of its faces, as straight lines v along which a coordinate u is
/// constant.
struct RuledSurface {
  enum class Kind {
    kFlat,   ///< rectangle: u along e1, v along e2
    kDisc,   ///< u an angle: at radius sin u along e1, v along e2
    kSide,   ///< of a cylinder: u the angle from e1 to e2, v along e3
    kRidge,  ///< sheet of a box's edge along e1; v the depth, inward along e2
    kRim     ///< sheet of a cylinder's rim, e3 outward; v the depth
  };
  Kind kind = Kind::kFlat;
  Vector3 centre = Vector3::Zero();
  Vector3 e1 = Vector3::UnitX();
  Vector3 e2 = Vector3::UnitY();
  Vector3 e3 = Vector3::UnitZ();  ///< outward normal of a flat or disc
  double radius = 0.0;            ///< of a disc, side or rim [m]
  double half_u = 0.0;            ///< |u| <= half_u [m or rad]
  double half_v = 0.0;            ///< |v|, or the largest v of a sheet [m]

  [[nodiscard]] bool is_sheet() const {
    return kind == Kind::kRidge || kind == Kind::kRim;
  }
  /// Whether u is an angle that turns all around.
  [[nodiscard]] bool is_closed() const {
    return kind == Kind::kSide || kind == Kind::kRim;
  }
  [[nodiscard]] StraightLine find_line(double u) const;
  /// Outward normal times the area by du dv; of no sheet.
  [[nodiscard]] Vector3 find_area(double u) const;
  /// Of a sheet, over the depths of a span of a line: flux of phi grad t out of
  /// both cells, by du.
  [[nodiscard]] double find_flux(const Span& span) const;
  /// At least that of a point of the line, by du.
  [[nodiscard]] double find_speed() const;
  /// Of a ball about the centre [m].
  [[nodiscard]] double find_reach() const;
  [[nodiscard]] RuledSurface place(const Pose& X) const;
};

using RuledSurfaces = StackArray<RuledSurface, 24>;

/// The surface of a half space, box or cylinder, rows of flats across the way
/// in which the depth below `soft` changes most. A half space's is as large as
/// `soft`, which must be bounded then.
/// @param X the pose of `hard` in the frame of `soft`
/// @throws ContractError for other kinds.
void list_surfaces(const ShapeKind& hard, const Pose& X, const ShapeKind& soft,
                   RuledSurfaces& out);

/// The sheets of a box or cylinder in its own frame; none of other kinds.
void list_sheets(const ShapeKind& soft, RuledSurfaces& out);

}  // namespace limber::contact
