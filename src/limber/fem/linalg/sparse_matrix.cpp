// SPDX-License-Identifier: BSD-3-Clause
#include "limber/fem/linalg/sparse_matrix.hpp"

#include "limber/common/errors.hpp"
#include "limber/fem/linalg/parallel.hpp"

namespace limber::fem {

MatrixX multiply_mass(const SparseMatrix& M_s, const MatrixX& X) {
  MatrixX Y(X.rows(), X.cols());
  if (X.rows() == M_s.cols()) {
    parallel_ranges(static_cast<std::size_t>(X.cols()), [&](std::size_t begin,
                                                            std::size_t end) {
      const auto first = static_cast<Eigen::Index>(begin);
      const auto count = static_cast<Eigen::Index>(end) - first;
      Y.middleCols(first, count).noalias() = M_s * X.middleCols(first, count);
    });
    return Y;
  }
  LIMBER_EXPECT(X.rows() == 3 * M_s.cols());
  // Column j of the symmetric M_s is its row j: each node of each column
  // gathers alone.
  const auto nodes = static_cast<std::size_t>(M_s.cols());
  const auto columns = static_cast<std::size_t>(X.cols());
  parallel_ranges(nodes * columns, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const auto column = static_cast<Eigen::Index>(i / nodes);
      const auto j = static_cast<Eigen::Index>(i % nodes);
      const auto x = X.col(column);
      Vector3 sum = Vector3::Zero();
      for (SparseMatrix::InnerIterator it(M_s, j); it; ++it)
        sum += it.value() * x.segment<3>(3 * it.row());
      Y.col(column).segment<3>(3 * j) = sum;
    }
  });
  return Y;
}

MatrixX multiply_stiffness(const SparseMatrix& K_lower, const MatrixX& X) {
  LIMBER_EXPECT(X.rows() == K_lower.cols());
  MatrixX Y(X.rows(), X.cols());
  parallel_ranges(static_cast<std::size_t>(X.cols()), [&](std::size_t begin,
                                                          std::size_t end) {
    const auto first = static_cast<Eigen::Index>(begin);
    const auto count = static_cast<Eigen::Index>(end) - first;
    Y.middleCols(first, count).noalias() =
        K_lower.selfadjointView<Eigen::Lower>() * X.middleCols(first, count);
  });
  return Y;
}

SparseMatrix restrict_matrix(const SparseMatrix& full,
                             const std::vector<int>& kept) {
  std::vector<int> place(static_cast<std::size_t>(full.rows()), -1);
  for (std::size_t i = 0; i < kept.size(); ++i)
    place[static_cast<std::size_t>(kept[i])] = static_cast<int>(i);
  const auto size = static_cast<Eigen::Index>(kept.size());
  SparseMatrix part(size, size);
  for (Eigen::Index j = 0; j < size; ++j) {
    part.startVec(j);
    for (SparseMatrix::InnerIterator it(full,
                                        kept[static_cast<std::size_t>(j)]);
         it; ++it) {
      const int row = place[static_cast<std::size_t>(it.row())];
      if (row >= 0) part.insertBack(row, j) = it.value();
    }
  }
  part.finalize();
  return part;
}

}  // namespace limber::fem
