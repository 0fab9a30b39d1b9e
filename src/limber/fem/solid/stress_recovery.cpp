// SPDX-License-Identifier: BSD-3-Clause
#include "limber/fem/solid/stress_recovery.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include "limber/common/dense/linear_solve.hpp"
#include "limber/common/dense/qr.hpp"
#include "limber/common/errors.hpp"
#include "limber/fem/mesh/mesh_checks.hpp"
#include "limber/fem/solid/element_matrices.hpp"
#include "limber/fem/solid/hooke.hpp"

namespace limber::fem {
namespace {

constexpr int kPrismCorners = 6;
constexpr int kBrickCorners = 8;

// Exponents of u, v, w.
using Exponents = std::array<int, 3>;

bool is_in_space(const ReferenceElement& element, const Exponents& e) {
  const int degree = element.order - 1;
  if (element.corner_count == kBrickCorners) return true;
  if (element.corner_count == kPrismCorners) return e[0] + e[1] <= degree;
  return e[0] + e[1] + e[2] <= degree;
}

std::vector<Exponents> list_terms(const ReferenceElement& element) {
  std::vector<Exponents> terms;
  for (int a = 0; a < element.order; ++a) {
    for (int b = 0; b < element.order; ++b) {
      for (int c = 0; c < element.order; ++c) {
        if (is_in_space(element, {a, b, c})) terms.push_back({a, b, c});
      }
    }
  }
  return terms;
}

// points x terms; @param uvw 3 x points
MatrixX evaluate(const std::vector<Exponents>& terms, const MatrixX& uvw) {
  MatrixX values(uvw.cols(), static_cast<Eigen::Index>(terms.size()));
  for (Eigen::Index q = 0; q < values.rows(); ++q) {
    for (Eigen::Index i = 0; i < values.cols(); ++i) {
      const Exponents& e = terms[static_cast<std::size_t>(i)];
      values(q, i) = std::pow(uvw(0, q), e[0]) * std::pow(uvw(1, q), e[1]) *
                     std::pow(uvw(2, q), e[2]);
    }
  }
  return values;
}

// The fits of one element type, for both rules of its stiffness.
struct Fits {
  explicit Fits(const ReferenceElement& element)
      : straight(make_stress_fit(element, element.stiffness)),
        curved(make_stress_fit(element, element.curved)) {}

