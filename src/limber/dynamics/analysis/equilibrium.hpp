// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "limber/common/progress.hpp"
#include "limber/dynamics/system/system_state.hpp"

namespace limber::dynamics {

enum class EquilibriumMethod {
  newton,      ///< load stepping: follows the branch from the start
  relaxation,  ///< dynamic relaxation to a distant equilibrium, then newton
};
/// "newton", "relaxation".
[[nodiscard]] const std::vector<std::string>& equilibrium_method_names();
/// @throws InputError naming the nearest method.
[[nodiscard]] EquilibriumMethod parse_equilibrium_method(std::string_view name);

struct EquilibriumSettings {
  EquilibriumMethod method = EquilibriumMethod::newton;
  double tolerance = 1e-12;         ///< last correction over the extents [-]
  int newton_iterations = 20;       ///< largest number per load step
  double smallest_fraction = 1e-4;  ///< of the load, a load step [-]
  double largest_fraction = 1.0;    ///< of the load, a load step [-]
  int relaxation_steps = 100000;    ///< largest number
};

/// A static equilibrium.
struct Equilibrium {
  SystemState state;          ///< without velocities, at the start's time
  int load_steps = 0;         ///< count; 0: the start is in equilibrium
  int newton_iterations = 0;  ///< count
  int relaxation_steps = 0;   ///< count
  double distance = 0.0;      ///< from the start, mass-weighted in a group [m]
  double extent = 0.0;        ///< of the largest group [m]
};

/// Static equilibrium under loads, gravity, couplers and drives at their
/// commands, all at the start's time (after a jump at that time). Ignores
/// velocities and friction. Latches do not change. Ideal joints are stiff ones
/// here (stiff_joints.hpp), which at the end transmit what holds the ideal ones
/// without a deflection.
///
/// Equation   f(x) = (1 - s) f(x_0), s from 0 to 1: the imbalance at
///            the start x_0 is applied gradually (numerical continuation), with
///            Newton's method at each s. Its equations are solved by GMRES with
///            the NewtonMatrix of a slow step as preconditioner; geometric
///            stiffness, which that neglects, comes from differences of forces.
///            Couplers' wrenches are separate unknowns, so that any stiffness
///            is admissible. relaxation: implicit Euler steps at constant
///            loads, stopped at each peak of kinetic energy, until Newton's
///            method finds a nearby equilibrium [@cundall1976].
/// Source     Knoll and Keyes, "Jacobian-free Newton-Krylov methods", J.
///            Comput. Phys. 193, 2004 [@knoll2004].
/// @throws InputError if a net force or moment acts on free bodies;
/// NumericalError at a limit point or for unconstrained motion, naming the body
/// that moves most and the fraction of the load reached.
[[nodiscard]] Equilibrium find_equilibrium(
    const SystemModel& model, const SystemState& start,
    const EquilibriumSettings& settings = {}, const Progress& progress = {});

}  // namespace limber::dynamics
