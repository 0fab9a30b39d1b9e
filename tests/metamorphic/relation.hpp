// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

#include "metamorphic/random_draw.hpp"
#include "metamorphic/scene_motion.hpp"
#include "metamorphic/scene_plan.hpp"

namespace limber::metamorphic {

/// A scene changed in a way that cannot matter.
struct Changed {
  ScenePlan plan;
  /// The changed scene with ten times the flexibility that it has beyond the
  /// first: differs from it by more than it differs from the first.
  std::optional<ScenePlan> softer = {};
  /// Turns what the changed scene does into what the first one should do.
  std::function<void(Output&)> undo = [](Output&) {};
  /// Where and how fast its bodies are at most, beyond the first scene's:
  /// doubles round there.
  double place = 0.0;  ///< [m]
  double speed = 0.0;  ///< [m/s]
  /// Which energies stay as they are.
  enum class Energies { all, strain, none } energies = Energies::all;
  /// Which runs take the same steps, and means over a step. In others the
  /// scheme has other errors; one pass to a tolerance has no bound of its own.
  enum class Steps {
    same,
    same_if_fixed,
    same_without_events,  ///< if they are fixed, and none ends at an event
    same_without_marks,   ///< nor at a jump of a load or command
    others,
  } steps = Steps::same;
};

struct Relation {
  std::string name;
  /// Nothing for a scene to which the relation does not apply.
  std::function<std::optional<Changed>(const ScenePlan&, RandomDraw&)> change;
};

/// For messages of tests.
inline void PrintTo(const Relation& relation, std::ostream* out) {
  *out << relation.name;
}

/// Those of place, velocity, time and units.
[[nodiscard]] std::vector<Relation> relations_of_frame();
/// Those of order, company and outputs.
[[nodiscard]] std::vector<Relation> relations_of_company();

}  // namespace limber::metamorphic