  MatrixX straight;
  MatrixX curved;
};

// Stress of fields at an element's quadrature points.
struct ElementStress {
  MatrixX at;       // 6 x points of each field
  VectorX measure;  // a point [m^3]
  Matrix3X x;       // a point [m]
  bool is_straight = false;
};

// Hooke's law for the strain sym(h).
Vector6 calc_linear_stress(const Hooke& hooke, const Matrix3& h) {
  if (hooke.C)
    return to_components(hooke.calc_stress(0.5 * (h + h.transpose())));
  const LameConstants<double>& lame = hooke.lame;
  const double volumetric = lame.lambda * h.trace();
  Vector6 stress;
  stress << volumetric + 2.0 * lame.mu * h(0, 0),
      volumetric + 2.0 * lame.mu * h(1, 1),
      volumetric + 2.0 * lame.mu * h(2, 2), lame.mu * (h(0, 1) + h(1, 0)),
      lame.mu * (h(1, 2) + h(2, 1)), lame.mu * (h(0, 2) + h(2, 0));
  return stress;
}

// Adds to the gradients of pairs the products of their fields', whose symmetric
// part is the rest of Green's strain. @param H 3 rows a field, then a pair
void add_products(const std::vector<int>& paired, Eigen::Index fields,
                  MatrixX& H) {
  Eigen::Index row = 3 * fields;
  for (std::size_t i = 0; i < paired.size(); ++i) {
    const Matrix3 H_i = H.middleRows<3>(3 * Eigen::Index{paired[i]});
    for (std::size_t j = i; j < paired.size(); ++j, row += 3) {
      H.middleRows<3>(row) +=
          H_i.transpose() * H.middleRows<3>(3 * Eigen::Index{paired[j]});
    }
  }
}

// Adds the law's own second order to the stress of pairs.
void add_curvature(const PairedFields& second,
                   const LameConstants<double>& lame, const MatrixX& H,
                   Eigen::Index fields, Eigen::Ref<VectorX> stress) {
  Eigen::Index row = 6 * fields;
  for (std::size_t i = 0; i < second.paired.size(); ++i) {
    const Matrix3 H_i = H.middleRows<3>(3 * Eigen::Index{second.paired[i]});
    for (std::size_t j = i; j < second.paired.size(); ++j, row += 6) {
      stress.segment<6>(row) += to_components(calc_stress_curvature(
          second.law, lame, H_i,
          H.middleRows<3>(3 * Eigen::Index{second.paired[j]})));
    }
  }
}

// @param own 3 rows of each of `fields` fields, then of each pair x nodes
ElementStress calc_element_stress(const ReferenceElement& element,
                                  const Matrix3X& x, const MatrixX& own,
                                  Eigen::Index fields,
                                  const PairedFields& second,
                                  const ElasticMaterial& material) {
  const ElementGradients gradients = calc_gradients(element, x);
  const std::vector<Hooke> laws = list_laws(material, gradients.x);
  const Eigen::Index all = own.rows() / 3;
  ElementStress stress{MatrixX(6 * all, gradients.measure.size()),
                       gradients.measure, gradients.x,
                       is_parallel_sided(element, x)};
  for (Eigen::Index q = 0; q < stress.at.cols(); ++q) {
    const Hooke& hooke = laws[static_cast<std::size_t>(q)];
    MatrixX H = own * gradients.at[static_cast<std::size_t>(q)].transpose();
    add_products(second.paired, fields, H);
    for (Eigen::Index k = 0; k < all; ++k) {
      stress.at.col(q).segment<6>(6 * k) =
          calc_linear_stress(hooke, H.middleRows<3>(3 * k));
    }
    if (second.law != Elasticity::st_venant_kirchhoff) {
      add_curvature(second, hooke.lame, H, fields, stress.at.col(q));
    }
  }
  return stress;
}

// Adds int d C^-1 d dV of a material with 21 constants.
void add_anisotropic_energy(const MatrixX& difference, const VectorX& measure,
                            const Matrix3X& x, const ElasticMaterial& material,
                            MatrixX& sum) {
  const std::vector<Hooke> laws = list_laws(material, x);
  const bool varies = material.anisotropy->axes.is_cylindrical;
  MatrixX compliance;
  for (Eigen::Index q = 0; q < difference.cols(); ++q) {
    if (varies || q == 0)
      compliance = dense::find_inverse(*laws[static_cast<std::size_t>(q)].C);
    const auto d = difference.col(q).reshaped(6, sum.rows());
    sum.noalias() += measure[q] * (d.transpose() * compliance * d);
  }
}

// Adds int d C^-1 d dV. Weights of the rule may be negative.
void add_energy(const MatrixX& difference, const VectorX& measure,
                const ElasticMaterial& material, MatrixX& sum) {
  const Eigen::Index fields = sum.rows();
  constexpr Eigen::Index kTerms = 7;  // six components and the trace
  MatrixX parts(fields, kTerms * difference.cols());
  VectorX compliance(parts.cols());
  const double nu = material.poisson_ratio;
  for (Eigen::Index q = 0; q < difference.cols(); ++q) {
    for (Eigen::Index k = 0; k < fields; ++k) {
      const auto d = difference.col(q).segment<6>(6 * k);
      parts.row(k).segment<6>(kTerms * q) = d;
      parts(k, kTerms * q + 6) = d.head<3>().sum();
    }
    const double size = measure[q] / material.youngs_modulus;
    compliance.segment<3>(kTerms * q).setConstant(size * (1.0 + nu));
    compliance.segment<3>(kTerms * q + 3).setConstant(2.0 * size * (1.0 + nu));
    compliance[kTerms * q + 6] = -size * nu;
  }
  sum.noalias() += parts * compliance.asDiagonal() * parts.transpose();
}

class Recovery {
 public:
  Recovery(const Mesh& mesh, const std::vector<ElasticMaterial>& materials,
           const MatrixX& Phi, const PairedFields& second)
      : mesh_(mesh), materials_(materials), Phi_(Phi), second_(second) {
    IndexedMaterials indexed = index_materials(materials);
    material_of_region_ = std::move(indexed.of_region);
    result_.constants = std::move(indexed.constants);
    for (const ElementBlock& block : mesh.blocks) {
      fits_.emplace_back(*block.element);
    }
  }

