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
  damped.setZero();
  rubbed.setZero();
}

EnergyFlows& EnergyFlows::operator+=(const EnergyFlows& other) {
  supplied += other.supplied;
  dissipated += other.dissipated;
  damped += other.damped;
  rubbed += other.rubbed;
  return *this;
}

EnergyFlows& EnergyFlows::operator*=(double factor) {
  supplied *= factor;
  dissipated *= factor;
  damped *= factor;
  rubbed *= factor;
  return *this;
}

void exchange(Archive& archive, EnergyFlows& flows) {
  archive(flows.supplied, flows.dissipated, flows.damped, flows.rubbed);
}

EnergyFlows make_flows(const SystemModel& model) {
  const VectorX none = VectorX::Zero(EnergyRows(model).count);
  const VectorX of_pairs = VectorX::Zero(std::ssize(model.pairs));
  return {none, none, of_pairs, of_pairs};
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
  Eigen::Index i = 0;
  for (const joints::PairResponse& pair : terms.pairs.responses) {
    add(0.0, pair.dissipation + pair.slip_power);
    flows.damped[i] += duration * (pair.dissipation - pair.rubbed);
    flows.rubbed[i++] += duration * (pair.rubbed + pair.slip_power);
  }
}

}  // namespace limber::dynamics
