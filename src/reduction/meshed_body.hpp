// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include "common/progress.hpp"
#include "fem/elastic_inverse.hpp"
#include "fem/material.hpp"
#include "fem/mesh.hpp"
#include "fem/mesh_reader.hpp"
#include "flexbody/recipe.hpp"
#include "flexbody/reduce_interfaces.hpp"
#include "flexbody/reduce_support.hpp"

namespace limber::flexbody {

/// Makes the mesh. @throws InputError naming the file.
[[nodiscard]] fem::TracedMesh read_source(const MeshSource& source,
                                          const Progress& progress);

/// One material a region of the mesh. @throws InputError naming the group.
[[nodiscard]] std::vector<fem::ElasticMaterial> find_materials(
    const fem::Mesh& mesh, const Recipe& recipe);

/// A recipe's body with its matrices, ready to be asked for modes and static
/// answers. Part of limber_reduction.
struct MeshedBody {
  /// @throws InputError naming the file, group or value.
  MeshedBody(const Recipe& recipe, const Progress& progress);
  /// Of a mesh that was made as the recipe says.
  MeshedBody(const Recipe& recipe,
             std::shared_ptr<const fem::TracedMesh> traced,
             const Progress& progress);
  MeshedBody(const MeshedBody&) = delete;  // `inverse` points into `support`
  MeshedBody& operator=(const MeshedBody&) = delete;

  std::shared_ptr<const fem::TracedMesh> made;  ///< with its notices
  const fem::Mesh& mesh;
  std::vector<Interface> interfaces;
  fem::SparseMatrix M_s;  ///< of all nodes [kg]
  Support support;
  fem::ElasticInverse inverse;  ///< of the free nodes
};

}  // namespace limber::flexbody