  NodalStress run() {
    list_points();
    average();
    measure_averaging();
    return std::move(result_);
  }

 private:
  template <typename Visit>  // visit(block index, element)
  void for_each_element(const Visit& visit) const {
    for (std::size_t b = 0; b < mesh_.blocks.size(); ++b) {
      for (std::size_t e = 0; e < mesh_.blocks[b].size(); ++e) visit(b, e);
    }
  }

  [[nodiscard]] std::size_t region_of(std::size_t b, std::size_t e) const {
    return static_cast<std::size_t>(mesh_.blocks[b].regions[e]);
  }

  [[nodiscard]] std::vector<int> nodes_of(std::size_t b, std::size_t e) const {
    const ElementBlock& block = mesh_.blocks[b];
    const int* first = block.element_nodes(e);
    return {first, first + block.element->node_count};
  }

  void list_points() {
    std::vector<std::pair<int, int>> points;  // node, material
    for_each_element([&](std::size_t b, std::size_t e) {
      const int material = material_of_region_[region_of(b, e)];
      for (const int node : nodes_of(b, e)) points.emplace_back(node, material);
    });
    std::sort(points.begin(), points.end());
    points.erase(std::unique(points.begin(), points.end()), points.end());
    first_of_node_.assign(static_cast<std::size_t>(mesh_.x.cols()), 0);
    for (std::size_t i = points.size(); i-- > 0;) {
      first_of_node_[static_cast<std::size_t>(points[i].first)] =
          static_cast<int>(i);
    }
    for (const auto& [node, material] : points) {
      result_.nodes.push_back(node);
      result_.materials.push_back(material);
    }
  }

  // The points of an element's nodes.
  [[nodiscard]] std::vector<int> points_of(std::size_t b, std::size_t e) const {
    const int material = material_of_region_[region_of(b, e)];
    std::vector<int> points = nodes_of(b, e);
    for (int& point : points) {
      point = first_of_node_[static_cast<std::size_t>(point)];
      while (result_.materials[static_cast<std::size_t>(point)] != material) {
        ++point;
      }
    }
    return points;
  }

  // Rows of the fields at an element's nodes.
  static void take_nodes(const MatrixX& fields, const std::vector<int>& nodes,
                         Eigen::Index first, MatrixX& own) {
    for (Eigen::Index k = 0; k < fields.cols(); ++k) {
      for (Eigen::Index a = 0; a < own.cols(); ++a) {
        own.block<3, 1>(3 * (first + k), a) = fields.block<3, 1>(
            3 * Eigen::Index{nodes[static_cast<std::size_t>(a)]}, k);
      }
    }
  }

  [[nodiscard]] ElementStress stress_of(std::size_t b, std::size_t e,
                                        const PairedFields& second) const {
    const std::vector<int> nodes = nodes_of(b, e);
    MatrixX own(3 * (Phi_.cols() + second.Theta.cols()), std::ssize(nodes));
    take_nodes(Phi_, nodes, 0, own);
    take_nodes(second.Theta, nodes, Phi_.cols(), own);
    return calc_element_stress(*mesh_.blocks[b].element,
                               mesh_.x(Eigen::all, nodes), own, Phi_.cols(),
                               second, materials_[region_of(b, e)]);
  }

