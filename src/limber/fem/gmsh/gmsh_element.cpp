// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <gmsh.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "limber/common/dense/linear_solve.hpp"
#include "limber/common/errors.hpp"
#include "limber/fem/mesh/reference_element.hpp"

namespace limber::fem {
namespace {

enum class Family { other, tetrahedron, hexahedron, prism, pyramid };

/// @throws InputError for families that we do not test.
Family family_of(const ReferenceElement& element) {
  if (element.dimension != 3) return Family::other;
  constexpr int kMaxOrder = 3;
  if (element.order <= kMaxOrder) {
    if (element.corner_count == 4) return Family::tetrahedron;
    if (element.corner_count == 5) return Family::pyramid;
    if (element.corner_count == 6) return Family::prism;
    if (element.corner_count == 8) return Family::hexahedron;
  }
  throw InputError(
      fmt::format("element type '{}' is not supported; expected tetrahedra, "
                  "hexahedra, prisms or pyramids of order 1 to {}",
                  element.name, kMaxOrder));
}

/// Corner cycles, counter-clockwise seen from outside (Gmsh's corner order,
/// Gmsh reference manual, "Node ordering").
std::vector<std::vector<int>> corner_faces(Family family) {
  switch (family) {
    case Family::tetrahedron:
      return {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
    case Family::hexahedron:
      return {{0, 3, 2, 1}, {0, 1, 5, 4}, {0, 4, 7, 3},
              {1, 2, 6, 5}, {2, 3, 7, 6}, {4, 5, 6, 7}};
    case Family::prism:
      return {{0, 2, 1}, {3, 4, 5}, {0, 1, 4, 3}, {0, 3, 5, 2}, {1, 2, 5, 4}};
    case Family::pyramid:
      return {{0, 3, 2, 1}, {0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}};
    case Family::other:
      break;
  }
  return {};
}

/// A face's nodes are those on the plane of its corners.
std::vector<int> nodes_on_face(const ReferenceElement& element,
                               const std::vector<int>& corners) {
  const Vector3 origin = element.node_uvw.col(corners[0]);
  const Vector3 a = element.node_uvw.col(corners[1]) - origin;
  const Vector3 b = element.node_uvw.col(corners[2]) - origin;
  const Vector3 normal = a.cross(b).normalized();
  constexpr double kOnPlane = 1e-9;
  std::vector<int> nodes = corners;
  for (int node = element.corner_count; node < element.node_count; ++node) {
    const Vector3 offset = element.node_uvw.col(node) - origin;
    if (std::abs(normal.dot(offset)) < kOnPlane) nodes.push_back(node);
  }
  return nodes;
}

void tabulate_basis(const ReferenceElement& element,
                    const std::vector<double>& uvw, Quadrature& table) {
  int components = 0;
  int orientations = 0;
  std::vector<double> values;
  std::vector<double> gradients;
  gmsh::model::mesh::getBasisFunctions(element.gmsh_type, uvw, "Lagrange",
                                       components, values, orientations);
  gmsh::model::mesh::getBasisFunctions(element.gmsh_type, uvw, "GradLagrange",
                                       components, gradients, orientations);
  const auto points = static_cast<Eigen::Index>(uvw.size() / 3);
  table.shape =
      Eigen::Map<const MatrixX>(values.data(), element.node_count, points);
  table.gradients.clear();
  for (Eigen::Index point = 0; point < points; ++point)
    table.gradients.emplace_back(Eigen::Map<const MatrixX>(
        gradients.data() + 3 * element.node_count * point, 3,
        element.node_count));
}

/// Length, area or volume of the reference element.
double reference_measure(const ReferenceElement& element, Family family) {
  switch (family) {
    case Family::tetrahedron:
      return 1.0 / 6.0;
    case Family::hexahedron:
      return 8.0;
    case Family::prism:
      return 1.0;
    case Family::pyramid:
      return 4.0 / 3.0;
    case Family::other:
      break;
  }
  if (element.dimension == 1) return 2.0;
  return element.corner_count == 3 ? 0.5 : 4.0;
}

/// Gmsh's rule. Its weights are scaled to the reference measure: for pyramids
/// Gmsh 4.8 has 4/3 of it, and some of its tables are rounded to 11 digits.
Quadrature make_quadrature(const ReferenceElement& element, Family family,
                           int degree) {
  std::vector<double> uvw;
  std::vector<double> weights;
  gmsh::model::mesh::getIntegrationPoints(
      element.gmsh_type, fmt::format("Gauss{}", degree), uvw, weights);
  Quadrature table;
  table.weights = Eigen::Map<const VectorX>(
      weights.data(), static_cast<Eigen::Index>(weights.size()));
  table.weights *= reference_measure(element, family) / table.weights.sum();
  tabulate_basis(element, uvw, table);
  return table;
}

/// Degrees that integrate exactly, for order p. Simplices have total degree
/// 2p (mass) and 2(p - 1) (stiffness); tensor elements have 2p per direction
/// for both, and Gmsh's cheaper non-tensor rules for hexahedra below degree 4
/// are exact in total degree only. A varying Jacobian adds its own degree,
/// 3(p - 1) on simplices and 3p - 1 on the others. Pyramids' functions are
/// rational; two more degrees bring their error to roundoff.
struct Degrees {
  int mass, curved, stiffness;
};
Degrees degrees_of(const ReferenceElement& element, Family family) {
  const int p = element.order;
  switch (family) {
    case Family::tetrahedron:
      return {2 * p, 2 * p + 3 * (p - 1), std::max(1, 2 * (p - 1))};
    case Family::hexahedron:
    case Family::prism:
      return {std::max(4, 2 * p), 5 * p, std::max(4, 2 * p)};
    case Family::pyramid:
      return {2 * p + 4, 5 * p + 4, 2 * p + 4};
    case Family::other:
      break;
  }
  return {2 * p, 3 * p, 2 * p};  // groups' elements: weights only
}

/// I - A^+ A with A = [1; u; v; w] at the nodes.
MatrixX affine_residual(const ReferenceElement& element) {
  MatrixX A(element.dimension + 1, element.node_count);
  A.row(0).setOnes();
  A.bottomRows(element.dimension) = element.node_uvw.topRows(element.dimension);
  const MatrixX inverse =
      A.transpose() * dense::find_inverse(A * A.transpose());
  return MatrixX::Identity(element.node_count, element.node_count) -
         inverse * A;
}

/// Gmsh's rule for the plane reference triangle (0,0)-(1,0)-(0,1) or square
/// [-1, 1]^2, moved onto the face.
Quadrature make_face_rule(const ReferenceElement& element, std::size_t face,
                          int degree) {
  constexpr int kTriangle = 2;
  constexpr int kSquare = 3;
  const std::vector<int>& nodes = element.faces[face];
  const bool is_quad = element.face_corners[face] == 4;
  std::vector<double> plane;
  std::vector<double> weights;
  gmsh::model::mesh::getIntegrationPoints(is_quad ? kSquare : kTriangle,
                                          fmt::format("Gauss{}", degree), plane,
                                          weights);
  const Vector3 origin = element.node_uvw.col(nodes[0]);
  Eigen::Matrix<double, 3, 2> edges;
  edges.col(0) = element.node_uvw.col(nodes[1]) - origin;
  edges.col(1) = element.node_uvw.col(nodes[is_quad ? 3 : 2]) - origin;
  std::vector<double> uvw;
  for (std::size_t q = 0; q < weights.size(); ++q) {
    Eigen::Vector2d place(plane[3 * q], plane[3 * q + 1]);
    if (is_quad) place = 0.5 * (place.array() + 1.0);
    const Vector3 point = origin + edges * place;
    uvw.insert(uvw.end(), point.begin(), point.end());
  }
  Quadrature rule;
  rule.weights = Eigen::Map<const VectorX>(
      weights.data(), static_cast<Eigen::Index>(weights.size()));
  if (is_quad) rule.weights /= 4.0;
  tabulate_basis(element, uvw, rule);
  for (MatrixX& gradients : rule.gradients)
    gradients = (edges.transpose() * gradients).eval();
  return rule;
}

MatrixX padded_coordinates(const std::vector<double>& local, int dimension,
                           int node_count) {
  MatrixX uvw = MatrixX::Zero(3, node_count);
  if (dimension > 0)
    uvw.topRows(dimension) =
        Eigen::Map<const MatrixX>(local.data(), dimension, node_count);
  return uvw;
}

}  // namespace

ReferenceElement make_reference_element(int gmsh_type) {
  ReferenceElement element;
  element.gmsh_type = gmsh_type;
  std::vector<double> local;
  gmsh::model::mesh::getElementProperties(
      gmsh_type, element.name, element.dimension, element.order,
      element.node_count, local, element.corner_count);
  element.node_uvw =
      padded_coordinates(local, element.dimension, element.node_count);
  if (element.dimension == 0) return element;
  const Family family = family_of(element);
  const Degrees degrees = degrees_of(element, family);
  element.straight = make_quadrature(element, family, degrees.mass);
  element.curved = make_quadrature(element, family, degrees.curved);
  element.stiffness = make_quadrature(element, family, degrees.stiffness);
  element.affine_residual = affine_residual(element);
  for (const std::vector<int>& corners : corner_faces(family)) {
    element.faces.push_back(nodes_on_face(element, corners));
    element.face_corners.push_back(static_cast<int>(corners.size()));
    element.face_rules.push_back(
        make_face_rule(element, element.faces.size() - 1, 3 * element.order));
  }
  return element;
}

}  // namespace limber::fem
