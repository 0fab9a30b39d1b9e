// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "limber/runs/compare/comparison.hpp"

namespace limber::runs {

/// The error that a tolerance applies to.
enum class ErrorMeasure { displacement, deformation, both };

/// "displacement", "deformation", "both".
/// @throws InputError naming the nearest.
[[nodiscard]] ErrorMeasure parse_error_measure(const std::string& name);
[[nodiscard]] std::string to_string(ErrorMeasure measure);

/// "1%" or "0.01" as a fraction in (0, 1) [-].
/// @throws InputError for anything else.
[[nodiscard]] double parse_tolerance(const std::string& text);

/// The error of all bodies [-]: for `both` the larger one. Ignores a field that
/// is zero in the reference; if both are (rigid links only), uses the rigid
/// motion. None if nothing moves.
[[nodiscard]] std::optional<double> find_error(
    const results::MotionError& error, ErrorMeasure measure);

/// Requirements on a choice.
struct Demand {
  double tolerance = 0.01;  ///< largest error [-]
  ErrorMeasure measure = ErrorMeasure::both;
};

/// The cheapest run that meets a demand.
/// @returns null if none does
[[nodiscard]] const ComparedRun* find_cheapest(const Comparison& comparison,
                                               const Demand& demand);

/// Reports the closest run and its error.
/// @throws NumericalError, always.
[[noreturn]] void refuse(const Comparison& comparison, const Demand& demand);

}  // namespace limber::runs
