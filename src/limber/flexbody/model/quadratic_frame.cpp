// SPDX-License-Identifier: BSD-3-Clause
#include "limber/flexbody/model/quadratic_frame.hpp"

#include "limber/common/errors.hpp"
#include "limber/flexbody/model/quadratic_manifold.hpp"

namespace limber::flexbody {
namespace {

constexpr int kMost = 256;  // as QuadraticStrain::kMostPaired
using Paired = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMost, 1>;
using Columns = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 3 * kMost, 1>;

MatrixX unpack(const Matrix3X& pairs, Eigen::Index p) {
  LIMBER_EXPECT(pairs.cols() == count_pairs(p));
  MatrixX table(3 * p, p);
  Eigen::Index pair = 0;
  for (Eigen::Index i = 0; i < p; ++i) {
    for (Eigen::Index j = i; j < p; ++j, ++pair) {
      table.block<3, 1>(3 * i, j) = pairs.col(pair);
      table.block<3, 1>(3 * j, i) = pairs.col(pair);
    }
  }
  return table;
}

}  // namespace

QuadraticFrame make_quadratic_frame(const std::vector<int>& paired,
                                    const Matrix3X& Phi2,
                                    const Matrix3X& Psi2) {
  LIMBER_EXPECT(paired.size() <= kMost);
  const auto p = static_cast<Eigen::Index>(paired.size());
  return {paired, unpack(Phi2, p), unpack(Psi2, p)};
}

// (exp(r) - I) arm = r x arm + r x (r x arm) / 2 to second order.
QuadraticFrame move_origin(const QuadraticFrame& frame, const Matrix3X& Psi,
                           const Vector3& arm) {
  QuadraticFrame moved = frame;
  const auto p = static_cast<Eigen::Index>(frame.paired.size());
  for (Eigen::Index i = 0; i < p; ++i) {
    const Vector3 psi_i = Psi.col(frame.paired[static_cast<std::size_t>(i)]);
    for (Eigen::Index j = 0; j < p; ++j) {
      const Vector3 psi_j = Psi.col(frame.paired[static_cast<std::size_t>(j)]);
      const Vector3 psi_ij = frame.Psi2.block<3, 1>(3 * i, j);
      moved.Phi2.block<3, 1>(3 * i, j) +=
          psi_ij.cross(arm) +
          0.5 * (psi_i.cross(psi_j.cross(arm)) + psi_j.cross(psi_i.cross(arm)));
    }
  }
  return moved;
}

void add_slopes(const QuadraticFrame& frame, const double* q, Matrix3X& Phi,
                Matrix3X& Psi) {
  const auto p = static_cast<Eigen::Index>(frame.paired.size());
  Paired own(p);
  for (Eigen::Index i = 0; i < p; ++i) {
    own[i] = q[frame.paired[static_cast<std::size_t>(i)]];
  }
  Columns slope(3 * p);
  const auto add_to = [&](Matrix3X& table) {
    for (Eigen::Index i = 0; i < p; ++i) {
      table.col(frame.paired[static_cast<std::size_t>(i)]) +=
          slope.segment<3>(3 * i);
    }
  };
  slope.noalias() = frame.Phi2 * own;
  add_to(Phi);
  slope.noalias() = frame.Psi2 * own;
  add_to(Psi);
}

void add_contraction(const QuadraticFrame& frame, const Vector3& force,
                     const Vector3& twist, double factor,
                     Eigen::Ref<MatrixX> K) {
  const auto p = static_cast<Eigen::Index>(frame.paired.size());
  const Vector3 f = factor * force;
  const Vector3 t = factor * twist;
  for (Eigen::Index j = 0; j < p; ++j) {
    double* column = K.col(frame.paired[static_cast<std::size_t>(j)]).data();
    for (Eigen::Index i = 0; i < p; ++i) {
      column[frame.paired[static_cast<std::size_t>(i)]] +=
          f.dot(frame.Phi2.block<3, 1>(3 * i, j)) +
          t.dot(frame.Psi2.block<3, 1>(3 * i, j));
    }
  }
}

}  // namespace limber::flexbody
