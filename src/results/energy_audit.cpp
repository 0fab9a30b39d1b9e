// SPDX-License-Identifier: BSD-3-Clause
#include "limber/results/energy_audit.hpp"

#include <algorithm>
#include <cmath>

namespace limber::results {

std::optional<double> EnergyAudit::relative() const {
  if (!(throughput > 0.0)) return std::nullopt;
  return drift / throughput;
}

std::optional<double> EnergyAudit::relative_largest() const {
  if (!(throughput > 0.0)) return std::nullopt;
  return largest / throughput;
}

EnergyAudit audit_energy(const History& history) {
  EnergyAudit audit;
  if (history.energies.empty()) return audit;
  const dynamics::EnergyBalance& first = history.energies.front();
  audit.initial = first.total();
  double kinetic = 0.0;
  for (const dynamics::EnergyBalance& now : history.energies) {
    audit.final = now.total();
    audit.work = now.work - first.work;
    audit.dissipated = now.dissipated - first.dissipated;
    audit.drift = (now.total() + now.dissipated - now.work) -
                  (first.total() + first.dissipated - first.work);
    audit.largest = std::max(audit.largest, std::abs(audit.drift));
    kinetic = std::max(kinetic, now.kinetic_rigid + now.kinetic_modal);
  }
  audit.throughput =
      std::max({std::abs(audit.initial), std::abs(audit.final),
                std::abs(audit.work), std::abs(audit.dissipated), kinetic});
  return audit;
}

}  // namespace limber::results
