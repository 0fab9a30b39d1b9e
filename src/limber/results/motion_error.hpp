// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "limber/dynamics/system/system_model.hpp"
#include "limber/results/history.hpp"

/// Error of one simulation of a system relative to another, the reference:
/// docs/reference/compare.md.
namespace limber::results {

/// Error of one field of displacements.
///
/// Equation   e(t)^2 = mean over points |u - u_ref|^2,
///            rms^2 = mean over times e(t)^2, max = max over times e(t),
///            reference^2 = mean over both of |u_ref|^2
/// Source     [@morrison2023, figures 17 and 19]: RMS error over all nodes in
///            percent of the reference's RMS displacement. Here one value for
///            all times, with one denominator, so that a reference that starts
///            at rest causes no division by zero.
struct FieldError {
  double rms = 0.0;        ///< [m]
  double max = 0.0;        ///< [m]
  double reference = 0.0;  ///< [m]
  double roundoff = 0.0;   ///< possible rms from rounding alone [m]

  /// rms / reference [-]; none if the reference is round-off.
  [[nodiscard]] std::optional<double> relative() const;
  /// max / reference [-]; none as above.
  [[nodiscard]] std::optional<double> relative_max() const;
};

/// The three fields by which motions are compared.
struct MotionError {
  /// Of the stored nodes, relative to the undeformed nodes at the start; world
  /// frame.
  FieldError displacement;
  /// The same for the motion of the body frame alone. A body without nodes uses
  /// its mass distribution, represented by its inertia.
  FieldError rigid;
  /// Of the stored nodes, relative to the body frame and expressed in it.
  FieldError deformation;
};

struct BodyMotionError {
  std::string name;
  bool has_nodes = false;  ///< without, only `rigid` is meaningful
  MotionError error;
};

/// All bodies together, and each body. Over all bodies every node counts once
/// in `displacement` and `deformation`, every unclamped body once in `rigid`.
struct SystemMotionError {
  MotionError error;
  std::vector<BodyMotionError> bodies;  ///< the model's order
};

/// One simulation: its model and its states at the output times.
struct Motion {
  const dynamics::SystemModel& model;
  States states;
};

/// Error of `motion` against `reference`. All output times have equal weight.
/// For a link that is whole in one and in pieces in the other ("LINK.1", ...),
/// only displacements of the nodes that both store are compared.
/// @throws ContractError unless both have the same bodies except for pieces,
/// with the same stored nodes, and the same times.
[[nodiscard]] SystemMotionError calc_motion_error(const Motion& motion,
                                                  const Motion& reference);

}  // namespace limber::results
