// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "limber/common/records/archive.hpp"
#include "limber/dynamics/equations/energy_flows.hpp"
#include "limber/dynamics/integrators/integrator_kind.hpp"
#include "limber/dynamics/monitors/energy_account.hpp"
#include "limber/dynamics/monitors/energy_groups.hpp"
#include "limber/dynamics/monitors/energy_record.hpp"
#include "limber/dynamics/system/system_state.hpp"
#include "limber/dynamics/terms/system_terms.hpp"

namespace limber::dynamics {

/// Energy of every body, coupler, transmission and pair over all steps, and the
/// unexplained part of its changes: a row each (EnergyRow), judged by groups of
/// connected bodies (EnergyGroups).
///
/// Equation   of a row: error = E - E at the start - sum over steps of
///            h (P_0 + P_1) / 2 - supplied + dissipated, P the power received
///            from other rows: by a body from all forces but inertial ones,
///            less its loads; by a coupler -wrench . v. Round-off: that of the
///            energy that passes through rows, and of positions through stiff
///            couplers: (|f| + k d) d, d = eps L
/// Limits     an error of a row has that of the trapezoidal rule, which cancels
///            in the sum of a group.
class EnergyObserver {
 public:
  /// @param model stored by reference
  /// @param h step of the run, 0 with a tolerance [s]
  EnergyObserver(const SystemModel& model, IntegratorKind integrator,
                 double h = 0.0);

  /// @param terms at `state`, here and below
  /// @param taken by an impulse just before [J]
  void start(const SystemState& state, const SystemTerms& terms,
             double taken = 0.0);
  /// The end of a step. @param flows sums since the start
  void add(const SystemState& state, const SystemTerms& terms,
           const EnergyFlows& flows);
  /// The same with approximate terms, which contain the remaining error of
  /// Newton's method in stiff couplers and contacts. More energy in these than
  /// ever before is not recorded but kept with its state, the peak. @returns
  /// false, without effect, if they would give a new extreme of a drift, which
  /// needs exact terms
  [[nodiscard]] bool try_add(const SystemState& state, const SystemTerms& terms,
                             const EnergyFlows& flows);
  /// The state of try_add() whose energy of couplers is still to be recorded,
  /// null if there is none.
  [[nodiscard]] const SystemState* peak() const {
    return has_peak_ ? &peak_ : nullptr;
  }
  /// Whether couplers have less energy by `terms` than at the peak, which will
  /// not grow on.
  [[nodiscard]] bool has_passed_peak(const SystemTerms& terms) const;
  /// Records the peak. @param terms exact, there
  void include_peak(const SystemTerms& terms);
  /// Forces jump at `state`: the next step begins with new ones.
  void restart(const SystemState& state, const SystemTerms& terms);

  /// A group that blows up, at the last state added.
  [[nodiscard]] std::optional<EnergyGroups::Excess> find_blow_up(bool is_end) {
    return groups_.find_blow_up(is_end);
  }
  /// Whether a group has more than ten times the energy that is accounted for
  /// (EnergyGrowthObserver) at the last state added, or at `state`, which is
  /// not added.
  [[nodiscard]] bool has_too_much() { return groups_.has_too_much(); }
  [[nodiscard]] bool has_too_much(const SystemState& state,
                                  const SystemTerms& terms);

  /// Change of a pair's energy by the last step added.
  struct PairStep {
    double time = 0.0;      ///< at its end [s]
    double stored = 0.0;    ///< in the pair, then [J]
    double returned = 0.0;  ///< to the bodies by then, since the start [J]
    /// Errors of the rows of the pair and its bodies, and of all bodies that
    /// are connected with them, in the step [J].
    double own_error = 0.0;
    double group_error = 0.0;
    double roundoff = 0.0;  ///< of the first since the start, at most [J]
  };
  /// In the frame of the mean velocity of both bodies then, of the world where
  /// it is one of them: free of what else moves. Call after add() or try_add().
  [[nodiscard]] PairStep find_pair_step(std::size_t pair) const;

  /// @param negligible losses of rows that nothing accounts for [J]
  [[nodiscard]] EnergyRecord find_record(const VectorX& negligible) const;

  /// Saves or restores its state for checkpoints.
  void exchange_memory(Archive& archive);

 private:
  struct Sums {
    double kinetic = 0.0;
    double elastic = 0.0;
    double coupler = 0.0;
    [[nodiscard]] double total() const { return kinetic + elastic + coupler; }
  };

  Sums evaluate(const SystemState& state, const SystemTerms& terms);
  void evaluate_body(std::size_t b, const SystemState& state,
                     const SystemTerms& terms);
  void set_noise(const SystemTerms& terms);
  void set_jitter(const SystemState& state, double h);
  // Sets next_ to the accounts after a step with what was evaluated.
  void advance(double t, const EnergyFlows& flows);
  [[nodiscard]] Vector3 find_mean_velocity(const Pair& pair) const;
  void accept(const Sums& sums, const SystemTerms& terms, double t);
  void include_bodies(const Sums& sums, double t);

  const SystemModel& model_;
  // Whether work is that of the forces at both ends of a step, from which the
  // change of momentum then differs.
  bool works_by_ends_;
  EnergyRows rows_;
  EnergyGroups groups_;
  std::vector<EnergyAccount> accounts_;
  std::vector<EnergyAccount> next_;  // or those of the step before
  std::vector<Matrix3X> scratch_;    // one a body, of BodyKind
  double time_ = 0.0;                // of accounts_ [s]
  double steps_ = 0.0;
  EnergyRecord record_;
  bool has_peak_ = false;
  double peak_energy_ = 0.0;  // of couplers, by approximate terms [J]
  SystemState peak_;
};

/// Energy in couplers, transmissions and pairs [J].
[[nodiscard]] double sum_coupler_energies(const SystemTerms& terms);

}  // namespace limber::dynamics
