// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "study.hpp"

/// Choices for the report's beam that several scenes share.
namespace limber::bench::trade {

/// Longest step at which Runge-Kutta is stable on the whole mesh with its
/// consistent mass: 2.83 / 1.607e5 rad/s, less some percent [s].
inline constexpr double kFullStep = 1.7e-5;

/// The reference of errors: the whole mesh, consistent mass, in steps of fourth
/// order, because central differences near their stable step shift the phases
/// of the lowest bending modes by about a percent in a second.
[[nodiscard]] Choice make_reference();
/// Central differences at their stable step; `lumped` is the yardstick of cost.
[[nodiscard]] Choice make_explicit(flexbody::NodalMassKind mass, int repeats);
/// Adds them all: the reference, and explicit steps with both masses.
void add_whole_meshes(Study& study);
/// The yardstick of cost among the runs of add_whole_meshes.
[[nodiscard]] const Outcome& find_lumped(const Study& study);
/// A basis of so many eigenmodes, with or without the static-deformation modes
/// of the loads.
[[nodiscard]] scene::BasisChoice make_basis(int eigenmodes, bool has_loads);
/// Modes in closed form where loads turn with the body; rigid motion by
/// Runge-Kutta at `step` [s].
[[nodiscard]] Choice make_exact(const std::string& name,
                                scene::BasisChoice basis, double step);
[[nodiscard]] Choice make_stepped(const std::string& name, Fidelity level,
                                  scene::BasisChoice basis,
                                  IntegratorKind integrator, double step);

}  // namespace limber::bench::trade
