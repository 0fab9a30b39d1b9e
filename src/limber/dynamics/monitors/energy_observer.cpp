// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/monitors/energy_observer.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "limber/common/index.hpp"
#include "limber/dynamics/bodies/body.hpp"
#include "limber/dynamics/equations/energy.hpp"
#include "limber/dynamics/equations/motion_fields.hpp"
#include "limber/dynamics/equations/pair_forces.hpp"

namespace limber::dynamics {
namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

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

double sum_coupler_energies(const SystemTerms& terms) {
  double sum = 0.0;
  for (const CouplerTerms& coupler : terms.couplers) {
    sum += coupler.response.energy;
  }
  for (const TransmissionTerms& transmission : terms.transmissions) {
    sum += transmission.response.energy;
  }
  for (const joints::PairResponse& pair : terms.pairs.responses) {
    sum += pair.energy;
  }
  return sum;
}

EnergyObserver::EnergyObserver(const SystemModel& model,
                               IntegratorKind integrator, double h)
    : model_(model),
      works_by_ends_(integrator == IntegratorKind::generalized_alpha ||
                     integrator == IntegratorKind::implicit_euler),
      rows_(model),
      groups_(model, integrator == IntegratorKind::explicit_euler, h),
      accounts_(static_cast<std::size_t>(rows_.count)),
      next_(accounts_),
      scratch_(model.bodies.size()),
      peak_(make_state(model)) {
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const UnknownRanges unknowns = list_unknowns(model, b);
    const bool is_free = unknowns.begin() != unknowns.end() &&
                         unknowns.begin()->kind != UnknownKind::modes;
    accounts_[b].mass = is_free ? model.bodies[b].mass : 0.0;
  }
}

void EnergyObserver::evaluate_body(std::size_t b, const SystemState& state,
                                   const SystemTerms& terms) {
  const BodyMomentum now = visit_body(model_, b, [&](const auto& own) {
    return own.find_momentum(state, terms, scratch_[b]);
  });
  EnergyAccount& row = next_[b];
  row.kinetic = now.kinetic;
  row.power = terms.bodies[b].received;
  row.momentum = now.momentum;
  row.force = now.force;
}

EnergyObserver::Sums EnergyObserver::evaluate(const SystemState& state,
                                              const SystemTerms& terms) {
  next_ = accounts_;
  Sums sums;
  std::size_t row = 0;
  for (; row < model_.bodies.size(); ++row) {
    evaluate_body(row, state, terms);
    const double elastic = find_elastic_energy(model_, row, state, terms);
    next_[row].stored = next_[row].kinetic + elastic;
    sums.kinetic += next_[row].kinetic;
    sums.elastic += elastic;
  }
  sums.coupler = sum_coupler_energies(terms);
  const auto set = [&](double energy, double power) {
    next_[row].stored = energy;
    next_[row++].power = power;
  };
  for (const CouplerTerms& coupler : terms.couplers) {
    set(coupler.response.energy, coupler.received);
  }
  for (const TransmissionTerms& transmission : terms.transmissions) {
    set(transmission.response.energy, transmission.received);
  }
  for (const joints::PairResponse& response : terms.pairs.responses) {
    set(response.energy, -find_power(response));
  }
  set_noise(terms);
  return sums;
}

// Of places as far from the origin as either frame's, and of its arm.
void EnergyObserver::set_noise(const SystemTerms& terms) {
  const auto include = [this](Eigen::Index row, double noise) {
    double& most = next_[static_cast<std::size_t>(row)].noise;
    most = std::max(most, noise);
  };
  const auto reach = [&](AttachmentIndex frame) {
    const auto i = static_cast<std::size_t>(frame);
    return terms.attachments[i].p_WF.norm() + model_.attachments[i].p_BF.norm();
  };
  for (std::size_t c = 0; c < terms.couplers.size(); ++c) {
    const Coupler& coupler = model_.couplers[c];
    include(rows_.couplers + static_cast<Eigen::Index>(c),
            find_noise(terms.couplers[c], std::max(reach(coupler.frame_F),
                                                   reach(coupler.frame_M))));
  }
  for (std::size_t i = 0; i < terms.pairs.responses.size(); ++i) {
    if (terms.pairs.responses[i].points().empty()) continue;
    const joints::PairBodies bodies = find_bodies(model_.pairs[i], terms.pairs);
    const double d = kEpsilon * (bodies.A.p_WB.norm() + bodies.B.p_WB.norm());
    double noise = 0.0;
    for (const auto& point : terms.pairs.responses[i].points()) {
      noise += (point.force_W.norm() + point.stiffness.norm() * d) * d;
    }
    include(rows_.pairs + static_cast<Eigen::Index>(i), noise);
  }
}

