// SPDX-License-Identifier: BSD-3-Clause
#include "limber/contact/potential/pair_potential.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <variant>

#include "limber/common/errors.hpp"
#include "limber/common/rotation.hpp"
#include "limber/contact/potential/solid_overlap.hpp"

namespace limber::contact {
namespace {

/// The fraction of W that one body's depth gives, about o.
struct Half {
  double energy = 0.0;
  double load = 0.0;
  Vector3 moved = Vector3::Zero();   // load times the centre of pressure
  Matrix3 spread = Matrix3::Zero();  // load times r r'
  Vector6 gradient = Vector6::Zero();
  Matrix6 hessian = Matrix6::Zero();
};

// W = c f sqrt(M), f the moments' factor
Half weigh(const DepthMoments& m, double modulus_factor) {
  const double c = modulus_factor * m.factor.value;
  const double root = std::sqrt(m.M);
  const double lambda = 0.5 * c / root;
  const Vector6& rate = m.factor.rate;
  Half half;
  half.energy = c * root;
  half.load = lambda * m.pressure;
  half.moved = lambda * m.first;
  half.spread = lambda * m.second;
  half.gradient = lambda * m.m1 + half.energy * rate;
  half.hessian = lambda * m.m2 -
                 (0.25 * c / (m.M * root)) * m.m1 * m.m1.transpose() +
                 lambda * (m.m1 * rate.transpose() + rate * m.m1.transpose()) +
                 half.energy * m.factor.second;
  return half;
}

// The motion about o of one about o + d.
Matrix6 shift(const Vector3& d) {
  Matrix6 T = Matrix6::Identity();
  T.topRightCorner<3, 3>() = skew(d);  // u_o = u - theta x d
  return T;
}

// About each axis, 0 where both radii across it are equal.
Vector3 find_fraction(const Ellipsoid& body) {
  Vector3 fraction;
  for (int i = 0; i < 3; ++i) {
    const double a = body.radii[(i + 1) % 3];
    const double b = body.radii[(i + 2) % 3];
    fraction[i] = std::abs(a - b) / std::max(a, b);
  }
  return fraction;
}

// In the body's frame.
Matrix3 find_moving_turns(const PlacedBody& body) {
  if (std::holds_alternative<Sphere>(body.kind)) return Matrix3::Zero();
  if (const auto* egg = std::get_if<Ellipsoid>(&body.kind)) {
    const Matrix3& R = body.X_BS.R;
    return R * find_fraction(*egg).asDiagonal() * R.transpose();
  }
  const bool is_round = std::holds_alternative<Capsule>(body.kind) ||
                        std::holds_alternative<Cylinder>(body.kind) ||
                        std::holds_alternative<Cone>(body.kind);
  if (!is_round) return Matrix3::Identity();
  const Vector3 axis = body.X_BS.R.col(2);
  return Matrix3::Identity() - axis * axis.transpose();
}

bool are_capsules(const BodyKind& A, const BodyKind& B) {
  return std::holds_alternative<Capsule>(A) &&
         std::holds_alternative<Capsule>(B);
}

bool is_bounded(const BodyKind& body) {
  const auto* solid = std::get_if<ConvexSolid>(&body);
  return solid == nullptr || solid->is_bounded();
}

Vector3 find_middle(const Polytope& polytope) {
  Vector3 sum = Vector3::Zero();
  for (const Vector3& x : polytope.corners()) sum += x;
  return sum / static_cast<double>(polytope.corners().size());
}

}  // namespace

bool PairPotential::suits(const BodyKind& A, const BodyKind& B) {
  if (are_capsules(A, B) || HertzPair::suits(A, B) ||
      BallOnCapsule::suits(A, B) || SmoothPair::suits(A, B)) {
    return true;
  }
  const auto* of_A = std::get_if<ConvexSolid>(&A);
  const auto* of_B = std::get_if<ConvexSolid>(&B);
  if (of_A == nullptr || of_B == nullptr) return RoundPair::suits(A, B);
  return of_A->is_bounded() || of_B->is_bounded();
}

PairPotential::PairPotential(const PlacedBody& A, const PlacedBody& B,
                             double modulus)
    : is_B_bounded_(is_bounded(B.kind)),
      X_AS_(A.X_BS),
      X_BS_(B.X_BS),
      modulus_(modulus) {
  LIMBER_EXPECT(suits(A.kind, B.kind));
  LIMBER_EXPECT(modulus > 0.0);
  turns_A_ = find_moving_turns(A);
  turns_B_ = find_moving_turns(B);
  if (HertzPair::suits(A.kind, B.kind)) {
    point_.emplace(A.kind, B.kind, modulus);
    return;
  }
  if (BallOnCapsule::suits(A.kind, B.kind)) {
    on_capsule_.emplace(A.kind, B.kind, modulus);
    return;
  }
  if (SmoothPair::suits(A.kind, B.kind)) {
    smooth_.emplace(A.kind, B.kind, modulus);
    return;
  }
  if (are_capsules(A.kind, B.kind)) {
    capsules_.emplace(std::get<Capsule>(A.kind), std::get<Capsule>(B.kind));
    return;
  }
  if (RoundPair::suits(A.kind, B.kind)) {
    round_.emplace(A.kind, B.kind);
    return;
  }
  A_ = std::get<ConvexSolid>(A.kind);
  B_ = std::get<ConvexSolid>(B.kind);
}

PairPotential::PairPotential(const Shape& A, const Shape& B, double modulus)
    : PairPotential(PlacedBody{make_body(A.kind), A.X_BS},
                    PlacedBody{make_body(B.kind), B.X_BS}, modulus) {}

std::optional<PairMoments> PairPotential::find_flat_moments(
    Pose X_A, Pose X_B, bool has_derivatives) const {
  Polytope overlap;
  find_overlap(*A_, X_A, *B_, X_B, overlap);
  if (overlap.is_empty()) return {};
  PairMoments out;
  out.o = find_middle(overlap);
  overlap.move(-out.o);
  X_A.p -= out.o;
  X_B.p -= out.o;
  out.of_A = find_depth_moments(*A_, X_A, overlap, 0, has_derivatives);
  out.of_B = find_depth_moments(*B_, X_B, overlap, 1, has_derivatives);
  return out;
}

std::optional<PairMoments> PairPotential::find_moments(
    const Pose& X_A, const Pose& X_B, bool has_derivatives) const {
  return round_ ? round_->find_moments(X_A, X_B, has_derivatives)
                : find_flat_moments(X_A, X_B, has_derivatives);
}

Patch PairPotential::press_capsules(const Pose& X_A, const Pose& X_B,
                                    bool has_derivatives) const {
  const auto touch = capsules_->find_touch(X_A, X_B, has_derivatives);
  if (!touch) return {};
  return {.touches = true,
          .energy = modulus_ * touch->energy,
          .centre_W = touch->centre,
          .gradient_W = modulus_ * touch->gradient,
          .hessian_W = modulus_ * touch->hessian,
          .spread_W = touch->spread,
          .depth = touch->depth};
}

Patch PairPotential::press(const Pose& X_A, const Pose& X_B,
                           bool has_derivatives) const {
  if (point_) return point_->evaluate(X_A, X_B);
  if (on_capsule_) return on_capsule_->evaluate(X_A, X_B);
  if (smooth_) return smooth_->evaluate(X_A, X_B);
  if (capsules_) return press_capsules(X_A, X_B, has_derivatives);
  Patch out;
  const auto moments = find_moments(X_A, X_B, has_derivatives);
  if (!moments || !(moments->of_A.M > 0.0) || !(moments->of_B.M > 0.0)) {
    return out;
  }
  out.touches = true;
  out.depth = std::max(moments->of_A.depth, moments->of_B.depth);
  const double c = modulus_ / std::sqrt(std::numbers::pi);
  const Half A = weigh(moments->of_A, c);
  const Half B = weigh(moments->of_B, c);
  const double load = A.load + B.load;
  const Vector3 centre = (A.moved + B.moved) / load;
  out.centre_W = moments->o + centre;
  out.spread_W = (A.spread + B.spread) / load - centre * centre.transpose();
  out.energy = 0.5 * (A.energy + B.energy);
  const Matrix6 T = shift(centre);
  out.gradient_W = 0.5 * T.transpose() * (A.gradient + B.gradient);
  out.hessian_W = 0.5 * T.transpose() * (A.hessian + B.hessian) * T;
  return out;
}

Patch PairPotential::evaluate(const joints::PairBodies& bodies,
                              bool has_derivatives,
                              const Vector3& shift_W) const {
  const Pose X_WA{bodies.A.R_WB, bodies.A.p_WB};
  const Pose X_WB{bodies.B.R_WB, bodies.B.p_WB};
  // Relative to a body's place, then to the overlap, so that the distance from
  // the world's origin takes no digits.
  const Vector3 near = is_B_bounded_ ? X_WB.p : X_WA.p;
  const auto place = [](const Pose& X_WB_, const Pose& X_BS,
                        const Vector3& from) {
    return Pose{X_WB_.R * X_BS.R, (X_WB_.p - from) + X_WB_.R * X_BS.p};
  };
  Pose X_B = place(X_WB, X_BS_, near);
  X_B.p += shift_W;
  Patch out = press(place(X_WA, X_AS_, near), X_B, has_derivatives);
  out.centre_W += near;
  out.turns_A_W = X_WA.R * turns_A_ * X_WA.R.transpose();
  out.turns_B_W = X_WB.R * turns_B_ * X_WB.R.transpose();
  return out;
}

}  // namespace limber::contact
