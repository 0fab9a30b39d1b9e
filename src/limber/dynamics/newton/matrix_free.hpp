// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/IterativeLinearSolvers>
#include <Eigen/SparseCore>
#include <functional>

#include "limber/common/types.hpp"

namespace limber::dynamics {
class MatrixFree;
}  // namespace limber::dynamics

namespace Eigen::internal {
template <>
struct traits<limber::dynamics::MatrixFree>
    : public traits<Eigen::SparseMatrix<double>> {};
}  // namespace Eigen::internal

namespace limber::dynamics {

/// A linear map given by its product with a vector, for Eigen's iterative
/// solvers.
class MatrixFree : public Eigen::EigenBase<MatrixFree> {
 public:
  using Scalar = double;
  using RealScalar = double;
  using StorageIndex = int;
  enum {
    ColsAtCompileTime = Eigen::Dynamic,
    MaxColsAtCompileTime = Eigen::Dynamic,
    IsRowMajor = false
  };
  using Map = std::function<VectorX(const VectorX&)>;

  MatrixFree(Eigen::Index size, Map map) : size_(size), map_(std::move(map)) {}
  [[nodiscard]] Eigen::Index rows() const { return size_; }
  [[nodiscard]] Eigen::Index cols() const { return size_; }
  [[nodiscard]] VectorX apply(const VectorX& x) const { return map_(x); }

  template <typename Rhs>
  Eigen::Product<MatrixFree, Rhs, Eigen::AliasFreeProduct> operator*(
      const Eigen::MatrixBase<Rhs>& x) const {
    return {*this, x.derived()};
  }

 private:
  Eigen::Index size_;
  Map map_;
};

}  // namespace limber::dynamics

namespace Eigen::internal {

template <typename Rhs>
struct generic_product_impl<limber::dynamics::MatrixFree, Rhs, SparseShape,
                            DenseShape, GemvProduct>
    : generic_product_impl_base<
          limber::dynamics::MatrixFree, Rhs,
          generic_product_impl<limber::dynamics::MatrixFree, Rhs>> {
  template <typename Result>
  static void scaleAndAddTo(Result& result,
                            const limber::dynamics::MatrixFree& matrix,
                            const Rhs& x, double alpha) {
    result.noalias() += alpha * matrix.apply(x);
  }
};

}  // namespace Eigen::internal
