// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <complex>
#include <optional>
#include <vector>

#include "limber/dynamics/analysis/steady_motion.hpp"
#include "limber/dynamics/system/system_model.hpp"
#include "limber/dynamics/system/system_state.hpp"

namespace limber::dynamics {

/// One mode of small motion, proportional to exp(value t).
struct NaturalMode {
  std::complex<double> value;  ///< imaginary part >= 0; 0: free [1/s]
  /// Whirl relative to the spin of a moving system, seen from the axes [-]: 1 a
  /// forward circle, -1 a backward circle, 0 a line. From the orbits of the
  /// masses.
  double orbit = 0.0;
  /// Of the axes in which both are expressed, world frame [rad/s].
  Vector3 axes_w_W = Vector3::Zero();

  [[nodiscard]] bool is_free() const { return value == 0.0; }
  /// Undamped natural frequency of a damped oscillation, |value| / 2 pi [Hz].
  [[nodiscard]] double frequency() const;
  /// -Re(value) / |value|: 1 and -1 without oscillation [-].
  [[nodiscard]] double damping_ratio() const;
};

/// Modes of small motion about a start.
struct NaturalModes {
  std::vector<NaturalMode> modes;  ///< free ones, then by |value|
  bool is_moving = false;
  TurningAxes axes;     ///< the fastest of the modes' axes; at rest: world
  Imbalance imbalance;  ///< of the start
  /// Largest relative change of a group's M, D and S while it rotates by 1 rad:
  /// 0 if the frequencies are exact [-].
  double change = 0.0;
};

/// Eigenvalues of small motion about the steady motion of a state, with
/// dampers, gyroscopic and centrifugal terms. Each linked group of bodies that
/// moves is described by itself, in fixed axes, or in axes that rotate with its
/// fastest spinning body, whichever give constant coefficients: an axisymmetric
/// rotor in any bearings, or any rotor in isotropic bearings.
///
/// Equation   det(M s^2 + D s + S + E' diag(s tau / (1 + s tau)) E) = 0 of
///            SmallMotion; relaxation of Maxwell elements is left out. Free
///            motion is the null space of S: of all couplers, whatever their
///            stiffness, where the rest of S is round-off. It is separated
///            first.
/// Source     Genta, "Dynamics of Rotating Systems", 2005, ch. 3 [@genta2005]
/// Limits     dense: (12 bodies + 2 modes + Maxwell elements)^3 of a group
/// @throws InputError for a body at level `full`.
[[nodiscard]] NaturalModes find_natural_modes(const SystemModel& model,
                                              const SystemState& state);

/// Natural frequencies at rest and without dampers, materials with their static
/// stiffness, drives at their commands of
/// state.t. Ascending; 0 for free motion, negative for unstable motion [Hz].
///
/// Equation   S x = lambda M x, S symmetrised;
///            sign(lambda) sqrt(|lambda|) / (2 pi)
/// @throws InputError for a body at level `full`.
[[nodiscard]] VectorX find_natural_frequencies(const SystemModel& model,
                                               const SystemState& state);

}  // namespace limber::dynamics
