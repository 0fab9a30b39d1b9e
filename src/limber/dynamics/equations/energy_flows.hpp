// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "limber/common/records/archive.hpp"
#include "limber/dynamics/terms/system_terms.hpp"

namespace limber::dynamics {

/// Energies by what they belong to: a row for each body, coupler, transmission
/// and pair, in this order and each in that of the model.
struct EnergyRows {
  explicit EnergyRows(const SystemModel& model);

  Eigen::Index couplers = 0;       ///< row of the first coupler
  Eigen::Index transmissions = 0;  ///< of the first transmission
  Eigen::Index pairs = 0;          ///< of the first pair
  Eigen::Index count = 0;
};

/// As "body 'link'".
[[nodiscard]] std::string name_energy_row(const SystemModel& model,
                                          Eigen::Index row);

/// Energy that came into a system and left it over some time, in the rows of
/// EnergyRows: of loads and weight at the bodies that they act on, of drives at
/// their couplers or transmissions.
struct EnergyFlows {
  VectorX supplied;    ///< by loads, gravity and drives [J]
  VectorX dissipated;  ///< by dampers, friction and modes [J]
  /// Of each pair the parts of `dissipated` by its damping and by its friction;
  /// a rest is what steps do not resolve [J].
  VectorX damped;
  VectorX rubbed;

  void clear();
  EnergyFlows& operator+=(const EnergyFlows& other);
  EnergyFlows& operator*=(double factor);
};

void exchange(Archive& archive, EnergyFlows& flows);

[[nodiscard]] EnergyFlows make_flows(const SystemModel& model);

/// Adds powers times `duration` [s]. @param terms with forces
void add_powers(const SystemTerms& terms, double duration, EnergyFlows& flows);

}  // namespace limber::dynamics
