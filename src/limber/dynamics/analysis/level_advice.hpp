// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "limber/dynamics/analysis/level_observer.hpp"

namespace limber::dynamics {

/// Errors that a user is willing to neglect. Defaults scale with the body: the
/// report's 1 um and 5 cm for a beam of 5 m.
struct AdviceSettings {
  std::optional<double> displacement;  ///< > 0 [m]
  std::optional<double> linear_limit;  ///< > 0 [m]
  std::optional<double> force;         ///< > 0, nodal inertial force [N]
};
/// @throws InputError if one that is set is not positive and finite.
void check(const AdviceSettings& settings);
/// Fractions of the longest edge of the body's bounding box [-].
inline constexpr double kNeglectedFraction = 2e-7;
inline constexpr double kLinearFraction = 0.01;

/// The settings for one body.
struct LevelLimits {
  double displacement = 0.0;    ///< that the user neglects [m]
  double linear_limit = 0.0;    ///< end of linear elasticity [m]
  std::optional<double> force;  ///< nodal inertial force neglected [N]
};
/// @throws InputError as check().
[[nodiscard]] LevelLimits find_limits(const AdviceSettings& settings,
                                      const flexbody::ReducedBody& body);

/// Estimated displacement that each level neglects [m].
struct LevelErrors {
  double rigid = 0.0;      ///< [m]
  double uncoupled = 0.0;  ///< [m]
  double one_way = 0.0;    ///< [m]
  double coupled = 0.0;    ///< [m]
  double nonlinear = 0.0;  ///< [m]
};

/// Equation   rigid      u + s
///            uncoupled  2 u_i + e
///            one-way    e = s + sum_k |phi_k| (f_k / lambda_k + d_k)
///            coupled    g u + min(d, 2) o, g = k N / (P + N), P the load at
///            which the body buckles, d = k omega int |N| / P dt / 2; at least
///            that of nonlinear
///            nonlinear  sum_k |phi_k| min(d_k, 2) o_k, d_k = 3/2 omega_k int
///            |e| dt, e the mean strain and o_k the part of the oscillation
///            that stretches the body
/// Source     docs/theory/choosing.md, "Which level"; u, u_i and s are
///            BodyPeaks' total, inertial and turned_aside; f_k bounds the
///            forces on mode k that one-way neglects, d_k the effect of
///            rotation on oscillation
/// Limits     estimates, with conservative factors
/// @throws InputError naming a body whose elasticity couples its modes.
[[nodiscard]] LevelErrors estimate_errors(const BodyModel& body,
                                          const BodyPeaks& peaks);

/// Largest error of a level relative to the deformation, where that exceeds
/// the neglected errors [-].
inline constexpr double kLargestFraction = 0.1;
/// Rotation of interfaces relative to one another beyond which linear
/// kinematics, and relative to the mean axes beyond which those of second order
/// are off by 2 % [rad].
inline constexpr double kLargestRotation = 0.4;
/// Fraction of the buckling load beyond which `nonlinear` is not reliable
/// [-].
inline constexpr double kLargestLoad = 0.8;

/// The lowest adequate level for one body, and the reason.
struct LevelAdvice {
  Fidelity level = Fidelity::coupled;
  std::string reason;  ///< one sentence with its numbers
  LevelErrors errors;
  /// Deformation or rotation of interfaces is too large for linear elasticity.
  bool is_beyond_linear = false;
};
/// @param body with its modes, at Fidelity::uncoupled
[[nodiscard]] LevelAdvice advise(const BodyModel& body, const BodyPeaks& peaks,
                                 const LevelLimits& limits);

}  // namespace limber::dynamics
