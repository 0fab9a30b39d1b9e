// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/system/unresolved_modes.hpp"

#include "limber/dynamics/system/body_model.hpp"

namespace limber::dynamics {
namespace {

// Square of the phase of a step up to which a mode is resolved [rad^2].
constexpr double kResolved = 4.0;

}  // namespace

UnresolvedModes::UnresolvedModes(const SystemModel& model, bool damps)
    : damps_(damps),
      ratios_(VectorX::Ones(model.modal_count)),
      dampings_(VectorX::Zero(model.modal_count)),
      calming_(VectorX::Zero(model.modal_count)) {}

// NewtonMatrix has 4 / h^2 and omega^2, twice the equations 2 (1 + rho) / h^2
// and 2 omega^2 / (1 + rho).
void UnresolvedModes::set_step(const SystemModel& model, double h) {
  if (!damps_) return;
  for (const BodyModel& body : model.bodies) {
    const VectorX* lambda = flexbody::find_eigenvalues(body.elasticity);
    if (lambda == nullptr) continue;
    for (int k = 0; k < body.modes; ++k) {
      const Eigen::Index i = body.offset + k;
      const double square = (*lambda)[k] * h * h;
      const double rho = square > kResolved ? 2.0 / (square - 2.0) : 1.0;
      ratios_[i] = rho;
      dampings_[i] = excess(i) * (*lambda)[k] * h;
      calming_[i] = (1.0 - rho) * ((*lambda)[k] / (1.0 + rho) - 2.0 / (h * h));
    }
  }
}

}  // namespace limber::dynamics
