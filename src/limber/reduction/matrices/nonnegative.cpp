// SPDX-License-Identifier: BSD-3-Clause
#include "limber/reduction/matrices/nonnegative.hpp"

#include <algorithm>
#include <vector>

#include "limber/common/errors.hpp"

namespace limber::flexbody {
namespace {

/// Columns that are positive, with their orthonormal basis: A_p = Q R.
class PassiveColumns {
 public:
  PassiveColumns(const MatrixX& A, const VectorX& b)
      : A_(A), b_(b), Q_(A.rows(), A.rows()), R_(A.rows(), A.rows()) {}

  [[nodiscard]] const std::vector<Eigen::Index>& columns() const {
    return columns_;
  }

  /// @returns false, without it, for a column that depends on the others.
  bool add(Eigen::Index column) {
    constexpr double kDependent = 1e-10;
    const Eigen::Index p = std::ssize(columns_);
    if (p == A_.rows()) return false;
    VectorX rest = A_.col(column);
    const double size = rest.norm();
    VectorX h = VectorX::Zero(p);
    for (int pass = 0; pass < 2; ++pass) {
      const VectorX part = Q_.leftCols(p).transpose() * rest;
      rest -= Q_.leftCols(p) * part;
      h += part;
    }
    const double length = rest.norm();
    if (length <= kDependent * size) return false;
    R_.col(p).head(p) = h;
    R_(p, p) = length;
    Q_.col(p) = rest / length;
    columns_.push_back(column);
    return true;
  }

  /// Only those that `keeps` selects.
  template <typename Keeps>
  void reduce(const Keeps& keeps) {
    std::vector<Eigen::Index> kept;
    std::copy_if(columns_.begin(), columns_.end(), std::back_inserter(kept),
                 keeps);
    columns_.clear();
    for (const Eigen::Index column : kept) add(column);
  }

  /// Least squares over these columns, beside columns().
  [[nodiscard]] VectorX solve() const {
    const Eigen::Index p = std::ssize(columns_);
    const VectorX projected = Q_.leftCols(p).transpose() * b_;
    return R_.topLeftCorner(p, p).triangularView<Eigen::Upper>().solve(
        projected);
  }

  /// b without its part in these columns.
  [[nodiscard]] VectorX find_rest() const {
    const auto Q = Q_.leftCols(std::ssize(columns_));
    return b_ - Q * (Q.transpose() * b_);
  }

 private:
  const MatrixX& A_;
  const VectorX& b_;
  MatrixX Q_;
  MatrixX R_;
  std::vector<Eigen::Index> columns_;
};

/// Moves x towards the solution of the passive columns, without those that
/// would become negative.
void step_inside(PassiveColumns& passive, VectorX& x) {
  for (;;) {
    const VectorX solution = passive.solve();
    double fraction = 1.0;
    Eigen::Index first = -1;
    for (Eigen::Index i = 0; i < solution.size(); ++i) {
      const Eigen::Index column =
          passive.columns()[static_cast<std::size_t>(i)];
      if (solution[i] > 0.0) continue;
      const double limit = x[column] / (x[column] - solution[i]);
      if (!(limit <= fraction)) continue;
      fraction = limit;
      first = column;
    }
    for (Eigen::Index i = 0; i < solution.size(); ++i) {
      double& value = x[passive.columns()[static_cast<std::size_t>(i)]];
      value += fraction * (solution[i] - value);
    }
    if (first < 0) return;
    x[first] = 0.0;
    for (const Eigen::Index column : passive.columns())
      if (x[column] < 0.0) x[column] = 0.0;
    passive.reduce([&](Eigen::Index column) { return x[column] > 0.0; });
  }
}

}  // namespace

NonnegativeFit fit_nonnegative(const MatrixX& A, const VectorX& b) {
  LIMBER_EXPECT(A.rows() == b.size() && b.norm() > 0.0);
  constexpr double kRoundoff = 1e-14;
  VectorX sizes = A.colwise().norm();
  sizes = (sizes.array() > 0.0).select(sizes, 1.0);
  const MatrixX unit = A * sizes.cwiseInverse().asDiagonal();
  const double size = b.norm();
  PassiveColumns passive(unit, b);
  VectorX x = VectorX::Zero(A.cols());
  VectorX rest = b;
  const Eigen::Index most = 3 * (A.rows() + A.cols());
  for (Eigen::Index step = 0; step < most; ++step) {
    VectorX gain = unit.transpose() * rest;
    for (const Eigen::Index column : passive.columns()) gain[column] = 0.0;
    bool is_added = false;
    while (!is_added) {
      Eigen::Index best = 0;
      if (!(gain.maxCoeff(&best) > kRoundoff * size)) break;
      is_added = passive.add(best);
      gain[best] = 0.0;
    }
    if (!is_added) break;
    step_inside(passive, x);
    const VectorX left = passive.find_rest();
    // Rounding would let columns come and go for ever.
    if (!(left.norm() < rest.norm())) break;
    rest = left;
  }
  return {x.cwiseQuotient(sizes),
          (A * x.cwiseQuotient(sizes) - b).norm() / size};
}

}  // namespace limber::flexbody
