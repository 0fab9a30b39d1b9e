// SPDX-License-Identifier: BSD-3-Clause
#include "limber/app/options/mesh_options.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>

#include "limber/app/options/shared_options.hpp"
#include "limber/common/deck_name.hpp"
#include "limber/common/errors.hpp"
#include "limber/scene/robot/flexible_reader.hpp"
#include "limber/scene/text/section_reader.hpp"

namespace limber::app {
namespace {

void check_isotropic(const StatedMaterial& m,
                     std::vector<std::string>& problems) {
  const double E = m.youngs_modulus.front();
  const double nu = m.poisson_ratio.front();
  if (!(E > 0.0))
    problems.push_back(
        fmt::format("--youngs-modulus is {} Pa; expected > 0", E));
  if (!(nu > -1.0 && nu < 0.5))
    problems.push_back(
        fmt::format("--poisson-ratio is {}; expected in (-1, 0.5): at 0.5 "
                    "the material is incompressible and its stiffness has "
                    "no bound",
                    nu));
}

void check_material(const StatedMaterial& m, bool is_stated,
                    std::vector<std::string>& problems) {
  if (is_stated && m.is_empty()) return;  // elsewhere
  try {
    static_cast<void>(make_material(m));
    if (!m.is_anisotropic()) check_isotropic(m, problems);
  } catch (const InputError& error) {
    for (const std::string& problem : error.problems())
      problems.push_back("material: " + problem);
  }
  if (!(m.density > 0.0))
    problems.push_back(
        fmt::format("--density is {} kg/m^3; expected > 0", m.density));
}

void check(const MeshOptions& options) {
  std::vector<std::string> problems;
  const auto require = [&](bool fine, const std::string& text) {
    if (!fine) problems.push_back(text);
  };
  check_material(options.material,
                 has_deck_name(options.file) || !options.materials.empty(),
                 problems);
  require(options.force >= 0.0 && std::isfinite(options.force),
          fmt::format("--force-unit is {} N; expected > 0", options.force));
  require(options.size >= 0.0,
          fmt::format("--size is {}; expected >= 0", options.size));
  require(options.unit >= 0.0 && std::isfinite(options.unit),
          fmt::format("--unit is {} m; expected > 0", options.unit));
  require(options.order >= 0 && options.order <= 3,
          fmt::format("--order is {}; expected 1, 2 or 3", options.order));
  if (!problems.empty()) throw InputError(problems);
}

}  // namespace

namespace {

/// Numbers in one argument, separated by commas.
void add_numbers(CLI::App& command, const char* name,
                 std::vector<double>& values, const char* text) {
  command.add_option(name, values, text)
      ->delimiter(',')
      ->allow_extra_args(false);
}

void add_vector(CLI::App& command, const char* name,
                std::optional<Vector3>& vector, const char* text) {
  command
      .add_option_function<std::vector<double>>(
          name,
          [&vector, name](const std::vector<double>& v) {
            if (v.size() != 3)
              throw CLI::ValidationError(fmt::format(
                  "{} has {} numbers; expected X,Y,Z", name, v.size()));
            vector = Vector3(v[0], v[1], v[2]);
          },
          text)
      ->delimiter(',')
      ->allow_extra_args(false);
}

void add_material(CLI::App& command, StatedMaterial& material) {
  add_numbers(command, "--youngs-modulus", material.youngs_modulus,
              "E, or E1,E2,E3 of an orthotropic material [Pa]");
  add_numbers(command, "--poisson-ratio", material.poisson_ratio,
              "nu, or nu12,nu13,nu23 [-]");
  add_numbers(command, "--shear-modulus", material.shear_modulus,
              "G12,G13,G23 of an orthotropic material [Pa]");
  add_numbers(command, "--stiffness", material.stiffness,
              "21 constants C11,C12,..,C16,C22,.. of an anisotropic material, "
              "components 11, 22, 33, 12, 23, 13, in place of moduli [Pa]");
  command.add_option("--density", material.density, "rho [kg/m^3]");
  add_vector(command, "--axis-1", material.axis_1,
             "Material axis 1 in the mesh frame: X,Y,Z");
  add_vector(command, "--axis-2", material.axis_2,
             "A direction in the plane of material axes 1 and 2: X,Y,Z");
  add_vector(command, "--cylinder-axis", material.cylinder_axis,
             "Material axes 1 radial, 2 tangential, 3 along this axis");
  add_vector(command, "--cylinder-point", material.cylinder_point,
             "A point on that axis, the origin if absent: X,Y,Z [m]");
}

/// Attributes of a region each time it is given.
void add_regions(CLI::App& command, const char* name,
                 std::vector<std::string>& values, const char* text) {
  command.add_option(name, values, text)->allow_extra_args(false);
}

}  // namespace

void add_model_options(CLI::App& command, MeshOptions& options) {
  add_mesh_options(command, options);
  // What a mesh needs is not needed then.
  const auto release = [&command](const std::string&) {
    command.get_option("mesh")->required(false);
  };
  command
      .add_option("--matrices", options.matrices,
                  "Stiffness and mass matrix of a finite-element model, in "
                  "place of a mesh and its material: a folder with K.mtx, "
                  "M.mtx and nodes.csv, or these files; lengths in --unit, "
                  "forces in N, times in s")
      ->each(release);
  command.add_option("--recovery", options.recovery,
                     "Recovery rows of a superelement in --matrices: a matrix "
                     "with a column for each of its rows, and a table of the "
                     "points that they move");
  command.add_option("--mass", options.mass,
                     "Mass of the model of --matrices, which its program "
                     "prints: it checks their unit [kg]");
  add_regions(command, "--shell", options.shells,
              "Shells on a group of surfaces by the attributes of <shell>: "
              "'group=\"Skin\" thickness=\"0.002\"' [m]; repeatable");
  add_regions(command, "--beam", options.beams,
              "Beams on a group of curves by the attributes of <beam>: "
              "'group=\"Boom\" section=\"tube\" radius=\"0.05\" "
              "wall=\"0.002\"' [m]; repeatable");
}

namespace {

void read_regions(const MeshOptions& options, flexbody::Recipe& recipe) {
  std::vector<std::string> problems;
  const auto read_each = [&](const char* option, const char* tag,
                             const std::vector<std::string>& texts,
                             const scene::XmlElement::Reader& read) {
    for (const std::string& text : texts) try {
        scene::read_attributes(option, tag, text, read);
      } catch (const InputError& error) {
        problems.insert(problems.end(), error.problems().begin(),
                        error.problems().end());
      }
  };
  flexbody::SectionSource& sections = recipe.mesh.sections;
  read_each("--material", "material", options.materials,
            [&](scene::XmlElement& element) {
              for (auto& region : scene::read_material(element, ""))
                recipe.materials.push_back(std::move(region));
            });
  read_each("--shell", "shell", options.shells,
            [&](scene::XmlElement& element) {
              sections.shells.push_back(scene::read_shell(element));
            });
  read_each("--beam", "beam", options.beams, [&](scene::XmlElement& element) {
    sections.beams.push_back(scene::read_beam(element));
  });
  if (!problems.empty()) throw InputError(problems);
  if (!sections.empty()) sections.materials = recipe.materials;
}

}  // namespace

void add_mesh_options(CLI::App& command, MeshOptions& options) {
  command
      .add_option("mesh", options.file,
                  "Mesh (.msh), geometry (.geo, .step), or deck (.bdf, .inp) "
                  "with its materials")
      ->required();
  add_material(command, options.material);
  command.add_option("--size", options.size,
                     "Element size when meshing geometry [mesh units, of "
                     "STEP and IGES millimetres]");
  command.add_option(
      "--order", options.order,
      "Element order when meshing geometry: 1, 2 or 3; 2 also makes a "
      "finished mesh of first order one of second order");
  add_unit(command, options.unit);
  add_force_unit(command, options.force);
  command
      .add_option("--ignore", options.ignored,
                  "A card, keyword or element type of a deck to leave out, "
                  "although the body then lacks it; repeatable")
      ->allow_extra_args(false);
  add_regions(command, "--material", options.materials,
              "Material of a group by the attributes of <material> in a robot: "
              "'group=\"Skin\" youngs_modulus=\"7e10\" poisson_ratio=\"0.3\" "
              "density=\"2700\"'; repeatable");
}

namespace {

void check_matrices(const MeshOptions& options) {
  std::vector<std::string> problems;
  const auto require = [&](bool fine, const std::string& text) {
    if (!fine) problems.push_back(text);
  };
  require(options.file.empty(),
          fmt::format("'{}' is a mesh, and --matrices is given; keep one",
                      options.file));
  require(options.shells.empty() && options.beams.empty(),
          "--shell and --beam go with a mesh; --matrices have theirs");
  require(options.material.is_empty() && options.materials.empty(),
          "--material, --youngs-modulus, --poisson-ratio, --density and other "
          "constants go "
          "with a mesh; --matrices have their material");
  require(options.size == 0.0 && options.order == 0 && options.force == 0.0 &&
              options.ignored.empty(),
          "--size, --order, --force-unit and --ignore go with a mesh");
  require(options.mass > 0.0 && std::isfinite(options.mass),
          fmt::format("--mass is {} kg; --matrices need the mass of the whole "
                      "model, which its program prints, > 0",
                      options.mass));
  require(options.unit >= 0.0 && std::isfinite(options.unit),
          fmt::format("--unit is {} m; expected > 0", options.unit));
  if (!problems.empty()) throw InputError(problems);
}

flexbody::Recipe make_matrix_recipe(const MeshOptions& options) {
  check_matrices(options);
  flexbody::Recipe recipe;
  flexbody::MeshSource& source = recipe.mesh;
  source.matrices.paths = {options.matrices.begin(), options.matrices.end()};
  source.matrices.mass = options.mass;
  source.matrices.recovery = {options.recovery.begin(), options.recovery.end()};
  source.unit = options.unit;
  source.file = source.matrices.paths.front().lexically_normal();
  if (!source.file.has_filename()) source.file = source.file.parent_path();
  recipe.name = source.file.stem().string();
  return recipe;
}

}  // namespace

flexbody::Recipe make_recipe(const MeshOptions& options) {
  if (!options.matrices.empty()) return make_matrix_recipe(options);
  if (options.mass != 0.0)
    throw InputError("--mass goes with --matrices; a mesh has its density");
  if (!options.recovery.empty())
    throw InputError("--recovery goes with --matrices; a mesh has all nodes");
  check(options);
  flexbody::Recipe recipe;
  recipe.mesh.file = options.file;
  recipe.mesh.size = options.size;
  recipe.mesh.order = options.order;
  recipe.mesh.unit = options.unit;
  recipe.name = recipe.mesh.file.stem().string();
  recipe.mesh.force = options.force;
  recipe.mesh.ignored = options.ignored;
  if (!options.material.is_empty())
    recipe.materials = {{"", make_material(options.material)}};
  read_regions(options, recipe);
  return recipe;
}

void print_found(const std::vector<std::string>& found) {
  for (const std::string& line : found) fmt::print("found {}\n", line);
}

}  // namespace limber::app
