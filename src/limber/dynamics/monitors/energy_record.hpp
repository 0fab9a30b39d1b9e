// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "limber/dynamics/monitors/followed.hpp"

namespace limber::dynamics {

/// Energy of a body, coupler, transmission or pair at the end of a run, and
/// what passed through it since the start.
///
/// Equation   stored = stored at the start + in - out - dissipated + error
/// Limits     in a frame that moves as the group of connected bodies did at the
///            start (EnergyGroups). The exchange with other rows is that of the
///            powers at both ends of steps, whose error cancels in the sum over
///            rows, so that an error of a single row means little.
struct EnergyRow {
  std::string name;         ///< as "body 'link'"
  double stored = 0.0;      ///< [J]
  double in = 0.0;          ///< from other rows, loads, gravity, drives [J]
  double out = 0.0;         ///< to them [J]
  double dissipated = 0.0;  ///< by dampers, friction, modes [J]
  double error = 0.0;       ///< [J]
};

/// Unexplained energy of a group of connected bodies.
struct EnergyDrift {
  Extreme drift;  ///< sum of the rows' errors [J]
  /// The largest of |stored|, |work|, dissipated and kinetic energy, and of
  /// bodies in contact that of a fall within a step (EnergyGroups) [J].
  double throughput = 0.0;
  /// Possible round-off of the drift, and what stiff joints may lose without a
  /// visible displacement (DeflectionObserver::find_negligible_energies) [J].
  double roundoff = 0.0;
  /// Row with the largest error of the drift's sign, as "body 'link'"; empty:
  /// none.
  std::string place;
  double place_error = 0.0;  ///< of that row [J]
  bool is_one_way = false;   ///< it is a body at that level
};

/// Drift over throughput [-]; 0 if it may be round-off.
[[nodiscard]] double find_unbalanced_fraction(const EnergyDrift& energy);

/// Energy over all steps of a run, and its unexplained part.
///
/// Equation   drift = stored + dissipated - work - stored at the start, which
///            should be zero
struct EnergyRecord {
  Extreme drift;            ///< of largest magnitude, all groups together [J]
  Extreme stored;           ///< total [J]
  Extreme kinetic;          ///< [J]
  Extreme elastic;          ///< of bodies [J]
  Extreme coupler;          ///< in couplers and transmissions [J]
  double throughput = 0.0;  ///< sum over groups [J]
  double roundoff = 0.0;    ///< sum over groups [J]
  EnergyDrift worst;  ///< of the group with the largest unbalanced fraction
  std::vector<EnergyRow> rows;  ///< those that hold or held energy
};

}  // namespace limber::dynamics
