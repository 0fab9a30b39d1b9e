// SPDX-License-Identifier: BSD-3-Clause
#include "limber/fem/structural/read_structure.hpp"

#include "limber/common/deck_name.hpp"
#include "limber/fem/mesh/mesh_file_kind.hpp"
#include "limber/fem/structural/read_abaqus_structure.hpp"
#include "limber/fem/structural/read_nastran_structure.hpp"

namespace limber::fem {

bool is_structure(const std::filesystem::path& file, bool with_solids) {
  if (!has_deck_name(file)) return false;
  switch (find_mesh_file_kind(file)) {
    case MeshFileKind::bulk_data:
      return is_nastran_structure(file, with_solids);
    case MeshFileKind::input_deck:
      return is_abaqus_structure(file, with_solids);
    case MeshFileKind::mesh:
    case MeshFileKind::universal:
    case MeshFileKind::geometry:
      break;
  }
  return false;
}

Structure read_structure(const std::filesystem::path& file) {
  return find_mesh_file_kind(file) == MeshFileKind::bulk_data
             ? read_nastran_structure(file)
             : read_abaqus_structure(file);
}

}  // namespace limber::fem
