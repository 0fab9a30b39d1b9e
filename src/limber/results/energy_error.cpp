// SPDX-License-Identifier: BSD-3-Clause
#include "limber/results/energy_error.hpp"

#include <algorithm>
#include <cmath>

namespace limber::results {

std::optional<double> EnergyError::relative() const {
  if (!(throughput > 0.0)) return std::nullopt;
  return drift / throughput;
}

std::optional<double> EnergyError::relative_largest() const {
  if (!(throughput > 0.0)) return std::nullopt;
  return largest / throughput;
}

EnergyError find_energy_error(const History& history) {
  EnergyError energy;
  if (history.energies.empty()) return energy;
  const dynamics::EnergyBalance& first = history.energies.front();
  energy.initial = first.total();
  double kinetic = 0.0;
  for (const dynamics::EnergyBalance& now : history.energies) {
    energy.final = now.total();
    energy.work = now.work - first.work;
    energy.dissipated = now.dissipated - first.dissipated;
    energy.drift = (now.total() + now.dissipated - now.work) -
                   (first.total() + first.dissipated - first.work);
    energy.largest = std::max(energy.largest, std::abs(energy.drift));
    kinetic = std::max(kinetic, now.kinetic_rigid + now.kinetic_modal);
  }
  energy.throughput =
      std::max({std::abs(energy.initial), std::abs(energy.final),
                std::abs(energy.work), std::abs(energy.dissipated), kinetic});
  return energy;
}

}  // namespace limber::results
