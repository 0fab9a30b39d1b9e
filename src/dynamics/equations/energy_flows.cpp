// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/equations/energy_flows.hpp"

#include <fmt/format.h>

namespace limber::dynamics {

EnergyRows::EnergyRows(const SystemModel& model)
    : couplers(std::ssize(model.bodies)),
      transmissions(couplers + std::ssize(model.couplers)),
      pairs(transmissions + std::ssize(model.transmissions)),
      count(pairs + std::ssize(model.pairs)) {}

std::string name_energy_row(const SystemModel& model, Eigen::Index row) {
  const EnergyRows rows(model);
  const auto name = [row](const char* kind, const auto& all,
                          Eigen::Index first) {
    return fmt::format("{} '{}'", kind,
                       all[static_cast<std::size_t>(row - first)].name);
  };
  if (row < rows.couplers) return name("body", model.bodies, 0);
  if (row < rows.transmissions) {
    return name("coupler", model.couplers, rows.couplers);
  }
  if (row < rows.pairs) {
    return name("coupler", model.transmissions, rows.transmissions);
  }
  return name("pair", model.pairs, rows.pairs);
}

void EnergyFlows::clear() {
  supplied.setZero();
  dissipated.setZero();
}

EnergyFlows& EnergyFlows::operator+=(const EnergyFlows& other) {
  supplied += other.supplied;
  dissipated += other.dissipated;
  return *this;
}

EnergyFlows make_flows(const SystemModel& model) {
  const VectorX none = VectorX::Zero(EnergyRows(model).count);
  return {none, none};
}

void add_powers(const SystemTerms& terms, double duration, EnergyFlows& flows) {
  Eigen::Index row = 0;
  const auto add = [&](double supplied, double dissipated) {
    flows.supplied[row] += duration * supplied;
    flows.dissipated[row++] += duration * dissipated;
  };
  for (const BodyTerms& body : terms.bodies) {
    add(body.supplied, body.dissipated);
  }
  for (const CouplerTerms& coupler : terms.couplers) {
    add(coupler.response.supplied, coupler.response.dissipation);
  }
  for (const TransmissionTerms& transmission : terms.transmissions) {
    add(transmission.response.supplied, transmission.response.dissipation);
  }
  for (const joints::PairResponse& pair : terms.pairs.responses) {
    add(0.0, pair.dissipation + pair.mean_dissipation);
  }
}

}  // namespace limber::dynamics
