// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>

#include "limber/contact/patches/contact_side.hpp"
#include "limber/contact/patches/patch_finder.hpp"
#include "limber/contact/shapes/mesh_surface.hpp"

namespace limber::contact {

/// A sphere on the surface of a flexible body, in contact at one point.
///
/// Equation   HertzLaw with k = 4/3 E* sqrt(R_e), 1 / R_e = 1 / r + the mean
///            curvature of the surface >= 1 / find_roundness, and its residual
///            flexibility, all at the place nearest to the ball's centre; the
///            patch moves with the body and the modes there
/// Limits     the tangent takes the normal as constant; the rotation of the
/// surface
///            by the modes is left out of friction and damping
class BallOnSurface final : public PatchFinder {
 public:
  /// @param modulus E* > 0 [Pa] @param radius R_e in place of that above [m]
  /// @throws ContractError unless suits(A, B) or suits(B, A).
  BallOnSurface(const ContactSide& A, const ContactSide& B, double modulus,
                std::optional<double> radius);

  /// @param surface of a flexible body, not a rigid mesh
  [[nodiscard]] static bool suits(const ContactSide& ball,
                                  const ContactSide& mesh_surface);

  [[nodiscard]] std::size_t count() const override { return 1; }
  [[nodiscard]] bool is_point() const override { return true; }
  [[nodiscard]] double modulus(std::size_t /*index*/) const override {
    return modulus_;
  }
  void check(int modes_A, int modes_B) const override;
  [[nodiscard]] PatchTouches find_patches(const joints::PairBodies& bodies,
                                          bool has_derivatives) const override;
  void set_places(const joints::PairBodies& bodies, const PatchTouch& touch,
                  const Vector3& place_W,
                  joints::PairPoint& out) const override;
  [[nodiscard]] Nearest find_nearest(
      const joints::PairBodies& bodies) const override;
  [[nodiscard]] Nearest find_pair(const joints::PairBodies& bodies,
                                  std::size_t /*index*/) const override {
    return find_nearest(bodies);
  }
  [[nodiscard]] double find_distance(
      const joints::PairBodies& bodies) const override;

 private:
  [[nodiscard]] const joints::PairBody& find_body(
      const joints::PairBodies& bodies) const {
    return is_surface_A_ ? bodies.A : bodies.B;
  }
  [[nodiscard]] Vector3 find_centre_W(const joints::PairBodies& bodies) const;
  [[nodiscard]] std::optional<MeshSurface::Hit> find_hit(
      const joints::PairBodies& bodies, double reach) const;
  [[nodiscard]] joints::PairBody find_motion(const joints::PairBody& body,
                                             const SurfacePlace& place) const;
  void set_frames(const joints::PairBodies& bodies, const SurfacePlace& place,
                  joints::PairBody& A, joints::PairBody& B) const;
  [[nodiscard]] Patch press(const joints::PairBody& body,
                            const MeshSurface::Hit& hit) const;

  bool is_surface_A_;
  std::shared_ptr<const MeshSurface> mesh_surface_;
  double ball_radius_;            // [m]
  Vector3 centre_B_;              // of the ball, in its body's frame [m]
  double modulus_;                // E* [Pa]
  std::optional<double> radius_;  // R_e [m]
  double most_radius_;            // of R_e on a hollow [m]
};

}  // namespace limber::contact
