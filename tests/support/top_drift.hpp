// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/dynamics/simulation/simulation.hpp"

namespace limber::testing {

/// Largest errors of a free top's conserved quantities over a run.
struct Drift {
  double energy = 0.0;          ///< relative
  double momentum = 0.0;        ///< of the angular momentum vector, relative
  double orthonormality = 0.0;  ///< |R^T R - I|
};

/// Sampled at the start and at `outputs` equal intervals of the run.
Drift find_drift(const dynamics::SystemModel& model,
                 dynamics::SystemState state,
                 dynamics::SimulationSettings settings, int outputs);

}  // namespace limber::testing
