// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "dynamics/equations.hpp"
#include "dynamics/step_result.hpp"
#include "flexbody/modal_response_oscillator.hpp"

namespace limber::dynamics {

/// Explicit scheme in which modes swing exactly and all else kicks.
///
/// Equation   drift(h/2), kick(h), drift(h/2). Drift: p += h v / 2,
///            R <- R exp(h w / 2), each mode as a free damped oscillator by
///            its closed form. Kick: velocities change by what else acts, at
///            positions and a time that rest, by the midpoint rule: a change
///            over h/2 with the velocities before, then over h with those
///            midway.
/// Source     [@strang1968]; of oscillators and impulses: [@garciaarchilla1998]
/// Limits     second order. Modes never limit the step by themselves: the
///            stiffness and damping of couplers do (h below about 2 / their
///            highest frequency on the bodies), and turns (well below a radian
///            a step). Steps near a multiple of half a mode's period resonate
///            with its kicks: its amplitude may grow there. Energy of fast
///            turns grows by (w h)^4 / 8 a step. Not for level `full`.
class Splitting {
 public:
  explicit Splitting(const SystemModel& model);

  /// Advances `state` by h, to the time `end`.
  /// @throws NumericalError if the motion is no longer finite.
  StepResult step(SystemState& state, double h, double end);

  /// At the middle of the last step; couplers' motion at its end.
  [[nodiscard]] const SystemTerms& terms() const { return terms_; }

 private:
  void set_half(double half);
  // Adds what modal dampers take to `dissipated`.
  void drift(SystemState& state, double& dissipated) const;
  void calc_kick();
  void kick(const SystemState& from, double h, SystemState& to) const;

  const SystemModel& model_;
  SystemTerms terms_;
  Accelerations kick_;  // without the modes' own springs and dampers
  SystemState next_;
  SystemState middle_;
  std::vector<flexbody::ModalOscillator> oscillators_;  // all modes
  std::vector<flexbody::FreeResponse> responses_;       // over half_
  double half_ = 0.0;                                   // of a step [s]
};

}  // namespace limber::dynamics
