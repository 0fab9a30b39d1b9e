// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "dynamics/system_model.hpp"
#include "results/history.hpp"

namespace limber::results {

inline constexpr int kResultsFileVersion = 1;

/// Writes rigid and modal states, probes and energies at every output time to
/// one HDF5 file; every dataset carries its unit and meaning.
/// @throws InputError if the place cannot be written.
void write_results(const std::filesystem::path& file,
                   const dynamics::SystemModel& model, const History& history);

}  // namespace limber::results
