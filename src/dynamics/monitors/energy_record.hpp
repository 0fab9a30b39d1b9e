// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "limber/dynamics/monitors/followed.hpp"

namespace limber::dynamics {

/// Energy over all steps of a run, and its unexplained part.
///
/// Equation   drift = stored + dissipated - work - stored at the start, which
///            should be zero; throughput = the largest of |stored|, |work|,
///            dissipated and kinetic energy
struct EnergyRecord {
  Extreme drift;            ///< of largest magnitude [J]
  Extreme stored;           ///< total [J]
  Extreme kinetic;          ///< [J]
  Extreme elastic;          ///< of bodies [J]
  Extreme coupler;          ///< in couplers and transmissions [J]
  double throughput = 0.0;  ///< [J]
  /// Possible round-off of the drift, and what stiff joints may lose without a
  /// visible displacement (HoldWatch::find_negligible_energy) [J].
  double roundoff = 0.0;
  /// Largest contributor to the drift at its extreme, as "body 'link'"; empty:
  /// none.
  std::string place;
  double share = 0.0;       ///< of that contributor [J]
  bool is_one_way = false;  ///< it is a body at that level
};

}  // namespace limber::dynamics
