// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "limber/common/material/stated_material.hpp"
#include "limber/flexbody/model/recipe.hpp"

namespace CLI {
class App;
}

namespace limber::app {

/// Command-line options of a mesh and one material, or of matrices.
struct MeshOptions {
  std::string file;
  std::vector<std::string> matrices;  ///< a folder, or files; empty: a mesh
  std::vector<std::string> recovery;  ///< files of their recovery rows
  double mass = 0.0;                  ///< of the matrices, as stated [kg]
  StatedMaterial material;
  double size = 0.0;   ///< element size [mesh units]; 0: the file's
  int order = 0;       ///< of elements, 1 to 3; 0: the file's, else 2 [-]
  double unit = 0.0;   ///< metres per mesh unit [m]; 0: the file's, or 1
  double force = 0.0;  ///< newtons per unit of force of a deck; 0: not stated
  std::vector<std::string> ignored;  ///< cards of a deck left out
  /// Attributes of <material>, <shell> and <beam> of a robot.
  std::vector<std::string> materials = {};
  std::vector<std::string> shells = {};
  std::vector<std::string> beams = {};
};

void add_mesh_options(CLI::App& command, MeshOptions& options);

/// The same with shells and beams, or matrices in place of mesh and material.
void add_model_options(CLI::App& command, MeshOptions& options);

/// Recipe of the mesh and its material, or of the matrices, only.
/// @throws InputError for a material or a mass outside its range, and for
/// options of a mesh with matrices.
[[nodiscard]] flexbody::Recipe make_recipe(const MeshOptions& options);

/// Report on the files of matrices, a line each.
void print_found(const std::vector<std::string>& found);

}  // namespace limber::app
