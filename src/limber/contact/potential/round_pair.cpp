// SPDX-License-Identifier: BSD-3-Clause
#include "limber/contact/potential/round_pair.hpp"

#include <cmath>
#include <numbers>
#include <variant>

#include "limber/common/errors.hpp"
#include "limber/common/rotation.hpp"

namespace limber::contact {
namespace {

// Without edges or flats: of no straight lines.
template <typename Kind>
bool is_smooth(const Kind& body) {
  return std::holds_alternative<Sphere>(body) ||
         std::holds_alternative<Capsule>(body) ||
         std::holds_alternative<Ellipsoid>(body);
}

bool is_polyhedral(const BodyKind& body) {
  return std::holds_alternative<ConvexSolid>(body);
}

bool is_small(const BodyKind& body) {
  const auto* solid = std::get_if<ConvexSolid>(&body);
  return solid == nullptr || solid->faces().size() <= SolidField::kMostFaces;
}

// Of which other laws are exact.
bool is_point_on_plane(const BodyKind& A, const BodyKind& B) {
  const auto* solid = std::get_if<ConvexSolid>(&B);
  return is_smooth(A) && !std::holds_alternative<Capsule>(A) &&
         solid != nullptr && !solid->is_bounded();
}

bool is_cone(const DepthField& field) {
  return std::holds_alternative<Cone>(field.kind());
}

// Whether the depth below one of them counts, beside the other.
bool counts(const RuledBody& soft, const RuledBody& other) {
  const bool is_cone_on_flats =
      is_cone(soft.field()) && other.field().is_flat() && other.is_soft();
  return soft.is_soft() && !is_smooth(other.field().kind()) &&
         !is_cone_on_flats;
}

// c of a cone, whose fraction of X is 2 (1 - f . a), f the way of the force on
// it, a its axis; the second derivative is left out.
class ConeFactor {
 public:
  // @param moments of B's motion against A
  explicit ConeFactor(const DepthMoments& moments) {
    const Vector3 m = moments.m1.head<3>();
    way_ = m.normalized();
    change_ = moments.m2.topRows<3>();
    change_.rightCols<3>() -= 0.5 * skew(m);
    change_ = (change_ - way_ * (way_.transpose() * change_)) / m.norm();
  }
  void add(const Pose& X, bool is_A) {
    const Vector3 axis = (is_A ? 1.0 : -1.0) * X.R.col(2);
    X_ += 2.0 * (1.0 - way_.dot(axis));
    rate_ -= 2.0 * change_.transpose() * axis;
    if (!is_A) rate_.tail<3>() -= 2.0 * axis.cross(way_);
  }
  [[nodiscard]] Factor find() const {
    constexpr double kNearlyFlat = 0.01;
    // That of a tip on a flat, M = pi d^6 / (15 tan^2 b), N = 2 E* d^2 / (pi
    // tan b), b its side's slope [@johnson1985, sec. 5.2]
    const double tip = 2.0 * std::sqrt(15.0) / (3.0 * std::numbers::pi);
    const double below = X_ + kNearlyFlat;
    Factor factor;
    factor.value = 1.0 - (1.0 - tip) * X_ / below;
    factor.rate =
        -(1.0 - tip) * kNearlyFlat / (below * below * factor.value) * rate_;
    return factor;
  }

 private:
  Vector3 way_;
  Eigen::Matrix<double, 3, 6> change_;  // of it by the motion
  double X_ = 0.0;
  Vector6 rate_ = Vector6::Zero();
};

}  // namespace

bool RoundPair::suits(const BodyKind& A, const BodyKind& B) {
  return !(is_smooth(A) && is_smooth(B)) &&
         !(is_polyhedral(A) && is_polyhedral(B)) && !is_point_on_plane(A, B) &&
         !is_point_on_plane(B, A) && is_small(A) && is_small(B);
}

RoundPair::RoundPair(const BodyKind& A, const BodyKind& B) : A_(A), B_(B) {
  LIMBER_EXPECT(suits(A, B));
}

Factor RoundPair::find_factor(const Pose& X_A, const Pose& X_B,
                              const DepthMoments& moments) const {
  // (8 / 15) sqrt(5 / 2): of a ball on a flat, M = 2 pi R d^5 / 5
  const double round = 8.0 / 15.0 * std::sqrt(2.5);
  if (is_smooth(A_.field().kind()) || is_smooth(B_.field().kind())) {
    return {.value = round};
  }
  if (is_cone(A_.field()) || is_cone(B_.field())) {
    ConeFactor cones(moments);
    if (is_cone(A_.field())) cones.add(X_A, true);
    if (is_cone(B_.field())) cones.add(X_B, false);
    return cones.find();
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

// @param soft_A, soft_B what touches below each that counts, else null
PairMoments RoundPair::integrate(const Pose& X_A, const Pose& X_B,
                                 const SurfaceContact* soft_A,
                                 const SurfaceContact* soft_B,
                                 bool has_derivatives) const {
  PairMoments out;
  out.o = soft_A != nullptr ? X_A * soft_A->deepest_place()
                            : X_B * soft_B->deepest_place();
  const auto find = [&](const SurfaceContact& contact, const Pose& X_soft,
                        double sign) {
    DepthMoments moments = rotate(
        contact.integrate(X_soft.inverse() * out.o, sign, has_derivatives),
        X_soft.R);
    if (moments.M > 0.0) {
      moments.factor = moments.factor * find_factor(X_A, X_B, moments);
    }
    return moments;
  };
  if (soft_A != nullptr) out.of_A = find(*soft_A, X_A, 1.0);
  if (soft_B != nullptr) out.of_B = find(*soft_B, X_B, -1.0);
  if (soft_A == nullptr) out.of_A = out.of_B;
  if (soft_B == nullptr) out.of_B = out.of_A;
  return out;
}

// Not by optional contacts: to make one clears all of its memory.
std::optional<PairMoments> RoundPair::find_moments(const Pose& X_A,
                                                   const Pose& X_B,
                                                   bool has_derivatives) const {
  const auto find =
      [&](const SurfaceContact* soft_A) -> std::optional<PairMoments> {
    if (!counts(B_, A_)) {
      return integrate(X_A, X_B, soft_A, nullptr, has_derivatives);
    }
    const SurfaceContact soft_B(B_, A_, X_B.inverse() * X_A);
    if (!soft_B.touches()) return {};
    return integrate(X_A, X_B, soft_A, &soft_B, has_derivatives);
  };
  if (!counts(A_, B_)) return find(nullptr);
  const SurfaceContact soft_A(A_, B_, X_A.inverse() * X_B);
  if (!soft_A.touches()) return {};
  return find(&soft_A);
}

}  // namespace limber::contact
