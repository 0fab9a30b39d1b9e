// SPDX-License-Identifier: BSD-3-Clause
#include "limber/flexbody/model/shape_integrals.hpp"

#include <array>

#include "limber/common/errors.hpp"

namespace limber::flexbody {
namespace {

/// Rows of one component, N x m.
MatrixX component_rows(const MatrixX& Phi, Eigen::Index component) {
  return Phi(Eigen::seqN(component, Phi.rows() / 3, 3), Eigen::all);
}

}  // namespace

InertiaShapeIntegrals calc_shape_integrals(
    const Eigen::SparseMatrix<double>& M_s, const Matrix3X& x_B,
    const MatrixX& Phi_B) {
  LIMBER_EXPECT(x_B.cols() == M_s.cols());
  LIMBER_EXPECT(Phi_B.rows() == 3 * M_s.cols());
  const auto m = static_cast<std::size_t>(Phi_B.cols());
  const Eigen::MatrixX3d Mx = M_s * x_B.transpose();
  InertiaShapeIntegrals result;
  result.S0 = x_B * Mx;
  result.S0 = 0.5 * (result.S0 + result.S0.transpose()).eval();
  result.S1.assign(m, Matrix3::Zero());
  result.S2.assign(m * m, Matrix3::Zero());
  result.P.resize(3, Phi_B.cols());
  std::array<MatrixX, 3> phi;
  for (Eigen::Index a = 0; a < 3; ++a)
    phi[static_cast<std::size_t>(a)] = component_rows(Phi_B, a);
  for (Eigen::Index b = 0; b < 3; ++b) {
    const MatrixX& phi_b = phi[static_cast<std::size_t>(b)];
    const MatrixX M_phi = M_s * phi_b;
    result.P.row(b) = M_phi.colwise().sum();
    const MatrixX first = Mx.transpose() * phi_b;  // 3 x m
    for (std::size_t k = 0; k < m; ++k)
      result.S1[k].col(b) = first.col(static_cast<Eigen::Index>(k));
    for (Eigen::Index a = 0; a < 3; ++a) {
      const MatrixX second =
          phi[static_cast<std::size_t>(a)].transpose() * M_phi;
      for (std::size_t k = 0; k < m; ++k)
        for (std::size_t l = 0; l < m; ++l)
          result.S2[k * m + l](a, b) = second(static_cast<Eigen::Index>(k),
                                              static_cast<Eigen::Index>(l));
    }
  }
  return result;
}

}  // namespace limber::flexbody
