// SPDX-License-Identifier: BSD-3-Clause
// Reaches Gmsh: asking for a mesh that is not there must say so.
#include <cstdio>
#include <limber/common/errors.hpp>
#include <limber/reduction/reduce.hpp>
#include <string>

int main() {
  limber::flexbody::Recipe recipe;
  recipe.name = "absent";
  recipe.mesh.file = "absent.msh";
  recipe.materials = {{"", {7e10, 0.33, 2700.0}}};
  try {
    static_cast<void>(limber::flexbody::reduce(recipe));
  } catch (const limber::InputError& error) {
    std::printf("%s\n", error.what());
    return std::string(error.what()).find("absent.msh") == std::string::npos;
  }
  return 1;
}
