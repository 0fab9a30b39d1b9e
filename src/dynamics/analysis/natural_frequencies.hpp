// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <complex>
#include <optional>
#include <vector>

#include "dynamics/steady_motion.hpp"
#include "dynamics/system_model.hpp"
#include "dynamics/system_state.hpp"

namespace limber::dynamics {

/// One way in which small motion goes: as exp(value t).
struct NaturalMode {
  std::complex<double> value;  ///< imaginary part >= 0; 0: free [1/s]
  /// How it goes around the spin, of a system that moves: 1 a circle with it,
  /// -1 one against it, 0 a line; seen from the axes. By the masses' orbits.
  double orbit = 0.0;

  [[nodiscard]] bool is_free() const { return value == 0.0; }
  /// Undamped natural frequency of a damped oscillation, |value| / 2 pi [Hz].
  [[nodiscard]] double frequency() const;
  /// -Re(value) / |value|: 1 and -1 without oscillation [-].
  [[nodiscard]] double damping_ratio() const;
};

/// Small motion about a start.
struct NaturalModes {
  std::vector<NaturalMode> modes;  ///< free ones, then by |value|
  bool is_moving = false;
  TurningAxes axes;     ///< the values are seen from these; at rest: world
  Imbalance imbalance;  ///< of the start
  /// How far M, D and S change while the system turns by 1 rad, of themselves:
  /// 0 where frequencies are meant exactly [-].
  double change = 0.0;
};

/// Eigenvalues of small motion about what a state goes on with, dampers,
/// gyroscopic and centrifugal terms included. About a motion in axes that
/// rest, or that turn with the body that spins fastest, whichever sees the
/// same system all the time: a round rotor in any bearings, or any rotor in
/// round bearings.
///
/// Equation   det(M s^2 + D s + S) = 0 of SmallMotion. What S leaves free is
///            its null space: that of what holds, whatever its stiffness, in
///            which the rest of S is round-off. It is split off.
/// Source     Genta, "Dynamics of Rotating Systems", 2005, ch. 3 [@genta2005]
/// Limits     dense: (12 bodies + 2 modes)^3
/// @throws InputError for a body at level `full`.
[[nodiscard]] NaturalModes find_natural_modes(const SystemModel& model,
                                              const SystemState& state);

/// Natural frequencies at rest and without dampers: drives hold what they
/// command at state.t. Ascending; what moves freely has 0, what would fall away
/// from an unstable configuration a negative one [Hz].
///
/// Equation   S x = lambda M x, S made symmetric;
///            sign(lambda) sqrt(|lambda|) / (2 pi)
/// @throws InputError for a body at level `full`.
[[nodiscard]] VectorX find_natural_frequencies(const SystemModel& model,
                                               const SystemState& state);

}  // namespace limber::dynamics
