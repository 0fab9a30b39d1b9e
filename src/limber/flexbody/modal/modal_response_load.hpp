// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "limber/common/types.hpp"

/// Loads on m modes. A modal load is Phi^T times the nodal forces expressed in
/// the body frame; its unit is kg^1/2 m/s^2.
namespace limber::flexbody {

/// Column j of `values` applies on [times[j], times[j+1]), the last one without
/// end; before the first the load is zero. Empty: no such load.
struct StepLoad {
  std::vector<double> times;  ///< n, strictly increasing [s]
  MatrixX values;             ///< m x n [kg^1/2 m/s^2]
};

/// cosine cos(omega (t - from)) + sine sin(omega (t - from)) on
/// [from, until), zero outside. One amplitude A with a phase p,
/// A sin(omega (t - from) + p), has cosine = A sin p, sine = A cos p.
struct SinusoidalLoad {
  double omega = 0.0;  ///< angular frequency >= 0 [rad/s]
  VectorX cosine;      ///< m [kg^1/2 m/s^2]
  VectorX sine;        ///< m [kg^1/2 m/s^2]
  double from = 0.0;   ///< [s]
  double until = std::numeric_limits<double>::infinity();  ///< > from [s]
};

/// The sum of its parts.
struct ModalLoads {
  StepLoad steps;
  std::vector<SinusoidalLoad> sinusoids;
};

/// @throws InputError, all problems at once, for times that do not increase,
/// sizes that differ from each other or from `modes`, a value that is not
/// finite (`until` may be infinite), a negative frequency, a window that ends
/// before it begins.
void check(const ModalLoads& loads, Eigen::Index modes);

/// Problems with the instants `times` [s] of the table called `what`: fewer
/// than `least`, not finite, not increasing. Empty if none.
[[nodiscard]] std::vector<std::string> find_time_problems(
    const std::vector<double>& times, std::size_t least,
    const std::string& what);

/// Problems with entries of `values` (m x n), called `what`, that are not
/// finite. Empty if none.
[[nodiscard]] std::vector<std::string> find_value_problems(
    const MatrixX& values, const std::string& what);

/// @throws InputError with `problems`, if there are any.
void refuse(std::vector<std::string> problems);

}  // namespace limber::flexbody
