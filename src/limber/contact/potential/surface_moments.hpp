// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/contact/potential/depth_moments.hpp"
#include "limber/contact/potential/ruled_body.hpp"
#include "limber/contact/potential/touched_part.hpp"

namespace limber::contact {

/// Where the surface of a rigid body, `hard`, lies within another, `soft`, and
/// the moments of the depth below the surface of `soft`, in its frame.
///
/// Equation   M = int 4 t^3 dV = int over the surface of `hard` within `soft`
///            of phi grad t . n dS + the same out of both cells over the sheets
///            where two faces of `soft` are equally near, within `hard`; m1 =
///            int 4 t^3 (n, r x n) dS, m2 along the motion exp(u, theta)
///            the symmetric part of int 12 t^2 (n, r x n) g' dS, exact also
///            where the nearest face changes; the pressure 4 t^3 n dS along the
///            resultant
/// Limits     one place of contact; quadrature of 12 lines in a part of which
///            the lines' ends and faces are the same: about 1e-7 of M; of a
///            cylinder the sheet where both ends are equally near is left out;
///            the factor's derivatives leave out the rotation of the resultant
///            and of g, the second one is rough next to edges
class SurfaceContact {
 public:
  /// @param X the pose of `hard` in the frame of `soft`
  /// @param soft of a solid all faces press
  /// @param hard a solid or cylinder; one of both bounded
  SurfaceContact(const RuledBody& soft, const RuledBody& hard, const Pose& X);

  [[nodiscard]] bool touches() const { return !parts_.all().empty(); }
  [[nodiscard]] const Vector3& deepest_place() const { return deepest_.place; }

  /// About o, in the axes of `soft`; the factor is find_shape_factor of the
  /// pressure's second moments seen along the resultant.
  /// @param sign 1 if B is `hard`, else -1
  /// @param has_derivatives whether the factor's second derivative is filled
  [[nodiscard]] DepthMoments integrate(const Vector3& o, double sign,
                                       bool has_derivatives) const;

 private:
  struct Part {
    RuledSurface surface;
    Span u;
  };

  template <typename Sums>
  void integrate_parts(const Vector3& o, Sums& sums) const;

  const RuledBody& soft_;
  const RuledBody& hard_;
  Pose X_hs_;  // of soft in the frame of hard
  StackArray<Part, SolidField::kMostFaces> parts_;
  TouchedPart deepest_;
  bool by_tip_ = false;  // see ConeField
};

/// Of vectors in other axes, R of those from these.
[[nodiscard]] DepthMoments rotate(const DepthMoments& moments,
                                  const Matrix3& R);

}  // namespace limber::contact
