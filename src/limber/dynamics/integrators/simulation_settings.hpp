// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "limber/dynamics/integrators/integrator_kind.hpp"

namespace limber::dynamics {

/// A change of the longest step at a time.
struct StepChange {
  double from = 0.0;  ///< [s]
  double step = 0.0;  ///< > 0 [s]
};

/// How a run meets a tolerance.
enum class TolerancePasses {
  automatic,  ///< verified where loads or commands oscillate, else one
  one,        ///< steps with an error that usually meets it; no estimate
  verified,   ///< again with shorter steps until the difference shows it
};

/// As scenarios name them, in the enumerators' order.
inline constexpr std::array<std::string_view, 3> kTolerancePasses = {
    "auto", "one", "verified"};

[[nodiscard]] constexpr std::string_view to_string(TolerancePasses passes) {
  return kTolerancePasses.at(static_cast<std::size_t>(passes));
}

struct SimulationSettings {
  IntegratorKind integrator = IntegratorKind::generalized_alpha;
  double end_time = 0.0;  ///< > start [s]
  double step = 0.0;      ///< longest step, > 0 [s]
  /// Largest error of any point's position at any output time, met by steps of
  /// varying length up to `step` [m]; 0: fixed steps. For adaptive integrators
  /// (IntegratorTraits::is_adaptive).
  double tolerance = 0.0;
  TolerancePasses passes = TolerancePasses::automatic;  ///< to a tolerance
  /// Largest number of steps to a tolerance, over all passes, including
  /// repeated steps.
  long most_steps = 5'000'000;
  std::vector<StepChange> step_changes = {};  ///< at increasing times
  std::vector<double> output_times = {};  ///< increasing, in [start, end] [s]
  double rho_inf = 0.9;  ///< spectral radius at infinity, in [0, 1] [-]
  /// Largest error of Newton's method relative to the step's motion [-]. 0: a
  /// hundredth of the step's error; 1e-12 for energy_conserving and for
  /// rho_inf = 1.
  double newton_tolerance = 0.0;
  int newton_iterations = 20;  ///< largest number per step
  /// Steps in half a period of an impact, at least; longer ones are divided
  /// [-].
  double impact_steps = 20.0;
  /// Modes of `uncoupled` bodies driven by known loads only are solved in
  /// closed form, without steps (not by explicit_euler, which samples loads).
  bool exact_modes = true;
};

}  // namespace limber::dynamics
