// SPDX-License-Identifier: BSD-3-Clause
#include "limber/reduction/manifold.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "limber/common/errors.hpp"
#include "limber/common/rotation.hpp"
#include "limber/fem/solid/second_order.hpp"
#include "limber/flexbody/elasticity/quadratic_strain.hpp"

namespace limber::flexbody {
namespace {

// Strains of this share of what their modes could have at most are round-off,
// or vanish by symmetry.
constexpr double kNoStrain = 1e-9;

Vector3 axial(const Matrix3& X) {
  return {X(2, 1) - X(1, 2), X(0, 2) - X(2, 0), X(1, 0) - X(0, 1)};
}

// A^+ with the range of `axes`, which are eigenvectors.
Matrix3 invert_on(const Matrix3X& axes, const Matrix3& A) {
  Matrix3 inverse = Matrix3::Zero();
  for (Eigen::Index k = 0; k < axes.cols(); ++k) {
    const Vector3 axis = axes.col(k);
    inverse += axis * axis.transpose() / axis.dot(A * axis);
  }
  return inverse;
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

std::vector<int> find_paired(const fem::Mesh& mesh, const MatrixX& Phi) {
  const VectorX ratios = fem::find_rotation_ratios(mesh, Phi);
  std::vector<int> paired;
  for (Eigen::Index k = 0; k < ratios.size(); ++k) {
    if (ratios[k] > kPairedRotation) paired.push_back(static_cast<int>(k));
  }
  return paired;
}

ManifoldFields make_manifold(const MeshedBody& body, const Recipe& recipe,
                             const MatrixX& Phi, const VectorX& lambda,
                             const Vector3& center, const Progress& progress) {
  report(progress, "second-order modes", 0.0);
  ManifoldFields made;
  made.tables.paired = find_paired(body.mesh, Phi);
  const std::vector<int>& paired = made.tables.paired;
  if (paired.size() > QuadraticStrain::kMostPaired) {
    throw InputError(
        fmt::format("body '{}': {} of its modes rotate more than they strain; "
                    "level nonlinear takes at most {}. Take fewer modes",
                    recipe.name, paired.size(), QuadraticStrain::kMostPaired));
  }
  const MatrixX Phi_P = Phi(Eigen::all, paired);
  const VectorX lambda_P = lambda(paired);
  const fem::SecondOrderTerms terms = fem::calc_second_order(
      body.mesh, find_materials(body.mesh, recipe), Phi_P);
  made.Theta = solve_fields(body, Phi_P, terms.loads);
  made.tables.Q = make_strains(terms, lambda_P);
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
  const Matrix3X wd = d * weights.asDiagonal();
  const Matrix3 S = wd * d.transpose();
  const Matrix3 A = S.trace() * Matrix3::Identity() - S;
  const Matrix3 inverse = invert_on(table.rotation_axes, A);
  const MatrixX theta = take_rows(Theta, nodes);
  const MatrixX phi = take_rows(Phi, nodes);
  const auto moment = [&](const MatrixX& fields, Eigen::Index column) {
    return Matrix3(fields.col(column).reshaped(3, d.cols()) * wd.transpose());
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
