// SPDX-License-Identifier: BSD-3-Clause
#include "limber/scene/contacts/shape_surface.hpp"

#include <cmath>
#include <numbers>

#include "limber/common/overloaded.hpp"

namespace limber::scene {
namespace {

constexpr int kAround = 16;  // corners of a circle
constexpr int kRings = 4;    // of a half sphere, with its equator

/// A ring about z.
struct Ring {
  double radius = 0.0;  // [m]
  double z = 0.0;       // [m]
};

// Rings from the lowest to the highest, closed by a point at each end.
ShapeSurface turn(const std::vector<Ring>& rings, double bottom, double top) {
  ShapeSurface surface;
  const auto count = static_cast<Eigen::Index>(rings.size()) * kAround;
  surface.points.resize(3, count + 2);
  for (std::size_t r = 0; r < rings.size(); ++r) {
    for (int a = 0; a < kAround; ++a) {
      const double angle = 2.0 * std::numbers::pi * a / kAround;
      surface.points.col(static_cast<Eigen::Index>(r) * kAround + a) =
          Vector3(rings[r].radius * std::cos(angle),
                  rings[r].radius * std::sin(angle), rings[r].z);
    }
  }
  surface.points.col(count) = Vector3(0.0, 0.0, bottom);
  surface.points.col(count + 1) = Vector3(0.0, 0.0, top);
  const auto at = [](std::size_t ring, int a) {
    return ring * kAround + static_cast<std::size_t>(a % kAround);
  };
  const auto low = static_cast<std::size_t>(count);
  const std::size_t last = rings.size() - 1;
  for (int a = 0; a < kAround; ++a) {
    surface.triangles.push_back({low, at(0, a + 1), at(0, a)});
    surface.triangles.push_back({low + 1, at(last, a), at(last, a + 1)});
    for (std::size_t r = 0; r < last; ++r) {
      surface.triangles.push_back({at(r, a), at(r, a + 1), at(r + 1, a + 1)});
      surface.triangles.push_back({at(r, a), at(r + 1, a + 1), at(r + 1, a)});
    }
  }
  return surface;
}

// Of half spheres with their middles at +- half of the length.
ShapeSurface make_capsule(double radius, double length) {
  std::vector<Ring> rings;
  for (const int side : {-1, 1}) {
    for (int i = 0; i < kRings; ++i) {
      const int from_pole = side < 0 ? i + 1 : kRings - i;
      const double angle = 0.5 * std::numbers::pi * from_pole / kRings;
      rings.push_back({radius * std::sin(angle),
                       side * (0.5 * length + radius * std::cos(angle))});
    }
    if (length == 0.0 && side < 0) rings.pop_back();  // one equator
  }
  const double end = 0.5 * length + radius;
  return turn(rings, -end, end);
}

ShapeSurface make_box(const Vector3& size) {
  ShapeSurface surface;
  surface.points.resize(3, 8);
  for (int i = 0; i < 8; ++i) {
    surface.points.col(i) =
        0.5 * size.cwiseProduct(Vector3((i & 1) != 0 ? 1.0 : -1.0,
                                        (i & 2) != 0 ? 1.0 : -1.0,
                                        (i & 4) != 0 ? 1.0 : -1.0));
  }
  surface.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6},
                       {0, 1, 5}, {0, 5, 4}, {2, 6, 7}, {2, 7, 3},
                       {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return surface;
}

}  // namespace

ShapeSurface make_surface(const Geometry& geometry) {
  return std::visit(
      Overloaded{
          [](const SphereGeometry& s) { return make_capsule(s.radius, 0.0); },
          [](const CapsuleGeometry& c) {
            return make_capsule(c.radius, c.length);
          },
          [](const CylinderGeometry& c) {
            const double half = 0.5 * c.length;
            return turn({{c.radius, -half}, {c.radius, half}}, -half, half);
          },
          [](const BoxGeometry& b) { return make_box(b.size); },
          [](const auto&) { return ShapeSurface{}; }},
      geometry);
}

}  // namespace limber::scene
