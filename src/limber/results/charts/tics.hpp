// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

/// Places of the labels on an axis of a picture, in increasing order, within
/// [least, most] (finite, least < most). Gnuplot by itself labels powers of ten
/// only, of which a short logarithmic axis may have none.
namespace limber::results {

/// Two to five multiples of 1, 2, 2.5 or 5 times a power of ten.
[[nodiscard]] std::vector<double> list_even_tics(double least, double most);

/// Two to nine round numbers: powers of ten if there are three of them, else 1,
/// 2 and 5 in each decade, else all digits, else even steps.
/// @param least above zero
[[nodiscard]] std::vector<double> list_logarithmic_tics(double least,
                                                        double most);

/// As gnuplot's `set xtics` takes them: "(0.1, 1, 10)".
[[nodiscard]] std::string to_tics(const std::vector<double>& places);

}  // namespace limber::results
