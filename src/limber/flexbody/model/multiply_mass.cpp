// SPDX-License-Identifier: BSD-3-Clause
#include "limber/flexbody/model/multiply_mass.hpp"

#include "limber/common/errors.hpp"

namespace limber::flexbody {

MatrixX multiply_mass(const Eigen::SparseMatrix<double>& M_s,
                      const MatrixX& X) {
  LIMBER_EXPECT(M_s.rows() == M_s.cols());
  if (X.rows() == M_s.cols()) return M_s * X;
  LIMBER_EXPECT(X.rows() == 3 * M_s.cols());
  MatrixX product(X.rows(), X.cols());
  for (Eigen::Index k = 0; k < X.cols(); ++k) {
    const Eigen::Map<const Matrix3X> nodal(X.col(k).data(), 3, M_s.cols());
    const Eigen::MatrixX3d column = M_s * nodal.transpose();
    Eigen::Map<Matrix3X>(product.col(k).data(), 3, M_s.cols()) =
        column.transpose();
  }
  return product;
}

}  // namespace limber::flexbody
