// SPDX-License-Identifier: BSD-3-Clause
#include "limber/flexbody/model/nodal_load.hpp"

#include <fmt/format.h>

#include <cmath>

#include "limber/common/errors.hpp"

namespace limber::flexbody {
namespace {

void check(const std::vector<double>& times, const MatrixX& forces) {
  for (std::size_t i = 0; i < times.size(); ++i) {
    if (!std::isfinite(times[i]))
      throw InputError(fmt::format("time {} is {}", i + 1, times[i]));
    if (i > 0 && !(times[i] > times[i - 1]))
      throw InputError(fmt::format(
          "time {} is {:g} s, not after {:g} s; times must increase", i + 1,
          times[i], times[i - 1]));
  }
  if (!forces.allFinite()) throw InputError("a force is not finite");
}

// @param Phi_B 3n x m, columns of all coordinates
NodalLoad reduce(const ReducedBody& body, const MatrixX& Phi_B,
                 const std::vector<double>& times, const MatrixX& forces) {
  const Eigen::Index n = body.rows.x_B.cols();
  const Eigen::Index m = Phi_B.cols();
  const auto count = static_cast<Eigen::Index>(times.size());
  LIMBER_EXPECT(forces.rows() == 3 * n && forces.cols() == count);
  check(times, forces);
  NodalLoad load;
  load.times = times;
  load.force = Matrix3X::Zero(3, count);
  load.moment = Matrix3X::Zero(3, count);
  load.moment_by_mode = Matrix3X::Zero(3, m * count);
  load.modal = Phi_B.transpose() * forces;
  for (Eigen::Index i = 0; i < count; ++i) {
    for (Eigen::Index node = 0; node < n; ++node) {
      const Vector3 f = forces.block<3, 1>(3 * node, i);
      if (f.isZero(0.0)) continue;
      load.force.col(i) += f;
      load.moment.col(i) += Vector3(body.rows.x_B.col(node)).cross(f);
      for (Eigen::Index k = 0; k < m; ++k) {
        const Vector3 phi = Phi_B.block<3, 1>(3 * node, k);
        load.moment_by_mode.col(i * m + k) += phi.cross(f);
      }
    }
  }
  return load;
}

}  // namespace

NodalLoad reduce_nodal_load(const ReducedBody& body,
                            const std::vector<double>& times,
                            const MatrixX& forces) {
  return reduce(body, body.rows.Phi_B, times, forces);
}

NodalLoad reduce_second_order_load(const ReducedBody& body,
                                   const std::vector<double>& times,
                                   const MatrixX& forces) {
  LIMBER_EXPECT(body.manifold);
  const MatrixX& Theta_B = body.manifold->Theta_B;
  MatrixX joined(body.rows.Phi_B.rows(), body.lambda.size() + Theta_B.cols());
  joined << body.rows.Phi_B, Theta_B;
  return reduce(body, joined, times, forces);
}

}  // namespace limber::flexbody
