// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "beam.hpp"
#include "full_modes.hpp"
#include "limber/flexbody/modal/modal_response.hpp"
#include "study.hpp"

/// Where an error of deformation comes from: one thing at a time against the
/// next finer one.
namespace limber::bench::trade {

/// Fractions of the reference's deformation, root mean squares over nodes and
/// outputs [-].
struct Split {
  /// All modes of the mesh, linear and exact in time, against the reference:
  /// the neglected physics, and the remaining error of the reference's step.
  double physics = 0.0;
  /// The basis, exact in time, against all modes.
  double truncation = 0.0;
  /// Least truncation of any basis of as many vectors.
  double bound = 0.0;
  /// The same basis in steps against exact in time.
  double step = 0.0;
};

/// Deformation by all modes at `times`, 3n x T [m]. The loads turn with the
/// body.
[[nodiscard]] MatrixX respond_by_all(const FullModes& modes,
                                     const flexbody::ModalLoads& loads,
                                     const std::vector<double>& times);

/// Step loads on all modes.
[[nodiscard]] flexbody::ModalLoads project(const FullModes& modes,
                                           const StepForces& forces);

/// @param all respond_by_all at the outputs
/// @param stepped null: no fraction of the step
[[nodiscard]] Split split_error(const Outcome& reference, const MatrixX& all,
                                const Outcome& exact, const Outcome* stepped);

}  // namespace limber::bench::trade
