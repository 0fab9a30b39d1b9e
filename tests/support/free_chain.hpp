// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/dynamics/system/system_model.hpp"
#include "limber/dynamics/system/system_state.hpp"

namespace limber::testing {

/// Three flexible bodies on stiff hinges without dampers, spinning together
/// about the system's centre while every mode vibrates: nothing takes energy.
struct FreeChain {
  dynamics::SystemModel model;
  dynamics::SystemState state;
  double shortest = 0.0;  ///< explicit limit 2 / omega of the highest mode [s]
};

FreeChain make_free_chain(double stiffness, double spin, double vibration);

/// Largest change of the conserved quantities of a free system, relative to the
/// start.
struct KeptDrift {
  double energy = 0.0;
  double linear = 0.0;   ///< of the momentum, to the bodies' own at 1 m/s
  double angular = 0.0;  ///< of the angular momentum
};

/// Sampled at a hundred times of the run.
KeptDrift find_energy_conserving_drift(const FreeChain& chain, double h,
                                       long steps);

}  // namespace limber::testing
