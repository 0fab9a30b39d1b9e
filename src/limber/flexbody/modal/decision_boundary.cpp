// SPDX-License-Identifier: BSD-3-Clause
#include "limber/flexbody/modal/decision_boundary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>
#include <vector>

#include "limber/common/dense/symmetric_eigen.hpp"
#include "limber/common/errors.hpp"

namespace limber::flexbody {
namespace {

void check_limit(double limit, const char* what, const char* unit) {
  if (limit > 0.0 && std::isfinite(limit)) return;
  throw InputError(
      fmt::format("decision boundary: the {} limit is {:g} {}; expected a "
                  "positive number.",
                  what, limit, unit));
}

/// m_n |b_n| [kg m].
VectorX find_levers(const VectorX& lumped_mass, const Matrix3X& x_B) {
  LIMBER_EXPECT(lumped_mass.size() == x_B.cols() && x_B.cols() > 0);
  return lumped_mass.cwiseProduct(x_B.colwise().norm().transpose());
}

/// max (Phi Lambda^-1 Phi^T g)_i, g_(3n+c) = m_n |b_n| [m s^2].
double find_report_displacement(const MatrixX& Phi, const VectorX& lambda,
                                const VectorX& levers) {
  if (lambda.size() == 0) return 0.0;
  const VectorX g = levers.transpose().replicate(3, 1).reshaped();
  const VectorX eta = (Phi.transpose() * g).cwiseQuotient(lambda);
  return (Phi * eta).cwiseAbs().maxCoeff();
}

/// G_k with a^T G_k a = phi_k . (-(a x (a x x))) integrated over the mass.
Matrix3 centrifugal_load(const Matrix3& S1) {
  return S1.trace() * Matrix3::Identity() - 0.5 * (S1 + S1.transpose());
}

/// c_k with e . c_k = -int phi_k . (e x x) dm.
Vector3 euler_load(const Matrix3& S1) {
  return {S1(2, 1) - S1(1, 2), S1(0, 2) - S1(2, 0), S1(1, 0) - S1(0, 1)};
}

/// Spectral radius of a symmetric matrix.
double spectral_radius(const Matrix3& symmetric) {
  return dense::find_eigenvalues(symmetric).cwiseAbs().maxCoeff();
}

/// Largest |L v| for |v| = 1.
template <typename Matrix>
double spectral_norm(const Matrix& L) {
  const Matrix3 square = L * L.transpose();
  return std::sqrt(std::max(0.0, spectral_radius(square)));
}

/// The symmetric matrix as a vector whose length is its Frobenius norm.
Vector6 flatten(const Matrix3& T) {
  const double root = std::sqrt(2.0);
  Vector6 v;
  v << T(0, 0), T(1, 1), T(2, 2), root * T(0, 1), root * T(0, 2),
      root * T(1, 2);
  return v;
}

/// Bound on |(a.T_x a, a.T_y a, a.T_z a)| over unit a, T the columns of
/// `flat`. The vector a a^T has Frobenius norm 1, and trace 1: the part of T
/// along the identity adds t/3, the rest meets a a^T - I/3 of norm sqrt(2/3).
double bound_quadratic(const std::array<Matrix3, 3>& T) {
  Eigen::Matrix<double, 3, 6> whole;
  Eigen::Matrix<double, 3, 6> rest;
  Vector3 mean;
  Vector3 radii;
  for (int c = 0; c < 3; ++c) {
    const Matrix3& T_c = T[static_cast<std::size_t>(c)];
    mean[c] = T_c.trace() / 3.0;
    whole.row(c) = flatten(T_c).transpose();
    rest.row(c) = flatten(T_c - mean[c] * Matrix3::Identity()).transpose();
    radii[c] = spectral_radius(T_c);
  }
  return std::min({radii.norm(), spectral_norm(whole),
                   mean.norm() + std::sqrt(2.0 / 3.0) * spectral_norm(rest)});
}

/// Loads of unit rotation on the modes, already divided by lambda.
struct ModalAnswers {
  std::vector<Matrix3> centrifugal;
  std::vector<Vector3> euler;
};

ModalAnswers find_answers(const ReducedBody& body) {
  const auto modes = static_cast<std::size_t>(body.mode_count());
  LIMBER_EXPECT(body.integrals.S1.size() == modes);
  LIMBER_EXPECT((body.lambda.array() > 0.0).all());
  ModalAnswers answers;
  for (std::size_t k = 0; k < modes; ++k) {
    const double lambda = body.lambda[static_cast<Eigen::Index>(k)];
    answers.centrifugal.emplace_back(centrifugal_load(body.integrals.S1[k]) /
                                     lambda);
    answers.euler.emplace_back(euler_load(body.integrals.S1[k]) / lambda);
  }
  return answers;
}

/// A and B of one node: the modes respond in phase.
std::pair<double, double> bound_slow(const Matrix3X& Phi_n,
                                     const ModalAnswers& answers) {
  std::array<Matrix3, 3> T{Matrix3::Zero(), Matrix3::Zero(), Matrix3::Zero()};
  Matrix3 L = Matrix3::Zero();
  for (std::size_t k = 0; k < answers.euler.size(); ++k) {
    const Vector3 phi = Phi_n.col(static_cast<Eigen::Index>(k));
    for (int c = 0; c < 3; ++c)
      T[static_cast<std::size_t>(c)] += phi[c] * answers.centrifugal[k];
    L += phi * answers.euler[k].transpose();
  }
  return {bound_quadratic(T), spectral_norm(L)};
}

/// Each mode may reach twice its static response, independently of the others.
std::pair<double, double> bound_sudden(const Matrix3X& Phi_n,
                                       const ModalAnswers& answers) {
  double A = 0.0;
  double B = 0.0;
  for (std::size_t k = 0; k < answers.euler.size(); ++k) {
    const double size = Phi_n.col(static_cast<Eigen::Index>(k)).norm();
    A += 2.0 * size * spectral_radius(answers.centrifugal[k]);
    B += 2.0 * size * answers.euler[k].norm();
  }
  return {A, B};
}

}  // namespace

InertialLevers calc_inertial_levers(const Eigen::SparseMatrix<double>& M_s,
                                    const Matrix3X& x_B, const MatrixX& Phi,
                                    const VectorX& lambda) {
  LIMBER_EXPECT(M_s.cols() == x_B.cols());
  LIMBER_EXPECT(Phi.rows() == 3 * x_B.cols() && Phi.cols() == lambda.size());
  LIMBER_EXPECT((lambda.array() > 0.0).all());
  const VectorX row_sums = M_s * VectorX::Ones(M_s.cols());
  const VectorX m_b = find_levers(row_sums, x_B);
  const Eigen::MatrixX3d moments = M_s * x_B.transpose();
  InertialLevers levers;
  levers.lumped = m_b.maxCoeff();
  levers.consistent = moments.rowwise().norm().maxCoeff();
  levers.displacement = find_report_displacement(Phi, lambda, m_b);
  return levers;
}

double find_report_force_boundary(const VectorX& lumped_mass,
                                  const Matrix3X& x_B, double force_limit) {
  check_limit(force_limit, "force", "N");
  const double lever = find_levers(lumped_mass, x_B).maxCoeff();
  if (!(lever > 0.0))
    throw NumericalError("decision boundary: no node has a positive m |b|");
  return force_limit / lever;
}

double find_report_displacement_boundary(const MatrixX& Phi,
                                         const VectorX& lambda,
                                         const VectorX& lumped_mass,
                                         const Matrix3X& x_B,
                                         double displacement_limit) {
  check_limit(displacement_limit, "displacement", "m");
  LIMBER_EXPECT(Phi.rows() == 3 * x_B.cols() && Phi.cols() == lambda.size());
  LIMBER_EXPECT(Phi.cols() > 0 && (lambda.array() > 0.0).all());
  const double displacement =
      find_report_displacement(Phi, lambda, find_levers(lumped_mass, x_B));
  if (!(displacement > 0.0))
    throw NumericalError("decision boundary: the modes displace no node");
  return displacement_limit / displacement;
}

InertialForceBound::InertialForceBound(const Matrix3X& moments)
    : lever_(moments.cols() > 0 ? moments.colwise().norm().maxCoeff() : 0.0) {}

double InertialForceBound::calc_force(double alpha, double Omega) const {
  const double half = 0.5 * Omega * Omega;
  return lever_ * (half + std::hypot(half, alpha));
}

double InertialForceBound::calc_margin(double alpha, double Omega,
                                       double force_limit) const {
  check_limit(force_limit, "force", "N");
  return calc_force(alpha, Omega) / force_limit;
}

InertialDisplacementBound::InertialDisplacementBound(const ReducedBody& body,
                                                     Onset onset) {
  if (body.clamped)
    throw InputError(
        fmt::format("body '{}' is clamped to the world and does not rotate: it "
                    "has no decision boundary.",
                    body.name));
  const ModalAnswers answers = find_answers(body);
  const Eigen::Index nodes = body.rows.x_B.cols();
  LIMBER_EXPECT(body.rows.Phi_B.rows() == 3 * nodes);
  LIMBER_EXPECT(body.rows.Phi_B.cols() == body.lambda.size());
  per_omega2_ = VectorX::Zero(nodes);
  per_alpha_ = VectorX::Zero(nodes);
  const auto bound = onset == Onset::slow ? bound_slow : bound_sudden;
  for (Eigen::Index n = 0; n < nodes; ++n)
    std::tie(per_omega2_[n], per_alpha_[n]) =
        bound(body.rows.Phi_B.middleRows<3>(3 * n), answers);
}

double InertialDisplacementBound::calc_displacement(double alpha,
                                                    double Omega) const {
  if (per_omega2_.size() == 0) return 0.0;
  return (per_omega2_ * (Omega * Omega) + per_alpha_ * std::abs(alpha))
      .maxCoeff();
}

double InertialDisplacementBound::calc_margin(double alpha, double Omega,
                                              double displacement_limit) const {
  check_limit(displacement_limit, "displacement", "m");
  return calc_displacement(alpha, Omega) / displacement_limit;
}

double InertialDisplacementBound::find_omega(double alpha,
                                             double displacement_limit) const {
  check_limit(displacement_limit, "displacement", "m");
  double omega2 = std::numeric_limits<double>::infinity();
  for (Eigen::Index n = 0; n < per_omega2_.size(); ++n) {
    const double left = displacement_limit - per_alpha_[n] * std::abs(alpha);
    if (left < 0.0) return 0.0;
    if (per_omega2_[n] > 0.0) omega2 = std::min(omega2, left / per_omega2_[n]);
  }
  return std::sqrt(omega2);
}

}  // namespace limber::flexbody
