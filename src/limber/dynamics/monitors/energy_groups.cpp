// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/monitors/energy_groups.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "limber/common/index.hpp"
#include "limber/dynamics/system/body_model.hpp"

namespace limber::dynamics {
namespace {

// Factor on the noise of couplers at one state, which accumulates as a random
// walk.
constexpr double kNoiseFactor = 10.0;
// Factor on both that no run at rest exceeds; what blows up soon does.
constexpr double kRestFactor = 1e6;
// Of the throughput: smaller drifts are not evaluated exactly.
constexpr double kNoteworthy = 1e-3;

std::size_t at(Eigen::Index i) { return static_cast<std::size_t>(i); }

}  // namespace

void exchange(Archive& archive, EnergyGroups::Group& group) {
  archive(group.is_held, group.mass, group.velocity, group.work,
          group.throughput, group.drift, group.worst, group.place_error);
  group.observer.exchange_memory(archive);
}

EnergyGroups::EnergyGroups(const SystemModel& model, bool lags, double h)
    : model_(model),
      rows_(model),
      lags_(lags),
      rest_speed_(h * model.gravity_W.norm()),
      has_met_(model.pairs.size(), 0),
      parents_(at(rows_.count)),
      groups_(at(rows_.count)),
      sums_(at(rows_.count)) {
  std::iota(parents_.begin(), parents_.end(), Eigen::Index(0));
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    groups_[b].is_held = model.bodies[b].is_held();
  }
  Eigen::Index row = rows_.couplers;
  for (const Coupler& coupler : model.couplers) {
    join_attachment(row, coupler.frame_F);
    join_attachment(row++, coupler.frame_M);
  }
  for (const Transmission& transmission : model.transmissions) {
    for (const BodyIndex b : find_joined_bodies(model, transmission)) {
      join_body(row, b);
    }
    ++row;
  }
  settle_roots();
}

Eigen::Index EnergyGroups::find_root(Eigen::Index row) const {
  while (parents_[at(row)] != row) row = parents_[at(row)];
  return row;
}

void EnergyGroups::settle_roots() {
  for (Eigen::Index& parent : parents_) parent = find_root(parent);
  roots_.clear();
  for (std::size_t i = 0; i < parents_.size(); ++i) {
    if (group_of(i) == i) roots_.push_back(i);
  }
}

std::size_t EnergyGroups::group_of(std::size_t row) const {
  return at(parents_[row]);
}

void EnergyGroups::join_attachment(Eigen::Index row,
                                   AttachmentIndex attachment) {
  join_body(row, model_.attachments[at(attachment)].body);
}

void EnergyGroups::join_body(Eigen::Index row, BodyIndex body) {
  if (body == kWorld) {
    Group& group = groups_[at(find_root(row))];
    Group world;
    world.is_held = true;
    if (!group.is_held) meet(group, world);
    return;
  }
  join(row, body);
}

void EnergyGroups::join(Eigen::Index row, Eigen::Index other) {
  const Eigen::Index a = find_root(row);
  const Eigen::Index b = find_root(other);
  if (a == b) return;
  const auto [root, child] = std::minmax(a, b);
  parents_[at(child)] = root;
  meet(groups_[at(root)], groups_[at(child)]);
  groups_[at(child)] = {};
}

// Of what each group moves beside the other counts as energy at the start.
void EnergyGroups::meet(Group& group, const Group& other) const {
  Vector3 velocity = Vector3::Zero();
  const bool is_held = group.is_held || other.is_held;
  const double mass = group.mass + other.mass;
  if (!is_held && mass > 0.0) {
    velocity =
        (group.mass * group.velocity + other.mass * other.velocity) / mass;
  }
  const auto add_motion = [&](const Group& of) {
    group.observer.add(0.5 * of.mass * (of.velocity - velocity).squaredNorm());
  };
  group.observer.add(other.observer.supplied());
  add_motion(other);
  add_motion(group);
  group.is_held = is_held;
  group.mass = mass;
  group.velocity = velocity;
  group.throughput = std::max(group.throughput, other.throughput);
  if (std::abs(other.drift.value) > std::abs(group.drift.value)) {
    group.drift = other.drift;
    group.worst = other.worst;
    group.place_error = other.place_error;
  }
}

