// SPDX-License-Identifier: BSD-3-Clause
#include "support/top_drift.hpp"

#include <algorithm>
#include <cmath>

#include "limber/dynamics/equations/energy.hpp"

namespace limber::testing {

Drift find_drift(const dynamics::SystemModel& model,
                 dynamics::SystemState state,
                 dynamics::SimulationSettings settings, int outputs) {
  for (int i = 0; i <= outputs; ++i) {
    settings.output_times.push_back(settings.end_time * i / outputs);
  }
  const dynamics::EnergyBalance start = calc_energy(model, state);
  Drift drift;
  simulate(model, state, settings,
           [&](const dynamics::SystemState& now,
               const dynamics::EnergyBalance& energy) {
             const Matrix3 R = now.bodies[0].quat_WB.toRotationMatrix();
             drift.energy = std::max(
                 drift.energy, std::abs(energy.total() / start.total() - 1.0));
             drift.momentum = std::max(
                 drift.momentum,
                 (energy.angular_momentum - start.angular_momentum).norm() /
                     start.angular_momentum.norm());
             drift.orthonormality =
                 std::max(drift.orthonormality,
                          (R.transpose() * R - Matrix3::Identity()).norm());
           });
  return drift;
}

}  // namespace limber::testing
