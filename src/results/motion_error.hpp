// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "dynamics/system_model.hpp"
#include "dynamics/system_state.hpp"

/// How far one simulation of a system is from another, the reference:
/// docs/compare.md.
namespace limber::results {

/// Error of one field of displacements.
///
/// Equation   e(t)^2 = mean over points |u - u_ref|^2,
///            rms^2 = mean over times e(t)^2, max = max over times e(t),
///            reference^2 = mean over both of |u_ref|^2
/// Source     [@morrison2023, figures 17 and 19]: RMS error over all nodes in
///            percent of the reference's RMS displacement. Here one figure for
///            all times, with one denominator, so that a reference that starts
///            at rest divides nothing by zero.
struct FieldError {
  double rms = 0.0;        ///< [m]
  double max = 0.0;        ///< [m]
  double reference = 0.0;  ///< [m]
  double roundoff = 0.0;   ///< what rounding alone may make of it [m]

  /// rms / reference [-]; none if the reference is no more than round-off.
  [[nodiscard]] std::optional<double> relative() const;
  /// max / reference [-]; none as above.
  [[nodiscard]] std::optional<double> relative_max() const;
};

/// The three fields by which motions are compared.
struct MotionError {
  /// Of the kept nodes, from where the undeformed nodes start; world axes.
  FieldError displacement;
  /// The same by the motion of the body frame alone. A body without nodes
  /// counts by the points of its mass, uniform in the sense of its inertia.
  FieldError rigid;
  /// Of the kept nodes, relative to the body frame; body axes.
  FieldError deformation;
};

struct BodyMotionError {
  std::string name;
  bool has_nodes = false;  ///< without, only `rigid` means something
  MotionError error;
};

/// All bodies, and each by itself. Over all bodies every node counts once in
/// `displacement` and `deformation`, every body that moves freely once in
/// `rigid`.
struct SystemMotionError {
  MotionError error;
  std::vector<BodyMotionError> bodies;  ///< the model's order
};

/// One simulation: its model and its states at the output times.
struct Motion {
  const dynamics::SystemModel& model;
  std::span<const dynamics::SystemState> states;
};

/// Error of `motion` against `reference`. Times are all counted alike, whatever
/// lies between them.
/// @throws ContractError unless both have the same bodies with the same kept
/// nodes, and the same times.
[[nodiscard]] SystemMotionError calc_motion_error(const Motion& motion,
                                                  const Motion& reference);

}  // namespace limber::results
