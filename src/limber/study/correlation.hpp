// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "limber/study/effects.hpp"

namespace limber::study {

/// Correlation of a response with a factor, from -1 to 1 [-].
struct Correlation {
  double linear = 0.0;  ///< Pearson's coefficient
  double rank = 0.0;    ///< Spearman's: of the ranks, for any monotonic law
  Interval linear_interval;  ///< confidence 95 %
  Interval rank_interval;    ///< the same
  std::size_t samples = 0;

  /// Whether the coefficient of the ranks is significantly different from 0.
  [[nodiscard]] bool is_significant() const {
    return rank_interval.low > 0.0 || rank_interval.high < 0.0;
  }
};

/// By factor, then response. None of factors that are texts, of those or
/// responses that do not vary, and of fewer than four samples with a value.
using Correlations = std::vector<std::vector<std::optional<Correlation>>>;
/// For a sampled design, for `sobol` over its independent runs; empty for
/// others.
///
/// Equation   tanh(atanh r ± 1.96 s), s² = 1 / (n - 3) of Pearson's r,
///            (1 + r² / 2) / (n - 3) of Spearman's
/// Source     Bonett, Wright (2000) [@bonett2000]; equal values have their mean
///            rank
/// Limits     Pearson's interval is that of normal quantities
[[nodiscard]] Correlations find_correlations(const Study& study,
                                             const std::vector<StudyRow>& rows);

}  // namespace limber::study
