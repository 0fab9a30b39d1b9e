// SPDX-License-Identifier: BSD-3-Clause
#include "limber/fem/sections/region_properties.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <numeric>

#include "limber/common/dense/linear_solve.hpp"
#include "limber/common/errors.hpp"

namespace limber::fem {
namespace {

[[noreturn]] void fail(const std::string& text) { throw InputError(text); }

const SolidMaterial& find_material(const std::string& group,
                                   const MeshSections& sections) {
  const auto find = [&](const std::string& name) {
    return std::ranges::find(sections.materials, name,
                             &MaterialAssignment::group);
  };
  auto found = find(group);
  if (found == sections.materials.end()) found = find("");
  if (found == sections.materials.end())
    fail(
        fmt::format("has no material. Expected one of group '{}', or one "
                    "without group for all.",
                    group));
  return found->material;
}

/// Materials of the plies, as many as there are.
std::vector<const SolidMaterial*> list_materials(const ShellRegion& region,
                                                 const MeshSections& sections,
                                                 std::size_t plies) {
  if (region.materials.empty())
    return {plies, &find_material(region.group, sections)};
  std::vector<const SolidMaterial*> materials;
  for (const std::string& name : region.materials) {
    const auto found =
        std::ranges::find(sections.materials, name, &MaterialAssignment::group);
    if (found == sections.materials.end())
      fail(fmt::format(
          "has a ply of material '{}', which is missing. Expected a material "
          "with this group.",
          name));
    materials.push_back(&found->material);
  }
  if (materials.size() == 1) materials.resize(plies, materials.front());
  if (materials.size() != plies)
    fail(
        fmt::format("has {} materials for {} plies. Expected one for each, or "
                    "one for all.",
                    materials.size(), plies));
  return materials;
}

/// Engineering constants, of components 11, 22, 33, 12, 23, 13.
PlyMaterial make_ply(const SolidMaterial& material) {
  if (!material.anisotropy)
    return make_isotropic(material.youngs_modulus, material.poisson_ratio,
                          material.density);
  const Matrix6 S = dense::find_inverse(material.anisotropy->C);
  constexpr double kRoundoff = 1e-9;
  for (int i = 0; i < 6; ++i)
    for (int j = 3; j < 6; ++j)
      if (i != j &&
          S(i, j) * S(i, j) > kRoundoff * kRoundoff * S(i, i) * S(j, j))
        fail(
            "has a material that couples stretching and shear in its axes. "
            "Expected an isotropic or orthotropic one in a shell.");
  PlyMaterial ply;
  ply.E_1 = 1.0 / S(0, 0);
  ply.E_2 = 1.0 / S(1, 1);
  ply.nu_12 = -S(0, 1) / S(0, 0);
  ply.G_12 = 1.0 / S(3, 3);
  ply.G_23 = 1.0 / S(4, 4);
  ply.G_13 = 1.0 / S(5, 5);
  ply.density = material.density;
  return ply;
}

/// @throws InputError unless `is_one` of sizes of the shape
void require_section(bool is_one, const BeamRegion& region) {
  if (is_one) return;
  std::vector<std::string> texts;
  for (const auto& [name, value] : region.sizes)
    texts.push_back(fmt::format("{} {:g}", name, value));
  fail(
      fmt::format("has sizes that give no section '{}': {}. Expected all > 0, "
                  "walls that fit into it.",
                  region.section, fmt::join(texts, ", ")));
}

}  // namespace

Laminate find_laminate(const ShellRegion& region,
                       const MeshSections& sections) {
  const std::size_t count = std::max(
      {region.thicknesses.size(), region.angles.size(), std::size_t(1)});
  const auto fits = [&](std::size_t size, std::size_t least) {
    return size == count || size == least;
  };
  if (!fits(region.thicknesses.size(), 1) || !fits(region.angles.size(), 0))
    fail(fmt::format(
        "has {} thicknesses and {} angles. Expected one of each for each ply, "
        "or one thickness for all.",
        region.thicknesses.size(), region.angles.size()));
  const auto materials = list_materials(region, sections, count);
  std::vector<Ply> plies;
  double thickness = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    const double own =
        region.thicknesses[region.thicknesses.size() == 1 ? 0 : i];
    if (!(own > 0.0))
      fail(fmt::format("has a thickness of {:g} m. Expected > 0.", own));
    plies.push_back({make_ply(*materials[i]), own,
                     region.angles.empty() ? 0.0 : region.angles[i]});
    thickness += own;
  }
  return make_laminate(plies, region.offset - 0.5 * thickness);
}

LaminateAxis find_laminate_axis(const ShellRegion& region,
                                const MeshSections& sections) {
  LaminateAxis axis;
  if (region.axis_1) {
    axis.constant = *region.axis_1;
    return axis;
  }
  const SolidMaterial& lowest =
      *list_materials(region, sections,
                      std::max({region.thicknesses.size(), region.angles.size(),
                                region.materials.size(), std::size_t(1)}))[0];
  if (!lowest.anisotropy) return axis;
  const MaterialAxes& axes = lowest.anisotropy->axes;
  axis.constant = axes.directions.col(0);
  if (axes.is_cylindrical) axis.cylinder = axes;
  return axis;
}

BeamProperty find_property(const BeamRegion& region,
                           const MeshSections& sections) {
  const SolidMaterial& m = find_material(region.group, sections);
  if (m.anisotropy)
    fail(
        "has a material with directions. Expected an isotropic one in a beam.");
  const double nu = m.poisson_ratio;
  const auto size = [&](const char* name) {
    const auto found = region.sizes.find(name);
    return found == region.sizes.end() ? 0.0 : found->second;
  };
  BeamProperty property;
  property.material = {m.youngs_modulus, 0.5 * m.youngs_modulus / (1.0 + nu),
                       m.density};
  BeamSection& section = property.section;
  const double height = size("height");
  const double width = size("width");
  const double flange = size("flange");
  const double web = size("web");
  if (region.section == "tube") {
    const double radius = size("radius");
    const double wall = size("wall");
    require_section(wall > 0.0 && wall <= radius, region);
    section = make_tube(radius, radius - wall, nu);
  } else if (region.section == "rectangle") {
    require_section(height > 0.0 && width > 0.0, region);
    section = make_rectangle(height, width, nu);
  } else if (region.section == "box") {
    require_section(
        flange > 0.0 && web > 0.0 && height > 2.0 * flange && width > 2.0 * web,
        region);
    section = make_box(height, width, flange, web, nu);
  } else if (region.section == "i") {
    require_section(
        flange > 0.0 && web > 0.0 && height > 2.0 * flange && width > web,
        region);
    section = make_i_section(height, width, flange, web, nu);
  } else if (region.section == "values") {
    section.area = size("area");
    section.I_y = size("I_y");
    section.I_z = size("I_z");
    section.torsion = size("torsion");
    section.shear_y = size("shear_y");
    section.shear_z = size("shear_z");
    require_section(section.area > 0.0 && section.I_y > 0.0 &&
                        section.I_z > 0.0 && section.torsion > 0.0 &&
                        section.shear_y >= 0.0 && section.shear_z >= 0.0,
                    region);
  } else {
    fail(
        fmt::format("has the section '{}', which is unknown.", region.section));
  }
  return property;
}

}  // namespace limber::fem
