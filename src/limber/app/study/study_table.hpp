// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "limber/app/console/json.hpp"
#include "limber/app/study/correlation.hpp"
#include "limber/app/study/effects.hpp"
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

/// Statistics of the finished runs of a study.
struct StudyFindings {
  Effects effects;
  Correlations correlations;
};
/// @param runs of the whole design
[[nodiscard]] StudyFindings find_findings(const Study& study, std::size_t runs,
                                          const std::vector<StudyRow>& rows);

/// @param runs of the whole design
[[nodiscard]] std::string to_text(const Study& study, std::size_t runs,
                                  const std::vector<StudyRow>& rows,
                                  const StudyFindings& findings);
[[nodiscard]] Json to_json(const Study& study, std::size_t runs,
                           const std::vector<StudyRow>& rows,
                           const StudyFindings& findings);

}  // namespace limber::app
