// SPDX-License-Identifier: BSD-3-Clause
#include "limber/fem/solid/second_order.hpp"

#include <cmath>
#include <numeric>
#include <utility>

#include "limber/common/dense/linear_solve.hpp"
#include "limber/common/errors.hpp"
#include "limber/fem/solid/element_matrices.hpp"
#include "limber/fem/solid/hooke.hpp"

namespace limber::fem {
namespace {

// Calls visit(block, e, nodes, gradients) of every element.
template <typename Visit>
void for_each_element(const Mesh& mesh, const Visit& visit) {
  for (const ElementBlock& block : mesh.blocks) {
    for (std::size_t e = 0; e < block.size(); ++e) {
      const int* first = block.element_nodes(e);
      const std::vector<int> nodes(first, first + block.element->node_count);
      visit(block, e, nodes,
            calc_gradients(*block.element, mesh.x(Eigen::all, nodes)));
    }
  }
}

// The same with the law at its points: visit(laws, nodes, gradients).
template <typename Visit>
void for_each_element(const Mesh& mesh,
                      const std::vector<ElasticMaterial>& materials,
                      const Visit& visit) {
  LIMBER_EXPECT(materials.size() == mesh.volume_groups.size());
  for_each_element(mesh, [&](const ElementBlock& block, std::size_t e,
                             const std::vector<int>& nodes,
                             const ElementGradients& gradients) {
    visit(list_laws(materials[static_cast<std::size_t>(block.regions[e])],
                    gradients.x),
          nodes, gradients);
  });
}

// i <= j of p fields in the order 11, 12, .., 1p, 22, ..
std::vector<std::pair<int, int>> list_pairs(Eigen::Index p) {
  std::vector<std::pair<int, int>> pairs;
  for (int i = 0; i < p; ++i) {
    for (int j = i; j < p; ++j) pairs.emplace_back(i, j);
  }
  return pairs;
}

// The fields at an element's nodes: 3k x nodes, field by field.
MatrixX gather(const MatrixX& Phi, const std::vector<int>& nodes) {
  MatrixX own(3 * Phi.cols(), static_cast<Eigen::Index>(nodes.size()));
  for (Eigen::Index k = 0; k < Phi.cols(); ++k) {
    for (Eigen::Index a = 0; a < own.cols(); ++a) {
      own.block<3, 1>(3 * k, a) = Phi.block<3, 1>(
          3 * Eigen::Index{nodes[static_cast<std::size_t>(a)]}, k);
    }
  }
  return own;
}

Matrix3 symmetric_part(const Matrix3& H) { return 0.5 * (H + H.transpose()); }

// One quadrature point's gradients and stresses of all fields.
struct Point {
  std::vector<Matrix3> H;
  std::vector<Matrix3> S;
  std::vector<double> norms;  // |H|
};

void fill(const MatrixX& own, const Matrix3X& gradients, const Hooke& hooke,
          Point& point) {
  const MatrixX H = own * gradients.transpose();  // 3k x 3
  for (std::size_t k = 0; k < point.H.size(); ++k) {
    point.H[k] = H.middleRows<3>(3 * static_cast<Eigen::Index>(k));
    point.S[k] = hooke.calc_stress(symmetric_part(point.H[k]));
    point.norms[k] = point.H[k].norm();
  }
}

// Factors of the products of components in a double contraction.
const Vector6 kContraction{{1.0, 1.0, 1.0, 2.0, 2.0, 2.0}};

// At the points of an element, six rows per point of tensors and one of norms;
// those of fields contain the factors of the integral.
class PointTensors {
 public:
  PointTensors(Eigen::Index points, Eigen::Index fields, Eigen::Index pairs)
      : stress_(6 * points, fields),
        strain_(6 * points, fields),
        pair_strain_(6 * points, pairs),
        curvature_(6 * points, pairs),
        stress_norm_(points, fields),
        pair_size_(points, pairs) {}

  void set_field(Eigen::Index q, Eigen::Index k, const Matrix3& H,
                 const Matrix3& S, double measure) {
    stress_.col(k).segment<6>(6 * q) =
        measure * kContraction.cwiseProduct(to_components(S));
    strain_.col(k).segment<6>(6 * q) =
        measure / 3.0 *
        kContraction.cwiseProduct(to_components(symmetric_part(H)));
    stress_norm_(q, k) = measure * S.norm();
  }
  void set_pair(Eigen::Index q, Eigen::Index pair, const Matrix3& E,
                const Matrix3& A, double size) {
    pair_strain_.col(pair).segment<6>(6 * q) = to_components(E);
    curvature_.col(pair).segment<6>(6 * q) = to_components(A);
    pair_size_(q, pair) = size;
  }
  void add_integrals(Elasticity law, SecondOrderTerms& terms) const {
    terms.strain.noalias() += stress_.transpose() * pair_strain_;
    if (law != Elasticity::st_venant_kirchhoff) {
      terms.strain.noalias() += strain_.transpose() * curvature_;
    }
    terms.scale.noalias() += stress_norm_.transpose() * pair_size_;
  }

