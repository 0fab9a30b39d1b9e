// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "limber/app/console/json.hpp"
#include "limber/study/correlation.hpp"
#include "limber/study/effects.hpp"
#include "limber/study/study_file.hpp"

namespace limber::app {

/// The table of runs: run, factors, responses, error, warnings; numbers with
/// all their digits.
[[nodiscard]] std::string to_csv(const study::Study& study,
                                 const std::vector<study::StudyRow>& rows);

/// Smallest, mean and largest value of one response over the runs that have it.
struct ResponseRange {
  std::size_t count = 0;
  double least = 0.0;    ///< [the response's unit]
  double mean = 0.0;     ///< [the response's unit]
  double largest = 0.0;  ///< [the response's unit]
};
[[nodiscard]] ResponseRange find_range(const std::vector<study::StudyRow>& rows,
                                       std::size_t response);

/// Statistics of the finished runs of a study.
struct StudyFindings {
  study::Effects effects;
  study::Correlations correlations;
};
/// @param runs of the whole design
[[nodiscard]] StudyFindings find_findings(
    const study::Study& study, std::size_t runs,
    const std::vector<study::StudyRow>& rows);

/// @param runs of the whole design
[[nodiscard]] std::string to_text(const study::Study& study, std::size_t runs,
                                  const std::vector<study::StudyRow>& rows,
                                  const StudyFindings& findings);
[[nodiscard]] Json to_json(const study::Study& study, std::size_t runs,
                           const std::vector<study::StudyRow>& rows,
                           const StudyFindings& findings);

}  // namespace limber::app
