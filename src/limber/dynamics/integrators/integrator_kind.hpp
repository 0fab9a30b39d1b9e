// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace limber::dynamics {

enum class IntegratorKind {
  generalized_alpha,
  runge_kutta_4,
  explicit_euler,
  central_differences,
  implicit_euler,
  energy_conserving,
  splitting,  // kLastIntegrator
};
inline constexpr IntegratorKind kLastIntegrator = IntegratorKind::splitting;

/// How steps too long for an explicit scheme are detected, to be divided.
enum class StepLimit {
  none,       ///< not detected
  stability,  ///< by the highest frequency (find_stable_step)
  growth,     ///< by the growth of small motion over a step
};

/// Properties of an integrator on which callers depend.
struct IntegratorTraits {
  std::string name;  ///< in files and messages
  int order = 2;     ///< of accuracy [-]
  /// Solves each step by Newton's method.
  bool is_implicit = false;
  /// Estimates each step's error, and so can meet a tolerance.
  bool is_adaptive = false;
  bool has_spectral_radius = false;  ///< reads SimulationSettings::rho_inf
  bool takes_nodes = false;  ///< integrates bodies whose unknowns are nodes
  bool takes_ideal_joints = false;  ///< solves for what holds them
  /// Modes driven by known loads only may be solved in closed form.
  bool takes_exact_modes = true;
  /// terms() belong to the end of the last step.
  bool leaves_end_terms = false;
  StepLimit limit = StepLimit::none;
};

[[nodiscard]] const IntegratorTraits& traits_of(IntegratorKind kind);

/// "generalized-alpha", "runge-kutta-4", "explicit-euler",
/// "central-differences", "implicit-euler", "energy-conserving", "splitting".
[[nodiscard]] const std::vector<std::string>& integrator_names();
[[nodiscard]] const std::string& to_string(IntegratorKind kind);
/// @throws InputError naming the nearest integrator.
[[nodiscard]] IntegratorKind parse_integrator(std::string_view name);

}  // namespace limber::dynamics
