// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "limber/contact/potential/body_kind.hpp"
#include "limber/flexbody/model/contact_surface.hpp"
#include "limber/joints/pairs/pair_interaction.hpp"

namespace limber::contact {

/// A convex body of one side of a contact, in a frame P of its own: that of its
/// body, or of the part or slice of a flexible surface that moves as one piece.
/// Immutable.
///
/// Equation   p_P = p_B + R_B (c + u), R_P = R_B exp(theta), (u, theta) =
///            motion_B eta
class PatchPart {
 public:
  explicit PatchPart(const PlacedBody& body);
  /// @param flexibility of the layer under its face, along the normal [m/N]
  PatchPart(const flexbody::ContactPart& part, double flexibility);
  /// @param body that stands for the slice, in the flexible body's frame
  PatchPart(const flexbody::ContactSlice& slice, const PlacedBody& body);

  /// About it, in P; of a half space the radius is infinite.
  [[nodiscard]] const ConvexSolid::Ball& ball() const { return ball_; }
  /// In P.
  [[nodiscard]] const PlacedBody& body() const { return body_; }
  /// Its solid; null of a round shape.
  [[nodiscard]] const ConvexSolid* solid() const {
    return std::get_if<ConvexSolid>(&body_.kind);
  }
  /// As a shape, in P; of solids nothing.
  [[nodiscard]] const std::optional<Shape>& shape() const { return shape_; }
  /// Of the layer under a flexible part's faces, in P; 0 of others [m/N].
  [[nodiscard]] const Matrix3& flexibility() const { return flexibility_; }

  [[nodiscard]] bool is_flexible() const { return motion_B_.cols() > 0; }
  /// Whether P is not the frame of the body.
  [[nodiscard]] bool has_own_frame() const {
    return is_flexible() || !centre_B_.isZero(0.0);
  }

  /// P as a body without modes. @param body with the part's modes; at rest in
  /// them without etadot
  [[nodiscard]] joints::PairBody find_motion(
      const joints::PairBody& body) const;
  /// The material point of the part at a place of the world [m].
  void set_place(const joints::PairBody& body, const Vector3& p_W,
                 joints::PairPlace& out) const;
  /// @throws InputError unless it fits a body of so many modes.
  void check(int modes) const;

 private:
  // (u, theta) of modal coordinates or velocities.
  [[nodiscard]] Vector6 move(const double* eta) const;

  ConvexSolid::Ball ball_;
  PlacedBody body_;
  std::optional<Shape> shape_;
  Vector3 centre_B_ = Vector3::Zero();
  MatrixX motion_B_ = MatrixX(6, 0);
  Matrix3 flexibility_ = Matrix3::Zero();
};

}  // namespace limber::contact
