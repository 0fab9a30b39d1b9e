// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "limber/app/run/run_scene.hpp"
#include "limber/scene/build/scene.hpp"

/// What the error of a run comes from: docs/reference/errors.md.
namespace limber::app {

/// One cause, with the run that shows it: the same scene with only this
/// refined.
struct ErrorCause {
  std::string name;   ///< "step", "modes", "level", "mesh", "contact"
  std::string finer;  ///< the refinement: "half of the step"
  scene::Overrides overrides;
  /// Error of the run over its difference from the finer one [-].
  double factor = 1.0;
};

struct ErrorCauses {
  std::vector<ErrorCause> causes;
  std::vector<std::string> unknown;  ///< what no run can show, and why
};

/// The causes of a completed run.
///
/// Halving the step leaves 1/4 of an error of second order, so that the error
/// is 4/3 of the difference (Richardson 1911), and of first order twice; a mesh
/// 1.5 times as fine leaves 4/9 of one of second order. Of modes and levels the
/// difference itself counts, of modes half as much again for those after them.
[[nodiscard]] ErrorCauses find_error_causes(const runs::Run& run);

/// All of them in one run, except the level, whose cost the others multiply;
/// none if there are fewer than two.
[[nodiscard]] std::optional<ErrorCause> join_causes(
    const std::vector<ErrorCause>& causes);

}  // namespace limber::app
