// SPDX-License-Identifier: BSD-3-Clause
#include "limber/reduction/modal/krylov.hpp"

#include "limber/flexbody/modal/reduced_basis.hpp"
#include "limber/flexbody/model/multiply_mass.hpp"

namespace limber::flexbody {

MatrixX find_krylov_vectors(const ElasticBody& body, const MatrixX& first,
                            int terms, double drop_tolerance) {
  if (terms <= 1 || first.cols() == 0) return first;
  const Support& support = body.support;
  const auto make_orthonormal = [&](const MatrixX& vectors) {
    return orthonormalise(vectors, support.matrices.M_s, support.R,
                          drop_tolerance);
  };
  MatrixX all = make_orthonormal(first);
  MatrixX block = all;
  for (int n = 1; n < terms && block.cols() > 0; ++n) {
    const MatrixX next =
        body.inverse.solve(multiply_mass(support.matrices.M_s, block));
    MatrixX joined(all.rows(), all.cols() + next.cols());
    joined << all, next;
    joined = make_orthonormal(joined);
    block = joined.rightCols(joined.cols() - all.cols());
    all = std::move(joined);
  }
  return all;
}

}  // namespace limber::flexbody
