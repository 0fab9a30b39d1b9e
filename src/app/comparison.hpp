// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/json.hpp"
#include "app/run_scene.hpp"

namespace limber::app {

/// Runs of one scenario that differ in fidelity; the last is the reference.
struct Comparison {
  std::vector<std::string> levels;
  std::vector<Run> runs;
};

/// Difference of one probe column from the reference, over all output times.
struct Difference {
  double rms = 0.0;
  double max = 0.0;
};
[[nodiscard]] Difference find_difference(const results::History& history,
                                         const results::History& reference,
                                         std::size_t column);

[[nodiscard]] Json to_json(const Comparison& comparison);
[[nodiscard]] std::string to_text(const Comparison& comparison);

/// Writes comparison.json and the overlay of the probes as pictures.
void write_comparison(const Comparison& comparison,
                      const std::filesystem::path& folder);

}  // namespace limber::app
