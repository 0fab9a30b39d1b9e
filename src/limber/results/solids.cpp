// SPDX-License-Identifier: BSD-3-Clause
#include "limber/results/solids.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "limber/common/dense/symmetric_eigen.hpp"

namespace limber::results {
namespace {

constexpr int kAround = 24;
constexpr int kAlong = 12;  // of a half circle

/// Radius and height of a point that rotates about z.
using ProfilePoint = std::array<double, 2>;

/// @param profile from the lower end to the upper, both on the axis
Solid revolve(const std::vector<ProfilePoint>& profile) {
  Solid solid;
  const auto rings = static_cast<std::uint32_t>(profile.size());
  solid.x.resize(3, Eigen::Index(rings) * kAround);
  for (std::uint32_t ring = 0; ring < rings; ++ring) {
    for (int k = 0; k < kAround; ++k) {
      const double angle = 2.0 * std::numbers::pi * k / kAround;
      const auto& [radius, height] = profile[ring];
      solid.x.col(Eigen::Index(ring) * kAround + k) << radius * std::cos(angle),
          radius * std::sin(angle), height;
    }
  }
  for (std::uint32_t ring = 0; ring + 1 < rings; ++ring) {
    for (std::uint32_t k = 0; k < kAround; ++k) {
      const std::uint32_t a = ring * kAround + k;
      const std::uint32_t b = ring * kAround + (k + 1) % kAround;
      for (const std::uint32_t corner :
           {a, b, b + kAround, a, b + kAround, a + kAround}) {
        solid.corners.push_back(corner);
      }
    }
  }
  return solid;
}

/// A half circle whose halves are apart by `length`.
std::vector<ProfilePoint> make_arc(double radius, double length) {
  std::vector<ProfilePoint> profile;
  for (int i = 0; i <= kAlong; ++i) {
    const double angle = std::numbers::pi * (double(i) / kAlong - 0.5);
    const double shift = length / 2.0;
    const double height = radius * std::sin(angle);
    const double width = std::max(radius * std::cos(angle), 0.0);
    if (length > 0.0 && 2 * i == kAlong) profile.push_back({width, -shift});
    profile.push_back({width, height + (2 * i < kAlong ? -shift : shift)});
  }
  return profile;
}

Solid make_box(const Vector3& size) {
  Solid solid;
  solid.x.resize(3, 8);
  for (int i = 0; i < 8; ++i) {
    solid.x.col(i) << (i & 1 ? 0.5 : -0.5) * size.x(),
        (i & 2 ? 0.5 : -0.5) * size.y(), (i & 4 ? 0.5 : -0.5) * size.z();
  }
  solid.corners = {0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4,
                   2, 6, 7, 2, 7, 3, 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5};
  return solid;
}

Solid make_square(double edge) {
  Solid solid = make_box({edge, edge, 0.0});
  solid.x.conservativeResize(3, 4);
  solid.corners = {0, 1, 3, 0, 3, 2};
  return solid;
}

}  // namespace

Solid make_solid(const SolidShape& shape, double edge) {
  const Vector3& s = shape.size;
  if (shape.kind == "box") return make_box(s);
  if (shape.kind == "sphere") return revolve(make_arc(s.x(), 0.0));
  if (shape.kind == "capsule") return revolve(make_arc(s.x(), s.y()));
  const double h = s.y() / 2.0;
  if (shape.kind == "cone") {
    return revolve({{0.0, -h}, {s.x(), -h}, {0.0, h}});
  }
  if (shape.kind == "ellipsoid") {
    Solid solid = revolve(make_arc(1.0, 0.0));
    solid.x = s.asDiagonal() * solid.x;
    return solid;
  }
  if (shape.kind == "cylinder") {
    return revolve({{0.0, -h}, {s.x(), -h}, {s.x(), h}, {0.0, h}});
  }
  if (shape.kind == "mesh") return {shape.x, shape.corners};
  return make_square(edge);
}

Solid place_solid(Solid solid, const Pose& X_BS) {
  solid.x = (X_BS.R * solid.x).colwise() + X_BS.p;
  return solid;
}

Solid make_ellipsoid(double mass, const Matrix3& inertia) {
  const auto [J, principal] = dense::find_eigenpairs(inertia);
  Vector3 axes =
      (5.0 / mass * (0.5 * J.sum() - J.array())).max(0.0).sqrt().matrix();
  constexpr double kThinnest = 0.02;  // of a thin rod, so that it can be seen
  axes = axes.cwiseMax(kThinnest * std::max(axes.maxCoeff(), 1e-9));
  Matrix3 R = principal;
  if (R.determinant() < 0.0) R.col(0) = -R.col(0);
  Solid solid = revolve(make_arc(1.0, 0.0));
  solid.x = R * (axes.asDiagonal() * solid.x);
  return solid;
}

}  // namespace limber::results
