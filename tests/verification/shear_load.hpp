// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "limber/common/errors.hpp"
#include "limber/fem/mesh/mesh_reader.hpp"
#include "limber/reduction/reduce.hpp"
#include "verification/body_reference.hpp"

/// Loads on the reference beam, as force files have them, and eigenmodes that
/// they choose.
namespace limber::test {

inline const fem::Mesh& beam() {
  static const fem::Mesh mesh = fem::read_mesh(beam_file("beam579_v41.msh"));
  return mesh;
}

/// Nodes of the beam clamped at `root` that can move, ascending.
inline std::vector<int> free_nodes(const fem::Mesh& mesh) {
  const std::vector<int>& root =
      mesh.groups[fem::find_group(mesh, "root")].nodes;
  return fem::find_free_nodes(mesh, root);
}

/// The report's shear test: 500 N along x on each of the five nodes of the
/// edge x = 0 of the free end; rows of the free nodes [N].
inline VectorX shear_load(const fem::Mesh& mesh) {
  const std::vector<int> nodes = free_nodes(mesh);
  VectorX load = VectorX::Zero(3 * static_cast<Eigen::Index>(nodes.size()));
  for (std::size_t i = 0; i < nodes.size(); ++i)
    if (std::abs(mesh.x(0, nodes[i])) < 1e-9 &&
        std::abs(mesh.x(2, nodes[i]) - 5.0) < 1e-9)
      load[3 * static_cast<Eigen::Index>(i)] = 500.0;
  return load;
}

/// The clamped beam with eigenmodes chosen by `loads`, a case a column.
inline flexbody::Recipe recipe_of(const MatrixX& loads,
                                  const flexbody::AutomaticModes& automatic) {
  flexbody::Recipe recipe = beam_recipe("beam579_v41.msh", true);
  recipe.basis.automatic = automatic;
  recipe.basis.load_modes = false;
  recipe.rows = flexbody::parse_rows({"all"});
  std::vector<double> times;
  for (Eigen::Index i = 0; i < loads.cols(); ++i)
    times.push_back(0.5 * static_cast<double>(i));
  recipe.nodal_forces = {{"forces.txt", times, loads}};
  return recipe;
}

/// The selected modes; nothing else is in the basis.
inline flexbody::SelectionRecord select_modes(
    const MatrixX& loads, const flexbody::AutomaticModes& automatic) {
  const flexbody::ReducedBody body =
      flexbody::reduce(recipe_of(loads, automatic));
  LIMBER_EXPECT(body.mode_count() ==
                static_cast<int>(body.selection->modes.size()));
  return *body.selection;
}

}  // namespace limber::test
