// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "dynamics/system_model.hpp"
#include "dynamics/system_state.hpp"

namespace limber::dynamics {

/// Natural frequencies of small motion of the whole system about a
/// configuration, at rest and without dampers: drives hold what they command at
/// state.t. Ascending; what moves freely has 0, what would fall away from an
/// unstable configuration a negative one [Hz].
///
/// Equation   eigenvalues of -d(acceleration)/d(position), by central
///            differences; sign(lambda) sqrt(|lambda|) / (2 pi)
/// Limits     dense: (6 bodies + modes)^3. Frequencies below about 1e-5 of the
///            largest are round-off.
/// @throws InputError for a body at level `full`.
[[nodiscard]] VectorX find_natural_frequencies(const SystemModel& model,
                                               const SystemState& state);

}  // namespace limber::dynamics
