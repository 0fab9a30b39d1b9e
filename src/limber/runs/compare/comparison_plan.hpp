// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "limber/scene/build/scene.hpp"

/// The runs of `limber compare`: docs/reference/compare.md.
namespace limber::runs {

/// How to simulate a scene. Unset values are those of the scenario.
struct Choice {
  dynamics::Fidelity level = dynamics::Fidelity::coupled;
  scene::BasisChoice basis;
  std::optional<double> step;  ///< [s]
  std::optional<dynamics::IntegratorKind> integrator = {};
  double tolerance_fraction =
      1.0;  ///< of the scenario's tolerance, if it has one

  bool operator==(const Choice&) const = default;
};

/// The scenario values that a choice replaces, over those set by path.
[[nodiscard]] scene::Overrides to_overrides(
    const Choice& choice, const std::vector<scene::Setting>& settings = {});

/// Values to combine; an empty axis means the scenario's value.
struct Axes {
  std::vector<dynamics::Fidelity> levels = {};  ///< empty: all with a basis
  std::vector<int> eigenmodes = {};             ///< numbers of eigenmodes
  std::vector<std::string> sources = {};        ///< names from source_names()
  std::vector<double> steps = {};               ///< [s]
};

/// Requested properties of the reference; by default the most expensive reduced
/// one.
struct ReferenceWish {
  std::optional<dynamics::Fidelity> level = {};
  std::optional<int> eigenmodes = {};  ///< number of eigenmodes
  std::optional<double> step = {};     ///< [s]
  std::optional<dynamics::IntegratorKind> integrator = {};
};

struct ComparisonPlan {
  std::vector<Choice> runs;  ///< none twice
  Choice reference;
  bool reference_is_default = false;  ///< its level was not requested
};

/// "eigenmodes", "interfaces", "loads", "all": eigenmodes alone, or with the
/// static-deformation modes of interfaces, of loads, of both.
[[nodiscard]] const std::vector<std::string>& source_names();
/// The name of a basis' sources; empty if it leaves them to the scenario.
[[nodiscard]] std::string find_source_name(const scene::BasisChoice& basis);

/// The product of the axes. Levels without a reduced basis have no basis axes;
/// neither has a scene without flexible links, which has only one level. The
/// reference has the most expensive level with a reduced basis, or a higher one
/// if that is among the axes, the most eigenmodes and all sources among the
/// axes, and half the shortest step of any run, or a tenth of the scenario's
/// tolerance, so that the error of the step is visible in every run.
/// @throws InputError for an unknown name, or a reference that computes less
/// than a run.
[[nodiscard]] ComparisonPlan make_plan(const Axes& axes,
                                       const ReferenceWish& wish,
                                       const scene::Scene& scene);

/// Describes a default reference and what it neglects; empty for a requested
/// one.
[[nodiscard]] std::string describe_default_reference(
    const ComparisonPlan& plan);

/// Rough estimate of a run's cost relative to the reference's, by level and
/// step.
[[nodiscard]] double estimate_cost(const Choice& choice,
                                   const Choice& reference);

/// For tables: "coupled, 10 eigenmodes + interfaces, 0.001 s".
[[nodiscard]] std::string describe(const Choice& choice);
/// For pictures, without the level: "10 + interfaces 0.001 s".
[[nodiscard]] std::string make_label(const Choice& choice);
/// For folders: "coupled-10-interfaces-0.001s".
[[nodiscard]] std::string make_folder_name(const Choice& choice);

}  // namespace limber::runs
