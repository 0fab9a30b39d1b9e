// SPDX-License-Identifier: BSD-3-Clause
#include "unit/contact/shapes/surfaces.hpp"

#include <cmath>
#include <map>
#include <utility>

#include "limber/common/rotation.hpp"

namespace limber::contact::test {
namespace {

using Triangles = std::vector<std::array<int, 3>>;
using Projection = std::function<Vector3(const Vector3&)>;

// Middle nodes of edges, each once, on the surface that `project` leads to.
flexbody::ContactSurface make_surface(std::vector<Vector3> nodes,
                                      const Triangles& triangles,
                                      bool quadratic,
                                      const Projection& project) {
  flexbody::ContactSurface surface;
  surface.name = "skin";
  std::map<std::pair<int, int>, int> middles;
  for (const auto& corners : triangles) {
    std::array<int, 6> face{corners[0], corners[1], corners[2], -1, -1, -1};
    for (std::size_t edge = 0; edge < 3 && quadratic; ++edge) {
      const int a = corners[edge];
      const int b = corners[(edge + 1) % 3];
      const auto [found, is_new] = middles.try_emplace(
          std::minmax(a, b), static_cast<int>(nodes.size()));
      if (is_new) {
        nodes.push_back(project(0.5 * (nodes[index(a)] + nodes[index(b)])));
      }
      face[3 + edge] = found->second;
    }
    surface.faces.push_back(face);
  }
  surface.x_B.resize(3, static_cast<Eigen::Index>(nodes.size()));
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    surface.x_B.col(static_cast<Eigen::Index>(i)) = nodes[i];
    surface.tags.push_back(i + 1);
  }
  surface.residual = VectorX::Zero(surface.x_B.cols());
  surface.patch_radius = VectorX::Ones(surface.x_B.cols());
  surface.Phi_B = MatrixX(surface.x_B.size(), 0);
  return surface;
}

// A square grid of nodes, and its triangles by every other diagonal.
Triangles list_grid_triangles(int first, int cells) {
  Triangles triangles;
  for (int j = 0; j < cells; ++j) {
    for (int i = 0; i < cells; ++i) {
      const int a = first + j * (cells + 1) + i;
      const int b = a + 1;
      const int c = a + cells + 1;
      const int d = c + 1;
      if ((i + j) % 2 == 0) {
        triangles.insert(triangles.end(), {{a, b, d}, {a, d, c}});
      } else {
        triangles.insert(triangles.end(), {{a, b, c}, {b, d, c}});
      }
    }
  }
  return triangles;
}

// Nodes at one position become one.
void merge(std::vector<Vector3>& nodes, Triangles& triangles) {
  std::vector<Vector3> kept;
  std::vector<int> place;
  for (const Vector3& x : nodes) {
    std::size_t i = 0;
    while (i < kept.size() && !kept[i].isApprox(x, 1e-12)) ++i;
    if (i == kept.size()) kept.push_back(x);
    place.push_back(static_cast<int>(i));
  }
  for (auto& triangle : triangles) {
    for (int& node : triangle) node = place[index(node)];
  }
  nodes = kept;
}

}  // namespace

flexbody::ContactSurface make_box_surface(const Vector3& half_size, int cells,
                                          bool quadratic) {
  std::vector<Vector3> nodes;
  Triangles triangles;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {-1.0, 1.0}) {
      const auto part =
          list_grid_triangles(static_cast<int>(nodes.size()), cells);
      triangles.insert(triangles.end(), part.begin(), part.end());
      for (int j = 0; j <= cells; ++j) {
        for (int i = 0; i <= cells; ++i) {
          Vector3 x;
          x[axis] = side;
          x[(axis + 1) % 3] = side * (2.0 * i / cells - 1.0);  // outward
          x[(axis + 2) % 3] = 2.0 * j / cells - 1.0;
          nodes.emplace_back(x.cwiseProduct(half_size));
        }
      }
    }
  }
  merge(nodes, triangles);
  return make_surface(nodes, triangles, quadratic,
                      [](const Vector3& x) { return x; });
}

