// SPDX-License-Identifier: BSD-3-Clause
#include "limber/reduction/matrices/free_system.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "limber/common/dense/linear_solve.hpp"
#include "limber/common/dense/symmetric_eigen.hpp"
#include "limber/common/errors.hpp"

namespace limber::flexbody {
namespace {

/// A displacement field quadratic in position and half its curl, of one row.
/// @param d position, scaled @param k of 9 monomials @param c component
double quadratic_entry(const fem::MatrixRow& row, const Vector3& d, int k,
                       int c, double scale) {
  const Eigen::Matrix<double, 9, 1> monomials{
      d[0],        d[1],        d[2],        d[0] * d[0], d[1] * d[1],
      d[2] * d[2], d[0] * d[1], d[1] * d[2], d[2] * d[0]};
  if (row.component < 3) return row.component == c ? monomials[k] : 0.0;
  Eigen::Matrix<double, 9, 3> gradient = Eigen::Matrix<double, 9, 3>::Zero();
  gradient.topRows<3>().setIdentity();
  for (int a = 0; a < 3; ++a) {
    const int b = (a + 1) % 3;
    gradient(3 + a, a) = 2.0 * d[a];
    gradient(6 + a, a) = d[b];
    gradient(6 + a, b) = d[a];
  }
  // curl of m e_c: component r is the derivative along the third axis.
  const int r = row.component - 3;
  if (r == c) return 0.0;
  const int third = 3 - r - c;
  const double sign = (c - r + 3) % 3 == 2 ? 1.0 : -1.0;
  return 0.5 * sign * gradient(k, third) / scale;
}

MatrixX make_quadratic_fields(const MatrixSystem& system,
                              const std::vector<int>& rows) {
  const Vector3 center = system.x.rowwise().mean();
  const double scale =
      std::max((system.x.colwise() - center).cwiseAbs().maxCoeff(), 1e-300);
  MatrixX fields = MatrixX::Zero(std::ssize(rows), 27);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const fem::MatrixRow& row = system.rows[static_cast<std::size_t>(rows[i])];
    if (row.node < 0 || row.component < 0) continue;
    const Vector3 d = (system.x.col(row.node) - center) / scale;
    for (int k = 0; k < 9; ++k)
      for (int c = 0; c < 3; ++c)
        fields(static_cast<Eigen::Index>(i), 3 * k + c) =
            quadratic_entry(row, d, k, c, scale);
  }
  return fields;
}

/// Ritz values and vectors of the part of V that has mass.
dense::Eigenpairs find_ritz(const fem::StructuralMatrices& matrices,
                            const MatrixX& V) {
  constexpr double kIndependent = 1e-10;
  const MatrixX M = V.transpose() * fem::multiply_mass(matrices.M_s, V);
  const MatrixX K = V.transpose() * fem::multiply_stiffness(matrices.K, V);
  const auto mass = dense::find_eigenpairs(MatrixX(0.5 * (M + M.transpose())));
  const double largest = mass.values[M.cols() - 1];
  const Eigen::Index kept =
      (mass.values.array() > kIndependent * largest).count();
  const MatrixX T =
      mass.vectors.rightCols(kept) *
      mass.values.tail(kept).cwiseSqrt().cwiseInverse().asDiagonal();
  const MatrixX reduced = T.transpose() * K * T;
  auto ritz =
      dense::find_eigenpairs(MatrixX(0.5 * (reduced + reduced.transpose())));
  ritz.vectors = T * ritz.vectors;
  return ritz;
}

/// Row whose own equations are the likely cause: the least K_ii.
std::string describe_softest(const MatrixSystem& system,
                             const std::vector<int>& rows,
                             const fem::StructuralMatrices& matrices) {
  Eigen::Index softest = 0;
  VectorX(matrices.K.diagonal()).minCoeff(&softest);
  return system.name_row(rows[static_cast<std::size_t>(softest)]);
}

constexpr double kShift = 0.01;  // of the first eigenvalue
constexpr double kTooFar = 0.1;  // refinement would take many steps

}  // namespace

std::vector<int> find_free_rows(const MatrixSystem& system,
                                const std::vector<int>& clamped) {
  std::vector<int> rows;
  for (int i = 0; i < system.row_count(); ++i) {
    const auto is_in = [i](const std::vector<int>& some) {
      return std::binary_search(some.begin(), some.end(), i);
    };
    if (!is_in(system.held) && !is_in(system.null) && !is_in(clamped))
      rows.push_back(i);
  }
  return rows;
}

fem::StructuralMatrices restrict_system(const MatrixSystem& system,
                                        const std::vector<int>& rows) {
  fem::StructuralMatrices matrices;
  if (std::ssize(rows) == system.row_count()) {
    matrices.M_s = system.M;
    matrices.K = system.K.triangularView<Eigen::Lower>();
    return matrices;
  }
  matrices.M_s = fem::restrict_matrix(system.M, rows);
  matrices.K =
      fem::restrict_matrix(system.K, rows).triangularView<Eigen::Lower>();
  return matrices;
}

MatrixX orthonormalise_rigid(const fem::StructuralMatrices& matrices,
                             const MatrixX& X) {
  // Scaled first: rotations and translations have other units.
  MatrixX R = X;
  for (int pass = 0; pass < 2; ++pass) {
    MatrixX B = R.transpose() * fem::multiply_mass(matrices.M_s, R);
    R = R * B.diagonal().cwiseSqrt().cwiseInverse().asDiagonal();
    B = R.transpose() * fem::multiply_mass(matrices.M_s, R);
    const auto L = dense::find_cholesky(MatrixX(0.5 * (B + B.transpose())));
    if (!L)
      throw InputError(
          "the mass matrix has no moment of inertia about some axis: a free "
          "body needs three. Give the model its rotary inertia, or clamp it");
    dense::divide_by_lower_transposed(*L, R);
  }
  return R;
}

FirstMode find_first_mode(const MatrixSystem& system,
                          const std::vector<int>& rows,
                          const fem::StructuralMatrices& matrices,
                          const MatrixX& R) {
  constexpr int kSteps = 4;
  const MatrixX MR = fem::multiply_mass(matrices.M_s, R);
  MatrixX V = make_quadratic_fields(system, rows);
  V -= R * (MR.transpose() * V);
  const bool is_free = R.cols() > 0;
  FirstMode first;
  first.shift = is_free ? -kShift * find_ritz(matrices, V).values[0] : 0.0;
  for (bool is_fine = false; !is_fine;) {
    std::unique_ptr<fem::ElasticInverse> inverse;
    try {
      inverse =
          std::make_unique<fem::ElasticInverse>(matrices, R, first.shift, "");
    } catch (const NumericalError& error) {
      throw InputError(fmt::format(
          "{}: the stiffness matrix is not positive {}: {}. Some part is a "
          "mechanism or held by nothing, or the file lacks entries; the "
          "softest "
          "row is {}",
          system.source, is_free ? "semidefinite" : "definite", error.what(),
          describe_softest(system, rows, matrices)));
    }
    dense::Eigenpairs ritz;
    for (int step = 0; step < kSteps; ++step) {
      V = inverse->solve_shifted(fem::multiply_mass(matrices.M_s, V));
      ritz = find_ritz(matrices, V);
      V = V * ritz.vectors;
    }
    first.lambda = ritz.values[0];
    first.phi = V.col(0);
    is_fine = !is_free || !(-first.shift > kTooFar * first.lambda) ||
              !(first.lambda > 0.0);
    if (!is_fine) first.shift = -kShift * first.lambda;
  }
  return first;
}

}  // namespace limber::flexbody
