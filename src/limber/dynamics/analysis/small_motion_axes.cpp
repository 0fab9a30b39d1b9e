// SPDX-License-Identifier: BSD-3-Clause
#include <Eigen/SparseCore>
#include <algorithm>
#include <utility>

#include "limber/common/rotation.hpp"
#include "limber/dynamics/analysis/small_motion.hpp"

namespace limber::dynamics {
namespace {

using Index = Eigen::Index;
using Sparse = Eigen::SparseMatrix<double>;
using Entries = std::vector<Eigen::Triplet<double>>;

void add_block(Index row, const Matrix3& block, Entries& entries) {
  for (int j = 0; j < 3; ++j) {
    for (int i = 0; i < 3; ++i) {
      if (block(i, j) == 0.0) continue;
      entries.emplace_back(row + i, row + j, block(i, j));
    }
  }
}

Sparse assemble(Index size, const Entries& entries) {
  Sparse matrix(size, size);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

// Rotation from the axes to the frames of the state.
Sparse make_turn(const SmallMotion& motion, const SystemState& state,
                 const Matrix3& R) {
  Entries entries;
  std::vector<bool> is_turned(static_cast<std::size_t>(motion.size()));
  for (std::size_t b = 0; b < motion.places.size(); ++b) {
    const Index p = motion.places[b];
    if (p < 0) continue;
    const Matrix3 R_WB = state.bodies[b].quat_WB.toRotationMatrix();
    add_block(p, R, entries);
    add_block(p + 3, R_WB.transpose() * R, entries);
    std::fill_n(is_turned.begin() + p, 6, true);
  }
  for (Index i = 0; i < motion.size(); ++i) {
    if (!is_turned[static_cast<std::size_t>(i)])
      entries.emplace_back(i, i, 1.0);
  }
  return assemble(motion.size(), entries);
}

// W and V of the equation; empty where nothing rotates.
std::pair<Sparse, Sparse> make_spins(const SmallMotion& motion,
                                     const SystemState& state,
                                     const TurningAxes& axes) {
  Entries W;
  Entries V;
  const Vector3 w = axes.R.transpose() * axes.w_W;
  for (std::size_t b = 0; b < motion.places.size(); ++b) {
    const Index p = motion.places[b];
    if (p < 0) continue;
    const BodyState& body = state.bodies[b];
    const Vector3 w_W = body.quat_WB * body.w_WB_B;
    add_block(p, skew(w), W);
    add_block(p + 3, skew(w), W);
    add_block(p, skew(w), V);
    add_block(p + 3, skew(w - axes.R.transpose() * w_W), V);
  }
  return {assemble(motion.size(), W), assemble(motion.size(), V)};
}

}  // namespace

void SmallMotion::express_in(const TurningAxes& axes,
                             const SystemState& state) {
  const Sparse P = make_turn(*this, state, axes.R);
  const auto [W, V] = make_spins(*this, state, axes);
  const auto turn = [&P](const MatrixX& A) -> MatrixX {
    return P.transpose() * MatrixX(A * P);
  };
  const MatrixX C = turn(D);
  M = turn(M);
  D = C + M * Sparse(W + V);
  G = (G * P).eval();
  rest = turn(rest) + C * W + M * Sparse(V * W);
  noise = turn(noise);
  const auto turn_velocities = [&P, &W = W](MatrixX& by_x, MatrixX& by_rate) {
    by_rate = (by_rate * P).eval();
    by_x = (by_x * P + by_rate * W).eval();
  };
  turn_velocities(velocities, velocities_by_rate);
  turn_velocities(frame_velocities, frame_velocities_by_rate);
  frames = (frames * P).eval();
}

}  // namespace limber::dynamics
