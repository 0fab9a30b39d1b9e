// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

#include "limber/common/pose.hpp"
#include "limber/contact/patches/contact_side.hpp"
#include "limber/contact/potential/mesh_parts.hpp"
#include "limber/contact/shapes/mesh_surface.hpp"

/// Closed meshes of triangles.
namespace limber::contact {

struct TestMesh {
  std::vector<Vector3> corners;
  std::vector<std::array<int, 6>> faces;

  int add(const Vector3& x) {
    corners.push_back(x);
    return static_cast<int>(corners.size()) - 1;
  }
  void add_triangle(int a, int b, int c) {
    faces.push_back({a, b, c, -1, -1, -1});
  }
  void add_quad(int a, int b, int c, int d) {
    add_triangle(a, b, c);
    add_triangle(a, c, d);
  }
  [[nodiscard]] Matrix3X x_B() const {
    Matrix3X x(3, std::ssize(corners));
    for (Eigen::Index i = 0; i < x.cols(); ++i) {
      x.col(i) = corners[static_cast<std::size_t>(i)];
    }
    return x;
  }
  [[nodiscard]] TestMesh place(const Pose& X, double scale = 1.0) const {
    TestMesh moved = *this;
    for (Vector3& x : moved.corners) x = X * Vector3(scale * x);
    return moved;
  }
  [[nodiscard]] std::vector<ConvexSolid> split() const {
    return split_mesh(x_B(), faces);
  }
  [[nodiscard]] std::vector<PlacedBody> list_bodies() const {
    std::vector<PlacedBody> bodies;
    for (const ConvexSolid& solid : split()) bodies.push_back({solid, Pose{}});
    return bodies;
  }
  [[nodiscard]] ContactSide make_side(double modulus, double mass,
                                      const Matrix3& inertia) const {
    flexbody::ContactSurface surface;
    surface.name = "mesh";
    surface.x_B = x_B();
    surface.tags.assign(corners.size(), 0);
    surface.Phi_B.resize(3 * surface.x_B.cols(), 0);
    surface.residual = VectorX::Zero(surface.x_B.cols());
    surface.patch_radius = VectorX::Constant(surface.x_B.cols(), 0.01);
    surface.faces = faces;
    return {Shape{std::make_shared<const MeshSurface>(std::move(surface)), {}},
            SurfaceMaterial{modulus, 0.3}, mass, inertia, list_bodies()};
  }
};

using Outline = std::vector<std::array<double, 2>>;

/// An outline, counterclockwise, of |z| <= h. @param triangles of it
inline TestMesh make_prism(const Outline& outline, double h,
                           const std::vector<std::array<int, 3>>& triangles) {
  TestMesh mesh;
  for (const double z : {-h, h}) {
    for (const auto& p : outline) mesh.add({p[0], p[1], z});
  }
  const int n = static_cast<int>(outline.size());
  for (int i = 0; i < n; ++i) {
    mesh.add_quad(i, (i + 1) % n, n + (i + 1) % n, n + i);
  }
  for (const auto& [a, b, c] : triangles) {
    mesh.add_triangle(n + a, n + b, n + c);
    mesh.add_triangle(a, c, b);
  }
  return mesh;
}

inline TestMesh make_box_mesh(const Vector3& half) {
  const double x = half.x();
  const double y = half.y();
  return make_prism({{-x, -y}, {x, -y}, {x, y}, {-x, y}}, half.z(),
                    {{0, 1, 2}, {0, 2, 3}});
}

/// Legs of 0.08 along x and y, 0.02 thick, |z| <= 0.03, about the middle of its
/// bounds.
inline TestMesh make_angle() {
  return make_prism({{-0.04, -0.04},
                     {0.04, -0.04},
                     {0.04, -0.02},
                     {-0.02, -0.02},
                     {-0.02, 0.04},
                     {-0.04, 0.04}},
                    0.03, {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}});
}

inline TestMesh make_channel() {
  return make_prism(
      {{-0.05, -0.03},
       {0.05, -0.03},
       {0.05, 0.03},
       {0.03, 0.03},
       {0.03, -0.01},
       {-0.03, -0.01},
       {-0.03, 0.03},
       {-0.05, 0.03}},
      0.05, {{0, 1, 4}, {1, 2, 3}, {1, 3, 4}, {0, 4, 5}, {0, 5, 6}, {0, 6, 7}});
}

/// A regular prism of n sides. @param radius of its corners
inline TestMesh make_rod(int n, double radius, double h) {
  Outline outline;
  std::vector<std::array<int, 3>> triangles;
  for (int i = 0; i < n; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / n;
    outline.push_back({radius * std::cos(angle), radius * std::sin(angle)});
    if (i > 1) triangles.push_back({0, i - 1, i});
  }
  return make_prism(outline, h, triangles);
}

/// A hole of n sides in a regular prism.
inline TestMesh make_ring(int n, double inner, double outer, double h) {
  TestMesh mesh;
  for (int i = 0; i < n; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / n;
    const Vector3 way(std::cos(angle), std::sin(angle), 0.0);
    for (const double z : {-h, h}) {
      mesh.add(inner * way + z * Vector3::UnitZ());
      mesh.add(outer * way + z * Vector3::UnitZ());
    }
  }
  for (int i = 0; i < n; ++i) {
    const int a = 4 * i;
    const int b = 4 * ((i + 1) % n);
    mesh.add_quad(a + 1, b + 1, b + 3, a + 3);
    mesh.add_quad(a, a + 2, b + 2, b);
    mesh.add_quad(a + 3, b + 3, b + 2, a + 2);
    mesh.add_quad(a, b, b + 1, a + 1);
  }
  return mesh;
}

/// A ball by n meridians and n / 2 parallels.
inline TestMesh make_globe(int n, double radius) {
  TestMesh mesh;
  const int rows = n / 2;
  mesh.add({0, 0, -radius});
  for (int i = 1; i < rows; ++i) {
    const double b = std::numbers::pi * (static_cast<double>(i) / rows - 0.5);
    for (int j = 0; j < n; ++j) {
      const double a = 2.0 * std::numbers::pi * j / n;
      mesh.add(radius * Vector3(std::cos(b) * std::cos(a),
                                std::cos(b) * std::sin(a), std::sin(b)));
    }
  }
  const int top = mesh.add({0, 0, radius});
  const auto at = [n](int i, int j) { return 1 + (i - 1) * n + j % n; };
  for (int j = 0; j < n; ++j) {
    mesh.add_triangle(0, at(1, j + 1), at(1, j));
    mesh.add_triangle(top, at(rows - 1, j), at(rows - 1, j + 1));
    for (int i = 1; i + 1 < rows; ++i) {
      mesh.add_quad(at(i, j), at(i, j + 1), at(i + 1, j + 1), at(i + 1, j));
    }
  }
  return mesh;
}

}  // namespace limber::contact