bool EnergyGroups::connect(const PairTerms& pairs,
                           const std::vector<EnergyAccount>& accounts) {
  bool has_joined = false;
  for (std::size_t i = 0; i < model_.pairs.size(); ++i) {
    const Eigen::Index row = rows_.pairs + static_cast<Eigen::Index>(i);
    if (pairs.responses[i].points().empty() || has_met_[i] != 0) continue;
    has_met_[i] = 1;
    has_joined = true;
    join_body(row, model_.pairs[i].body_A);
    join_body(row, model_.pairs[i].body_B);
  }
  if (!has_joined) return false;
  settle_roots();
  sum_up(accounts);
  for (const std::size_t i : roots_) groups_[i].work = sums_[i].work;
  return true;
}

void EnergyGroups::start(const std::vector<EnergyAccount>& accounts,
                         double taken) {
  std::vector<Vector3> momenta(groups_.size(), Vector3::Zero());
  for (std::size_t i = 0; i < accounts.size(); ++i) {
    const std::size_t root = group_of(i);
    groups_[root].mass += accounts[i].mass;
    momenta[root] += accounts[i].momentum;
  }
  for (std::size_t i = 0; i < groups_.size(); ++i) {
    Group& group = groups_[i];
    if (group.is_held || group.mass == 0.0) continue;
    group.velocity = momenta[i] / group.mass;
  }
  sum_up(accounts);
  for (std::size_t i = 0; i < groups_.size(); ++i) {
    groups_[i].observer =
        EnergyGrowthObserver(std::abs(sums_[i].stored) + taken, lags_);
    groups_[i].throughput = taken;
    include_extremes(i);
  }
}

void EnergyGroups::sum_up(const std::vector<EnergyAccount>& accounts) {
  std::fill(sums_.begin(), sums_.end(), Sums{});
  for (std::size_t i = 0; i < accounts.size(); ++i) {
    const EnergyAccount& account = accounts[i];
    const std::size_t root = group_of(i);
    const Vector3& v = groups_[root].velocity;
    Sums& sums = sums_[root];
    sums.stored += account.stored_in(v);
    sums.kinetic += account.kinetic_in(v);
    sums.work += account.work_in(v);
    sums.dissipated += account.dissipated;
    sums.error += account.error_in(v);
    sums.rest +=
        kRestFactor * (account.noise + account.jitter) + account.roundoff_in(v);
  }
}

void EnergyGroups::include_extremes(std::size_t root) {
  const Sums& sums = sums_[root];
  double& throughput = groups_[root].throughput;
  throughput =
      std::max({throughput, std::abs(sums.stored), std::abs(sums.kinetic),
                std::abs(sums.work), std::abs(sums.dissipated)});
}

bool EnergyGroups::has_new_drift() const {
  for (const std::size_t i : roots_) {
    const double drift = std::abs(sums_[i].error);
    if (drift > kLeastGrowth * std::abs(groups_[i].drift.value) &&
        drift > kNoteworthy * groups_[i].throughput) {
      return true;
    }
  }
  return false;
}

void EnergyGroups::include(const std::vector<EnergyAccount>& accounts,
                           double t) {
  double drift = 0.0;
  for (const std::size_t i : roots_) {
    Group& group = groups_[i];
    group.observer.add(sums_[i].work - group.work);
    group.work = sums_[i].work;
    include_extremes(i);
    if (group.drift.include(sums_[i].error, t)) note_place(i, accounts);
    drift += sums_[i].error;
  }
  drift_.include(drift, t);
}

