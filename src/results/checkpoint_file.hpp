// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

#include "dynamics/checkpoint.hpp"
#include "results/history.hpp"

namespace limber::results {

/// A run that is under way, with what it has left behind so far.
struct CheckpointRecord {
  std::string fingerprint;  ///< of the run: dynamics/fingerprint.hpp
  dynamics::Checkpoint run;
  History history;
};

/// Writes the file as a whole: a crash leaves the one before.
/// @throws InputError if the place cannot be written.
void write_checkpoint(const std::filesystem::path& file,
                      const CheckpointRecord& record);

/// Whether it is one, whole or damaged. @throws InputError if it is not HDF5.
[[nodiscard]] bool is_checkpoint_file(const std::filesystem::path& file);

/// @throws InputError if the file is no checkpoint, is damaged or is of another
/// version of the layout.
[[nodiscard]] CheckpointRecord read_checkpoint(
    const std::filesystem::path& file);

}  // namespace limber::results
