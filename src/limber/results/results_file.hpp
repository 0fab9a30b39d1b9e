// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "limber/dynamics/simulation/run_record.hpp"
#include "limber/dynamics/system/system_model.hpp"
#include "limber/results/history.hpp"
#include "limber/results/scenery.hpp"

namespace limber::results {

inline constexpr int kResultsFileVersion = 1;

/// Writes rigid and modal states, probes and energies at every output time, and
/// the events, to one HDF5 file; every dataset carries its unit and meaning.
/// Names of bodies and probes are encoded by `to_path_step`.
/// @param scenery what `limber view` needs beside that; null: none
/// @param record peaks and envelopes of the probes' columns; null: none
/// @throws InputError if it cannot be written.
void write_results(const std::filesystem::path& file,
                   const dynamics::SystemModel& model, const History& history,
                   const Scenery* scenery = nullptr,
                   const dynamics::RunRecord* record = nullptr);

/// Contents of a results file, without its data.
struct ResultsContents {
  Eigen::Index outputs = 0;         ///< count
  Eigen::Index events = 0;          ///< count
  double start = 0.0;               ///< first output time [s]
  double end = 0.0;                 ///< last output time [s]
  std::vector<std::string> bodies;  ///< names
  std::vector<std::string> probes;  ///< columns, e.g. "tip.ux"
};

/// Whether an HDF5 file has the mark of our results.
/// @throws InputError if it is not an HDF5 file.
[[nodiscard]] bool is_results_file(const std::filesystem::path& file);

/// @throws InputError if the file is not a results file or is damaged.
[[nodiscard]] ResultsContents read_contents(const std::filesystem::path& file);

}  // namespace limber::results
