// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "limber/dynamics/simulation/run_record.hpp"
#include "limber/results/history.hpp"

namespace limber::results {

/// Writes "time [s],NAME [UNIT],..." and a line an output time, 17 digits.
/// A name with a comma or a quotation mark is quoted (RFC 4180).
/// @throws InputError if it cannot be written.
void write_probes_csv(const std::filesystem::path& file,
                      const History& history);

/// Writes "name,unit,peak,time [s]" and a line a column of the probes: its
/// value of largest magnitude, signed, and when, of all steps of a run.
/// @throws InputError if it cannot be written.
void write_peaks_csv(const std::filesystem::path& file, const History& history,
                     const std::vector<dynamics::Extreme>& peaks);

/// Writes "from [s],to [s],NAME least [UNIT],NAME most [UNIT],..." and a line
/// an interval: the smallest and largest values of its steps and outputs;
/// nothing between commas where there is none.
/// @throws InputError if it cannot be written.
void write_envelopes_csv(const std::filesystem::path& file,
                         const History& history, const Envelopes& envelopes);

}  // namespace limber::results
