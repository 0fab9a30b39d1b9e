// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/reduction/reduce.hpp"
#include "unit/reduction/bar.hpp"
#include "unit/reduction/matrices/mass_points.hpp"

namespace limber::flexbody::matrices_test {

/// The matrices of a mesh, with its groups as node sets.
inline fem::MatrixModel export_mesh(const MeshedBody& body) {
  const MatrixX lower = body.support.matrices.K;
  const MatrixX K = lower.selfadjointView<Eigen::Lower>();
  const MatrixX M = testing::kron(MatrixX(body.M_s), Matrix3::Identity());
  fem::MatrixModel model = make_model(body.mesh.x, K, M, 3);
  model.tags = body.mesh.tags;
  for (const fem::PhysicalGroup& group : body.mesh.groups)
    model.sets.push_back({group.name, group.nodes});
  return model;
}

/// `body` with the signs of its modes as those of `model`, which has the same
/// rows: the largest entry of a symmetric body's mode is that of two nodes.
inline ReducedBody align_signs(ReducedBody body, const ReducedBody& model) {
  const auto m = static_cast<std::size_t>(body.mode_count());
  EXPECT_EQ(body.rows.tags, model.rows.tags);
  VectorX sign(body.lambda.size());
  for (Eigen::Index k = 0; k < sign.size(); ++k)
    sign[k] =
        body.rows.Phi_B.col(k).dot(model.rows.Phi_B.col(k)) < 0.0 ? -1.0 : 1.0;
  const auto flip = [&](auto& columns) {
    columns = (columns * sign.asDiagonal()).eval();
  };
  flip(body.rows.Phi_B);
  flip(body.integrals.P);
  for (InterfaceTable& table : body.interfaces) {
    flip(table.Phi_B);
    flip(table.Psi_B);
  }
  for (std::size_t k = 0; k < m; ++k) {
    const double s = sign[static_cast<Eigen::Index>(k)];
    body.integrals.S1[k] *= s;
    for (std::size_t l = 0; l < m; ++l)
      body.integrals.S2[k * m + l] *= s * sign[static_cast<Eigen::Index>(l)];
  }
  return body;
}

}  // namespace limber::flexbody::matrices_test
