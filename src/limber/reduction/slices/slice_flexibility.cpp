// SPDX-License-Identifier: BSD-3-Clause
#include "limber/reduction/slices/slice_flexibility.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "limber/common/index.hpp"
#include "limber/common/rotation.hpp"

namespace limber::flexbody {
namespace {

using Samples = std::vector<const SurfaceSample*>;

constexpr int kStations = 8;

std::array<Samples, kStations> divide_along_longest(const SurfaceSlice& slice,
                                                    const Matrix3& axes) {
  Vector3 low = Vector3::Constant(std::numeric_limits<double>::max());
  Vector3 high = -low;
  for (const SurfaceSample* s : slice.samples) {
    low = low.cwiseMin(axes.transpose() * s->x);
    high = high.cwiseMax(axes.transpose() * s->x);
  }
  Eigen::Index longest = 0;
  const double step = (high - low).maxCoeff(&longest) / kStations;
  std::array<Samples, kStations> stations;
  for (const SurfaceSample* s : slice.samples) {
    const double at = (axes.col(longest).dot(s->x) - low[longest]) / step;
    const int station = std::clamp(static_cast<int>(at), 0, kStations - 1);
    stations[index(station)].push_back(s);
  }
  return stations;
}

// What is pressed along each axis [m^2].
Vector3 find_faces(const Samples& samples, const Matrix3& axes) {
  Vector3 faces = Vector3::Constant(std::numeric_limits<double>::min());
  for (const SurfaceSample* s : samples) {
    faces += s->area * (axes.transpose() * s->normal).cwiseAbs2();
  }
  return faces;
}

}  // namespace

Matrix3 find_excess(const SurfaceSlice& slice, const Matrix3& residual,
                    const Matrix3& axes, const fem::ElasticMaterial& material) {
  const double nu = material.poisson_ratio;
  Vector3 excess = Vector3::Zero();
  for (int k = 0; k < 3; ++k) {
    const Vector3 axis = axes.col(k);
    double ahead = 0.0;
    double behind = 0.0;
    for (const SurfaceSample* s : slice.samples) {
      ahead += s->area * std::max(s->normal.dot(axis), 0.0);
      behind += s->area * std::max(-s->normal.dot(axis), 0.0);
    }
    const double a = std::sqrt(std::max(ahead, behind) / std::numbers::pi);
    const double own = (1.0 - nu * nu) / (2.0 * material.youngs_modulus * a);
    excess[k] = std::max(2.0 * axis.dot(residual * axis) - own, 0.0);
  }
  return axes * excess.asDiagonal() * axes.transpose();
}

Matrix3 find_own_flexibility(const SurfaceSlice& slice,
                             const SliceMotion& whole, const MatrixX& motion,
                             const Matrix3& axes, const VectorX& lambda,
                             const MatrixX& Phi) {
  const Vector3 faces = find_faces(slice.samples, axes);
  Matrix3 flexibility = Matrix3::Zero();
  for (const Samples& samples : divide_along_longest(slice, axes)) {
    if (samples.empty()) continue;
    const SliceMotion station(samples);
    const Vector3 r = station.centre() - whole.centre();
    const MatrixX own = (station.find_motion(Phi).topRows<3>() -
                         motion.topRows<3>() + skew(r) * motion.bottomRows<3>())
                            .leftCols(lambda.size());
    const Vector3 fraction = find_faces(samples, axes).cwiseQuotient(faces);
    const MatrixX pressed =
        fraction.cwiseSqrt().asDiagonal() * axes.transpose() * own;
    flexibility +=
        pressed * lambda.cwiseInverse().asDiagonal() * pressed.transpose();
  }
  return axes * flexibility * axes.transpose();
}

}  // namespace limber::flexbody
