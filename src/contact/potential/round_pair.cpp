// SPDX-License-Identifier: BSD-3-Clause
#include "limber/contact/potential/round_pair.hpp"

#include <cmath>
#include <variant>

#include "limber/common/errors.hpp"

namespace limber::contact {
namespace {

// Without edges or flats: of no straight lines.
template <typename Kind>
bool is_smooth(const Kind& body) {
  return std::holds_alternative<Sphere>(body) ||
         std::holds_alternative<Capsule>(body);
}

bool is_polyhedral(const BodyKind& body) {
  return std::holds_alternative<ConvexSolid>(body);
}

bool is_small(const BodyKind& body) {
  const auto* solid = std::get_if<ConvexSolid>(&body);
  return solid == nullptr || solid->faces().size() <= SolidField::kMostFaces;
}

bool is_ball_on_plane(const BodyKind& A, const BodyKind& B) {
  const auto* solid = std::get_if<ConvexSolid>(&B);
  return std::holds_alternative<Sphere>(A) && solid != nullptr &&
         !solid->is_bounded();
}

}  // namespace

bool RoundPair::suits(const BodyKind& A, const BodyKind& B) {
  return !(is_smooth(A) && is_smooth(B)) &&
         !(is_polyhedral(A) && is_polyhedral(B)) && !is_ball_on_plane(A, B) &&
         !is_ball_on_plane(B, A) && is_small(A) && is_small(B);
}

RoundPair::RoundPair(const BodyKind& A, const BodyKind& B) : A_(A), B_(B) {
  LIMBER_EXPECT(suits(A, B));
}

Factor RoundPair::find_factor(const Pose& X_A, const Pose& X_B) const {
  // (8 / 15) sqrt(5 / 2): of a ball on a flat, M = 2 pi R d^5 / 5
  const double round = 8.0 / 15.0 * std::sqrt(2.5);
  if (is_smooth(A_.field().kind()) || is_smooth(B_.field().kind())) {
    return {.value = round};
  }
  if (A_.field().is_flat() || B_.field().is_flat()) return {};
  constexpr double kAligned = 0.01;
  const Vector3 a = X_A.R.col(2);
  const Vector3 b = X_B.R.col(2);
  const double x = a.cross(b).squaredNorm();
  const double slope =
      -(1.0 - round) * kAligned / ((x + kAligned) * (x + kAligned));
  Factor factor;
  factor.value = 1.0 - (1.0 - round) * x / (x + kAligned);
  factor.rate.tail<3>() = (-2.0 * a.dot(b) * slope / factor.value) * b.cross(a);
  return factor;
}

std::optional<PairMoments> RoundPair::find_moments(const Pose& X_A,
                                                   const Pose& X_B,
                                                   bool has_derivatives) const {
  PairMoments out;
  std::optional<SurfaceContact> soft_A;
  std::optional<SurfaceContact> soft_B;
  if (A_.is_soft() && !is_smooth(B_.field().kind())) {
    soft_A.emplace(A_, B_, X_A.inverse() * X_B);
    if (!soft_A->touches()) return {};
    out.o = X_A * soft_A->deepest_place();
  }
  if (B_.is_soft() && !is_smooth(A_.field().kind())) {
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
  const Factor c = find_factor(X_A, X_B);
  out.of_A.factor = out.of_A.factor * c;
  out.of_B.factor = out.of_B.factor * c;
  if (!soft_A) out.of_A = out.of_B;
  if (!soft_B) out.of_B = out.of_A;
  return out;
}

}  // namespace limber::contact
