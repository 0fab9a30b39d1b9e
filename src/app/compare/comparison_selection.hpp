// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "app/comparison.hpp"

namespace limber::app {

/// The error that a tolerance is held against.
enum class ErrorMeasure { displacement, deformation, both };

/// "displacement", "deformation", "both".
/// @throws InputError naming the nearest.
[[nodiscard]] ErrorMeasure parse_error_measure(const std::string& name);
[[nodiscard]] std::string to_string(ErrorMeasure measure);

/// "1%" or "0.01" as a share in (0, 1) [-].
/// @throws InputError for anything else.
[[nodiscard]] double parse_tolerance(const std::string& text);

/// The error of all bodies [-]: for `both` the larger one. What the reference
/// does not have does not count; where it has neither (rigid links alone), the
/// rigid motion does. None if it does not move.
[[nodiscard]] std::optional<double> find_error(
    const results::MotionError& error, ErrorMeasure measure);

/// What a user wants of a choice.
struct Demand {
  double tolerance = 0.01;  ///< largest error [-]
  ErrorMeasure measure = ErrorMeasure::both;
};

/// The cheapest run that meets a demand.
/// @returns null if none does
[[nodiscard]] const ComparedRun* find_cheapest(const Comparison& comparison,
                                               const Demand& demand);

/// What came closest, with its error.
/// @throws NumericalError, always.
[[noreturn]] void refuse(const Comparison& comparison, const Demand& demand);

}  // namespace limber::app
