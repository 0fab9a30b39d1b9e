// SPDX-License-Identifier: BSD-3-Clause
#include "limber/contact/patches/series_potential.hpp"

#include <Eigen/LU>
#include <cmath>
#include <limits>
#include <optional>

#include "limber/common/errors.hpp"

namespace limber::contact {
namespace {

Matrix3 rotate(const Matrix3& R_WB, const Matrix3& in_B) {
  return R_WB * in_B * R_WB.transpose();
}

// The force where W continues along the normal as d^(p + 1), p of its present
// energy, load and stiffness, and deflects by the layers; or nothing.
std::optional<Vector3> find_first_force(const Patch& patch, const Matrix3& R) {
  constexpr int kHalvings = 40;
  const Vector3 g = patch.gradient_W.head<3>();
  const double N = g.norm();
  const Vector3 n = g / N;
  const double stiffness = n.dot(patch.hessian_W.topLeftCorner<3, 3>() * n);
  // 1 / (p + 1)
  const double fraction = 1.0 - patch.energy * stiffness / (N * N);
  const double p = 1.0 / fraction - 1.0;
  if (!(p > 0.5 && p < 4.0)) return std::nullopt;
  const double give = n.dot(R * n) * N * fraction * N / patch.energy;
  double low = 0.0;
  double high = 1.0;
  for (int i = 0; i < kHalvings; ++i) {
    const double x = 0.5 * (low + high);
    (x + give * std::pow(x, p) < 1.0 ? low : high) = x;
  }
  return Vector3(-std::pow(0.5 * (low + high), p) * g);
}

}  // namespace

SeriesPotential::SeriesPotential(const PlacedBody& A, const PlacedBody& B,
                                 double modulus, const Matrix3& R_A,
                                 const Matrix3& R_B)
    : potential_(A, B, modulus),
      R_A_(R_A),
      R_B_(R_B),
      has_layers_(!R_A_.isZero(0.0) || !R_B_.isZero(0.0)) {
  LIMBER_EXPECT(R_A_.trace() >= 0.0 && R_B_.trace() >= 0.0);
}

// Newton's method from f = 0 and a force by W's power of the depth, with steps
// that do not raise the energy.
Patch SeriesPotential::evaluate(const joints::PairBodies& bodies,
                                bool has_derivatives) const {
  if (!has_layers_) return potential_.evaluate(bodies, has_derivatives);
  constexpr int kMost = 100;
  constexpr double kTolerance = 1e-6;  // of f, before its last change
  constexpr double kRise = 1e-3;
  const Matrix3 of_A = rotate(bodies.A.R_WB, R_A_);
  const Matrix3 R = of_A + rotate(bodies.B.R_WB, R_B_);
  // The resolution of the positions' own digits [m].
  const double floor = 4.0 * std::numeric_limits<double>::epsilon() *
                       (bodies.B.p_WB - bodies.A.p_WB).norm();
  Vector3 f = Vector3::Zero();
  Vector3 last = Vector3::Zero();
  Vector3 last_gradient = Vector3::Zero();
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < kMost; ++i) {
    const Vector3 d = R * f;
    Patch patch = potential_.evaluate(bodies, true, d);
    if (!patch.touches && f.isZero(0.0)) return patch;
    const double energy = patch.energy + 0.5 * f.dot(d);
    if (!patch.touches || energy > (1.0 + kRise) * least) {
      f = 0.5 * (f + last);
      continue;
    }
    least = energy;
    const Vector3 gradient = patch.gradient_W.head<3>();
    Matrix3 stiffness = patch.hessian_W.topLeftCorner<3, 3>();
    // Not exact where a part ends: along the last step its difference.
    const Vector3 way = R * (f - last);
    if (i > 1 && !way.isZero(0.0)) {
      stiffness += (gradient - last_gradient - stiffness * way) *
                   way.transpose() / way.squaredNorm();
    }
    const Matrix3 inverse = (Matrix3::Identity() + R * stiffness).inverse();
    const Vector3 change = -(inverse * (R * gradient + d));  // of d
    last = f;
    last_gradient = gradient;
    f = -(gradient + stiffness * change);
    const bool is_close = (f - last).norm() <= kTolerance * f.norm();
    if (!is_close && change.norm() > floor) {
      if (i == 0) f = find_first_force(patch, R).value_or(f);
      continue;
    }
    // At the end of the change, to its second order.
    patch.energy = energy + 0.5 * (gradient + last).dot(change);
    patch.series_energy = 0.5 * f.dot(R * f);
    // Where A's own layer deflects, as B's does.
    patch.centre_W -= of_A * f;
    const Eigen::Matrix<double, 6, 3> coupling = patch.hessian_W.leftCols<3>();
    patch.gradient_W += coupling * change;
    patch.hessian_W -= coupling * inverse * R * coupling.transpose();
    return patch;
  }
  throw NumericalError(
      "contact: the local deformation of a flexible surface does not converge");
}

}  // namespace limber::contact