flexbody::ContactSurface make_ball_surface(double radius, int subdivisions,
                                           bool quadratic) {
  const double g = 0.5 * (1.0 + std::sqrt(5.0));
  std::vector<Vector3> nodes = {{-1, g, 0}, {1, g, 0}, {-1, -g, 0}, {1, -g, 0},
                                {0, -1, g}, {0, 1, g}, {0, -1, -g}, {0, 1, -g},
                                {g, 0, -1}, {g, 0, 1}, {-g, 0, -1}, {-g, 0, 1}};
  Triangles triangles = {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10},
                         {0, 10, 11}, {1, 5, 9},  {5, 11, 4}, {11, 10, 2},
                         {10, 7, 6},  {7, 1, 8},  {3, 9, 4},  {3, 4, 2},
                         {3, 2, 6},   {3, 6, 8},  {3, 8, 9},  {4, 9, 5},
                         {2, 4, 11},  {6, 2, 10}, {8, 6, 7},  {9, 8, 1}};
  const auto project = [radius](const Vector3& x) -> Vector3 {
    return radius * x.normalized();
  };
  for (Vector3& x : nodes) x = project(x);
  for (int i = 0; i < subdivisions; ++i) {
    const auto finer = make_surface(nodes, triangles, true, project);
    nodes.clear();
    for (const auto& x : finer.x_B.colwise()) nodes.emplace_back(x);
    triangles.clear();
    for (const auto& f : finer.faces) {
      triangles.insert(triangles.end(), {{f[0], f[3], f[5]},
                                         {f[3], f[1], f[4]},
                                         {f[5], f[4], f[2]},
                                         {f[3], f[4], f[5]}});
    }
  }
  return make_surface(nodes, triangles, quadratic, project);
}

flexbody::ContactSurface make_sheet_surface(
    double half_side, int cells, bool quadratic,
    const std::function<double(double, double)>& height) {
  const Projection lift = [&height](const Vector3& x) -> Vector3 {
    return {x.x(), x.y(), height(x.x(), x.y())};
  };
  std::vector<Vector3> nodes;
  for (int j = 0; j <= cells; ++j) {
    for (int i = 0; i <= cells; ++i) {
      nodes.push_back(lift(half_side * Vector3(2.0 * i / cells - 1.0,
                                               2.0 * j / cells - 1.0, 0.0)));
    }
  }
  return make_surface(nodes, list_grid_triangles(0, cells), quadratic, lift);
}

void set_modes(flexbody::ContactSurface& surface,
               const std::vector<Field>& fields) {
  surface.Phi_B.resize(surface.x_B.size(),
                       static_cast<Eigen::Index>(fields.size()));
  for (Eigen::Index n = 0; n < surface.x_B.cols(); ++n) {
    for (std::size_t k = 0; k < fields.size(); ++k) {
      surface.Phi_B.block<3, 1>(3 * n, static_cast<Eigen::Index>(k)) =
          fields[k](surface.x_B.col(n));
    }
  }
}

std::vector<Field> make_fields() {
  return {[](const Vector3& x) {
            return Vector3(-2.0 * x.x() * x.z(), 0.0, x.x() * x.x());
          },
          [](const Vector3& x) {
            return Vector3(0.0, -x.z() * x.x(), x.y() * x.x());
          },
          [](const Vector3& x) {
            return Vector3(x.x(), -0.3 * x.y(), -0.3 * x.z());
          },
          [](const Vector3& x) {
            return Vector3(0.1 * std::sin(3.0 * x.y()), 0.0,
                           0.2 * std::cos(2.0 * x.x() + x.y()));
          }};
}

ModalView view(const VectorX& eta) { return {eta.data(), eta.size()}; }

Vector3 draw_point(std::mt19937& random, double half_side) {
  std::uniform_real_distribution<double> draw(-half_side, half_side);
  Vector3 x;
  for (double& value : x) value = draw(random);
  return x;
}

Matrix3 draw_rotation(std::mt19937& random) {
  return exp_rotation(draw_point(random, 3.0));
}

MeshSurface::NearestPoint find_nearest_of_box(const Vector3& h,
                                              const Vector3& p) {
  const Vector3 beyond = p.cwiseAbs() - h;
  if ((beyond.array() > 0.0).any()) {
    const Vector3 point = p.cwiseMax(-h).cwiseMin(h);
    const Vector3 arm = p - point;
    const double distance = arm.norm();
    return {.distance = distance,
            .point = point,
            .normal = arm / distance,
            .curvature = 0.0};
  }
  int axis = 0;
  const double distance = beyond.maxCoeff(&axis);
  Vector3 normal = Vector3::Zero();
  normal[axis] = p[axis] < 0.0 ? -1.0 : 1.0;
  return {.distance = distance,
          .point = p - distance * normal,
          .normal = normal,
          .curvature = 0.0};
}

}  // namespace limber::contact::test
