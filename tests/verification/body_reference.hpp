// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "limber/flexbody/model/recipe.hpp"
#include "places.hpp"

/// The reference beam (tests/data/beam) and its published figures.
namespace limber::test {

inline std::string beam_file(const std::string& name) {
  return std::string(LIMBER_SOURCE_DIR) + "/tests/data/beam/" + name;
}

inline flexbody::Recipe beam_recipe(const std::string& mesh,
                                    bool is_clamped = false) {
  flexbody::Recipe recipe;
  recipe.name = "beam";
  recipe.mesh.file = beam_file(mesh);
  recipe.materials = {{"", {200e9, 0.0, 8000.0}}};
  if (is_clamped) recipe.clamped_groups = {"root"};
  recipe.basis.eigenmodes = 20;
  return recipe;
}

/// A column of eigenvalues.csv for a mesh and boundary condition: 5 is the
/// exactly integrated mass, 8 the report's Table 2 [rad^2/s^2].
inline std::vector<double> reference_eigenvalues(const std::string& mesh,
                                                 const std::string& support,
                                                 std::size_t column) {
  std::ifstream file(beam_file("eigenvalues.csv"));
  std::vector<double> values;
  for (std::string line; std::getline(file, line);) {
    std::vector<std::string> cells;
    std::istringstream stream(line);
    for (std::string cell; std::getline(stream, cell, ',');)
      cells.push_back(cell);
    if (cells.size() > column && cells[0] == mesh && cells[1] == support &&
        !cells[column].empty())
      values.push_back(std::strtod(cells[column].c_str(), nullptr));
  }
  return values;
}

}  // namespace limber::test
