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
#include "limber/fem/solid/hooke.hpp"

namespace limber::fem {
namespace {

using Real = long double;
using InverseMap =
    Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>;

// Largest number C of columns multiplied at once.
constexpr int kColumns = 8;
template <int C>
using Columns = Eigen::Array<double, C, 1>;
template <int C>
using Tensor3 = std::array<std::array<Columns<C>, 3>, 3>;

// du_i/dxi_j of displacements relative to node 0.
template <int C, typename NodalColumns>
Tensor3<C> find_local_gradient(const MatrixX& gradients,
                               const NodalColumns& d) {
  Tensor3<C> local;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      Columns<C> sum = Columns<C>::Zero();
      for (Eigen::Index a = 1; a < gradients.cols(); ++a) {
        sum += gradients(static_cast<Eigen::Index>(j), a) *
               d[static_cast<std::size_t>(a)][i];
      }
      local[i][j] = sum;
    }
  }
  return local;
}

// A B
template <int C>
Tensor3<C> multiply(const Tensor3<C>& A, const Matrix3& B) {
  Tensor3<C> product;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      const auto column = static_cast<Eigen::Index>(j);
      product[i][j] = A[i][0] * B(0, column) + A[i][1] * B(1, column) +
                      A[i][2] * B(2, column);
    }
  }
  return product;
}

// sigma of the strain sym H.
template <int C>
Tensor3<C> calc_lane_stress(const Tensor3<C>& H, double lambda, double mu) {
  Tensor3<C> sigma;
  const Columns<C> volumetric = lambda * (H[0][0] + H[1][1] + H[2][2]);
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) sigma[i][j] = mu * (H[i][j] + H[j][i]);
    sigma[i][i] += volumetric;
  }
  return sigma;
}

template <int C>
Tensor3<C> calc_lane_stress(const Tensor3<C>& H, const Constants21& constants) {
  const std::array<Columns<C>, 6> gamma = {
      H[0][0],           H[1][1],           H[2][2],
      H[0][1] + H[1][0], H[1][2] + H[2][1], H[0][2] + H[2][0]};
  const auto s = multiply_constants<Columns<C>>(constants, gamma);
  return {{{s[0], s[3], s[5]}, {s[3], s[1], s[4]}, {s[5], s[4], s[2]}}};
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
                     type.node_count, lambda, mu,
                     material.anisotropy.has_value(), to.constants.size()});
  if (material.anisotropy) {
    for (const Hooke& hooke : list_laws(material, x * rule.shape))
      to.constants.push_back(list_constants(*hooke.C));
  }
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
template <int C>
void StiffnessProduct::find_deformation(const Element& element,
                                        const std::vector<double>& u,
                                        NodalColumns<C>& d) const {
  const auto at = [&](std::size_t a, std::size_t i, int c) -> Real {
    const int row = rows_[index(element.nodes[a])];
    return row < 0 ? 0.0 : u[(index(3 * row) + i) * C + index(c)];
  };
  const auto nodes = index(element.node_count);
  std::array<std::array<std::array<Real, C>, 3>, kMostElementNodes> edge;
  for (std::size_t a = 1; a < nodes; ++a) {
    for (std::size_t i = 0; i < 3; ++i) {
      for (int c = 0; c < C; ++c) {
        Real& component = edge[a][i][index(c)];
        component = at(a, i, c) - at(0, i, c);
        d[a][i][c] = static_cast<double>(component);
      }
    }
  }
  const Tensor3<C> H = multiply<C>(
      find_local_gradient<C>(element.rule->gradients[0], d),
      InverseMap(elements_->points[element.first_point].inverse.data()));
  Tensor3<C> rotation;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      rotation[i][j] = 0.5 * (H[i][j] - H[j][i]);
    }
  }
  for (std::size_t a = 1; a < nodes; ++a) {
    const Vector3 arm =
        elements_->x.col(element.nodes[a]) - elements_->x.col(element.nodes[0]);
    for (std::size_t i = 0; i < 3; ++i) {
      for (int c = 0; c < C; ++c) {
        Real rest = edge[a][i][index(c)];
        for (std::size_t j = 0; j < 3; ++j) {
          rest -= Real{rotation[i][j][c]} * arm[static_cast<Eigen::Index>(j)];
        }
        d[a][i][c] = static_cast<double>(rest);
      }
    }
  }
}

