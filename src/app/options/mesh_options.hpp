// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "limber/flexbody/model/recipe.hpp"

namespace CLI {
class App;
}

namespace limber::app {

/// Command-line options of a mesh and one material.
struct MeshOptions {
  std::string file;
  flexbody::Material material;
  double size = 0.0;  ///< element size [mesh units]; 0: the file's
  int order = 0;      ///< of elements, 1 to 3; 0: the file's, else 2 [-]
  double unit = 0.0;  ///< metres per mesh unit [m]; 0: the file's, or 1
};

void add_mesh_options(CLI::App& command, MeshOptions& options);

/// Recipe of the mesh and its material only.
/// @throws InputError for a material outside its range.
[[nodiscard]] flexbody::Recipe make_recipe(const MeshOptions& options);

}  // namespace limber::app
