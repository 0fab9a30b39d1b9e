// SPDX-License-Identifier: BSD-3-Clause
#include "limber/fem/solid/stiffness_product.hpp"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <numeric>

#include "limber/common/errors.hpp"
#include "limber/common/index.hpp"
#include "limber/fem/linalg/parallel.hpp"
#include "limber/fem/mesh/mesh_checks.hpp"
#include "limber/fem/solid/hyperelastic.hpp"

namespace limber::fem {
namespace {

using Real = long double;
using Matrix43 = Eigen::Matrix<double, 4, 3>;
using InverseMap =
    Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>;

/// du_i/dxi_j of displacements relative to node 0.
Matrix43 find_local_gradient(const MatrixX& gradients, const ElementField& d) {
  Matrix43 local = Matrix43::Zero();
  for (Eigen::Index a = 1; a < d.cols(); ++a)
    for (Eigen::Index j = 0; j < 3; ++j)
      local.col(j) += gradients(j, a) * d.col(a);
  return local;
}

/// w sigma J^-T: maps a local gradient of a shape function to a nodal force.
Matrix43 find_local_stress(const Matrix3& H, const Matrix3& inverse,
                           double measure, double lambda, double mu) {
  Matrix3 sigma = mu * (H + H.transpose());
  sigma.diagonal().array() += lambda * H.trace();
  Matrix43 stress = Matrix43::Zero();
  stress.topRows<3>() = measure * sigma * inverse.transpose();
  return stress;
}

}  // namespace

StiffnessProduct::StiffnessProduct(
    const Mesh& mesh, const std::vector<ElasticMaterial>& materials)
    : rows_(mesh.node_count()), row_count_(static_cast<int>(rows_.size())) {
  LIMBER_EXPECT(materials.size() == mesh.volume_groups.size());
  std::iota(rows_.begin(), rows_.end(), 0);
  auto elements = std::make_shared<Elements>();
  elements->blocks = mesh.blocks;
  elements->x = mesh.x;
  for (const ElementBlock& block : elements->blocks)
    for (std::size_t e = 0; e < block.size(); ++e)
      add_element(block, e, element_positions(mesh, block, e),
                  materials[static_cast<std::size_t>(block.regions[e])],
                  *elements);
  elements_ = std::move(elements);
  find_spread(materials);
}

void StiffnessProduct::add_element(const ElementBlock& block, std::size_t e,
                                   const Matrix3X& x,
                                   const ElasticMaterial& material,
                                   Elements& to) {
  const ReferenceElement& type = *block.element;
  const Quadrature& rule =
      is_parallel_sided(type, x) ? type.stiffness : type.curved;
  const auto [lambda, mu] = find_lame_constants(material);
  to.list.push_back({&rule, block.element_nodes(e), to.points.size(),
                     type.node_count, lambda, mu});
  const Matrix3X edges = x.colwise() - Vector3(x.col(0));
  for (Eigen::Index q = 0; q < rule.weights.size(); ++q) {
    const Matrix3 J =
        edges * rule.gradients[static_cast<std::size_t>(q)].transpose();
    Point& point = to.points.emplace_back();
    Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(
        point.inverse.data()) = J.inverse();
    point.measure = rule.weights[q] * J.determinant();
  }
}

void StiffnessProduct::find_spread(
    const std::vector<ElasticMaterial>& materials) {
  spread_.softest = spread_.stiffest = materials.front().youngs_modulus;
  for (const ElasticMaterial& material : materials) {
    spread_.softest = std::min(spread_.softest, material.youngs_modulus);
    spread_.stiffest = std::max(spread_.stiffest, material.youngs_modulus);
  }
  std::size_t index = 0;
  for (const ElementBlock& block : elements_->blocks)
    for (std::size_t e = 0; e < block.size(); ++e, ++index) {
      const Point& point =
          elements_->points[elements_->list[index].first_point];
      const Matrix3 inverse = Eigen::Map<const Matrix3>(point.inverse.data());
      const double flatness = inverse.norm() * inverse.inverse().norm();
      if (!(flatness > spread_.flatness)) continue;
      spread_.flatness = flatness;
      spread_.flattest =
          fmt::format("{} ({})", block.tags[e], block.element->name);
    }
}

StiffnessProduct StiffnessProduct::restrict_to(
    const std::vector<int>& nodes) const {
  std::vector<int> places(static_cast<std::size_t>(row_count_), -1);
  for (std::size_t i = 0; i < nodes.size(); ++i)
    places[static_cast<std::size_t>(nodes[i])] = static_cast<int>(i);
  StiffnessProduct part = *this;
  for (int& row : part.rows_)
    if (row >= 0) row = places[static_cast<std::size_t>(row)];
  part.row_count_ = static_cast<int>(nodes.size());
  return part;
}

// Displacements relative to node 0, without the rotation at the first point.
// The rotation is subtracted in extended precision: the rest is as small as the
// strain, so double precision suffices for it.
ElementField StiffnessProduct::find_deformation(const Element& element,
                                                const VectorX& u) const {
  const auto at = [&](int a, int i) -> Real {
    const int row = rows_[static_cast<std::size_t>(element.nodes[a])];
    return row < 0 ? 0.0 : u[3 * row + i];
  };
  std::array<Real, std::size_t{3} * kMostElementNodes> edge{};
  ElementField d = ElementField::Zero(4, element.node_count);
  for (int a = 1; a < element.node_count; ++a)
    for (int i = 0; i < 3; ++i) {
      Real& component = edge[index(3 * a + i)];
      component = at(a, i) - at(0, i);
      d(i, a) = static_cast<double>(component);
    }
  const Matrix3 H =
      find_local_gradient(element.rule->gradients[0], d).topRows<3>() *
      InverseMap(elements_->points[element.first_point].inverse.data());
  const Matrix3 turn = 0.5 * (H - H.transpose());
  for (int a = 1; a < element.node_count; ++a) {
    const Vector3 arm =
        elements_->x.col(element.nodes[a]) - elements_->x.col(element.nodes[0]);
    for (int i = 0; i < 3; ++i) {
      Real rest = edge[index(3 * a + i)];
      for (int j = 0; j < 3; ++j) rest -= Real{turn(i, j)} * arm[j];
      d(i, a) = static_cast<double>(rest);
    }
  }
  return d;
}

void StiffnessProduct::add_forces(const Element& element, const VectorX& u,
                                  std::vector<Real>& forces) const {
  const ElementField d = find_deformation(element, u);
  ElementField f = ElementField::Zero(4, element.node_count);
  const Quadrature& rule = *element.rule;
  for (std::size_t q = 0; q < rule.gradients.size(); ++q) {
    const Point& point = elements_->points[element.first_point + q];
    const MatrixX& gradients = rule.gradients[q];
    const Matrix3 inverse = InverseMap(point.inverse.data());
    const Matrix3 H = find_local_gradient(gradients, d).topRows<3>() * inverse;
    const Matrix43 stress = find_local_stress(H, inverse, point.measure,
                                              element.lambda, element.mu);
    for (Eigen::Index a = 1; a < f.cols(); ++a)
      for (Eigen::Index j = 0; j < 3; ++j)
        f.col(a) += gradients(j, a) * stress.col(j);
  }
  f.col(0) = -f.rightCols(f.cols() - 1).rowwise().sum();
  for (int a = 0; a < element.node_count; ++a) {
    const int row = rows_[static_cast<std::size_t>(element.nodes[a])];
    for (int i = 0; i < 3 && row >= 0; ++i)
      forces[index(3 * row + i)] += f(i, a);
  }
}

MatrixX StiffnessProduct::subtract_from(const MatrixX& F,
                                        const MatrixX& X) const {
  LIMBER_EXPECT(X.rows() == 3 * row_count_ && F.rows() == X.rows());
  LIMBER_EXPECT(F.cols() == X.cols());
  MatrixX rest(F.rows(), F.cols());
  const auto columns = static_cast<std::size_t>(X.cols());
  parallel_ranges(columns, [&](std::size_t begin, std::size_t end) {
    std::vector<Real> forces(static_cast<std::size_t>(X.rows()));
    for (std::size_t c = begin; c < end; ++c) {
      const auto column = static_cast<Eigen::Index>(c);
      std::fill(forces.begin(), forces.end(), Real{0});
      const VectorX u = X.col(column);
      for (const Element& element : elements_->list)
        add_forces(element, u, forces);
      for (Eigen::Index i = 0; i < X.rows(); ++i)
        rest(i, column) = static_cast<double>(
            F(i, column) - forces[static_cast<std::size_t>(i)]);
    }
  });
  return rest;
}

}  // namespace limber::fem
