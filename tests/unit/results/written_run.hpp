// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "limber/results/results_file.hpp"
#include "unit/results/raw_hdf5.hpp"
#include "unit/results/small_run.hpp"
#include "unit/results/temporary_folder.hpp"

namespace limber::results::test {

/// Every dataset of the run's results file, by its path in the file.
inline std::map<std::string, RawDataset> write_and_read(const SmallRun& run) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "results.h5";
  write_results(file, run.model, run.history);
  return read_all_datasets(file);
}

}  // namespace limber::results::test
