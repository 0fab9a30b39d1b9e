// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/monitors/energy_ledger.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "limber/dynamics/equations/full_terms.hpp"
#include "limber/dynamics/equations/maxwell.hpp"
#include "limber/dynamics/equations/pair_forces.hpp"
#include "limber/dynamics/monitors/peak_watch.hpp"

namespace limber::dynamics {
namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
// Error relative to the energy through parts: round-off, and the tolerance of
// Newton's method.
constexpr double kPassedError = 1e-11;
// Factor on the noise of couplers at one state, which accumulates as a random
// walk.
constexpr double kNoiseFactor = 10.0;

// Least relative growth of an extreme before it is evaluated exactly; a drift
// is relative to the throughput.
constexpr double kGrowth = 1.01;
constexpr double kNoteworthy = 1e-3;

// Wrench and stiffness times the round-off of a frame's motion.
double find_noise(const CouplerTerms& coupler, double reach) {
  const double d = kEpsilon * reach;
  const auto& response = coupler.response;
  const double k = response.stiffness.topLeftCorner<3, 3>().trace();
  const double k_turn = response.stiffness.bottomRightCorner<3, 3>().trace();
  const double force = response.wrench.head<3>().norm();
  const double moment = response.wrench.tail<3>().norm();
  return (force + k * d) * d + (moment + k_turn * kEpsilon) * kEpsilon;
}

// Power of a pair's forces on moving bodies.
double find_power(const joints::PairResponse& pair) {
  double power = 0.0;
  for (const joints::PairPoint& point : pair.points()) {
    power += point.force_W.dot(point.velocity_W);
  }
  return power;
}

}  // namespace

void exchange(Archive& archive, EnergyLedger::Part& part) {
  archive(part.energy, part.power, part.open);
}

EnergyLedger::EnergyLedger(const SystemModel& model)
    : model_(model),
      parts_(model.bodies.size() + model.couplers.size() +
             model.transmissions.size() + model.pairs.size()),
      now_(parts_) {
  for (const FullModel& full : model.full_bodies) {
    scratch_.emplace_back(Matrix3X::Zero(3, full.mesh->node_count()));
  }
}

void EnergyLedger::evaluate_full(std::size_t b, const SystemState& state,
                                 const SystemTerms& terms, Sums& sums) {
  const auto f = static_cast<std::size_t>(model_.bodies[b].full);
  const FullTerms& t = terms.full[f];
  const ConstNodes udot = nodes_of(model_.full_bodies[f], state.udot_H);
  t.solver->multiply_mass(udot, scratch_[f]);
  const double kinetic = 0.5 * scratch_[f].cwiseProduct(udot).sum();
  sums.kinetic += kinetic;
  sums.elastic += t.strain_energy;
  now_[b].energy = kinetic + t.strain_energy;
  now_[b].power = t.force.cwiseProduct(udot).sum();
}

void EnergyLedger::evaluate_body(std::size_t b, const SystemState& state,
                                 const SystemTerms& terms, Sums& sums) {
  const BodyModel& body = model_.bodies[b];
  if (body.full >= 0) {
    evaluate_full(b, state, terms, sums);
    return;
  }
  const BodyState& rigid = state.bodies[b];
  const BodyTerms& t = terms.bodies[b];
  double kinetic = 0.0;
  double elastic = 0.0;
  double power = 0.0;
  const VectorX* lambda = flexbody::find_eigenvalues(body.elasticity);
  if (lambda == nullptr) {
    elastic = flexbody::calc_elastic_energy(
        body.elasticity, state.eta.segment(body.offset, body.modes));
  }
  Vector3 h = Vector3::Zero();
  for (int k = 0; k < body.modes; ++k) {
    const double eta = state.eta[body.offset + k];
    const double etadot = state.etadot[body.offset + k];
    kinetic += 0.5 * etadot * etadot;
    if (lambda != nullptr) elastic += 0.5 * (*lambda)[k] * eta * eta;
    power += (t.modal_force[k] - body.damping[k] * etadot) * etadot;
    h += t.H.col(k) * etadot;
  }
  elastic += find_maxwell_energy(body, state.maxwell);
  power -= find_maxwell_loss(body, state.maxwell);
  if (body.has_rigid_motion()) {
    const Vector3& w = rigid.w_WB_B;
    kinetic += 0.5 * body.mass * rigid.v_WB_W.squaredNorm() +
               w.dot(0.5 * (t.J * w) + h);
    power += t.force_W.dot(rigid.v_WB_W) + t.moment_B.dot(w);
  }
  sums.kinetic += kinetic;
  sums.elastic += elastic;
  now_[b].energy = kinetic + elastic;
  now_[b].power = power;
}