// Rounding of a place in each step of `h` [s] by up to eps L.
void EnergyObserver::set_jitter(const SystemState& state, double h) {
  if (!(h > 0.0)) return;
  for (std::size_t b = 0; b < model_.bodies.size(); ++b) {
    const BodyModel& body = model_.bodies[b];
    const double reach =
        state.bodies[b].p_WB.norm() + std::sqrt(body.J0.trace() / body.mass);
    const double speed = kEpsilon * reach / h;
    double& most = next_[b].jitter;
    most = std::max(most, 0.5 * body.mass * speed * speed);
  }
}

void EnergyObserver::advance(double t, const EnergyFlows& flows) {
  const double half = 0.5 * (t - time_);
  for (std::size_t i = 0; i < accounts_.size(); ++i) {
    const EnergyAccount& last = accounts_[i];
    EnergyAccount& row = next_[i];
    const auto k = static_cast<Eigen::Index>(i);
    const double received = half * (last.power + row.power);
    const Vector3 impulse = works_by_ends_
                                ? Vector3(half * (last.force + row.force))
                                : Vector3(row.momentum - last.momentum);
    const double supplied = flows.supplied[k] - last.supplied;
    const double lost = flows.dissipated[k] - last.dissipated;
    const double net =
        received + supplied - impulse.dot(groups_.find_velocity(k));
    row.received += received;
    row.impulse += impulse;
    row.supplied = flows.supplied[k];
    row.dissipated = flows.dissipated[k];
    (net > 0.0 ? row.in : row.out) += std::abs(net);
    row.passed += half * (std::abs(last.power) + std::abs(row.power)) +
                  std::abs(supplied) + std::abs(lost);
  }
}

// All but the energy of couplers alone.
void EnergyObserver::include_bodies(const Sums& sums, double t) {
  record_.stored.include(sums.total(), t);
  record_.kinetic.include(sums.kinetic, t);
  record_.elastic.include(sums.elastic, t);
}

void EnergyObserver::start(const SystemState& state, const SystemTerms& terms,
                           double taken) {
  const Sums sums = evaluate(state, terms);
  for (EnergyAccount& row : next_) {
    row.initial = row.stored;
    row.first_momentum = row.momentum;
  }
  accounts_ = next_;
  time_ = state.t;
  record_ = {};
  groups_.start(accounts_, taken);
  groups_.connect(terms.pairs, accounts_);
  include_bodies(sums, state.t);
  record_.coupler.include(sums.coupler, state.t);
  has_peak_ = false;
}

void EnergyObserver::restart(const SystemState& state,
                             const SystemTerms& terms) {
  evaluate(state, terms);
  for (std::size_t i = 0; i < accounts_.size(); ++i) {
    accounts_[i].power = next_[i].power;
    accounts_[i].force = next_[i].force;
  }
}

void EnergyObserver::add(const SystemState& state, const SystemTerms& terms,
                         const EnergyFlows& flows) {
  const Sums sums = evaluate(state, terms);
  set_jitter(state, state.t - time_);
  advance(state.t, flows);
  groups_.sum_up(next_);
  accept(sums, terms, state.t);
  record_.coupler.include(sums.coupler, state.t);
}

bool EnergyObserver::try_add(const SystemState& state, const SystemTerms& terms,
                             const EnergyFlows& flows) {
  const Sums sums = evaluate(state, terms);
  set_jitter(state, state.t - time_);
  advance(state.t, flows);
  groups_.sum_up(next_);
  if (groups_.has_new_drift()) return false;
  accept(sums, terms, state.t);
  if (!(sums.coupler > kLeastGrowth * std::abs(record_.coupler.value))) {
    record_.coupler.include(sums.coupler, state.t);
  } else if (!has_peak_ || sums.coupler > peak_energy_) {
    has_peak_ = true;
    peak_energy_ = sums.coupler;
    peak_ = state;
  }
  return true;
}

