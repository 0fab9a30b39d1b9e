// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "limber/flexbody/model/recipe.hpp"

namespace limber::flexbody::test {

/// A recipe in which every list has an entry; its mesh is never meshed.
inline Recipe make_recipe(const std::filesystem::path& mesh) {
  Recipe recipe;
  recipe.name = "upper arm";
  recipe.mesh = {mesh, 0.1, 2, 0.001};
  recipe.materials = {{"steel", {210e9, 0.3, 7800.0}}};
  recipe.clamped_groups = {"base"};
  recipe.interfaces = {{"root", GroupNodes{"root"}, Weighting::uniform, true}};
  recipe.load_patterns = {
      {"root", Vector3(1.0, 2.0, 3.0), Vector3(4.0, 5.0, 6.0)}};
  return recipe;
}

}  // namespace limber::flexbody::test