EnergyLedger::Sums EnergyLedger::evaluate(const SystemState& state,
                                          const SystemTerms& terms) {
  Sums sums;
  for (std::size_t b = 0; b < model_.bodies.size(); ++b) {
    evaluate_body(b, state, terms, sums);
  }
  std::size_t part = model_.bodies.size();
  for (const CouplerTerms& coupler : terms.couplers) {
    const auto& response = coupler.response;
    now_[part].energy = response.energy;
    now_[part].power = response.supplied - response.dissipation -
                       response.wrench.head<3>().dot(coupler.motion.v_FM_F) -
                       response.wrench.tail<3>().dot(coupler.motion.w_FM_F);
    sums.coupler += now_[part++].energy;
  }
  for (const TransmissionTerms& transmission : terms.transmissions) {
    const auto& response = transmission.response;
    now_[part].energy = response.energy;
    now_[part].power = response.supplied - response.dissipation -
                       transmission.applied * transmission.motion.rate;
    sums.coupler += now_[part++].energy;
  }
  for (const joints::PairResponse& response : terms.pairs.responses) {
    now_[part].energy = response.energy;
    now_[part].power = -response.dissipation - find_power(response);
    sums.coupler += now_[part++].energy;
  }
  return sums;
}

double EnergyLedger::find_noise(const SystemTerms& terms) const {
  double noise = 0.0;
  for (std::size_t c = 0; c < terms.couplers.size(); ++c) {
    const auto frame = static_cast<std::size_t>(model_.couplers[c].frame_M);
    noise += dynamics::find_noise(terms.couplers[c],
                                  terms.attachments[frame].p_WF.norm());
  }
  for (std::size_t i = 0; i < terms.pairs.responses.size(); ++i) {
    if (terms.pairs.responses[i].points().empty()) continue;
    const joints::PairBodies bodies = find_bodies(model_.pairs[i], terms.pairs);
    const double d = kEpsilon * (bodies.A.p_WB.norm() + bodies.B.p_WB.norm());
    for (const auto& point : terms.pairs.responses[i].points()) {
      noise += (point.force_W.norm() + point.stiffness.norm() * d) * d;
    }
  }
  return noise;
}

void EnergyLedger::include_energies(const Sums& sums, double t) {
  record_.stored.include(sums.total(), t);
  record_.kinetic.include(sums.kinetic, t);
  record_.elastic.include(sums.elastic, t);
  record_.coupler.include(sums.coupler, t);
  record_.throughput = std::max(
      {record_.throughput, std::abs(sums.total()), std::abs(sums.kinetic)});
}

void EnergyLedger::start(const SystemState& state, const SystemTerms& terms,
                         const StepResult& totals) {
  const Sums sums = evaluate(state, terms);
  parts_ = now_;
  time_ = state.t;
  initial_ = sums.total() + totals.dissipated - totals.load_work;
  noise_ = find_noise(terms);
  record_ = {};
  include_energies(sums, state.t);
}

