// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>

/// Numbers that describe a curve over the output times of a run. `values` has
/// one for each of `times` [s], increasing.
namespace limber::study {

/// Largest distance beyond the final value, on the side away from the first
/// one, over the distance of both [-]; 0 without. Between samples it is that
/// of a parabola. None if both values are equal.
[[nodiscard]] std::optional<double> find_overshoot(
    std::span<const double> times, std::span<const double> values);

/// Time from the start after which the curve stays within 2 % of its final
/// value, of the distance of the first and the final one [s]. None if both are
/// equal, or if that is in the last tenth of the time: it has not settled.
[[nodiscard]] std::optional<double> find_settling_time(
    std::span<const double> times, std::span<const double> values);

/// Frequency with the largest amplitude [Hz]: of the curve without its linear
/// trend, in Hann's window. None for fewer than 16 samples, times that are not
/// even, and less than one and a half periods.
///
/// Source     Harris (1978) of the window [@harris1978]
/// Limits     resolves frequencies that differ by 2 / duration; what is faster
///            than half the outputs appears as something slower
[[nodiscard]] std::optional<double> find_dominant_frequency(
    std::span<const double> times, std::span<const double> values);

/// Largest magnitude of the derivative of this order, 1 or 2, by differences
/// [its unit / s^order]. None for fewer than three samples, or times that are
/// not even.
///
/// Limits     low by a fraction (omega h)^2 / 12, of order 1 / 6, of a
///            frequency omega and outputs every h: an impact needs fine outputs
[[nodiscard]] std::optional<double> find_largest_derivative(
    std::span<const double> times, std::span<const double> values, int order);

}  // namespace limber::study
