// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>

#include "limber/contact/patches/nodal_motion.hpp"
#include "limber/contact/potential/body_kind.hpp"
#include "limber/flexbody/model/contact_surface.hpp"
#include "limber/joints/pairs/pair_interaction.hpp"

namespace limber::contact {

/// A convex body of one side of a contact, in a frame P of its own: that of its
/// body, or of the part or slice of a flexible surface that moves as one piece.
/// Immutable.
///
/// Equation   p_P = p_B + R_B (c + u), R_P = R_B exp(theta), (u, theta) =
///            motion_B eta; at level `full` NodalMotion
class PatchPart {
 public:
  explicit PatchPart(const PlacedBody& body);
  /// @param flexibility of the layer under its face, along the normal [m/N]
  PatchPart(const flexbody::ContactPart& part, double flexibility);
  /// @param body that represents the slice, in the flexible body's frame
  PatchPart(const flexbody::ContactSlice& slice, const PlacedBody& body);

  /// Moves it, of a flexible surface at level `full`, with the nodes of a mesh.
  void move_with(const flexbody::NodalPiece& piece) {
    nodes_ = std::make_shared<const NodalMotion>(piece);
  }

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

  [[nodiscard]] bool is_flexible() const {
    return nodes_ != nullptr || motion_B_.cols() > 0;
  }
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
  // How far it is moved by the modes or the nodes, and how fast in its own
  // axes.
  struct Motion {
    Pose X;                          // from its undeformed centre, body's axes
    Vector6 rate = Vector6::Zero();  // (v, w), axes of P
  };
  [[nodiscard]] Motion find_own_motion(const joints::PairBody& body) const;
  // (u, theta) of modal coordinates or velocities.
  [[nodiscard]] Vector6 move(const double* eta) const;
  void set_modal_rows(const joints::PairBody& body, const Vector3& arm,
                      Matrix3X& out) const;

  ConvexSolid::Ball ball_;
  PlacedBody body_;
  std::optional<Shape> shape_;
  Vector3 centre_B_ = Vector3::Zero();
  MatrixX motion_B_ = MatrixX(6, 0);
  std::shared_ptr<const NodalMotion> nodes_;  // at level `full`
  Matrix3 flexibility_ = Matrix3::Zero();
};

}  // namespace limber::contact
