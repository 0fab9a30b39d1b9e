// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "dynamics/simulation.hpp"

namespace limber::testing {

/// What a free top should keep and does not quite, at most over a run.
struct Drift {
  double energy = 0.0;          ///< relative
  double momentum = 0.0;        ///< of the angular momentum vector, relative
  double orthonormality = 0.0;  ///< |R^T R - I|
};

/// Looks at the start and at `outputs` equal distances of the run.
Drift find_drift(const dynamics::SystemModel& model,
                 dynamics::SystemState state,
                 dynamics::SimulationSettings settings, int outputs);

}  // namespace limber::testing
