// SPDX-License-Identifier: BSD-3-Clause
#include "limber/fem/solid/material.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "limber/common/errors.hpp"
#include "limber/common/names.hpp"

namespace limber::fem {
namespace {

using Problems = std::vector<std::string>;

std::string describe(const MaterialAssignment& assignment) {
  return assignment.group.empty()
             ? std::string("material")
             : fmt::format("material of group '{}'", assignment.group);
}

void check_values(const MaterialAssignment& assignment, Problems& problems) {
  const ElasticMaterial& m = assignment.material;
  const std::string what = describe(assignment);
  if (!(m.youngs_modulus > 0.0) || !std::isfinite(m.youngs_modulus))
    problems.push_back(
        fmt::format("{}: Young's modulus {} Pa; expected a positive number.",
                    what, m.youngs_modulus));
  if (!(m.poisson_ratio > -1.0 && m.poisson_ratio < 0.5))
    problems.push_back(fmt::format(
        "{}: Poisson's ratio {}; expected above -1 and below 0.5 (at 0.5 a "
        "solid is incompressible and its stiffness infinite).",
        what, m.poisson_ratio));
  if (!(m.density > 0.0) || !std::isfinite(m.density))
    problems.push_back(fmt::format(
        "{}: density {} kg/m^3; expected a positive number.", what, m.density));
}

void check_group(const Mesh& mesh, const MaterialAssignment& assignment,
                 Problems& problems) {
  if (assignment.group.empty()) return;
  std::vector<std::string> known;
  for (const auto& names : mesh.volume_groups)
    for (const std::string& name : names)
      if (std::count(known.begin(), known.end(), name) == 0)
        known.push_back(name);
  if (std::count(known.begin(), known.end(), assignment.group) == 0)
    problems.push_back(
        fmt::format("{}: {}", mesh.source,
                    describe_unknown("volume group", assignment.group, known)));
}

std::string describe_region(const std::vector<std::string>& names) {
  return names.empty()
             ? std::string("a volume without a group")
             : fmt::format("volume group '{}'", fmt::join(names, "', '"));
}

/// The one assignment that names the region, or else the nameless one.
ElasticMaterial find_material(
    const Mesh& mesh, const std::vector<std::string>& names,
    const std::vector<MaterialAssignment>& assignments, Problems& problems) {
  std::vector<const MaterialAssignment*> named;
  std::vector<const MaterialAssignment*> nameless;
  for (const MaterialAssignment& assignment : assignments) {
    if (assignment.group.empty())
      nameless.push_back(&assignment);
    else if (std::count(names.begin(), names.end(), assignment.group) > 0)
      named.push_back(&assignment);
  }
  const auto& found = named.empty() ? nameless : named;
  if (found.size() == 1) return found.front()->material;
  problems.push_back(fmt::format("{}: {} has {} materials; expected one.",
                                 mesh.source, describe_region(names),
                                 found.empty() ? "no" : "several"));
  return {};
}

/// A nameless material needs a region that no other one names.
void check_rest(const Mesh& mesh,
                const std::vector<MaterialAssignment>& assignments,
                Problems& problems) {
  const auto is_nameless = [](const auto& a) { return a.group.empty(); };
  const auto is_named = [&](const std::vector<std::string>& names) {
    return std::any_of(names.begin(), names.end(), [&](const auto& name) {
      return std::any_of(assignments.begin(), assignments.end(),
                         [&](const auto& a) { return a.group == name; });
    });
  };
  if (std::any_of(assignments.begin(), assignments.end(), is_nameless) &&
      std::all_of(mesh.volume_groups.begin(), mesh.volume_groups.end(),
                  is_named))
    problems.push_back(
        fmt::format("{}: a material without a group is left over: every volume "
                    "has one by its group. Expected no more materials than "
                    "volumes.",
                    mesh.source));
}

}  // namespace

std::vector<ElasticMaterial> assign_materials(
    const Mesh& mesh, const std::vector<MaterialAssignment>& assignments) {
  Problems problems;
  for (const MaterialAssignment& assignment : assignments) {
    check_values(assignment, problems);
    check_group(mesh, assignment, problems);
  }
  std::vector<ElasticMaterial> materials;
  if (problems.empty())
    for (const auto& names : mesh.volume_groups)
      materials.push_back(find_material(mesh, names, assignments, problems));
  if (problems.empty()) check_rest(mesh, assignments, problems);
  if (!problems.empty()) throw InputError(problems);
  return materials;
}

}  // namespace limber::fem
