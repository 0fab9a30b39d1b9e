// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "limber/app/console/json.hpp"
#include "limber/app/study/study_file.hpp"

namespace limber::app {

/// The table of runs: run, factors, responses, error, warnings; numbers with
/// all their digits.
[[nodiscard]] std::string to_csv(const Study& study,
                                 const std::vector<StudyRow>& rows);

/// Smallest, mean and largest value of one response over the runs that have it.
struct ResponseRange {
  std::size_t count = 0;
  double least = 0.0;    ///< [the response's unit]
  double mean = 0.0;     ///< [the response's unit]
  double largest = 0.0;  ///< [the response's unit]
};
[[nodiscard]] ResponseRange find_range(const std::vector<StudyRow>& rows,
                                       std::size_t response);

/// Main and total effect of each factor on each response: shares of its
/// variance; by factor, then response. None where a run is missing, or where
/// the response does not vary.
struct Effect {
  double main = 0.0;   ///< [-]
  double total = 0.0;  ///< [-]
};
using Effects = std::vector<std::vector<std::optional<Effect>>>;
/// For a complete `sobol` or `grid` design; empty for others.
///
/// Source     `sobol`: Saltelli et al. (2010) [@saltelli2010], its estimators
///            (b) and (f); `grid`: the variances of conditional means
/// Limits     `sobol`: the error falls with the samples, and an effect near 0
///            may come out below it
[[nodiscard]] Effects find_effects(const Study& study, std::size_t runs,
                                   const std::vector<StudyRow>& rows);

[[nodiscard]] std::string to_text(const Study& study,
                                  const std::vector<StudyRow>& rows,
                                  const Effects& effects);
[[nodiscard]] Json to_json(const Study& study, std::size_t runs,
                           const std::vector<StudyRow>& rows,
                           const Effects& effects);

}  // namespace limber::app
