// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "limber/common/records/archive.hpp"
#include "limber/dynamics/equations/workspace.hpp"
#include "limber/dynamics/integrators/step_result.hpp"
#include "limber/dynamics/monitors/energy_record.hpp"
#include "limber/dynamics/system/system_state.hpp"

namespace limber::dynamics {

/// Energy of every body, coupler, transmission and pair over all steps, and the
/// unexplained part of its changes.
///
/// Equation   of a part: open = sum over steps of (E_1 - E_0 - h (P_0 + P_1) /
///            2), P the power supplied: to a body by all forces but inertial
///            ones, less its damping; to a coupler -wrench . v - dissipation +
///            supplied. Of all together: EnergyRecord. Round-off: that of the
///            energy that passes through parts, and of positions through stiff
///            couplers: (|f| + k d) d, d = eps L
/// Limits     a part's share has the error of the trapezoidal rule, which
///            cancels in the sum.
class EnergyLedger {
 public:
  /// @param model stored by reference
  explicit EnergyLedger(const SystemModel& model);

  /// @param terms at `state`, here and below
  /// @param totals of an impulse before the first step
  void start(const SystemState& state, const SystemTerms& terms,
             const StepResult& totals);
  /// The end of a step. @param totals work and dissipation since the start
  void add(const SystemState& state, const SystemTerms& terms,
           const StepResult& totals);
  /// The same with approximate terms, which contain the remaining error of
  /// Newton's method in stiff couplers and contacts. @returns false, without
  /// effect, if they would give a new extreme, which needs exact terms
  [[nodiscard]] bool try_add(const SystemState& state, const SystemTerms& terms,
                             const StepResult& totals);
  /// Forces jump at `state`: the next step begins with new ones.
  void restart(const SystemState& state, const SystemTerms& terms);

  [[nodiscard]] EnergyRecord find_record() const;

  /// Saves or restores its state for checkpoints.
  void exchange_memory(Archive& archive);

 private:
  struct Part {
    double energy = 0.0;  // [J]
    double power = 0.0;   // [W]
    double open = 0.0;    // [J]
  };
  struct Sums {
    double kinetic = 0.0;
    double elastic = 0.0;
    double coupler = 0.0;
    [[nodiscard]] double total() const { return kinetic + elastic + coupler; }
  };
  friend void exchange(Archive& archive, Part& part);

  Sums evaluate(const SystemState& state, const SystemTerms& terms);
  void evaluate_body(std::size_t b, const SystemState& state,
                     const SystemTerms& terms, Sums& sums);
  void evaluate_full(std::size_t b, const SystemState& state,
                     const SystemTerms& terms, Sums& sums);
  [[nodiscard]] double find_drift(const Sums& sums,
                                  const StepResult& totals) const;
  [[nodiscard]] bool is_remarkable(const Sums& sums, double drift) const;
  // Includes evaluated sums and parts.
  void include(const Sums& sums, double drift, const SystemState& state,
               const SystemTerms& terms, const StepResult& totals);
  void include_energies(const Sums& sums, double t);
  void note_drift(double drift, double t);
  [[nodiscard]] double find_noise(const SystemTerms& terms) const;

  const SystemModel& model_;
  std::vector<Part> parts_;  // bodies, couplers, transmissions, pairs
  std::vector<Part> now_;
  std::vector<Matrix3X> scratch_;  // of unreduced bodies
  double time_ = 0.0;              // of parts_ [s]
  double initial_ = 0.0;           // stored [J]
  double passed_ = 0.0;            // through parts [J]
  double noise_ = 0.0;             // of couplers at a state, at most [J]
  double steps_ = 0.0;
  std::size_t worst_ = 0;  // part, at the drift's extreme
  EnergyRecord record_;
};

}  // namespace limber::dynamics
