// SPDX-License-Identifier: BSD-3-Clause
#include "limber/common/dense/exponential.hpp"

#include <cmath>
#include <utility>

#include "limber/common/errors.hpp"

namespace limber::dense {
namespace {

constexpr int kTerms = 15;  // 0.5^16 / 16! is below round-off

// Halvings after which a norm is at most 1/2.
int count_halvings(double norm) {
  int exponent = 0;
  std::frexp(norm, &exponent);  // norm < 2^exponent
  return norm > 0.5 ? exponent + 1 : 0;
}

}  // namespace

Exponential::Exponential(Eigen::Index size)
    : scaled_(size, size),
      term_(size, size),
      sum_(size, size),
      next_(size, size) {}

const MatrixX& Exponential::operator()(const MatrixX& A) {
  LIMBER_EXPECT(A.rows() == sum_.rows() && A.cols() == sum_.cols());
  const double norm = A.cwiseAbs().rowwise().sum().maxCoeff();
  LIMBER_EXPECT(std::isfinite(norm));
  const int halvings = count_halvings(norm);
  scaled_ = std::ldexp(1.0, -halvings) * A;
  term_.setIdentity();
  sum_.setIdentity();
  for (int k = 1; k <= kTerms; ++k) {
    next_.noalias() = term_ * scaled_;
    term_ = next_ / k;
    sum_ += term_;
  }
  for (int i = 0; i < halvings; ++i) {
    next_.noalias() = sum_ * sum_;
    sum_.swap(next_);
  }
  return sum_;
}

}  // namespace limber::dense
