// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "limber/dynamics/analysis/equilibrium.hpp"
#include "limber/scene/build/build_system.hpp"

/// Displacements, forces and stability of an equilibrium.
namespace limber::runs {

/// One body, relative to the start.
struct StaticBody {
  std::string name;
  double moved = 0.0;          ///< of the centre of mass [m]
  double turned = 0.0;         ///< [rad]
  double deformation = 0.0;    ///< largest of a stored node [m]
  double size = 0.0;           ///< longest edge; 0 if rigid [m]
  double strain_energy = 0.0;  ///< [J]
  /// Static stiffness by that of the material, which a body with a loss factor
  /// has at the scene's lowest frequency [-].
  double static_stiffness = 1.0;
};

/// Load of one coupler or transmission.
struct StaticCoupler {
  std::string name;
  double force = 0.0;   ///< [N]; of a gear the force along its coordinate
  double moment = 0.0;  ///< on M, at its origin [N m]
};

struct StaticReport {
  std::vector<StaticBody> bodies;
  std::vector<StaticCoupler> couplers;
  double coupler_energy = 0.0;  ///< [J]
  /// Lowest natural frequency at equilibrium, negative if a disturbance grows;
  /// none if not computed [Hz].
  std::optional<double> lowest_frequency;
};

/// @param built its initial state is the start
[[nodiscard]] StaticReport report_equilibrium(
    const scene::BuiltScene& built, const dynamics::Equilibrium& found);

}  // namespace limber::runs
