// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "limber/results/history.hpp"

namespace limber::results {

/// Writes "time [s],NAME [UNIT],..." and a line an output time, 17 digits.
/// A name with a comma or a quotation mark is quoted (RFC 4180).
/// @throws InputError if it cannot be written.
void write_probes_csv(const std::filesystem::path& file,
                      const History& history);

}  // namespace limber::results