  void average() {
    const auto count = static_cast<Eigen::Index>(result_.nodes.size());
    result_.stress.setZero(6 * (Phi_.cols() + second_.Theta.cols()), count);
    VectorX elements = VectorX::Zero(count);
    for_each_element([&](std::size_t b, std::size_t e) {
      const ElementStress own = stress_of(b, e, second_);
      const MatrixX& fit =
          own.is_straight ? fits_[b].straight : fits_[b].curved;
      const MatrixX nodal = own.at * fit.transpose();
      const std::vector<int> points = points_of(b, e);
      for (std::size_t a = 0; a < points.size(); ++a) {
        result_.stress.col(points[a]) +=
            nodal.col(static_cast<Eigen::Index>(a));
        elements[points[a]] += 1.0;
      }
    });
    for (Eigen::Index i = 0; i < count; ++i) {
      result_.stress.col(i) /= elements[i];
    }
  }

  void measure_averaging() {
    result_.averaging.setZero(Phi_.cols(), Phi_.cols());
    for_each_element([&](std::size_t b, std::size_t e) {
      ElementStress own = stress_of(b, e, {});
      const ReferenceElement& element = *mesh_.blocks[b].element;
      const Quadrature& rule =
          own.is_straight ? element.stiffness : element.curved;
      own.at -=
          result_.stress.topRows(own.at.rows())(Eigen::all, points_of(b, e)) *
          rule.shape;
      const ElasticMaterial& material = materials_[region_of(b, e)];
      if (material.anisotropy) {
        add_anisotropic_energy(own.at, own.measure, own.x, material,
                               result_.averaging);
      } else {
        add_energy(own.at, own.measure, material, result_.averaging);
      }
    });
    result_.averaging =
        (0.5 * (result_.averaging + result_.averaging.transpose())).eval();
  }

  const Mesh& mesh_;
  const std::vector<ElasticMaterial>& materials_;
  const MatrixX& Phi_;
  const PairedFields& second_;
  std::vector<int> material_of_region_;
  std::vector<Fits> fits_;          // one per block
  std::vector<int> first_of_node_;  // its first point
  NodalStress result_;
};

}  // namespace

MatrixX make_stress_fit(const ReferenceElement& element,
                        const Quadrature& rule) {
  const std::vector<Exponents> terms = list_terms(element);
  // Some rules have negative weights.
  const VectorX roots = rule.weights.cwiseAbs().cwiseSqrt();
  const MatrixX at_points =
      roots.asDiagonal() * evaluate(terms, element.node_uvw * rule.shape);
  const MatrixX coefficients =
      dense::solve_least_squares(at_points, MatrixX(roots.asDiagonal()));
  return evaluate(terms, element.node_uvw) * coefficients;
}

IndexedMaterials index_materials(
    const std::vector<ElasticMaterial>& materials) {
  IndexedMaterials indexed;
  auto& known = indexed.constants;
  for (const ElasticMaterial& material : materials) {
    const auto found =
        std::find_if(known.begin(), known.end(), [&](const auto& other) {
          return have_same_elasticity(other, material);
        });
    indexed.of_region.push_back(static_cast<int>(found - known.begin()));
    if (found == known.end()) known.push_back(material);
  }
  return indexed;
}

NodalStress recover_stress(const Mesh& mesh,
                           const std::vector<ElasticMaterial>& materials,
                           const MatrixX& Phi, const PairedFields& second) {
  const auto paired = std::ssize(second.paired);
  LIMBER_EXPECT(Phi.rows() == 3 * mesh.x.cols());
  LIMBER_EXPECT(second.Theta.cols() == paired * (paired + 1) / 2);
  LIMBER_EXPECT(paired == 0 || second.Theta.rows() == Phi.rows());
  LIMBER_EXPECT(materials.size() == mesh.volume_groups.size());
  return Recovery(mesh, materials, Phi, second).run();
}

}  // namespace limber::fem
