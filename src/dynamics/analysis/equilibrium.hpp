// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "common/progress.hpp"
#include "dynamics/system_state.hpp"

namespace limber::dynamics {

enum class EquilibriumMethod {
  newton,      ///< load stepping: follows the branch from the start
  relaxation,  ///< falls to an equilibrium, however far, then newton
};
/// "newton", "relaxation".
[[nodiscard]] const std::vector<std::string>& equilibrium_method_names();
/// @throws InputError naming the nearest method.
[[nodiscard]] EquilibriumMethod parse_equilibrium_method(std::string_view name);

struct EquilibriumSettings {
  EquilibriumMethod method = EquilibriumMethod::newton;
  double tolerance = 1e-12;       ///< last correction over the extent [-]
  int newton_iterations = 20;     ///< at most, a load step
  double smallest_share = 1e-4;   ///< of the load, a load step [-]
  int relaxation_steps = 100000;  ///< at most
};

/// Where a system stays at rest.
struct Equilibrium {
  SystemState state;   ///< without velocities, at the start's time
  int load_steps = 0;  ///< 0: it was in equilibrium already
  int newton_iterations = 0;
  int relaxation_steps = 0;
  double distance = 0.0;  ///< from the start, mass-weighted [m]
  double extent = 0.0;    ///< of the system [m]
};

/// Static equilibrium under loads, gravity and couplers, drives holding what
/// they command, all as at the start's time (after a jump then). Velocities of
/// the start do not count, and neither does friction. Latches stay as they are.
///
/// Equation   f(x) = (1 - s) f(x_0), s from 0 to 1: what does not balance at
///            the start x_0 is put on by and by (numerical continuation), with
///            Newton's method at each s. Its equations are solved by GMRES
///            with the NewtonMatrix of a slow step as preconditioner; what that
///            leaves out, geometric stiffness, is felt by differences of
///            forces. Couplers' wrenches are unknowns of their own, so that no
///            stiffness is too stiff.
///            relaxation: implicit Euler's steps at constant loads, stopped at
///            each peak of kinetic energy, until Newton's method finds what is
///            near [@cundall1976].
/// Source     Knoll and Keyes, "Jacobian-free Newton-Krylov methods", J.
///            Comput. Phys. 193, 2004 [@knoll2004].
/// @throws InputError if free bodies are pushed or turned; NumericalError if
/// there is a limit point on the way, or motion that nothing holds, naming the
/// body that moves most and the share of the load reached.
[[nodiscard]] Equilibrium find_equilibrium(
    const SystemModel& model, const SystemState& start,
    const EquilibriumSettings& settings = {}, const Progress& progress = {});

}  // namespace limber::dynamics
