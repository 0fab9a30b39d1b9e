// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scene/scene.hpp"

/// Which runs `limber compare` does: docs/compare.md.
namespace limber::app {

/// How to simulate a scene. What is not given is as the scenario has it.
struct Choice {
  dynamics::Fidelity level = dynamics::Fidelity::coupled;
  scene::BasisChoice basis;
  std::optional<double> step;  ///< [s]
  std::optional<dynamics::IntegratorKind> integrator = {};

  bool operator==(const Choice&) const = default;
};

/// What takes the scenario's words' place for a choice.
[[nodiscard]] scene::Overrides to_overrides(const Choice& choice);

/// Values to combine; an empty axis means the scenario's own.
struct Axes {
  std::vector<dynamics::Fidelity> levels;  ///< empty: all that have a basis
  std::vector<int> eigenmodes;
  std::vector<std::string> sources;  ///< names from source_names()
  std::vector<double> steps;         ///< [s]
};

/// What is asked of the reference; else it is the costliest that is reduced.
struct ReferenceWish {
  std::optional<dynamics::Fidelity> level;
  std::optional<int> eigenmodes;
  std::optional<double> step;  ///< [s]
  std::optional<dynamics::IntegratorKind> integrator = {};
};

struct ComparisonPlan {
  std::vector<Choice> runs;  ///< none twice
  Choice reference;
  bool reference_is_default = false;  ///< its level was not asked for
};

/// "eigenmodes", "interfaces", "loads", "all": eigenmodes alone, or with the
/// static-deformation modes of interfaces, of loads, of both.
[[nodiscard]] const std::vector<std::string>& source_names();
/// The name of a basis' sources; empty if it leaves them to the scenario.
[[nodiscard]] std::string find_source_name(const scene::BasisChoice& basis);

/// The product of the axes. Levels without a reduced basis have no basis axes;
/// neither has a scene without flexible links, which has but one level. The
/// reference has the costliest level with a reduced basis, or a higher one that
/// is among the axes, the most eigenmodes and all the sources among the axes,
/// and half of the shortest step of any run, so that the error of the step
/// shows in every run.
/// @throws InputError for a name that is unknown, or a reference that leaves
/// out what a run computes.
[[nodiscard]] ComparisonPlan make_plan(const Axes& axes,
                                       const ReferenceWish& wish,
                                       const scene::Scene& scene);

/// What a reference that was not asked for is, and what it leaves out; empty
/// for one that was.
[[nodiscard]] std::string describe_default_reference(
    const ComparisonPlan& plan);

/// What a run will cost, in parts of what the reference costs: a rough model
/// by level and step.
[[nodiscard]] double estimate_cost(const Choice& choice,
                                   const Choice& reference);

/// For tables: "coupled, 10 eigenmodes + interfaces, 0.001 s".
[[nodiscard]] std::string describe(const Choice& choice);
/// For pictures, without the level: "10 + interfaces 0.001 s".
[[nodiscard]] std::string make_label(const Choice& choice);
/// For folders: "coupled-10-interfaces-0.001s".
[[nodiscard]] std::string make_folder_name(const Choice& choice);

}  // namespace limber::app
