// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "limber/study/study_file.hpp"

namespace limber::study {

/// Distribution of a response over the values of the factors, and the
/// uncertainty of its estimate with a confidence of 95 %.
///
/// Equation   mean ± t s / √n, t of Student's distribution with n - 1 degrees
///            of freedom; distribution function ± √(ln(2 / 0.05) / (2 n))
/// Source     Massart (1990) [@massart1990] of the band
/// Limits     exact of independent samples (the mean's of normal ones or many);
///            a Latin hypercube and Sobol's sequence are usually closer
struct Distribution {
  /// Values of the runs that have one, ascending [the response's unit].
  std::vector<double> values;
  double mean = 0.0;        ///< [the response's unit]
  double mean_error = 0.0;  ///< half the width of its interval [the same]
  double band = 0.0;        ///< the same of the distribution function [-]

  /// The value that a fraction p in (0, 1) of the samples does not exceed.
  [[nodiscard]] double quantile(double p) const;
};

/// Whether values of the factors are drawn: `monte-carlo`, `latin-hypercube`,
/// `sobol`.
[[nodiscard]] bool is_sampled(const Study& study);
/// Runs that are samples of the factors' distribution: not those of `sobol`
/// that share values with others.
[[nodiscard]] bool is_sample(const Study& study, std::size_t run);

/// For a sampled design, for `sobol` over its independent runs; none for other
/// designs, or for fewer than two values.
[[nodiscard]] std::optional<Distribution> find_distribution(
    const Study& study, const std::vector<StudyRow>& rows,
    std::size_t response);

/// The 97.5 % quantile of Student's t distribution.
///
/// Source     Abramowitz, Stegun, 26.7.5: 0.12 % off with 3 degrees of freedom,
///            less with more; 1 and 2 in closed form
[[nodiscard]] double find_student_quantile(std::size_t degrees);

}  // namespace limber::study
