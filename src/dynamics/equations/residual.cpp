// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/equations/residual.hpp"

#include "limber/dynamics/equations/full_terms.hpp"
#include "limber/dynamics/system/unknowns.hpp"

namespace limber::dynamics {

Rates make_rates(const SystemModel& model) {
  const std::size_t n = model.bodies.size();
  return {std::vector<Vector3>(n, Vector3::Zero()),
          std::vector<Vector3>(n, Vector3::Zero()),
          VectorX::Zero(model.modal_count), VectorX::Zero(model.nodal_count)};
}

void calc_residual(const SystemModel& model, const Rates& acceleration,
                   SystemTerms& terms, VectorX& residual) {
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const BodyModel& body = model.bodies[b];
    const BodyTerms& t = terms.bodies[b];
    double* r = residual.data() + first_row(body, b);
    Eigen::Map<Vector3> translation(r);
    Eigen::Map<Vector3> rotation(r + 3);
    translation.setZero();
    rotation.setZero();
    const Vector3& dw = acceleration.rotation[b];
    if (body.has_rigid_motion()) {
      translation = body.mass * acceleration.translation[b] - t.force_W;
      rotation = t.J * dw + t.bias_r - t.moment_B;
    }
    const double* etaddot = acceleration.modes.data() + body.offset;
    for (int k = 0; k < body.modes; ++k) {
      rotation += t.H.col(k) * etaddot[k];
      r[6 + k] =
          etaddot[k] + t.H.col(k).dot(dw) + t.bias_e[k] - t.modal_force[k];
    }
    if (body.clamped) rotation.setZero();
  }
  for (std::size_t f = 0; f < model.full_bodies.size(); ++f) {
    const FullModel& full = model.full_bodies[f];
    double* rows = residual.data() + first_node_row(model) + full.first;
    calc_full_residual(model, f, acceleration.nodes, terms,
                       Nodes(rows, 3, full.mesh->node_count()));
  }
}

}  // namespace limber::dynamics
