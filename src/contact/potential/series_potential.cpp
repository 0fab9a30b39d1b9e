// SPDX-License-Identifier: BSD-3-Clause
#include "limber/contact/potential/series_potential.hpp"

#include <Eigen/LU>
#include <limits>

#include "limber/common/errors.hpp"

namespace limber::contact {
namespace {

using Vector2 = Eigen::Vector2d;
using Matrix2 = Eigen::Matrix2d;
using Normals = Eigen::Matrix<double, 3, 2>;

}  // namespace

SeriesPotential::SeriesPotential(const PlacedBody& A, const PlacedBody& B,
                                 double modulus, double R_A, double R_B)
    : potential_(A, B, modulus),
      normal_A_(A.X_BS.R.col(2)),
      normal_B_(B.X_BS.R.col(2)),
      R_(R_A, R_B) {
  LIMBER_EXPECT(R_A >= 0.0 && R_B >= 0.0);
}

// Newton's method from d = 0, monotone where W's slope is convex along d, with
// steps that do not raise the energy.
Patch SeriesPotential::evaluate(const joints::PairBodies& bodies,
                                bool has_derivatives) const {
  if (R_.isZero(0.0)) return potential_.evaluate(bodies, has_derivatives);
  constexpr int kMost = 100;
  constexpr double kTolerance = 1e-12;
  constexpr double kRise = 1e-3;
  Normals N;
  N << bodies.A.R_WB * normal_A_, -(bodies.B.R_WB * normal_B_);
  // What the places' own digits can tell apart [m].
  const double floor = 4.0 * std::numeric_limits<double>::epsilon() *
                       (bodies.B.p_WB - bodies.A.p_WB).norm();
  Vector2 d = Vector2::Zero();
  Vector2 last = Vector2::Zero();
  Vector2 last_load = Vector2::Zero();
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < kMost; ++i) {
    Patch patch = potential_.evaluate(bodies, true, N * d);
    if (!patch.touches && d.isZero(0.0)) return patch;
    const double energy = patch.energy + find_layer_energy(d);
    if (!patch.touches || energy > (1.0 + kRise) * least) {
      d = 0.5 * (d + last);
      continue;
    }
    least = energy;
    const Vector2 load = -N.transpose() * patch.gradient_W.head<3>();
    const Eigen::Matrix<double, 6, 2> KN = patch.hessian_W.leftCols<3>() * N;
    Matrix2 stiffness = N.transpose() * KN.topRows<3>();
    // Not exact where a part ends: along the last step its difference.
    const Vector2 way = d - last;
    if (!way.isZero(0.0)) {
      stiffness += (last_load - load - stiffness * way) * way.transpose() /
                   way.squaredNorm();
    }
    const Matrix2 inverse =
        (Matrix2::Identity() + R_.asDiagonal() * stiffness).inverse();
    const Vector2 change = inverse * (R_.cwiseProduct(load) - d);
    last = d;
    last_load = load;
    d += change;
    if (change.norm() > kTolerance * d.norm() + floor) continue;
    // Where A's own layer lets it give way, as B's does.
    patch.centre_W -= (d[0] - change[0]) * N.col(0);
    patch.energy += 0.5 * load.dot(R_.cwiseProduct(load));
    patch.hessian_W -= KN * inverse * R_.asDiagonal() * KN.transpose();
    return patch;
  }
  throw NumericalError(
      "contact: the local deformation of a flat surface does not converge");
}

double SeriesPotential::find_layer_energy(const Vector2& d) const {
  double energy = 0.0;
  for (int k = 0; k < 2; ++k) {
    if (R_[k] > 0.0) energy += 0.5 * d[k] * d[k] / R_[k];
  }
  return energy;
}

}  // namespace limber::contact
