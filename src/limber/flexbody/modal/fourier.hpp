// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>
#include <vector>

#include "limber/common/types.hpp"
#include "limber/flexbody/modal/modal_response_load.hpp"

namespace limber::flexbody {

/// A measured load. The table spans one period: its last instant is where the
/// first repeats.
struct LoadTable {
  std::vector<double> times;  ///< n >= 2, strictly increasing [s]
  MatrixX values;             ///< m x n [unit of the load]
};

/// f(t) = sum over k = 0..K of cosine_k cos(k w (t - start))
///                          + sine_k sin(k w (t - start)), w = 2 pi / period.
struct FourierSeries {
  double start = 0.0;   ///< [s]
  double period = 0.0;  ///< > 0 [s]
  MatrixX cosine;       ///< m x (K + 1), column 0 is the mean [unit of f]
  MatrixX sine;         ///< m x (K + 1), column 0 is zero [unit of f]
  /// m, root mean square over the period of the table minus the series [unit of
  /// f]
  VectorX residual;
};

/// Least-squares fit of K = `harmonics` harmonics to the table.
///
/// Equation   minimises sum_i h_i |f(t_i) - table_i|^2 for each row, h_i half
///            of the time between the neighbours of t_i (trapezoidal weights)
/// Source     elementary; on a uniform grid, the discrete Fourier transform
/// Limits     a table whose ends differ jumps once a period: there the fit
///            passes between both ends and converges like 1/K.
/// @throws InputError, all problems at once, as check(ModalLoads) for the
/// table; for fewer than 2 K + 1 different instants of the period; and for
/// instants so uneven that errors of the table would be amplified by more
/// than kMostAmplification.
[[nodiscard]] FourierSeries fit_fourier_series(const LoadTable& table,
                                               int harmonics);
inline constexpr double kMostAmplification = 1e6;  // [-]

/// Values at `times` [s], m x T.
[[nodiscard]] MatrixX evaluate(const FourierSeries& series,
                               const std::vector<double>& times);

/// The series as loads on m modes, from its start until `until` [s].
[[nodiscard]] std::vector<SinusoidalLoad> make_sinusoids(
    const FourierSeries& series,
    double until = std::numeric_limits<double>::infinity());

}  // namespace limber::flexbody