 private:
  MatrixX stress_, strain_;
  MatrixX pair_strain_, curvature_;
  MatrixX stress_norm_, pair_size_;
};

// Sets point q's tensors and its stresses T of g, 3 pairs x 3.
void set_point(const Point& point, const Hooke& hooke, Elasticity law,
               double measure, Eigen::Index q, PointTensors& tensors,
               MatrixX& T) {
  const std::size_t p = point.H.size();
  Eigen::Index pair = 0;
  for (std::size_t i = 0; i < p; ++i) {
    tensors.set_field(q, static_cast<Eigen::Index>(i), point.H[i], point.S[i],
                      measure);
    for (std::size_t j = i; j < p; ++j, ++pair) {
      const Matrix3 E = symmetric_part(point.H[i].transpose() * point.H[j]);
      const Matrix3 A =
          calc_stress_curvature(law, hooke.lame, point.H[i], point.H[j]);
      T.middleRows<3>(3 * pair) =
          measure * (hooke.calc_stress(E) + point.H[i] * point.S[j] +
                     point.H[j] * point.S[i] + A);
      tensors.set_pair(q, pair, E, A, point.norms[i] * point.norms[j]);
    }
  }
}

constexpr Eigen::Index kTerms = 7;  // six components and the trace

// Factors of the squares of a point's terms in 2 (energy). Of an anisotropic
// law, C = L L', the strains become L' gamma.
void weigh_terms(const Hooke& hooke, double measure,
                 Eigen::Ref<MatrixX> strains, Eigen::Ref<VectorX> weights) {
  if (!hooke.C) {
    weights << 2.0 * hooke.lame.mu * measure * kContraction,
        hooke.lame.lambda * measure;
    return;
  }
  const MatrixX L = dense::find_cholesky(MatrixX(*hooke.C)).value();
  const Vector6 to_engineering{{1.0, 1.0, 1.0, 2.0, 2.0, 2.0}};
  strains.leftCols<6>() =
      (strains.leftCols<6>() * to_engineering.asDiagonal() * L).eval();
  strains.col(6).setZero();
  weights.setConstant(measure);
}

// Calls visit(strains, weights) of every element: the strains of pairs at its
// points, six components and the trace, pairs x 7 points, and the factors of
// their squares in 2 (energy).
template <typename Visit>
void for_each_strain(const Mesh& mesh,
                     const std::vector<ElasticMaterial>& materials,
                     const MatrixX& Phi, const MatrixX& Theta,
                     const std::vector<int>& of, const Visit& visit) {
  const std::vector<std::pair<int, int>> pairs = list_pairs(Phi.cols());
  const MatrixX theta = Theta(Eigen::all, of);
  MatrixX strains;
  VectorX weights;
  for_each_element(
      mesh, materials,
      [&](const std::vector<Hooke>& laws, const std::vector<int>& nodes,
          const ElementGradients& gradients) {
        const MatrixX own = gather(Phi, nodes);
        const MatrixX second = gather(theta, nodes);
        const Eigen::Index points = gradients.measure.size();
        strains.resize(std::ssize(of), kTerms * points);
        weights.resize(kTerms * points);
        for (Eigen::Index q = 0; q < points; ++q) {
          const Matrix3X& at = gradients.at[static_cast<std::size_t>(q)];
          const MatrixX H = own * at.transpose();
          const MatrixX H2 = second * at.transpose();
          for (Eigen::Index k = 0; k < strains.rows(); ++k) {
            const auto [i, j] = pairs[static_cast<std::size_t>(
                of[static_cast<std::size_t>(k)])];
            const Matrix3 E = symmetric_part(
                H2.middleRows<3>(3 * k) +
                H.middleRows<3>(3 * i).transpose() * H.middleRows<3>(3 * j));
            strains.row(k).segment<kTerms>(kTerms * q)
                << to_components(E).transpose(),
                E.trace();
          }
          weigh_terms(laws[static_cast<std::size_t>(q)], gradients.measure[q],
                      strains.middleCols<kTerms>(kTerms * q),
                      weights.segment<kTerms>(kTerms * q));
        }
        visit(strains, weights);
      });
}

}  // namespace

MeanDeformation find_mean_deformation(const Mesh& mesh, const MatrixX& Phi) {
  LIMBER_EXPECT(Phi.rows() == 3 * mesh.x.cols());
  VectorX rotation = VectorX::Zero(Phi.cols());
  VectorX strain = VectorX::Zero(Phi.cols());
  double volume = 0.0;
  for_each_element(mesh, [&](const ElementBlock& /*block*/, std::size_t /*e*/,
                             const std::vector<int>& nodes,
                             const ElementGradients& gradients) {
    const MatrixX own = gather(Phi, nodes);
    for (std::size_t q = 0; q < gradients.at.size(); ++q) {
      const MatrixX all = own * gradients.at[q].transpose();
      const double measure = gradients.measure[static_cast<Eigen::Index>(q)];
      for (Eigen::Index k = 0; k < Phi.cols(); ++k) {
        const Matrix3 H = all.middleRows<3>(3 * k);
        rotation[k] += 0.125 * measure * (H - H.transpose()).squaredNorm();
        strain[k] += 0.25 * measure * (H + H.transpose()).squaredNorm();
      }
      volume += measure;
    }
  });
  return {(rotation / volume).cwiseSqrt(), (strain / volume).cwiseSqrt()};
}

VectorX find_rotation_ratios(const MeanDeformation& mean) {
  return std::sqrt(2.0) * mean.rotation.cwiseQuotient(mean.strain);
}

SecondOrderTerms calc_second_order(
    const Mesh& mesh, const std::vector<ElasticMaterial>& materials,
    Elasticity law, const MatrixX& Phi) {
  LIMBER_EXPECT(Phi.rows() == 3 * mesh.x.cols());
  const Eigen::Index p = Phi.cols();
  const Eigen::Index pairs = p * (p + 1) / 2;
  SecondOrderTerms terms{MatrixX::Zero(Phi.rows(), pairs),
                         MatrixX::Zero(p, pairs), MatrixX::Zero(p, pairs)};
  const auto count = static_cast<std::size_t>(p);
  Point point{std::vector<Matrix3>(count), std::vector<Matrix3>(count),
              std::vector<double>(count)};
  MatrixX T(3 * pairs, 3);
  MatrixX forces;  // 3 pairs x nodes of an element
  for_each_element(
      mesh, materials,
      [&](const std::vector<Hooke>& laws, const std::vector<int>& nodes,
          const ElementGradients& gradients) {
        const MatrixX own = gather(Phi, nodes);
        forces.setZero(3 * pairs, own.cols());
        PointTensors tensors(gradients.measure.size(), p, pairs);
        for (Eigen::Index q = 0; q < gradients.measure.size(); ++q) {
          const Matrix3X& at = gradients.at[static_cast<std::size_t>(q)];
          const Hooke& hooke = laws[static_cast<std::size_t>(q)];
          fill(own, at, hooke, point);
          set_point(point, hooke, law, gradients.measure[q], q, tensors, T);
          forces.noalias() += T * at;
        }
        tensors.add_integrals(law, terms);
        for (Eigen::Index a = 0; a < own.cols(); ++a) {
          const Eigen::Index row =
              3 * Eigen::Index{nodes[static_cast<std::size_t>(a)]};
          terms.loads.middleRows<3>(row) += forces.col(a).reshaped(3, pairs);
        }
      });
  return terms;
}

MatrixX calc_pair_energy(const Mesh& mesh,
                         const std::vector<ElasticMaterial>& materials,
                         const MatrixX& Phi, const MatrixX& Theta,
                         const std::vector<int>& of) {
  MatrixX W = MatrixX::Zero(std::ssize(of), std::ssize(of));
  for_each_strain(mesh, materials, Phi, Theta, of,
                  [&](const MatrixX& strains, const VectorX& weights) {
                    W.noalias() +=
                        strains * weights.asDiagonal() * strains.transpose();
                  });
  return 0.5 * (W + W.transpose());
}

VectorX calc_pair_energies(const Mesh& mesh,
                           const std::vector<ElasticMaterial>& materials,
                           const MatrixX& Phi, const MatrixX& Theta) {
  std::vector<int> all(static_cast<std::size_t>(Theta.cols()));
  std::iota(all.begin(), all.end(), 0);
  VectorX diagonal = VectorX::Zero(Theta.cols());
  for_each_strain(mesh, materials, Phi, Theta, all,
                  [&](const MatrixX& strains, const VectorX& weights) {
                    diagonal.noalias() += strains.cwiseAbs2() * weights;
                  });
  return diagonal;
}

}  // namespace limber::fem
