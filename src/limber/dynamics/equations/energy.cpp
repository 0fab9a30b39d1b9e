// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/equations/energy.hpp"

#include "limber/common/index.hpp"
#include "limber/dynamics/equations/equations.hpp"
#include "limber/dynamics/equations/full_energy.hpp"
#include "limber/dynamics/terms/maxwell.hpp"

namespace limber::dynamics {

double find_elastic_energy(const SystemModel& model, std::size_t body,
                           const SystemState& state, const SystemTerms& terms) {
  const BodyModel& b = model.bodies[body];
  if (b.full >= 0) return terms.full[index(b.full)].strain_energy;
  return flexbody::calc_elastic_energy(b.elasticity,
                                       state.eta.segment(b.offset, b.modes)) +
         find_maxwell_energy(b, state.maxwell);
}

EnergyBalance calc_energy(const SystemModel& model, const SystemState& state) {
  SystemTerms terms = make_terms(model);
  return calc_energy(model, state, terms);
}

EnergyBalance calc_energy(const SystemModel& model, const SystemState& state,
                          SystemTerms& terms) {
  calc_terms(model, state, Side::right, terms);
  EnergyBalance balance;
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    balance.elastic += find_elastic_energy(model, b, state, terms);
    const BodyModel& body = model.bodies[b];
    const BodyState& rigid = state.bodies[b];
    const BodyTerms& t = terms.bodies[b];
    const auto etadot = state.etadot.segment(body.offset, body.modes);

    balance.kinetic_modal += 0.5 * etadot.squaredNorm();
    if (!body.has_rigid_motion()) continue;
    const Vector3 h = t.H() * etadot;
    const Vector3 spin_B = t.J * rigid.w_WB_B + h;
    balance.kinetic_modal += rigid.w_WB_B.dot(h);
    balance.kinetic_rigid += 0.5 * body.mass * rigid.v_WB_W.squaredNorm() +
                             0.5 * rigid.w_WB_B.dot(t.J * rigid.w_WB_B);
    const Vector3 momentum = body.mass * rigid.v_WB_W;
    balance.linear_momentum += momentum;
    balance.angular_momentum += rigid.p_WB.cross(momentum) + t.R_WB * spin_B;
  }
  add_full_energy(model, state, terms, balance);
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
