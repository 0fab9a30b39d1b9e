// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "limber/results/history.hpp"

namespace limber::results {

/// Energy that a run gained or lost without a physical cause.
///
/// Equation   drift = final + dissipated - initial - work, which should be
///            zero: energy created, at the last output; throughput = the
///            largest of |initial|, |final|, |work|, dissipated, and the
///            kinetic energy of any output
struct EnergyError {
  double initial = 0.0;     ///< stored at the first output [J]
  double final = 0.0;       ///< stored at the last output [J]
  double work = 0.0;        ///< of loads, gravity and drives in between [J]
  double dissipated = 0.0;  ///< in between [J]
  double drift = 0.0;       ///< [J]
  double largest = 0.0;     ///< magnitude of the drift at any output [J]
  double throughput = 0.0;  ///< [J]

  /// drift / throughput and largest / throughput [-]; none if the throughput is
  /// zero.
  [[nodiscard]] std::optional<double> relative() const;
  [[nodiscard]] std::optional<double> relative_largest() const;
};

/// All zero for a run without outputs.
[[nodiscard]] EnergyError find_energy_error(const History& history);

}  // namespace limber::results
