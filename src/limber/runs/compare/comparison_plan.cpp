// SPDX-License-Identifier: BSD-3-Clause
#include "limber/runs/compare/comparison_plan.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "limber/common/errors.hpp"
#include "limber/common/names.hpp"

namespace limber::runs {
namespace {

using dynamics::Fidelity;
using scene::BasisChoice;

/// Of the scenario's tolerance, for the reference [-].
constexpr double kToleranceFraction = 0.1;

bool has_flexible_link(const scene::Scene& scene) {
  return std::any_of(scene.robot.links.begin(), scene.robot.links.end(),
                     [](const scene::Link& link) { return link.flexible; });
}

/// Whether a level uses a reduced basis.
bool has_basis(Fidelity level) {
  return level != Fidelity::rigid && level < Fidelity::full;
}

/// The most expensive level with a reduced basis, unless a higher one was
/// requested: whole meshes may take hours.
Fidelity find_highest_level(const Axes& axes) {
  Fidelity highest = Fidelity::coupled;
  for (const Fidelity level : axes.levels) highest = std::max(highest, level);
  return highest;
}

std::vector<Fidelity> find_levels(const Axes& axes, Fidelity reference) {
  if (!axes.levels.empty()) return axes.levels;
  std::vector<Fidelity> levels;
  const Fidelity last = std::min(reference, Fidelity::coupled);
  for (int i = 0; i <= static_cast<int>(last); ++i) {
    levels.push_back(static_cast<Fidelity>(i));
  }
  return levels;
}

void set_sources(const std::string& name, BasisChoice& basis) {
  const auto& names = source_names();
  if (std::find(names.begin(), names.end(), name) == names.end()) {
    throw InputError("--sources: " + describe_unknown("source", name, names));
  }
  basis.interfaces = name == "interfaces" || name == "all";
  basis.loads = name == "loads" || name == "all";
}

std::vector<BasisChoice> combine_bases(const Axes& axes) {
  std::vector<BasisChoice> bases;
  const std::size_t counts = std::max<std::size_t>(axes.eigenmodes.size(), 1);
  const std::size_t kinds = std::max<std::size_t>(axes.sources.size(), 1);
  for (std::size_t i = 0; i < counts; ++i) {
    for (std::size_t j = 0; j < kinds; ++j) {
      BasisChoice basis;
      if (!axes.eigenmodes.empty()) basis.eigenmodes = axes.eigenmodes[i];
      if (!axes.sources.empty()) set_sources(axes.sources[j], basis);
      const bool is_empty = basis.eigenmodes == 0 &&
                            basis.interfaces == false && basis.loads == false;
      if (!is_empty) bases.push_back(basis);
    }
  }
  return bases;
}

std::vector<std::optional<double>> find_steps(const Axes& axes) {
  if (axes.steps.empty()) return {std::nullopt};
  return {axes.steps.begin(), axes.steps.end()};
}

double find_shortest_step(const Axes& axes, const scene::Scene& scene) {
  if (!axes.steps.empty()) {
    return *std::min_element(axes.steps.begin(), axes.steps.end());
  }
  double shortest = scene.scenario.settings.step;
  for (const auto& change : scene.scenario.settings.step_changes) {
    shortest = std::min(shortest, change.step);
  }
  return shortest;
}

BasisChoice find_largest_basis(const Axes& axes, const ReferenceWish& wish) {
  BasisChoice largest;
  for (const BasisChoice& basis : combine_bases(axes)) {
    largest.eigenmodes = std::max(largest.eigenmodes, basis.eigenmodes);
    largest.interfaces = std::max(largest.interfaces, basis.interfaces);
    largest.loads = std::max(largest.loads, basis.loads);
  }
  if (wish.eigenmodes) largest.eigenmodes = wish.eigenmodes;
  return largest;
}

// Without a step of their own, compared runs step to the scenario's tolerance.
bool steps_to_tolerance(const Axes& axes, const scene::Scene& scene) {
  return axes.steps.empty() && scene.scenario.settings.tolerance > 0.0;
}

Choice find_reference(const Axes& axes, const ReferenceWish& wish,
                      const scene::Scene& scene) {
  Choice reference;
  reference.level = wish.level.value_or(find_highest_level(axes));
  if (has_basis(reference.level) && has_flexible_link(scene)) {
    reference.basis = find_largest_basis(axes, wish);
  }
  reference.integrator = wish.integrator;
  if (!wish.step && steps_to_tolerance(axes, scene)) {
    reference.tolerance_fraction = kToleranceFraction;
  } else {
    reference.step = wish.step.value_or(0.5 * find_shortest_step(axes, scene));
  }
  return reference;
}

void check_reference(const ComparisonPlan& plan, const Axes& axes,
                     const ReferenceWish& wish, const scene::Scene& scene) {
  const Choice& reference = plan.reference;
  std::vector<std::string> problems;
  for (const Fidelity level : axes.levels) {
    if (level <= reference.level) continue;
    problems.push_back(
        fmt::format("--fidelity: '{}' computes more than the reference, '{}'; "
                    "choose another reference by --reference",
                    to_string(level), to_string(reference.level)));
  }
  const double shortest = find_shortest_step(axes, scene);
  if (reference.integrator && !reference.step &&
      !dynamics::traits_of(*reference.integrator).is_adaptive) {
    problems.push_back(
        fmt::format("--reference-integrator: {} cannot step to the scenario's "
                    "tolerance; also give --reference-step",
                    to_string(*reference.integrator)));
  }
  if (reference.step.value_or(0.0) > shortest) {
    problems.push_back(fmt::format(
        "--reference-step: {:g} s is longer than a compared step, {:g} s",
        *reference.step, shortest));
  }
  for (const int count : axes.eigenmodes) {
    if (!reference.basis.eigenmodes || count <= *reference.basis.eigenmodes) {
      continue;
    }
    problems.push_back(fmt::format(
        "--reference-modes: {} are fewer than the {} of a compared run",
        *reference.basis.eigenmodes, count));
  }
  if (wish.eigenmodes && !reference.basis.eigenmodes) {
    problems.push_back(fmt::format(
        "--reference-modes: the reference, '{}', has no reduced basis here",
        to_string(reference.level)));
  }
  if (!problems.empty()) throw InputError(problems);
}

/// Rejects requests without effect.
void check_runs(const ComparisonPlan& plan, const Axes& axes) {
  if (plan.runs.empty()) {
    throw InputError("nothing to compare: the only run is the reference");
  }
  const bool is_reduced =
      std::any_of(plan.runs.begin(), plan.runs.end(),
                  [](const Choice& run) { return has_basis(run.level); });
  if (!is_reduced && !(axes.eigenmodes.empty() && axes.sources.empty())) {
    throw InputError(
        "--modes and --sources choose reduced bases; no level that is compared "
        "has one");
  }
}

// Its step, or its fraction of the tolerance; empty if they are the scenario's.
std::string describe_accuracy(const Choice& choice) {
  if (choice.step) return fmt::format("{:g} s", *choice.step);
  if (choice.tolerance_fraction == 1.0) return "";
  return fmt::format("{:g} of the tolerance", choice.tolerance_fraction);
}

std::vector<std::string> list_details(const Choice& choice) {
  std::vector<std::string> details;
  const std::string sources = find_source_name(choice.basis);
  if (choice.basis.eigenmodes) {
    details.push_back(fmt::format("{}", *choice.basis.eigenmodes));
  }
  if (!sources.empty()) details.push_back(sources);
  const std::string accuracy = describe_accuracy(choice);
  if (!accuracy.empty()) details.push_back(accuracy);
  return details;
}

const std::string& name_of(dynamics::IntegratorKind kind) {
  return dynamics::to_string(kind);
}

std::string describe_details(const Choice& choice) {
  std::vector<std::string> parts;
  const std::string sources = find_source_name(choice.basis);
  if (choice.basis.eigenmodes) {
    parts.push_back(fmt::format("{} eigenmodes", *choice.basis.eigenmodes));
    if (!sources.empty() && sources != "eigenmodes") {
      parts.back() += " + " + sources;
    }
  } else if (!sources.empty()) {
    parts.push_back(sources);
  }
  if (choice.integrator) parts.push_back(name_of(*choice.integrator));
  const std::string accuracy = describe_accuracy(choice);
  if (!accuracy.empty()) parts.push_back(accuracy);
  return fmt::format("{}", fmt::join(parts, ", "));
}

}  // namespace

scene::Overrides to_overrides(const Choice& choice,
                              const std::vector<scene::Setting>& settings) {
  scene::Overrides overrides;
  overrides.settings = settings;
  overrides.fidelity = choice.level;
  overrides.basis = choice.basis;
  overrides.step = choice.step;
  overrides.integrator = choice.integrator;
  return overrides;
}

const std::vector<std::string>& source_names() {
  static const std::vector<std::string> names = {"eigenmodes", "interfaces",
                                                 "loads", "all"};
  return names;
}

std::string find_source_name(const BasisChoice& basis) {
  if (!basis.interfaces || !basis.loads) return "";
  if (*basis.interfaces) return *basis.loads ? "all" : "interfaces";
  return *basis.loads ? "loads" : "eigenmodes";
}

ComparisonPlan make_plan(const Axes& axes, const ReferenceWish& wish,
                         const scene::Scene& scene) {
  ComparisonPlan plan;
  (void)combine_bases(axes);  // checks the names even if unused
  plan.reference = find_reference(axes, wish, scene);
  plan.reference_is_default = !wish.level;
  check_reference(plan, axes, wish, scene);
  const bool is_flexible = has_flexible_link(scene);
  for (Fidelity level : find_levels(axes, plan.reference.level)) {
    if (!is_flexible) level = plan.reference.level;
    const bool is_reduced = is_flexible && has_basis(level);
    for (const BasisChoice& basis :
         is_reduced ? combine_bases(axes) : std::vector<BasisChoice>(1)) {
      for (const auto& step : find_steps(axes)) {
        const Choice choice{level, basis, step};
        const bool is_known =
            choice == plan.reference ||
            std::count(plan.runs.begin(), plan.runs.end(), choice) > 0;
        if (!is_known) plan.runs.push_back(choice);
      }
    }
  }
  check_runs(plan, axes);
  return plan;
}

std::string describe_default_reference(const ComparisonPlan& plan) {
  if (!plan.reference_is_default) return "";
  if (!has_basis(plan.reference.level)) {
    return fmt::format(
        "The reference is the highest level requested, '{}'; choose another by "
        "--reference.",
        to_string(plan.reference.level));
  }
  return fmt::format(
      "The reference is the costliest reduced level, '{}': errors relative to "
      "whole meshes are not shown. --reference full uses whole meshes, at "
      "their cost.",
      to_string(plan.reference.level));
}

double estimate_cost(const Choice& choice, const Choice& reference) {
  const auto of_level = [](Fidelity level) {
    switch (level) {
      case Fidelity::rigid:
        return 0.2;
      case Fidelity::uncoupled:
      case Fidelity::one_way:
        return 0.5;
      case Fidelity::coupled:
        return 1.0;
      case Fidelity::nonlinear:
        return 2.0;
      case Fidelity::full:
        break;
    }
    return 100.0;
  };
  const double steps =
      choice.step && reference.step ? *reference.step / *choice.step : 0.5;
  return steps * of_level(choice.level) / of_level(reference.level);
}

std::string describe(const Choice& choice) {
  const std::string details = describe_details(choice);
  const std::string level(to_string(choice.level));
  return details.empty() ? level : level + ", " + details;
}

std::string make_label(const Choice& choice) {
  std::vector<std::string> parts;
  std::string sources = find_source_name(choice.basis);
  if (choice.basis.eigenmodes) {
    parts.push_back(fmt::format("{}", *choice.basis.eigenmodes));
    if (sources.empty() || sources == "eigenmodes") {
      sources = "modes";
    } else {
      parts.back() += " +";
    }
  }
  if (!sources.empty()) parts.push_back(sources);
  const std::string accuracy = describe_accuracy(choice);
  if (!accuracy.empty()) parts.push_back(accuracy);
  return fmt::format("{}", fmt::join(parts, " "));
}

std::string make_folder_name(const Choice& choice) {
  std::string name(to_string(choice.level));
  for (const std::string& part : list_details(choice)) name += "-" + part;
  std::erase(name, ' ');
  return name;
}

}  // namespace limber::runs
