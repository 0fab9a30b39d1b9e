// SPDX-License-Identifier: BSD-3-Clause
#include "limber/reduction/manifold.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "limber/common/dense/symmetric_eigen.hpp"
#include "limber/common/errors.hpp"
#include "limber/common/rotation.hpp"
#include "limber/fem/solid/second_order.hpp"
#include "limber/flexbody/elasticity/quadratic_strain.hpp"

namespace limber::flexbody {
namespace {

// Strains of this fraction of the largest that their modes could have are
// round-off, or vanish by symmetry.
constexpr double kNoStrain = 1e-9;

Vector3 axial(const Matrix3& X) {
  return {X(2, 1) - X(1, 2), X(0, 2) - X(2, 0), X(1, 0) - X(0, 1)};
}

// Modes with rotation above kPairedRotation.
std::vector<int> find_paired(const fem::MeanDeformation& mean) {
  const VectorX ratios = fem::find_rotation_ratios(mean);
  std::vector<int> paired;
  for (Eigen::Index k = 0; k < ratios.size(); ++k) {
    if (ratios[k] > kPairedRotation) paired.push_back(static_cast<int>(k));
  }
  return paired;
}

// theta: without what the paired modes themselves span.
MatrixX solve_fields(const MeshedBody& body, const MatrixX& Phi_P,
                     const MatrixX& loads) {
  const std::vector<int>& free = body.support.free_nodes;
  return -put_rows(
      body.inverse.solve(take_rows(loads, free), take_rows(Phi_P, free)), free,
      body.mesh.x.cols());
}

MatrixX make_strains(const fem::SecondOrderTerms& terms,
                     const VectorX& lambda_P) {
  MatrixX Q = terms.strain;
  for (Eigen::Index r = 0; r < Q.rows(); ++r) {
    const double root = std::sqrt(lambda_P[r]);
    Eigen::Index pair = 0;
    for (Eigen::Index i = 0; i < Q.rows(); ++i) {
      for (Eigen::Index j = i; j < Q.rows(); ++j, ++pair) {
        double& q = Q(r, pair);
        if (std::abs(q) <= kNoStrain * terms.scale(r, pair)) q = 0.0;
        q *= (i == j ? 0.5 : 1.0) / root;
      }
    }
  }
  return Q;
}

// Self-strains count from this fraction of the linear energy of their modes
// on, where these rotate or strain as much at most, root-mean-square.
// Bending beyond that strain has an energy of fourth degree, which
// displacements of third degree would remove: without them a slender bar
// would lock.
constexpr double kLeastSelfEnergy = 0.02;
constexpr double kReferenceRotation = 0.1;  // [rad]
constexpr double kReferenceStrain = 0.001;  // [-]

// c_ij of the products p_ij = c_ij q_i q_j.
VectorX find_pair_factors(Eigen::Index p) {
  VectorX c = VectorX::Ones(count_pairs(p));
  for (Eigen::Index i = 0, pair = 0; i < p; ++i) {
    c[pair] = 0.5;
    pair += p - i;
  }
  return c;
}

// Products where their modes are at the reference, over the root of the linear
// energies there: energies of pairs times their squares are fractions of these.
VectorX find_pair_scales(const fem::MeanDeformation& mean,
                         const VectorX& lambda) {
  const auto find_scale = [&](Eigen::Index k) {
    return std::sqrt(std::min(kReferenceRotation / mean.rotation[k],
                              kReferenceStrain / mean.strain[k])) /
           std::sqrt(std::sqrt(lambda[k]));
  };
  VectorX scale = find_pair_factors(lambda.size());
  Eigen::Index pair = 0;
  for (Eigen::Index i = 0; i < lambda.size(); ++i) {
    for (Eigen::Index j = i; j < lambda.size(); ++j, ++pair) {
      scale[pair] *= find_scale(i) * find_scale(j);
    }
  }
  return scale;
}

std::vector<int> choose_pairs(const VectorX& fractions) {
  std::vector<int> chosen;
  for (int pair = 0; pair < fractions.size(); ++pair) {
    if (fractions[pair] > kLeastSelfEnergy) chosen.push_back(pair);
  }
  return chosen;
}

// Rows whose squares add up to the energy W of products, significant ones only.
// @param scale of the products
MatrixX take_roots(const MatrixX& W, const VectorX& scale, Eigen::Index most) {
  const auto [fractions, shapes] = dense::find_eigenpairs(
      MatrixX(scale.asDiagonal() * W * scale.asDiagonal()));
  const Eigen::Index count = std::min<Eigen::Index>(
      (fractions.array() > kLeastSelfEnergy).count(), most);
  return fractions.tail(count).cwiseSqrt().asDiagonal() *
         shapes.rightCols(count).transpose() *
         scale.cwiseInverse().asDiagonal();
}

// The energy of the pairs' strains outside of the modal strains, as squares of
// significant self-strains. Slender bars have none. @param mean of Phi_P
MatrixX make_self_strains(const MeshedBody& body, const Recipe& recipe,
                          const fem::MeanDeformation& mean,
                          const MatrixX& Phi_P, const MatrixX& Theta,
                          const VectorX& lambda_P, const MatrixX& Q) {
  const auto materials = find_materials(body.mesh, recipe);
  const VectorX c = find_pair_factors(lambda_P.size());
  const VectorX scale = find_pair_scales(mean, lambda_P);
  // Q and self-strains are of q_i q_j, energies of the products.
  const MatrixX modal = Q * c.cwiseInverse().asDiagonal();
  const VectorX left =
      fem::calc_pair_energies(body.mesh, materials, Phi_P, Theta) -
      modal.colwise().squaredNorm().transpose();
  const std::vector<int> of =
      choose_pairs(left.cwiseProduct(scale.cwiseAbs2()));
  if (of.empty()) return MatrixX(0, scale.size());
  const MatrixX own = modal(Eigen::all, of);
  const MatrixX roots =
      take_roots(fem::calc_pair_energy(body.mesh, materials, Phi_P, Theta, of) -
                     own.transpose() * own,
                 scale(of), QuadraticStrain::kMostPaired - lambda_P.size());
  MatrixX self = MatrixX::Zero(roots.rows(), scale.size());
  self(Eigen::all, of) = roots * c(of).asDiagonal();
  return self;
}

// sym(int x theta' dm) of every pair.
Matrix6X make_integrals(const fem::SparseMatrix& M_s, const Matrix3X& x_B,
                        const MatrixX& Theta) {
  const Matrix3X xM = x_B * M_s;
  Matrix6X S2(6, Theta.cols());
  for (Eigen::Index pair = 0; pair < Theta.cols(); ++pair) {
    const Matrix3 Y = xM * Theta.col(pair).reshaped(3, x_B.cols()).transpose();
    const Matrix3 D = 0.5 * (Y + Y.transpose());
    S2.col(pair) << D(0, 0), D(1, 1), D(2, 2), D(0, 1), D(0, 2), D(1, 2);
  }
  return S2;
}

}  // namespace

ManifoldFields make_manifold(const MeshedBody& body, const Recipe& recipe,
                             const MatrixX& Phi, const VectorX& lambda,
                             const Vector3& center, const Progress& progress) {
  report(progress, "second-order modes", 0.0);
  ManifoldFields made;
  const fem::MeanDeformation mean = fem::find_mean_deformation(body.mesh, Phi);
  made.tables.paired = find_paired(mean);
  const std::vector<int>& paired = made.tables.paired;
  if (paired.size() > QuadraticStrain::kMostPaired) {
    throw InputError(
        fmt::format("body '{}': {} of its modes rotate more than they strain; "
                    "level nonlinear takes at most {}. Use fewer modes",
                    recipe.name, paired.size(), QuadraticStrain::kMostPaired));
  }
  const MatrixX Phi_P = Phi(Eigen::all, paired);
  const VectorX lambda_P = lambda(paired);
  const fem::SecondOrderTerms terms =
      fem::calc_second_order(body.mesh, find_materials(body.mesh, recipe),
                             find_elasticity(recipe.law), Phi_P);
  made.Theta = solve_fields(body, Phi_P, terms.loads);
  made.tables.Q = make_strains(terms, lambda_P);
  made.tables.self = make_self_strains(
      body, recipe, {mean.rotation(paired), mean.strain(paired)}, Phi_P,
      made.Theta, lambda_P, made.tables.Q);
  made.tables.S2 =
      make_integrals(body.M_s, body.mesh.x.colwise() - center, made.Theta);
  return made;
}

Matrix3X integrate(const fem::SparseMatrix& M_s, const MatrixX& Theta) {
  const VectorX mass =
      M_s.selfadjointView<Eigen::Lower>() * VectorX::Ones(M_s.cols());
  Matrix3X P(3, Theta.cols());
  for (Eigen::Index pair = 0; pair < Theta.cols(); ++pair) {
    P.col(pair) = Theta.col(pair).reshaped(3, mass.size()) * mass;
  }
  return P;
}

void add_second_order(const fem::Mesh& mesh, const Interface& interface,
                      const std::vector<int>& paired, const MatrixX& Phi,
                      const MatrixX& Theta, InterfaceTable& table) {
  const std::vector<int>& nodes = interface.selection.nodes;
  const VectorX& weights = interface.selection.weights;
  const Matrix3X d =
      mesh.x(Eigen::all, nodes).colwise() - interface.motion.mean_point();
  const Matrix3X& y = interface.selection.moments;
  const Matrix3 S = d * y.transpose();
  const Matrix3 A = S.trace() * Matrix3::Identity() - S;
  const Matrix3 inverse = invert_second_moment(A, table.rotation_axes);
  const MatrixX theta = take_rows(Theta, nodes);
  const MatrixX phi = take_rows(Phi, nodes);
  const auto moment = [&](const MatrixX& fields, Eigen::Index column) {
    return Matrix3(fields.col(column).reshaped(3, d.cols()) * y.transpose());
  };
  std::vector<Matrix3> G;
  for (const int k : paired) G.emplace_back(moment(phi, k));
  table.Phi2_B.resize(3, Theta.cols());
  table.Psi2_B = Matrix3X::Zero(3, Theta.cols());
  Eigen::Index pair = 0;
  for (std::size_t i = 0; i < paired.size(); ++i) {
    const Matrix3 P_i = skew(Vector3(table.Psi_B.col(paired[i])));
    for (std::size_t j = i; j < paired.size(); ++j, ++pair) {
      table.Phi2_B.col(pair) = theta.col(pair).reshaped(3, d.cols()) * weights;
      const Matrix3 P_j = skew(Vector3(table.Psi_B.col(paired[j])));
      const Matrix3 X = moment(theta, pair) - P_i * G[j] - P_j * G[i] +
                        0.5 * (P_i * P_j + P_j * P_i) * S;
      table.Psi2_B.col(pair) = inverse * axial(X);
    }
  }
}

}  // namespace limber::flexbody
