// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "limber/dynamics/monitors/contact_record.hpp"
#include "limber/dynamics/system/system_model.hpp"

namespace limber::dynamics {

/// Whether a body's basis has frequencies for the shortest impact on it.
///
/// Equation   fraction = f_max T_c, with f_max of the highest mode
/// Source     docs/theory/contact_laws.md, "Modes for an impact": measured
///            against whole finite elements
/// Limits     static-deformation modes count as eigenmodes of their frequency,
///            which may be above those of the body: f_max is then too high
struct ImpactSpectrum {
  static constexpr double kEnough = 2.0;  ///< fraction [-]
  static constexpr double kPoor = 0.6;    ///< impulses err by a fifth [-]

  std::string pair;        ///< name
  std::string body;        ///< name
  double duration = 0.0;   ///< T_c, expected, of the shortest impact [s]
  double frequency = 0.0;  ///< f_max [Hz]
  int modes = 0;           ///< count
  /// Modes up to kEnough / T_c, by the density of the basis' upper half; none
  /// of fewer than four modes.
  std::optional<int> needed;

  [[nodiscard]] double fraction() const { return frequency * duration; }
  [[nodiscard]] bool is_enough() const { return fraction() >= kEnough; }
};

/// One for each pair of bodies that touched, for each of its bodies with modes
/// in the model.
[[nodiscard]] std::vector<ImpactSpectrum> find_impact_spectra(
    const SystemModel& model, const std::vector<ContactRecord>& records);

/// One sentence with its numbers.
[[nodiscard]] std::string describe(const ImpactSpectrum& spectrum);

}  // namespace limber::dynamics