template <int C>
void StiffnessProduct::add_forces(const Element& element,
                                  const std::vector<double>& u,
                                  std::vector<Real>& forces) const {
  NodalColumns<C> d;
  find_deformation<C>(element, u, d);
  const auto nodes = index(element.node_count);
  NodalColumns<C> f;
  for (std::size_t a = 0; a < nodes; ++a) f[a].fill(Columns<C>::Zero());
  const Quadrature& rule = *element.rule;
  for (std::size_t q = 0; q < rule.gradients.size(); ++q) {
    const Point& point = elements_->points[element.first_point + q];
    const MatrixX& gradients = rule.gradients[q];
    const Matrix3 inverse = InverseMap(point.inverse.data());
    const Tensor3<C> H =
        multiply<C>(find_local_gradient<C>(gradients, d), inverse);
    // w sigma J^-T maps the local gradient of a shape function to its force.
    const Tensor3<C> stress = multiply<C>(
        element.is_anisotropic
            ? calc_lane_stress<C>(
                  H, elements_->constants[element.first_constants + q])
            : calc_lane_stress<C>(H, element.lambda, element.mu),
        point.measure * inverse.transpose());
    for (std::size_t a = 1; a < nodes; ++a) {
      const auto column = static_cast<Eigen::Index>(a);
      for (std::size_t i = 0; i < 3; ++i) {
        f[a][i] += gradients(0, column) * stress[i][0] +
                   gradients(1, column) * stress[i][1] +
                   gradients(2, column) * stress[i][2];
      }
    }
  }
  for (std::size_t a = 1; a < nodes; ++a) {
    for (std::size_t i = 0; i < 3; ++i) f[0][i] -= f[a][i];
  }
  for (std::size_t a = 0; a < nodes; ++a) {
    const int row = rows_[index(element.nodes[a])];
    if (row < 0) continue;
    for (std::size_t i = 0; i < 3; ++i) {
      for (int c = 0; c < C; ++c) {
        forces[(index(3 * row) + i) * C + index(c)] += f[a][i][c];
      }
    }
  }
}

template <int C>
void StiffnessProduct::subtract_columns(const MatrixX& F, const MatrixX& X,
                                        Eigen::Index first,
                                        MatrixX& rest) const {
  const auto size = static_cast<std::size_t>(X.rows()) * C;
  std::vector<double> u(size);
  std::vector<Real> forces(size);
  const auto place = [](Eigen::Index row, Eigen::Index column) {
    return static_cast<std::size_t>(C * row + column);
  };
  for (Eigen::Index c = 0; c < C; ++c) {
    for (Eigen::Index i = 0; i < X.rows(); ++i)
      u[place(i, c)] = X(i, first + c);
  }
  for (const Element& element : elements_->list) {
    add_forces<C>(element, u, forces);
  }
  for (Eigen::Index c = 0; c < C; ++c) {
    for (Eigen::Index i = 0; i < X.rows(); ++i) {
      rest(i, first + c) =
          static_cast<double>(F(i, first + c) - forces[place(i, c)]);
    }
  }
}

MatrixX StiffnessProduct::subtract_from(const MatrixX& F,
                                        const MatrixX& X) const {
  LIMBER_EXPECT(X.rows() == 3 * row_count_ && F.rows() == X.rows());
  LIMBER_EXPECT(F.cols() == X.cols());
  MatrixX rest(F.rows(), F.cols());
  // Groups of columns, then those that are left, one by one.
  const Eigen::Index groups = X.cols() / kColumns;
  const Eigen::Index single = X.cols() % kColumns;
  parallel_ranges(static_cast<std::size_t>(groups + single),
                  [&](std::size_t begin, std::size_t end) {
                    for (std::size_t k = begin; k < end; ++k) {
                      const auto part = static_cast<Eigen::Index>(k);
                      if (part < groups) {
                        subtract_columns<kColumns>(F, X, kColumns * part, rest);
                      } else {
                        subtract_columns<1>(
                            F, X, kColumns * groups + part - groups, rest);
                      }
                    }
                  });
  return rest;
}

}  // namespace limber::fem
