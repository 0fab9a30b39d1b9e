// SPDX-License-Identifier: BSD-3-Clause
#include "limber/view/extremes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "limber/common/rotation.hpp"
#include "limber/results/solids.hpp"

namespace limber::view {
namespace {

constexpr Eigen::Index kOutputs = 16;  // at a time, to bound the memory

Matrix3X gather_points(const Recording& recording, int b) {
  const Body& body = recording.bodies[std::size_t(b)];
  if (body.surface >= 0) {
    return recording.surfaces[std::size_t(body.surface)].x_B;
  }
  Matrix3X x(3, 0);
  const auto append = [&x](const results::Solid& solid) {
    x.conservativeResize(3, x.cols() + solid.x.cols());
    x.rightCols(solid.x.cols()) = solid.x;
  };
  bool has_shape = false;
  for (const Shape& shape : recording.shapes) {
    if (shape.body != b) continue;
    has_shape = true;
    append(place_solid(make_solid(shape.form, 0.0), shape.X_BS));
  }
  if (!has_shape) append(results::make_ellipsoid(body.mass, body.inertia));
  return x.allFinite() ? x : Matrix3X::Zero(3, 1);
}

MatrixX find_rates(const Body& body, const VectorX& times) {
  if (body.etadot.cols() == body.eta.cols()) return body.etadot;
  MatrixX rates = MatrixX::Zero(body.eta.rows(), body.eta.cols());
  const Eigen::Index last = times.size() - 1;
  for (Eigen::Index i = 0; last > 0 && i <= last; ++i) {
    const Eigen::Index from = std::min(i, last - 1);
    const double h = times[from + 1] - times[from];
    if (!(h > 0.0)) continue;
    rates.row(i) = (body.eta.row(from + 1) - body.eta.row(from)) / h;
  }
  return rates;
}

double find_longest(const Matrix3X& vectors) {
  return std::sqrt(vectors.colwise().squaredNorm().maxCoeff());
}

// @param s (xx, yy, zz, xy, yz, xz), a column a node
double find_von_mises(const Eigen::Map<const Matrix6X>& s) {
  const auto difference = [&s](int i, int j) {
    return (s.row(i) - s.row(j)).array().square();
  };
  const auto shear = s.bottomRows(3).colwise().squaredNorm().array();
  return std::sqrt(
      (0.5 * (difference(0, 1) + difference(1, 2) + difference(2, 0)) +
       3.0 * shear)
          .maxCoeff());
}

void take_larger(double& most, double value) { most = std::max(most, value); }

void add_von_mises(const MatrixX& Sigma_B, const MatrixX& coordinates,
                   Extremes& extremes) {
  const Eigen::Index T = coordinates.rows();
  for (Eigen::Index first = 0; first < T; first += kOutputs) {
    const Eigen::Index count = std::min(kOutputs, T - first);
    const MatrixX s =
        Sigma_B * coordinates.middleRows(first, count).transpose();
    for (Eigen::Index j = 0; j < count; ++j) {
      take_larger(extremes.fields(first + j, 3),
                  find_von_mises(Eigen::Map<const Matrix6X>(s.col(j).data(), 6,
                                                            s.rows() / 6)));
    }
  }
}

/// Points of one body at output i.
struct Snapshot {
  Matrix3X u_B;  ///< deformation [m]
  Matrix3X v_B;  ///< velocity [m/s]
  Matrix3X p;    ///< from the offset, axes of the world [m]
};

Snapshot find_snapshot(const Body& body, const Vector3& offset, Eigen::Index i,
                       const Matrix3X& x, const VectorX& u,
                       const VectorX& udot) {
  const Eigen::Index n = x.cols();
  const Matrix3 R = Quaternion(body.quat_WB(i, 0), body.quat_WB(i, 1),
                               body.quat_WB(i, 2), body.quat_WB(i, 3))
                        .normalized()
                        .toRotationMatrix();
  const Vector3 v_B = R.transpose() * body.v_WB_W.row(i).transpose();
  Snapshot now;
  now.u_B = u.reshaped(3, n);
  const Matrix3X y = x + now.u_B;
  now.v_B = skew(Vector3(body.w_WB_B.row(i).transpose())) * y;
  now.v_B += udot.reshaped(3, n);
  now.v_B.colwise() += v_B;
  now.p = (R * y).colwise() + Vector3(body.p_WB.row(i).transpose() - offset);
  return now;
}

void add_motion(const Recording& recording, const results::Home& home, int b,
                Extremes& extremes) {
  const Body& body = recording.bodies[std::size_t(b)];
  const Matrix3X x = gather_points(recording, b);
  const MatrixX Phi = body.surface < 0
                          ? MatrixX(x.size(), 0)
                          : recording.surfaces[std::size_t(body.surface)].Phi_B;
  const MatrixX rates = find_rates(body, recording.times);
  const Eigen::Index T = recording.times.size();
  Matrix3X start;
  for (Eigen::Index first = 0; first < T; first += kOutputs) {
    const Eigen::Index count = std::min(kOutputs, T - first);
    const MatrixX u = Phi * body.eta.middleRows(first, count).transpose();
    const MatrixX udot = Phi * rates.middleRows(first, count).transpose();
    for (Eigen::Index j = 0; j < count; ++j) {
      const Eigen::Index i = first + j;
      const Snapshot now =
          find_snapshot(body, home.offset, i, x, u.col(j), udot.col(j));
      if (i == 0) start = now.p;
      take_larger(extremes.fields(i, 0), find_longest(now.u_B));
      take_larger(extremes.fields(i, 1), find_longest(now.p - start));
      take_larger(extremes.fields(i, 2), find_longest(now.v_B));
      const Vector3 path = home.path.row(i);
      extremes.lower =
          extremes.lower.cwiseMin(now.p.rowwise().minCoeff() - path);
      extremes.upper =
          extremes.upper.cwiseMax(now.p.rowwise().maxCoeff() - path);
    }
  }
}

}  // namespace

Extremes calc_extremes(const Recording& recording, const results::Home& home) {
  constexpr double kFar = std::numeric_limits<double>::max();
  Extremes extremes{MatrixX::Zero(recording.times.size(), 4),
                    Vector3::Constant(kFar), Vector3::Constant(-kFar)};
  for (std::size_t b = 0; b < recording.bodies.size(); ++b) {
    const Body& body = recording.bodies[b];
    add_motion(recording, home, static_cast<int>(b), extremes);
    if (body.surface < 0) continue;
    const MatrixX& Sigma_B =
        recording.surfaces[static_cast<std::size_t>(body.surface)].Sigma_B;
    if (body.Sigma_B.rows() > 0) {
      add_von_mises(body.Sigma_B, body.zeta, extremes);
    } else if (Sigma_B.cols() > 0) {
      add_von_mises(Sigma_B, body.eta, extremes);
    }
  }
  return extremes;
}

}  // namespace limber::view
