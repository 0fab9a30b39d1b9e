// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/analysis/stepped_motion.hpp"

#include <algorithm>
#include <cmath>

#include "limber/common/dense/linear_solve.hpp"

namespace limber::dynamics {
namespace {

using Index = Eigen::Index;

MatrixX raise(MatrixX base, long exponent) {
  MatrixX power = MatrixX::Identity(base.rows(), base.cols());
  for (; exponent > 0; exponent /= 2) {
    if (exponent % 2 == 1) power = base * power;
    base = (base * base).eval();
  }
  return power;
}

}  // namespace

// First rows of the parts of the vector.
struct SteppedMotion::Layout {
  Layout(Index n, Index states, const Inputs& in)
      : v(n),
        y(2 * n),
        a(states),
        vdot(a + n),
        last(vdot + n),
        inputs(last + in.by_value.cols()),
        slopes(inputs + in.by_value.cols()),
        steady(slopes + in.by_value.cols()),
        size(steady + in.by_steady.cols()) {}

  Index v, y, a, vdot, last, inputs, slopes, steady, size;
};

SteppedMotion::SteppedMotion(const MatrixX& A, Index coordinates,
                             const AlphaParameters& parameters, double step)
    : A_(A), n_(coordinates), p_(parameters), step_(step) {}

VectorX SteppedMotion::find_gains(double h) const {
  const VectorX rates = -A_.diagonal().tail(A_.rows() - 2 * n_);
  return rates.unaryExpr(
      [h](double rate) { return -std::expm1(-h * rate) / (h * rate); });
}

MatrixX SteppedMotion::find_matrix(double h) const {
  const VectorX s = A_.block(0, n_, n_, n_).diagonal();
  const Index r = A_.rows() - 2 * n_;
  MatrixX matrix = -h * p_.gamma * A_.block(n_, n_, n_, n_);
  matrix -= h * h * p_.beta *
            (A_.block(n_, 0, n_, n_) * s.asDiagonal() +
             A_.block(n_, 2 * n_, n_, r) * find_gains(h).asDiagonal() *
                 A_.block(2 * n_, n_, r, n_));
  matrix.diagonal().array() += (1.0 - p_.am) / (1.0 - p_.af);
  return matrix;
}

MatrixX SteppedMotion::find_jump(const Inputs& inputs, const Layout& at,
                                 double h) const {
  const Index m = inputs.by_value.cols();
  const double c = (1.0 - p_.am) / (1.0 - p_.af);
  const MatrixX force = inputs.by_value.middleRows(at.v, n_);
  const MatrixX change = c * dense::solve(find_matrix(h), force);
  MatrixX jump = MatrixX::Identity(at.size, at.size);
  for (const Index row : {at.a, at.vdot}) {
    jump.block(row, at.inputs, n_, m) = change;
    jump.block(row, at.last, n_, m) = -change;
  }
  jump.block(at.last, at.last, m, m).setZero();
  jump.block(at.last, at.inputs, m, m).setIdentity();
  return jump;
}

MatrixX SteppedMotion::find_step(const Inputs& inputs, const Layout& at,
                                 double h) const {
  const Index m = inputs.by_value.cols();
  const Index r = A_.rows() - 2 * n_;
  const VectorX s = A_.block(0, n_, n_, n_).diagonal();
  const VectorX g = find_gains(h);
  const MatrixX now = MatrixX::Identity(at.size, at.size);
  const auto a = now.middleRows(at.a, n_);
  const auto v = now.middleRows(at.v, n_);
  const auto E = A_.block(2 * n_, n_, r, n_);

  MatrixX next = now;
  next.block(at.inputs, at.slopes, m, m).diagonal().setConstant(h);
  next.middleRows(at.last, m) = next.middleRows(at.inputs, m);
  // The end for a_1 = 0.
  MatrixX moved = h * v + h * h * p_.lag * a;
  next.topRows(n_) += s.asDiagonal() * moved;
  next.middleRows(at.v, n_) += h * (1.0 - p_.gamma) * a;
  const VectorX kept = (h * A_.diagonal().tail(r)).unaryExpr([](double x) {
    return std::exp(x);
  });
  next.middleRows(at.y, r) =
      kept.asDiagonal() * now.middleRows(at.y, r) + g.asDiagonal() * E * moved;

  const auto find_rate = [&] {
    MatrixX rate = A_.middleRows(n_, n_) * next.topRows(A_.rows());
    rate += inputs.by_value.middleRows(n_, n_) * next.middleRows(at.inputs, m);
    rate += inputs.by_slope.middleRows(n_, n_) * next.middleRows(at.slopes, m);
    rate += inputs.by_steady.middleRows(n_, n_) *
            next.bottomRows(inputs.by_steady.cols());
    return rate;
  };
  const double c = 1.0 - p_.af;
  const MatrixX right =
      find_rate() - p_.am / c * a + p_.af / c * now.middleRows(at.vdot, n_);
  const MatrixX a_next = dense::solve(find_matrix(h), right);
  moved = h * h * p_.beta * a_next;
  next.topRows(n_) += s.asDiagonal() * moved;
  next.middleRows(at.v, n_) += h * p_.gamma * a_next;
  next.middleRows(at.y, r) += g.asDiagonal() * E * moved;
  next.middleRows(at.a, n_) = a_next;
  next.middleRows(at.vdot, n_) = find_rate();
  return next;
}

MatrixX SteppedMotion::find_flow(const Inputs& inputs, double duration) const {
  constexpr double kRounding = 1e-9;
  const long count =
      std::max(1L, std::lround(std::ceil(duration / step_ - kRounding)));
  const double h = duration / static_cast<double>(count);
  const Layout at(n_, A_.rows(), inputs);
  return raise(find_step(inputs, at, h), count) * find_jump(inputs, at, h);
}

}  // namespace limber::dynamics
