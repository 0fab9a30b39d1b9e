// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "dynamics/system_model.hpp"
#include "results/history.hpp"

namespace limber::results {

inline constexpr int kResultsFileVersion = 1;

/// Writes rigid and modal states, probes and energies at every output time, and
/// the events, to one HDF5 file; every dataset carries its unit and meaning.
/// Names of bodies and probes are spelled there as `to_path_step` has them.
/// @throws InputError if the place cannot be written.
void write_results(const std::filesystem::path& file,
                   const dynamics::SystemModel& model, const History& history);

/// What a results file holds, without its data.
struct ResultsContents {
  Eigen::Index outputs = 0;
  Eigen::Index events = 0;
  double start = 0.0;               ///< first output time [s]
  double end = 0.0;                 ///< last output time [s]
  std::vector<std::string> bodies;  ///< names
  std::vector<std::string> probes;  ///< columns, e.g. "tip.ux"
};

/// Whether an HDF5 file says that it is one of ours.
/// @throws InputError if it is no HDF5 file.
[[nodiscard]] bool is_results_file(const std::filesystem::path& file);

/// @throws InputError if the file is no results file or is damaged.
[[nodiscard]] ResultsContents read_contents(const std::filesystem::path& file);

}  // namespace limber::results
