// SPDX-License-Identifier: BSD-3-Clause
#include "limber/contact/potential/round_pair.hpp"

#include <variant>

#include "limber/common/errors.hpp"
#include "limber/contact/potential/convex_solid.hpp"

namespace limber::contact {
namespace {

// Without edges or flats.
bool is_smooth(const ShapeKind& shape) {
  return std::holds_alternative<Sphere>(shape) ||
         std::holds_alternative<Capsule>(shape);
}

// Of straight lines.
bool is_ruled(const ShapeKind& shape) {
  return is_solid(shape) || std::holds_alternative<Cylinder>(shape);
}

bool is_ball_on_plane(const ShapeKind& A, const ShapeKind& B) {
  return std::holds_alternative<Sphere>(A) &&
         std::holds_alternative<HalfSpace>(B);
}

}  // namespace

bool RoundPair::suits(const ShapeKind& A, const ShapeKind& B) {
  const auto is_known = [](const ShapeKind& shape) {
    return is_smooth(shape) || is_ruled(shape);
  };
  return is_known(A) && is_known(B) && (is_ruled(A) || is_ruled(B)) &&
         !(is_solid(A) && is_solid(B)) && !is_ball_on_plane(A, B) &&
         !is_ball_on_plane(B, A);
}

RoundPair::RoundPair(const ShapeKind& A, const ShapeKind& B) : A_(A), B_(B) {
  LIMBER_EXPECT(suits(A, B));
}

std::optional<PairMoments> RoundPair::find_moments(const Pose& X_A,
                                                   const Pose& X_B,
                                                   bool has_derivatives) const {
  PairMoments out;
  std::optional<SurfaceContact> soft_A;
  std::optional<SurfaceContact> soft_B;
  if (is_ruled(B_.shape())) {
    soft_A.emplace(A_, B_, X_A.inverse() * X_B);
    if (!soft_A->touches()) return {};
    out.o = X_A * soft_A->deepest_place();
  }
  if (is_ruled(A_.shape())) {
    soft_B.emplace(B_, A_, X_B.inverse() * X_A);
    if (!soft_B->touches()) return {};
    if (!soft_A) out.o = X_B * soft_B->deepest_place();
  }
  const auto integrate = [&](const SurfaceContact& contact, const Pose& X_soft,
                             double sign) {
    return rotate(
        contact.integrate(X_soft.inverse() * out.o, sign, has_derivatives),
        X_soft.R);
  };
  if (soft_A) out.of_A = integrate(*soft_A, X_A, 1.0);
  if (soft_B) out.of_B = integrate(*soft_B, X_B, -1.0);
  if (!soft_A) out.of_A = out.of_B;
  if (!soft_B) out.of_B = out.of_A;
  return out;
}

}  // namespace limber::contact
