// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "flexbody/recipe.hpp"

namespace CLI {
class App;
}

namespace limber::app {

/// A mesh and one material, as subcommands take them.
struct MeshOptions {
  std::string file;
  flexbody::Material material;
  double size = 0.0;
  int order = 0;
  double unit = 1.0;
};

void add_mesh_options(CLI::App& command, MeshOptions& options);

/// Recipe of the mesh and its material, nothing else.
/// @throws InputError for a material outside its range.
[[nodiscard]] flexbody::Recipe make_recipe(const MeshOptions& options);

}  // namespace limber::app
