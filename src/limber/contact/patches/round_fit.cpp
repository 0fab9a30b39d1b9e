// SPDX-License-Identifier: BSD-3-Clause
#include "limber/contact/patches/round_fit.hpp"

#include <algorithm>
#include <cmath>

#include "limber/common/dense/linear_solve.hpp"

namespace limber::contact {
namespace {

// Tilts of the axis, moves across it, the radius and both ends.
constexpr Eigen::Index kUnknowns = 7;

Vector3 find_mean(std::span<const Vector3> points) {
  Vector3 sum = Vector3::Zero();
  for (const Vector3& x : points) sum += x;
  return sum / static_cast<double>(points.size());
}

void set_error(std::span<const Vector3> points, RoundFit& fit) {
  fit.error = 0.0;
  for (const Vector3& x : points) {
    fit.error = std::max(fit.error, std::abs(fit.find_distance(x)));
  }
}

// Extents along the axis, then the mean distance from the line.
RoundFit begin_rod(std::span<const Vector3> points, const Vector3& axis,
                   bool has_low, bool has_high) {
  RoundFit fit{.centre = find_mean(points), .axis = axis};
  double low = RoundFit::kEndless;
  double high = -low;
  for (const Vector3& x : points) {
    const double z = fit.find_height(x);
    low = std::min(low, z);
    high = std::max(high, z);
    const Vector3 r = x - fit.centre;
    fit.radius = std::max(fit.radius, (r - z * axis).norm());
  }
  if (has_low) fit.low = std::min(low + fit.radius, 0.5 * (low + high));
  if (has_high) fit.high = std::max(high - fit.radius, 0.5 * (low + high));
  return fit;
}

// One step of Gauss and Newton. @return its length over the radius
double improve(std::span<const Vector3> points, RoundFit& fit) {
  const Vector3 e1 = fit.axis.unitOrthogonal();
  const Vector3 e2 = fit.axis.cross(e1);
  MatrixX H = MatrixX::Zero(kUnknowns, kUnknowns);
  VectorX g = VectorX::Zero(kUnknowns);
  const double scale = fit.radius;  // of tilts
  for (const Vector3& x : points) {
    const double z = fit.find_height(x);
    const double s = std::clamp(z, fit.low, fit.high);
    const Vector3 way = x - fit.centre - s * fit.axis;
    const Vector3 u = way.normalized();
    VectorX row = VectorX::Zero(kUnknowns);
    row << -u.dot(e1), -u.dot(e2), -s / scale * u.dot(e1),
        -s / scale * u.dot(e2), -1.0, z < fit.low ? -u.dot(fit.axis) : 0.0,
        z > fit.high ? -u.dot(fit.axis) : 0.0;
    H += row * row.transpose();
    g -= (way.norm() - fit.radius) * row;
  }
  constexpr double kLeast = 1e-12;  // of what no point determines [-]
  H.diagonal().array() += kLeast * H.trace();
  const VectorX step = dense::solve(H, g);
  fit.centre += step[0] * e1 + step[1] * e2;
  fit.axis = (fit.axis + (step[2] * e1 + step[3] * e2) / scale).normalized();
  fit.radius += step[4];
  fit.low += step[5];
  fit.high += step[6];
  return step.norm() / scale;
}

}  // namespace

double RoundFit::find_distance(const Vector3& x) const {
  const double s = std::clamp(find_height(x), low, high);
  return (x - centre - s * axis).norm() - radius;
}

std::optional<RoundFit> fit_ball(std::span<const Vector3> points) {
  const Vector3 mean = find_mean(points);
  Matrix3 H = Matrix3::Zero();
  Vector3 g = Vector3::Zero();
  double square = 0.0;
  for (const Vector3& x : points) square += (x - mean).squaredNorm();
  square /= static_cast<double>(points.size());
  for (const Vector3& x : points) {
    const Vector3 r = x - mean;
    H += r * r.transpose();
    g += 0.5 * (r.squaredNorm() - square) * r;
  }
  constexpr double kFlat = 1e-9;
  if (std::abs(H.determinant()) < kFlat * std::pow(H.trace(), 3)) return {};
  const VectorX shift = dense::solve(MatrixX(H), VectorX(g));
  RoundFit fit{.centre = mean + Vector3(shift), .low = 0.0, .high = 0.0};
  fit.radius = std::sqrt(square + shift.squaredNorm());
  set_error(points, fit);
  return fit;
}

std::optional<RoundFit> fit_rod(std::span<const Vector3> points,
                                const Vector3& axis, bool has_low,
                                bool has_high) {
  constexpr int kMost = 50;
  constexpr double kDone = 1e-12;
  RoundFit fit = begin_rod(points, axis, has_low, has_high);
  for (int i = 0; i < kMost; ++i) {
    const double change = improve(points, fit);
    if (!(fit.radius > 0.0) || !std::isfinite(change) || fit.low > fit.high) {
      return {};
    }
    if (change > kDone) continue;
    set_error(points, fit);
    return fit;
  }
  set_error(points, fit);
  return fit;
}

}  // namespace limber::contact
