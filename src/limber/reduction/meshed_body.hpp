// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "limber/common/progress.hpp"
#include "limber/fem/mesh/mesh.hpp"
#include "limber/fem/mesh/mesh_reader.hpp"
#include "limber/fem/solid/hyperelastic.hpp"
#include "limber/fem/solid/material.hpp"
#include "limber/flexbody/model/mesh_locking.hpp"
#include "limber/flexbody/model/recipe.hpp"
#include "limber/reduction/modal/elastic_body.hpp"

namespace limber::flexbody {

/// Makes the mesh. @throws InputError naming the file.
[[nodiscard]] fem::TracedMesh read_source(const MeshSource& source,
                                          const Progress& progress);

[[nodiscard]] fem::Elasticity find_elasticity(MaterialLaw law);

/// One material a region of the mesh. @throws InputError naming the group.
[[nodiscard]] std::vector<fem::ElasticMaterial> find_materials(
    const fem::Mesh& mesh, const Recipe& recipe);

/// A line for the material that the mesh's file states for each region, and
/// whether the recipe replaces it.
[[nodiscard]] std::vector<std::string> find_file_materials(
    const fem::Mesh& mesh, const Recipe& recipe);

/// A recipe's body with its matrices, for computing modes and static responses.
/// Part of limber_reduction.
struct MeshedBody : ElasticBody {
  /// @throws InputError naming the file, group or value.
  MeshedBody(const Recipe& recipe, const Progress& progress);
  /// From a mesh that was made for the recipe.
  MeshedBody(const Recipe& recipe,
             std::shared_ptr<const fem::TracedMesh> traced,
             const Progress& progress);

  std::shared_ptr<const fem::TracedMesh> made;  ///< with its notices
  const fem::Mesh& mesh;
  fem::SparseMatrix M_s;  ///< of all nodes [kg]

 private:
  struct Parts;
  MeshedBody(Parts parts, const Progress& progress);
};

/// Of a mesh of first order, by its lowest modes on the free nodes.
[[nodiscard]] std::optional<MeshLocking> find_locking(const MeshedBody& body,
                                                      const Recipe& recipe,
                                                      const VectorX& lambda,
                                                      const MatrixX& Phi);

}  // namespace limber::flexbody
