// SPDX-License-Identifier: BSD-3-Clause
#include "limber/fem/mesh/face_shape.hpp"

#include <array>
#include <cmath>
#include <vector>

#include "limber/common/dense/linear_solve.hpp"

namespace limber::fem {
namespace {

using Powers = std::vector<std::array<int, 2>>;

/// Monomials of degree `order` in all (triangles) or in each (quadrilaterals).
Powers list_complete(bool is_quad, int order) {
  Powers powers;
  for (int i = 0; i <= order; ++i)
    for (int j = 0; j <= (is_quad ? order : order - i); ++j)
      powers.push_back({i, j});
  return powers;
}

/// Of a face with `count` nodes; empty if they are not known.
Powers list_powers(bool is_quad, int order, std::size_t count) {
  Powers powers = list_complete(is_quad, order);
  if (powers.size() == count || !is_quad)
    return powers.size() == count ? powers : Powers{};
  // Quadrilaterals without inner nodes, of order two and three.
  powers = list_complete(false, order);
  powers.push_back({order, 1});
  powers.push_back({1, order});
  return powers.size() == count ? powers : Powers{};
}

MatrixX find_places(const ReferenceElement& element, std::size_t face) {
  const std::vector<int>& nodes = element.faces[face];
  const bool is_quad = element.face_corners[face] == 4;
  const Vector3 origin = element.node_uvw.col(nodes[0]);
  Eigen::Matrix<double, 3, 2> axes;
  axes.col(0) = element.node_uvw.col(nodes[1]) - origin;
  axes.col(1) = element.node_uvw.col(nodes[is_quad ? 3 : 2]) - origin;
  const MatrixX from_corner =
      MatrixX(element.node_uvw(Eigen::all, nodes)).colwise() - origin;
  return (axes.transpose() * axes).inverse() * axes.transpose() * from_corner;
}

/// Places and weights on the reference face.
struct Rule {
  std::vector<Eigen::Vector2d> places;
  std::vector<double> weights;
};

/// Three points, exact for second degree (Strang and Fix, 1973).
void add_triangle(const Eigen::Matrix<double, 2, 3>& corners, double area,
                  Rule& rule) {
  for (int k = 0; k < 3; ++k) {
    rule.places.emplace_back(corners.rowwise().sum() / 6.0 +
                             corners.col(k) / 2.0);
    rule.weights.push_back(area / 3.0);
  }
}

/// Gauss, two by two, which is as symmetric as the square.
void add_square(const Eigen::Vector2d& corner, double size, Rule& rule) {
  const double inner = 0.5 * (1.0 - 1.0 / std::sqrt(3.0));
  for (const double u : {inner, 1.0 - inner})
    for (const double v : {inner, 1.0 - inner}) {
      rule.places.emplace_back(corner + size * Eigen::Vector2d(u, v));
      rule.weights.push_back(size * size / 4.0);
    }
}

double power(double x, int n) { return n > 0 ? x * power(x, n - 1) : 1.0; }

}  // namespace

FaceShape::FaceShape(const ReferenceElement& element, std::size_t face)
    : corners_(element.face_corners[face]),
      order_(element.order),
      places_(find_places(element, face)) {
  const auto count = static_cast<std::size_t>(places_.cols());
  Powers powers = list_powers(corners_ == 4, order_, count);
  Eigen::Index used = places_.cols();
  if (powers.empty()) {
    order_ = 1;
    used = corners_;
    powers = list_complete(corners_ == 4, 1);
  }
  powers_.resize(2, used);
  for (Eigen::Index j = 0; j < used; ++j) {
    const auto& [i_u, i_v] = powers[static_cast<std::size_t>(j)];
    powers_.col(j) << i_u, i_v;
  }
  MatrixX V(used, used);
  for (Eigen::Index k = 0; k < used; ++k)
    for (Eigen::Index j = 0; j < used; ++j)
      V(k, j) = power(places_(0, k), powers_(0, j)) *
                power(places_(1, k), powers_(1, j));
  inverse_ = MatrixX::Zero(places_.cols(), used);
  inverse_.topRows(used) = dense::find_inverse(V.transpose());
}

FaceTable FaceShape::tabulate(const MatrixX& places) const {
  MatrixX value(powers_.cols(), places.cols());
  MatrixX by_u = value;
  MatrixX by_v = value;
  for (Eigen::Index q = 0; q < places.cols(); ++q)
    for (Eigen::Index j = 0; j < powers_.cols(); ++j) {
      const int a = powers_(0, j);
      const int b = powers_(1, j);
      const double u = power(places(0, q), a);
      const double v = power(places(1, q), b);
      value(j, q) = u * v;
      by_u(j, q) = a > 0 ? a * power(places(0, q), a - 1) * v : 0.0;
      by_v(j, q) = b > 0 ? b * power(places(1, q), b - 1) * u : 0.0;
    }
  return {{}, inverse_ * value, inverse_ * by_u, inverse_ * by_v};
}

FaceTable FaceShape::make_rule(int divisions) const {
  const double size = 1.0 / divisions;
  const auto corner = [&](int i, int j) {
    return Eigen::Vector2d(size * Eigen::Vector2d(i, j));
  };
  Rule rule;
  Eigen::Matrix<double, 2, 3> cell;
  for (int i = 0; i < divisions; ++i)
    for (int j = 0; j < (corners_ == 4 ? divisions : divisions - i); ++j) {
      if (corners_ == 4) {
        add_square(corner(i, j), size, rule);
        continue;
      }
      cell << corner(i, j), corner(i + 1, j), corner(i, j + 1);
      add_triangle(cell, 0.5 * size * size, rule);
      if (i + j + 2 > divisions) continue;
      cell << corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1);
      add_triangle(cell, 0.5 * size * size, rule);
    }
  const auto count = static_cast<Eigen::Index>(rule.places.size());
  MatrixX places(2, count);
  for (Eigen::Index q = 0; q < count; ++q)
    places.col(q) = rule.places[static_cast<std::size_t>(q)];
  FaceTable table = tabulate(places);
  table.weights = Eigen::Map<const VectorX>(rule.weights.data(), count);
  return table;
}

}  // namespace limber::fem
