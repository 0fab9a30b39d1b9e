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

}  // namespace limber::flexbody::matrices_test
