// SPDX-License-Identifier: BSD-3-Clause
#include "limber/fem/solid/material.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "limber/common/errors.hpp"
#include "limber/common/material/anisotropy.hpp"
#include "limber/common/names.hpp"
#include "limber/fem/mesh/volume_names.hpp"

namespace limber::fem {
namespace {

using Problems = std::vector<std::string>;

std::string describe(const MaterialAssignment& assignment) {
  return assignment.group.empty()
             ? std::string("material")
             : fmt::format("material of group '{}'", assignment.group);
}

void check_isotropic(const ElasticMaterial& m, const std::string& what,
                     Problems& problems) {
  if (!(m.youngs_modulus > 0.0) || !std::isfinite(m.youngs_modulus))
    problems.push_back(
        fmt::format("{}: Young's modulus {} Pa; expected a positive number.",
                    what, m.youngs_modulus));
  if (!(m.poisson_ratio > -1.0 && m.poisson_ratio < 0.5))
    problems.push_back(fmt::format(
        "{}: Poisson's ratio {}; expected above -1 and below 0.5 (at 0.5 a "
        "solid is incompressible and its stiffness infinite).",
        what, m.poisson_ratio));
}

void check_values(const MaterialAssignment& assignment, Problems& problems) {
  const ElasticMaterial& m = assignment.material;
  const std::string what = describe(assignment);
  if (m.anisotropy) {
    for (const std::string& problem : find_inadmissible(m.anisotropy->C))
      problems.push_back(fmt::format("{}: {}", what, problem));
  } else {
    check_isotropic(m, what, problems);
  }
  if (!(m.density > 0.0) || !std::isfinite(m.density))
    problems.push_back(fmt::format(
        "{}: density {} kg/m^3; expected a positive number.", what, m.density));
}

void check_group(const Mesh& mesh, const MaterialAssignment& assignment,
                 Problems& problems) {
  if (assignment.group.empty()) return;
  const std::set<std::string> names = find_volume_names(mesh);
  if (names.contains(assignment.group)) return;
  const std::vector<std::string> known(names.begin(), names.end());
  problems.push_back(
      fmt::format("{}: {}", mesh.source,
                  describe_unknown("volume group", assignment.group, known)));
}

std::string describe_region(const std::vector<std::string>& names) {
  return names.empty()
             ? std::string("a volume without a group")
             : fmt::format("volume group '{}'", fmt::join(names, "', '"));
}

/// The assignments that name the region, or else the nameless ones.
std::vector<const MaterialAssignment*> find_assignments(
    const std::vector<std::string>& names,
    const std::vector<MaterialAssignment>& assignments) {
  std::vector<const MaterialAssignment*> named;
  std::vector<const MaterialAssignment*> nameless;
  for (const MaterialAssignment& assignment : assignments) {
    if (assignment.group.empty())
      nameless.push_back(&assignment);
    else if (std::count(names.begin(), names.end(), assignment.group) > 0)
      named.push_back(&assignment);
  }
  return named.empty() ? nameless : named;
}

/// Whether there is no such solid: a unit is wrong.
bool is_out_of_proportion(const ElasticMaterial& m) {
  constexpr double kSoftest = 1e4;    // gels [Pa]
  constexpr double kStiffest = 3e12;  // diamond has 1.2e12 [Pa]
  constexpr double kLightest = 1.0;   // aerogel [kg/m^3]
  constexpr double kHeaviest = 3e4;   // osmium has 2.3e4 [kg/m^3]
  return !(m.youngs_modulus > kSoftest && m.youngs_modulus < kStiffest &&
           m.density > kLightest && m.density < kHeaviest);
}

const RegionMaterial* find_file_material(const Mesh& mesh, std::size_t region) {
  if (mesh.materials.empty() || mesh.materials[region].name.empty())
    return nullptr;
  return &mesh.materials[region];
}

ElasticMaterial take_file_material(const Mesh& mesh,
                                   const RegionMaterial& stated,
                                   Problems& problems) {
  if (!stated.problem.empty()) {
    problems.push_back(fmt::format("{}: {}", mesh.source, stated.problem));
    return {};
  }
  if (!stated.material.anisotropy) {
    const std::size_t before = problems.size();
    check_isotropic(stated.material,
                    fmt::format("{}: {}", mesh.source, stated.name), problems);
    if (problems.size() > before) return {};
  }
  if (is_out_of_proportion(stated.material))
    problems.push_back(fmt::format(
        "{}: {} would have a Young's modulus of {:.4g} Pa and a density of "
        "{:.4g} kg/m^3, which no solid has (steel: 2.1e+11 Pa, 7850 kg/m^3). "
        "Expected the file's length unit (unit, mm for one) and its unit of "
        "force, or a material in place of the file's.",
        mesh.source, stated.name, stated.material.youngs_modulus,
        stated.material.density));
  return stated.material;
}

ElasticMaterial find_material(
    const Mesh& mesh, std::size_t region,
    const std::vector<MaterialAssignment>& assignments, Problems& problems) {
  const std::vector<std::string>& names = mesh.volume_groups[region];
  const auto found = find_assignments(names, assignments);
  if (found.size() == 1) return found.front()->material;
  if (const auto* stated = find_file_material(mesh, region);
      stated != nullptr && found.empty())
    return take_file_material(mesh, *stated, problems);
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
    for (std::size_t region = 0; region < mesh.volume_groups.size(); ++region)
      materials.push_back(find_material(mesh, region, assignments, problems));
  if (problems.empty()) check_rest(mesh, assignments, problems);
  if (!problems.empty()) throw InputError(problems);
  return materials;
}

std::vector<std::string> describe_file_materials(
    const Mesh& mesh, const std::vector<MaterialAssignment>& assignments) {
  std::vector<std::string> lines;
  for (std::size_t region = 0; region < mesh.volume_groups.size(); ++region) {
    const RegionMaterial* stated = find_file_material(mesh, region);
    if (stated == nullptr) continue;
    const std::string where = describe_region(mesh.volume_groups[region]);
    const ElasticMaterial& m = stated->material;
    if (!find_assignments(mesh.volume_groups[region], assignments).empty()) {
      lines.push_back(
          fmt::format("{} of {}: replaced by the material that is given",
                      stated->name, where));
    } else if (!stated->problem.empty()) {
      lines.push_back(
          fmt::format("{} of {}: it cannot be used", stated->name, where));
    } else {
      lines.push_back(fmt::format(
          "{} of {}: {} {:.4g} Pa, density {:.4g} kg/m^3", stated->name, where,
          m.anisotropy ? "anisotropic, Young's modulus in the mean"
                       : "Young's modulus",
          m.youngs_modulus, m.density));
    }
  }
  if (!mesh.masses.empty()) {
    double sum = 0.0;
    for (const NodeMass& point : mesh.masses) sum += point.mass;
    lines.push_back(fmt::format(
        "{} with point masses: {:.4g} kg in all",
        mesh.masses.size() == 1 ? std::string("1 node")
                                : fmt::format("{} nodes", mesh.masses.size()),
        sum));
  }
  return lines;
}

}  // namespace limber::fem
