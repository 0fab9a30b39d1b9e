// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "dynamics/followed.hpp"

namespace limber::dynamics {

/// Energy over all steps of a run, and what of it nothing accounts for.
///
/// Equation   drift = stored + dissipated - work - stored at the start, which
///            should be zero; throughput = the largest of |stored|, |work|,
///            dissipated and kinetic energy
struct EnergyRecord {
  Extreme drift;            ///< of largest magnitude [J]
  Extreme stored;           ///< in all [J]
  Extreme kinetic;          ///< [J]
  Extreme elastic;          ///< of bodies [J]
  Extreme coupler;          ///< in couplers and transmissions [J]
  double throughput = 0.0;  ///< [J]
  double roundoff = 0.0;    ///< what rounding may make of the drift [J]
  /// Where most of the drift came from by the time of its extreme, as
  /// "body 'link'"; empty: nowhere.
  std::string place;
  double share = 0.0;       ///< of that place [J]
  bool is_one_way = false;  ///< it is a body at that level
};

}  // namespace limber::dynamics
