// SPDX-License-Identifier: BSD-3-Clause
#include "limber/app/options/mesh_options.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>

#include "limber/app/options/shared_options.hpp"
#include "limber/common/deck_name.hpp"
#include "limber/common/errors.hpp"

namespace limber::app {
namespace {

void check_size(const MeshOptions& options,
                std::vector<std::string>& problems) {
  const auto require = [&](bool fine, const std::string& text) {
    if (!fine) problems.push_back(text);
  };
  require(options.size >= 0.0,
          fmt::format("--size is {}; expected >= 0", options.size));
  require(options.unit >= 0.0 && std::isfinite(options.unit),
          fmt::format("--unit is {} m; expected > 0", options.unit));
  require(options.order >= 0 && options.order <= 3,
          fmt::format("--order is {}; expected 1, 2 or 3", options.order));
}

void check(const MeshOptions& options) {
  std::vector<std::string> problems;
  const auto require = [&](bool fine, const std::string& text) {
    if (!fine) problems.push_back(text);
  };
  const flexbody::Material& m = options.material;
  if (has_deck_name(options.file) && m.youngs_modulus == 0.0 &&
      m.poisson_ratio == 0.0 && m.density == 0.0) {
    check_size(options, problems);
    if (!problems.empty()) throw InputError(problems);
    return;
  }
  require(
      m.youngs_modulus > 0.0,
      fmt::format("--youngs-modulus is {} Pa; expected > 0", m.youngs_modulus));
  require(m.poisson_ratio > -1.0 && m.poisson_ratio < 0.5,
          fmt::format("--poisson-ratio is {}; expected in (-1, 0.5): at 0.5 "
                      "the material is incompressible and its stiffness has "
                      "no bound",
                      m.poisson_ratio));
  require(m.density > 0.0,
          fmt::format("--density is {} kg/m^3; expected > 0", m.density));
  check_size(options, problems);
  if (!problems.empty()) throw InputError(problems);
}

}  // namespace

void add_model_options(CLI::App& command, MeshOptions& options) {
  add_mesh_options(command, options);
  // What a mesh needs is not needed then.
  const auto release = [&command](const std::string&) {
    for (const char* name :
         {"mesh", "--youngs-modulus", "--poisson-ratio", "--density"})
      command.get_option(name)->required(false);
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
}

void add_mesh_options(CLI::App& command, MeshOptions& options) {
  command
      .add_option("mesh", options.file,
                  "Mesh (.msh), geometry (.geo, .step), or deck of beams and "
                  "shells with its materials (.bdf, .inp)")
      ->required()
      ->each([&command](const std::string& file) {
        if (!has_deck_name(file)) return;
        for (const char* name :
             {"--youngs-modulus", "--poisson-ratio", "--density"})
          command.get_option(name)->required(false);
      });
  command
      .add_option("--youngs-modulus", options.material.youngs_modulus, "E [Pa]")
      ->required();
  command
      .add_option("--poisson-ratio", options.material.poisson_ratio, "nu [-]")
      ->required();
  command.add_option("--density", options.material.density, "rho [kg/m^3]")
      ->required();
  command.add_option("--size", options.size,
                     "Element size when meshing geometry [mesh units, of "
                     "STEP and IGES millimetres]");
  command.add_option(
      "--order", options.order,
      "Element order when meshing geometry: 1, 2 or 3; 2 also makes a "
      "finished mesh of first order one of second order");
  add_unit(command, options.unit);
}

namespace {

void check_matrices(const MeshOptions& options) {
  std::vector<std::string> problems;
  const auto require = [&](bool fine, const std::string& text) {
    if (!fine) problems.push_back(text);
  };
  const flexbody::Material& m = options.material;
  require(options.file.empty(),
          fmt::format("'{}' is a mesh, and --matrices is given; keep one",
                      options.file));
  require(m.youngs_modulus == 0.0 && m.poisson_ratio == 0.0 && m.density == 0.0,
          "--youngs-modulus, --poisson-ratio and --density go with a mesh; "
          "--matrices have their material");
  require(options.size == 0.0 && options.order == 0,
          "--size and --order go with a mesh");
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
  if (!has_deck_name(options.file) || options.material.youngs_modulus != 0.0)
    recipe.materials = {{"", options.material}};
  return recipe;
}

void print_found(const std::vector<std::string>& found) {
  for (const std::string& line : found) fmt::print("found {}\n", line);
}

}  // namespace limber::app
