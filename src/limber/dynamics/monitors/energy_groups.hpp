// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "limber/dynamics/equations/energy_flows.hpp"
#include "limber/dynamics/equations/relative_energy.hpp"
#include "limber/dynamics/monitors/energy_account.hpp"
#include "limber/dynamics/monitors/energy_growth_observer.hpp"
#include "limber/dynamics/monitors/energy_record.hpp"

namespace limber::dynamics {

/// Least relative growth of an extreme before it is evaluated exactly.
inline constexpr double kLeastGrowth = 1.01;

/// Energies judged by groups of bodies that are connected to each other, each
/// relative to its own throughput: neither what else moves in a scene nor a
/// common velocity changes a verdict.
///
/// Equation   in the frame of a group that is not connected to the world, with
///            its velocity v at the start: E' = E - p . v + m v^2 / 2, and the
///            work less v . (impulse of all forces). Groups that touch become
///            one, which moves with the mean of both velocities. Of bodies
///            that have been in contact the throughput is at least m (|g| h)^2
///            / 2, h the step of the run: slower than a fall within a step is
///            rest, as for ImpactObserver
class EnergyGroups {
 public:
  /// @param lags whether work lags by a step (EnergyGrowthObserver)
  /// @param model stored by reference
  /// @param h step of the run, 0 with a tolerance [s]
  EnergyGroups(const SystemModel& model, bool lags, double h);

  /// Connects the bodies of pairs that touch.
  /// @param accounts last included
  /// @returns whether groups became one: the sums are of `accounts` then
  bool connect(const PairTerms& pairs,
               const std::vector<EnergyAccount>& accounts);
  /// Begins with the energies at the start.
  /// @param taken by an impulse just before, which each group may have had [J]
  void start(const std::vector<EnergyAccount>& accounts, double taken);
  /// Sets each group's sums of accounts, which the functions below judge.
  void sum_up(const std::vector<EnergyAccount>& accounts);
  /// The end of a step [s]. Call connect() and sum_up() before.
  void include(const std::vector<EnergyAccount>& accounts, double t);
  /// Whether include() would find a new extreme of a drift that matters.
  [[nodiscard]] bool has_new_drift() const;

  /// Stored energy of a group and the energy of its start and loads [J].
  struct Excess {
    double stored = 0.0;
    double accounted = 0.0;
  };
  /// A group whose energy can only be a numerical artefact
  /// (EnergyGrowthObserver).
  [[nodiscard]] std::optional<Excess> find_blow_up(bool is_end);
  /// Whether a group stores more than ten times the supplied energy.
  [[nodiscard]] bool has_too_much() const;

  /// Whether two rows are of one group.
  [[nodiscard]] bool is_same(Eigen::Index row, Eigen::Index other) const;
  /// Of the group of `row`, the velocity of its frame [m/s].
  [[nodiscard]] const Vector3& find_velocity(Eigen::Index row) const;
  /// Of all groups together.
  [[nodiscard]] Extreme drift() const { return drift_; }
  /// @param negligible losses of rows that nothing accounts for [J]
  /// @param steps number so far
  [[nodiscard]] std::vector<EnergyDrift> find_drifts(
      const std::vector<EnergyAccount>& accounts, const VectorX& negligible,
      double steps) const;

  /// Saves or restores its state for checkpoints.
  void exchange_memory(Archive& archive);

 private:
  struct Group {
    bool is_held = false;                // connected to the world
    double mass = 0.0;                   // of bodies that are free [kg]
    Vector3 velocity = Vector3::Zero();  // of its frame [m/s]
    double work = 0.0;                   // at the last include() [J]
    double throughput = 0.0;             // [J]
    Extreme drift;                       // [J]
    Eigen::Index worst = -1;             // row of its largest error
    double place_error = 0.0;            // [J]
    EnergyGrowthObserver observer;
  };
  friend void exchange(Archive& archive, Group& group);
  struct Sums {
    double stored = 0.0;
    double kinetic = 0.0;
    double work = 0.0;
    double dissipated = 0.0;
    double error = 0.0;
    double rest = 0.0;  // energy that a group at rest may have by round-off
  };
  [[nodiscard]] Eigen::Index find_root(Eigen::Index row) const;
  [[nodiscard]] std::size_t group_of(std::size_t row) const;
  void settle_roots();
  void join(Eigen::Index row, Eigen::Index other);
  void join_body(Eigen::Index row, BodyIndex body);
  void join_attachment(Eigen::Index row, AttachmentIndex attachment);
  void meet(Group& group, const Group& other) const;
  void include_extremes(std::size_t root);
  [[nodiscard]] std::vector<double> find_rest_energies(
      const std::vector<EnergyAccount>& accounts) const;
  void note_place(std::size_t root, const std::vector<EnergyAccount>& accounts);

  const SystemModel& model_;
  EnergyRows rows_;
  bool lags_;
  double rest_speed_;                  // [m/s]
  std::vector<char> has_met_;          // of pairs: they have touched
  std::vector<Eigen::Index> parents_;  // of rows; a root is its own
  std::vector<std::size_t> roots_;     // increasing
  std::vector<Group> groups_;          // at roots
  std::vector<Sums> sums_;             // likewise
  Extreme drift_;
};

}  // namespace limber::dynamics
