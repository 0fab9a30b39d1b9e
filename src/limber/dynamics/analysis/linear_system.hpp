// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "limber/dynamics/analysis/linear_inputs.hpp"
#include "limber/dynamics/analysis/linear_model.hpp"
#include "limber/dynamics/analysis/steady_motion.hpp"

namespace limber::dynamics {

/// A system linearised about the motion from a state: first-order equations of
/// motion, and the rows that outputs are composed of.
///
/// Equation   z' = A z + B du,   z = (s q, q', y),   x = Q q
///            q'' = -Q' S Q q - Q' D Q q' - Q' E' y + Q' F du,
///            y' = E Q q' - y / tau
///            of SmallMotion in PrincipalBasis; s the frequency of a
///            coordinate, which scales A, and 1 of free motion
/// Limits     dense. Coefficients are those at the state: exact for steady
///            motion (`imbalance`, `change`). Controllers are not included:
///            what they write are inputs. Switches keep their positions;
///            friction acts as the damper that it is near rest
///
/// Rows as functions of the states: six for each link (couplers, then
/// transmissions), as SmallMotion::G; six for each requested frame, world
/// frame, translation first.
struct LinearSystem {
  TurningAxes axes;  ///< R = 1; vectors are in these axes
  bool is_moving = false;
  Imbalance imbalance;  ///< of the reference
  double change = 0.0;  ///< of the coefficients while it rotates by 1 rad [-]
  Eigen::Index coordinates = 0;  ///< of q
  Eigen::Index free = 0;         ///< those of free motion
  MatrixX A;                     ///< [1/s]
  MatrixX B;                     ///< [state's / s / input's]
  std::vector<LinearSignal> states;
  std::vector<LinearInput> inputs;
  MatrixX links;              ///< motion [m, rad]
  MatrixX link_velocities;    ///< [m/s, rad/s]
  MatrixX wrenches;           ///< of the links' laws [N, N m]
  MatrixX wrenches_by_input;  ///< likewise, by the inputs [N, N m]
  MatrixX frames;             ///< motion [m, rad]
  MatrixX frame_velocities;   ///< [m/s, rad/s]
  MatrixX modes;              ///< of all bodies, order of the state [kg^1/2 m]
  /// Modes with the extensions of their Maxwell elements, sum_j g_j d_j, to
  /// which stress is proportional [kg^1/2 m].
  MatrixX stressed_modes;
};

/// @param frames attachments whose motion is needed for outputs
/// @param names of drives; default: find_linear_inputs
/// @throws InputError for a body at level `full`, bodies that touch, or if
/// nothing moves.
[[nodiscard]] LinearSystem linearise(
    const SystemModel& model, const SystemState& state,
    const std::vector<AttachmentIndex>& frames = {},
    const DriveNames& names = {});

}  // namespace limber::dynamics
