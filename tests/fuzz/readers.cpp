// SPDX-License-Identifier: BSD-3-Clause
#include "fuzz/readers.hpp"

#include <algorithm>
#include <cctype>

#include "limber/common/errors.hpp"
#ifdef LIMBER_HAS_REDUCTION
#include "limber/fem/abaqus/solid_deck_reader.hpp"
#include "limber/fem/matrices/read_matrices.hpp"
#include "limber/fem/mesh/mesh_checks.hpp"
#include "limber/fem/mesh/mesh_wire.hpp"
#include "limber/fem/nastran/bulk_data.hpp"
#include "limber/fem/structural/assemble_structure.hpp"
#include "limber/fem/structural/read_structure.hpp"
#endif
#include "fuzz/body_edits.hpp"
#include "limber/flexbody/file/body_file.hpp"
#include "limber/scene/contacts/collision_mesh.hpp"
#include "limber/scene/robot/akantu_material.hpp"
#include "limber/scene/robot/robot_reader.hpp"
#include "limber/scene/scenario/scenario_reader.hpp"
#include "limber/scene/text/force_file.hpp"
#include "limber/scene/text/series_file.hpp"
#include "limber/study/study_reader.hpp"
#include "unit/flexbody/files.hpp"

namespace limber::fuzz {
namespace {

using flexbody::test::TemporaryFolder;
using flexbody::test::write_bytes;

// Where the input lies, with neighbours that it can name.
class Place {
 public:
  Place() {
    write_bytes(folder_.path() / "series.csv", "0 0\n1 2\n2 1\n3 0\n");
    write_bytes(folder_.path() / "material.dat",
                "material elastic [ rho = 1 E = 1 ]\n");
  }
  std::filesystem::path write(std::string_view bytes,
                              const std::string& name) const {
    const std::filesystem::path file = folder_.path() / name;
    write_bytes(file, std::string(bytes));
    return file;
  }

 private:
  TemporaryFolder folder_;
};

std::filesystem::path write_input(std::string_view bytes,
                                  const std::string& name = "input") {
  static const Place place;
  return place.write(bytes, name);
}

void read_scenario(std::string_view bytes) {
  (void)scene::read_scenario(write_input(bytes));
}

void read_robot(std::string_view bytes) {
  (void)scene::read_robot(write_input(bytes));
}

void read_forces(std::string_view bytes) {
  (void)scene::read_force_file(write_input(bytes));
}

void read_field(std::string_view bytes) {
  (void)scene::read_nodal_field(write_input(bytes));
}

void read_series(std::string_view bytes) {
  (void)scene::read_series(write_input(bytes));
}

void read_material(std::string_view bytes) {
  (void)scene::read_akantu_materials(write_input(bytes));
}

void read_shape(std::string_view bytes, const std::string& name) {
  (void)scene::read_collision_mesh({write_input(bytes, name)}, Pose());
}

void read_stl(std::string_view bytes) { read_shape(bytes, "input.stl"); }

void read_obj(std::string_view bytes) { read_shape(bytes, "input.obj"); }

void read_study(std::string_view bytes) {
  (void)study::read_study(write_input(bytes));
}

void read_body(std::string_view bytes) {
  (void)flexbody::read_body(write_input(bytes));
}

void read_edited_body(std::string_view edits) {
  const std::filesystem::path file = write_input(find_body_bytes());
  apply_edits(edits, file);
  flexbody::seal_body_file(file);
  (void)flexbody::read_body(file);
}

#ifdef LIMBER_HAS_REDUCTION
// What a mesher that a geometry took over may send.
void read_mesh_reply(std::string_view bytes) {
  fem::Mesh mesh = fem::unpack_reply(std::string(bytes)).mesh;
  fem::check_elements(mesh);
  fem::find_boundary(mesh);
  fem::check_faces(mesh);
  fem::check_connected(mesh);
}

void read_input_deck(std::string_view bytes) {
  (void)fem::read_solid_deck(write_input(bytes, "input.inp"));
}

void read_bulk_deck(std::string_view bytes) {
  (void)fem::read_bulk_data(write_input(bytes, "deck.bdf"));
}

// Beams and shells, whatever the deck has, with their elements' matrices.
void read_structure_deck(std::string_view bytes, const std::string& name) {
  (void)fem::assemble_structure(fem::read_structure(write_input(bytes, name)));
}

void read_bulk_structure(std::string_view bytes) {
  read_structure_deck(bytes, "structure.bdf");
}

void read_input_structure(std::string_view bytes) {
  read_structure_deck(bytes, "structure.inp");
}

// Files of a model, each behind a line "=== NAME".
void read_matrix_files(std::string_view bytes) {
  constexpr std::string_view kMark = "=== ";
  constexpr std::size_t kMostFiles = 6;
  const TemporaryFolder folder;
  for (std::size_t count = 0; count < kMostFiles && bytes.starts_with(kMark);
       ++count) {
    const std::size_t start = std::min(bytes.find('\n'), bytes.size());
    std::string name;
    for (const char c : bytes.substr(kMark.size(), start - kMark.size()))
      if (std::isalnum(c & 0xff) != 0 || c == '.' || c == '_') name += c;
    bytes.remove_prefix(std::min(start + 1, bytes.size()));
    const std::size_t end = bytes.find("\n=== ");
    // Its number first: names are neither empty nor "..".
    write_bytes(folder.path() / (std::to_string(count) + "_" + name),
                std::string(bytes.substr(
                    0, end == std::string_view::npos ? end : end + 1)));
    bytes.remove_prefix(end == std::string_view::npos ? bytes.size() : end + 1);
  }
  (void)fem::read_matrices({{folder.path()}});
}
#endif

}  // namespace

const std::vector<Reader>& all_readers() {
  static const std::vector<Reader> readers = {
      {"scenario", read_scenario},
      {"robot", read_robot},
      {"forces", read_forces},
      {"field", read_field},
      {"series", read_series},
      {"material", read_material},
      {"stl", read_stl},
      {"obj", read_obj},
      {"study", read_study},
      {"body", read_body},
      {"body_content", read_edited_body},
#ifdef LIMBER_HAS_REDUCTION
      {"mesh_reply", read_mesh_reply},
      {"matrices", read_matrix_files},
      {"input_deck", read_input_deck},
      {"bulk_deck", read_bulk_deck},
      {"bulk_structure", read_bulk_structure},
      {"input_structure", read_input_structure},
#endif
  };
  return readers;
}

bool takes(const Reader& reader, std::string_view bytes) {
  try {
    reader.read(bytes);
    return true;
  } catch (const InputError&) {
    return false;
  }
}

}  // namespace limber::fuzz
