// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/equations/energy.hpp"

#include "limber/dynamics/bodies/body.hpp"
#include "limber/dynamics/equations/equations.hpp"

namespace limber::dynamics {

double find_elastic_energy(const SystemModel& model, std::size_t body,
                           const SystemState& state, const SystemTerms& terms) {
  return visit_body(model, body, [&](const auto& own) {
    return own.find_elastic_energy(state, terms);
  });
}

EnergyBalance calc_energy(const SystemModel& model, const SystemState& state) {
  SystemTerms terms = make_terms(model);
  return calc_energy(model, state, terms);
}

EnergyBalance calc_energy(const SystemModel& model, const SystemState& state,
                          SystemTerms& terms) {
  calc_terms(model, state, Side::right, terms);
  EnergyBalance balance;
  visit_bodies(model, [&](const auto& own) {
    balance.elastic += own.find_elastic_energy(state, terms);
    own.add_energy(state, terms, balance);
  });
  for (const CouplerTerms& coupler : terms.couplers) {
    balance.coupler += coupler.response.energy;
  }
  for (const TransmissionTerms& transmission : terms.transmissions) {
    balance.coupler += transmission.response.energy;
  }
  for (const joints::PairResponse& pair : terms.pairs.responses) {
    balance.coupler += pair.energy;
  }
  return balance;
}

}  // namespace limber::dynamics
