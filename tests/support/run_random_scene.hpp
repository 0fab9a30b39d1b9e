// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "limber/dynamics/simulation/run_record.hpp"
#include "support/random_scene.hpp"

namespace limber::testing {

/// How a random scene ended.
struct RandomOutcome {
  enum class Kind {
    finished,  ///< with numbers at every output
    refused,   ///< by an InputError or a NumericalError with a message
    failed,    ///< NaN or infinity as a result, or any other exception
  };
  Kind kind = Kind::finished;
  std::string text;                                ///< why, unless it finished
  dynamics::SimulationStatistics statistics = {};  ///< also if refused
  dynamics::EnergyRecord energy = {};
  /// Largest magnitude of stored + dissipated - work since the first output, at
  /// any output [J].
  double drift = 0.0;
};

/// Whether a run that finished leaves more than a percent of its throughput
/// open, not all of it round-off, and gave no warning.
[[nodiscard]] bool is_silent_about_drift(const RandomOutcome& outcome);

/// Draws the scene of a seed and runs it.
RandomOutcome run_random_scene(unsigned seed,
                               const RandomSceneOptions& options = {});

}  // namespace limber::testing
