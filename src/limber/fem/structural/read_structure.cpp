// SPDX-License-Identifier: BSD-3-Clause
#include "limber/fem/structural/read_structure.hpp"

#include <set>

#include "limber/common/deck_name.hpp"
#include "limber/common/upper_case.hpp"
#include "limber/fem/mesh/mesh_file_kind.hpp"
#include "limber/fem/structural/read_abaqus_structure.hpp"
#include "limber/fem/structural/read_nastran_structure.hpp"

namespace limber::fem {

namespace {

/// As the deck's readers have names of cards, keywords and types.
std::set<std::string> to_names(const std::vector<std::string>& ignored) {
  std::set<std::string> names;
  for (const std::string& name : ignored)
    names.insert(to_upper(name.starts_with('*') ? name.substr(1) : name));
  return names;
}

}  // namespace

bool is_structure(const std::filesystem::path& file,
                  const std::vector<std::string>& ignored) {
  if (!has_deck_name(file)) return false;
  switch (find_mesh_file_kind(file)) {
    case MeshFileKind::bulk_data:
      return is_nastran_structure(file, to_names(ignored));
    case MeshFileKind::input_deck:
      return is_abaqus_structure(file, to_names(ignored));
    case MeshFileKind::mesh:
    case MeshFileKind::universal:
    case MeshFileKind::geometry:
      break;
  }
  return false;
}

Structure read_structure(const std::filesystem::path& file,
                         const std::vector<std::string>& ignored) {
  const std::set<std::string> names = to_names(ignored);
  Structure structure = find_mesh_file_kind(file) == MeshFileKind::bulk_data
                            ? read_nastran_structure(file, names)
                            : read_abaqus_structure(file, names);
  structure.beside_solids.insert(structure.beside_solids.end(), ignored.begin(),
                                 ignored.end());
  return structure;
}

void convert_forces(Structure& structure, double newtons) {
  const auto scale = [newtons](auto&... values) { ((values *= newtons), ...); };
  const auto scale_strengths = [&](Vector6& strengths) {
    strengths.head<5>() *= newtons;
    strengths[5] /= newtons * newtons;  // F12
  };
  for (BeamProperty& p : structure.beam_properties)
    scale(p.material.youngs_modulus, p.material.shear_modulus,
          p.material.density, p.section.extra_mass);
  for (Laminate& l : structure.laminates) {
    scale(l.A, l.B, l.D, l.S, l.mass, l.first_mass, l.second_mass);
    PlyMaterial& m = l.outer;
    scale(m.E_1, m.E_2, m.G_12, m.G_13, m.G_23, m.density, m.plane_stress);
    scale_strengths(m.strengths);
    for (LaminatePoint& point : l.points) {
      scale(point.membrane, point.bending);
      scale_strengths(point.strengths);
    }
  }
  for (StructureMass& mass : structure.masses) scale(mass.mass, mass.inertia);
}

}  // namespace limber::fem