bool EnergyLedger::is_remarkable(const Sums& sums, double drift) const {
  const auto grows = [](double now, const Extreme& before) {
    return now > kGrowth * std::abs(before.value);
  };
  return grows(sums.total(), record_.stored) ||
         grows(sums.coupler, record_.coupler) ||
         (grows(std::abs(drift), record_.drift) &&
          std::abs(drift) > kNoteworthy * record_.throughput);
}

void EnergyLedger::restart(const SystemState& state, const SystemTerms& terms) {
  evaluate(state, terms);
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    parts_[i].energy = now_[i].energy;
    parts_[i].power = now_[i].power;
  }
  time_ = state.t;
}

double EnergyLedger::find_drift(const Sums& sums,
                                const StepResult& totals) const {
  return sums.total() + totals.dissipated - totals.load_work - initial_;
}

void EnergyLedger::add(const SystemState& state, const SystemTerms& terms,
                       const StepResult& totals) {
  const Sums sums = evaluate(state, terms);
  include(sums, find_drift(sums, totals), state, terms, totals);
}

bool EnergyLedger::try_add(const SystemState& state, const SystemTerms& terms,
                           const StepResult& totals) {
  const Sums sums = evaluate(state, terms);
  const double drift = find_drift(sums, totals);
  if (is_remarkable(sums, drift)) return false;
  include(sums, drift, state, terms, totals);
  return true;
}

void EnergyLedger::include(const Sums& sums, double drift,
                           const SystemState& state, const SystemTerms& terms,
                           const StepResult& totals) {
  const double half = 0.5 * (state.t - time_);
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    Part& part = parts_[i];
    const Part& now = now_[i];
    const double given = half * (part.power + now.power);
    passed_ += half * (std::abs(part.power) + std::abs(now.power));
    part.open += now.energy - part.energy - given;
    part.energy = now.energy;
    part.power = now.power;
  }
  time_ = state.t;
  ++steps_;
  noise_ = std::max(noise_, find_noise(terms));
  include_energies(sums, state.t);
  record_.throughput = std::max({record_.throughput, std::abs(totals.load_work),
                                 std::abs(totals.dissipated)});
  note_drift(drift, state.t);
}

void EnergyLedger::note_drift(double drift, double t) {
  if (!(std::abs(drift) > std::abs(record_.drift.value))) return;
  record_.drift = {drift, t};
  const double sign = drift < 0.0 ? -1.0 : 1.0;
  record_.share = 0.0;
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    if (!(sign * parts_[i].open > sign * record_.share)) continue;
    record_.share = parts_[i].open;
    worst_ = i;
  }
}

EnergyRecord EnergyLedger::find_record() const {
  EnergyRecord record = record_;
  record.roundoff = kPassedError * passed_ +
                    kNoiseFactor * std::sqrt(std::max(steps_, 1.0)) * noise_;
  if (record.share == 0.0) return record;
  const std::size_t bodies = model_.bodies.size();
  const std::size_t couplers = model_.couplers.size();
  if (worst_ < bodies) {
    record.place = fmt::format("body '{}'", model_.bodies[worst_].name);
    record.is_one_way = model_.bodies[worst_].fidelity == Fidelity::one_way;
  } else if (worst_ < bodies + couplers) {
    record.place =
        fmt::format("coupler '{}'", model_.couplers[worst_ - bodies].name);
  } else if (worst_ < bodies + couplers + model_.transmissions.size()) {
    record.place = fmt::format(
        "coupler '{}'", model_.transmissions[worst_ - bodies - couplers].name);
  } else {
    const std::size_t pairs = parts_.size() - model_.pairs.size();
    record.place = fmt::format("pair '{}'", model_.pairs[worst_ - pairs].name);
  }
  return record;
}

void EnergyLedger::exchange_memory(Archive& archive) {
  archive(parts_, time_, initial_, passed_, noise_, steps_, worst_,
          record_.drift, record_.stored, record_.kinetic, record_.elastic,
          record_.coupler, record_.throughput, record_.share);
}

}  // namespace limber::dynamics
