// SPDX-License-Identifier: BSD-3-Clause
#include "limber/fem/structural/structure_solids.hpp"

#include <fmt/format.h>

#include <set>
#include <utility>

#include "limber/common/errors.hpp"
#include "limber/fem/mesh/mesh_checks.hpp"
#include "limber/fem/mesh/mesher.hpp"

namespace limber::fem {

StructureSolids read_structure_solids(const Structure& structure, double unit,
                                      double force) {
  StructureSolids solids;
  solids.unit = unit;
  if (!structure.has_solids) return solids;
  MeshOptions options;
  options.unit = unit;
  options.force = force;
  options.ignored = structure.beside_solids;
  solids.mesh = run_mesher(find_mesher(), structure.files.at(0), options).mesh;
  const std::set<std::size_t> known(structure.tags.begin(),
                                    structure.tags.end());
  for (const std::size_t tag : solids.mesh.tags)
    if (!known.contains(tag))
      throw InputError(fmt::format(
          "{}: a solid beside beams and shells has a blank mid-side node, of "
          "which no other element has one. Expected its node.",
          structure.source));
  check_elements(solids.mesh);
  find_boundary(solids.mesh);
  check_faces(solids.mesh);
  solids.materials = assign_materials(solids.mesh, {});
  return solids;
}

}  // namespace limber::fem
