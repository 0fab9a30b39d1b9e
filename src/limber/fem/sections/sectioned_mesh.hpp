// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "limber/common/files/file_stamp.hpp"
#include "limber/common/progress.hpp"
#include "limber/fem/mesh/mesh_options.hpp"
#include "limber/fem/sections/region_properties.hpp"
#include "limber/fem/structural/structure_solids.hpp"

namespace limber::fem {

/// A mesh as beams, shells and solids with shared nodes, in SI units.
struct SectionedMesh {
  Structure structure;
  StructureSolids solids;        ///< none: an empty mesh
  std::vector<FileStamp> files;  ///< that it depends on
  bool is_repeatable = false;    ///< whether on these alone
};

/// Elements of a mesh that was read `with_surfaces`, each with its region, each
/// node once. An element of second order (three nodes of a curve, six or nine
/// of a surface) is two or four of first order with the same nodes. Groups
/// become sets of nodes.
/// @throws InputError, all problems of groups at once: a region without group
/// or with one of another dimension, an element in two regions or in none that
/// is no face or edge of others, a missing, unused or unsuited material, sizes
/// that give no section, a missing direction; and as assign_materials
[[nodiscard]] SectionedMesh assign_sections(const Mesh& mesh,
                                            const MeshSections& sections);

/// Reads a mesh, or meshes a geometry, by find_mesher().
/// @throws InputError as run_mesher and assign_sections, and for a deck, which
/// has sections of its own
[[nodiscard]] SectionedMesh read_sectioned_mesh(
    const std::filesystem::path& file, MeshOptions options,
    const MeshSections& sections, const Progress& progress = {});

}  // namespace limber::fem