bool EnergyObserver::has_passed_peak(const SystemTerms& terms) const {
  return has_peak_ && sum_coupler_energies(terms) < peak_energy_;
}

void EnergyObserver::include_peak(const SystemTerms& terms) {
  record_.coupler.include(sum_coupler_energies(terms), peak_.t);
  has_peak_ = false;
}

void EnergyObserver::accept(const Sums& sums, const SystemTerms& terms,
                            double t) {
  if (groups_.connect(terms.pairs, accounts_)) groups_.sum_up(next_);
  accounts_.swap(next_);
  time_ = t;
  ++steps_;
  include_bodies(sums, t);
  groups_.include(accounts_, t);
}

bool EnergyObserver::has_too_much(const SystemState& state,
                                  const SystemTerms& terms) {
  evaluate(state, terms);
  groups_.sum_up(next_);
  const bool is_much = groups_.has_too_much();
  groups_.sum_up(accounts_);
  return is_much;
}

Vector3 EnergyObserver::find_mean_velocity(const Pair& pair) const {
  double mass = 0.0;
  Vector3 momentum = Vector3::Zero();
  for (const BodyIndex b : {pair.body_A, pair.body_B}) {
    if (b == kWorld) return Vector3::Zero();
    const EnergyAccount& account = accounts_[index(b)];
    if (account.mass == 0.0) return Vector3::Zero();
    mass += account.mass;
    momentum += account.momentum;
  }
  return momentum / mass;
}

EnergyObserver::PairStep EnergyObserver::find_pair_step(std::size_t i) const {
  const Pair& pair = model_.pairs[i];
  const Eigen::Index row = rows_.pairs + static_cast<Eigen::Index>(i);
  const EnergyAccount& account = accounts_[static_cast<std::size_t>(row)];
  const Vector3 v = find_mean_velocity(pair);
  const double walk = 10.0 * std::sqrt(steps_);
  PairStep step{
      .time = time_, .stored = account.stored, .returned = account.out};
  for (std::size_t k = 0; k < accounts_.size(); ++k) {
    const auto other = static_cast<Eigen::Index>(k);
    if (!groups_.is_same(row, other)) continue;
    const double error = accounts_[k].error_in(v) - next_[k].error_in(v);
    step.group_error += error;
    const bool is_body =
        k < model_.bodies.size() &&
        (BodyIndex(other) == pair.body_A || BodyIndex(other) == pair.body_B);
    if (other != row && !is_body) continue;
    step.own_error += error;
    step.roundoff += accounts_[k].roundoff_in(v) + walk * accounts_[k].noise;
  }
  return step;
}

EnergyRecord EnergyObserver::find_record(const VectorX& negligible) const {
  EnergyRecord record = record_;
  record.drift = groups_.drift();
  const auto is_worse = [](const EnergyDrift& a, const EnergyDrift& b) {
    const double fractions[] = {find_unbalanced_fraction(a),
                                find_unbalanced_fraction(b)};
    if (fractions[0] != fractions[1]) return fractions[0] > fractions[1];
    return std::abs(a.drift.value) > std::abs(b.drift.value);
  };
  for (EnergyDrift& drift :
       groups_.find_drifts(accounts_, negligible, steps_)) {
    record.throughput += drift.throughput;
    record.roundoff += drift.roundoff;
    if (is_worse(drift, record.worst)) record.worst = std::move(drift);
  }
  for (std::size_t i = 0; i < accounts_.size(); ++i) {
    const EnergyAccount& row = accounts_[i];
    const auto k = static_cast<Eigen::Index>(i);
    const Vector3& v = groups_.find_velocity(k);
    const double stored = row.stored_in(v);
    if (row.in + row.out + row.dissipated == 0.0 && stored == 0.0) continue;
    record.rows.push_back({name_energy_row(model_, k), stored, row.in, row.out,
                           row.dissipated, row.error_in(v)});
  }
  return record;
}

void EnergyObserver::exchange_memory(Archive& archive) {
  archive(accounts_, time_, steps_, record_.stored, record_.kinetic,
          record_.elastic, record_.coupler, has_peak_, peak_energy_, peak_);
  groups_.exchange_memory(archive);
  if (archive.reads()) groups_.sum_up(accounts_);
}

}  // namespace limber::dynamics