void EnergyGroups::note_place(std::size_t root,
                              const std::vector<EnergyAccount>& accounts) {
  Group& group = groups_[root];
  const double sign = group.drift.value < 0.0 ? -1.0 : 1.0;
  group.place_error = 0.0;
  for (std::size_t i = 0; i < accounts.size(); ++i) {
    if (group_of(i) != root) continue;
    const double error = accounts[i].error_in(group.velocity);
    if (!(sign * error > sign * group.place_error)) continue;
    group.place_error = error;
    group.worst = static_cast<Eigen::Index>(i);
  }
}

std::optional<EnergyGroups::Excess> EnergyGroups::find_blow_up(bool is_end) {
  std::optional<Excess> excess;
  for (const std::size_t i : roots_) {
    Group& group = groups_[i];
    if (group.observer.is_blown_up(sums_[i].stored, is_end, sums_[i].rest) &&
        !excess) {
      excess = Excess{sums_[i].stored, group.observer.supplied()};
    }
  }
  return excess;
}

bool EnergyGroups::has_too_much() const {
  for (const std::size_t i : roots_) {
    if (groups_[i].observer.is_too_much(sums_[i].stored, sums_[i].rest)) {
      return true;
    }
  }
  return false;
}

bool EnergyGroups::is_same(Eigen::Index row, Eigen::Index other) const {
  return parents_[at(row)] == parents_[at(other)];
}

const Vector3& EnergyGroups::find_velocity(Eigen::Index row) const {
  return groups_[group_of(at(row))].velocity;
}

// Of bodies that have been in contact, at the speed that a fall within a step
// has: what rests on another body can have no less without a finer step.
std::vector<double> EnergyGroups::find_rest_energies(
    const std::vector<EnergyAccount>& accounts) const {
  std::vector<double> energies(groups_.size(), 0.0);
  std::vector<char> counts(model_.bodies.size(), 0);
  for (std::size_t i = 0; i < model_.pairs.size(); ++i) {
    if (has_met_[i] == 0) continue;
    for (const BodyIndex b : {model_.pairs[i].body_A, model_.pairs[i].body_B}) {
      if (b != kWorld) counts[index(b)] = 1;
    }
  }
  for (std::size_t b = 0; b < counts.size(); ++b) {
    if (counts[b] == 0) continue;
    energies[group_of(b)] += 0.5 * accounts[b].mass * rest_speed_ * rest_speed_;
  }
  return energies;
}

std::vector<EnergyDrift> EnergyGroups::find_drifts(
    const std::vector<EnergyAccount>& accounts, const VectorX& negligible,
    double steps) const {
  std::vector<EnergyDrift> drifts(groups_.size());
  const double walk = kNoiseFactor * std::sqrt(std::max(steps, 1.0));
  for (std::size_t i = 0; i < accounts.size(); ++i) {
    const Vector3& v = groups_[group_of(i)].velocity;
    drifts[group_of(i)].roundoff += negligible[static_cast<Eigen::Index>(i)] +
                                    accounts[i].roundoff_in(v) +
                                    walk * accounts[i].noise;
  }
  const std::vector<double> rest = find_rest_energies(accounts);
  for (std::size_t i = 0; i < groups_.size(); ++i) {
    const Group& group = groups_[i];
    EnergyDrift& drift = drifts[i];
    drift.drift = group.drift;
    drift.throughput = std::max(group.throughput, rest[i]);
    drift.place_error = group.place_error;
    if (group.place_error == 0.0) continue;
    drift.place = name_energy_row(model_, group.worst);
    drift.is_one_way = group.worst < rows_.couplers &&
                       is_one_way(model_.bodies[at(group.worst)]);
  }
  return drifts;
}

void EnergyGroups::exchange_memory(Archive& archive) {
  archive(has_met_, parents_, groups_, drift_);
  if (archive.reads()) settle_roots();
}

}  // namespace limber::dynamics
