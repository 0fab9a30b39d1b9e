// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "limber/study/study_file.hpp"

namespace limber::study {

/// Where a value lies with a confidence of 95 % [its unit].
struct Interval {
  double low = 0.0;
  double high = 0.0;
  [[nodiscard]] double half_width() const { return 0.5 * (high - low); }
};

/// Main and total effect of a factor on a response: fractions of its variance
/// [-].
struct Effect {
  double main = 0.0;   ///< [-]
  double total = 0.0;  ///< [-]
  /// Of a `sobol` design; the effects of a grid are exact.
  std::optional<Interval> main_interval = {};
  std::optional<Interval> total_interval = {};
  /// Samples that would carry the effect; none if those that are there do.
  std::optional<std::size_t> samples_needed = {};
};

/// Intervals with a larger half width are meaningless for a fraction [-].
inline constexpr double kWidestEffect = 0.25;
/// The intervals of fewer samples are too narrow.
inline constexpr std::size_t kFewestSamples = 32;

/// By factor, then response. None where a run is missing, or where the response
/// does not vary.
using Effects = std::vector<std::vector<std::optional<Effect>>>;
/// For a complete `sobol` or `grid` design; empty for others.
///
/// Equation   `sobol`: main  mean (B - m) (C - A) / V, total  mean (A - C)² /
///            (2 V), m and V mean and variance of A and B, C = A with the
///            factor's value of B; the 95 % in the middle of 1000 resamples
/// Source     `sobol`: Saltelli et al. (2010) [@saltelli2010], estimators (b)
///            and (f); (b) of centred responses, because its error grows with
///            the mean; `grid`: the variances of conditional means
/// Limits     `sobol`: intervals hold in 90 % of studies of 32 samples, 95 % of
///            more
[[nodiscard]] Effects find_effects(const Study& study, std::size_t runs,
                                   const std::vector<StudyRow>& rows);

/// Why a response of a `sobol` or `grid` design has no effects; empty if it has
/// them, or if the design has none.
[[nodiscard]] std::string find_missing_effects(
    const Study& study, std::size_t runs, const std::vector<StudyRow>& rows,
    std::size_t response);

/// "not significant with 12 samples; about 256 may suffice"; empty if they
/// suffice.
[[nodiscard]] std::string describe_doubt(const Study& study,
                                         const Effect& effect);

}  // namespace limber::study
