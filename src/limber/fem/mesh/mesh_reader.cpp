// SPDX-License-Identifier: BSD-3-Clause
#include "limber/fem/mesh/mesh_reader.hpp"

#include <utility>

#include "limber/fem/mesh/mesh_checks.hpp"
#include "limber/fem/mesh/mesh_file_kind.hpp"

namespace limber::fem {

void complete_mesh(Mesh& mesh) {
  check_elements(mesh);
  find_boundary(mesh);
  check_faces(mesh);
  check_connected(mesh);
}

TracedMesh read_traced_mesh(const std::filesystem::path& file,
                            const MeshOptions& options, const Mesher& mesher,
                            const Progress& progress) {
  check_mesh_options(file, find_mesh_file_kind(file), options);
  MeshReply reply = run_mesher(mesher, file, options, progress);
  complete_mesh(reply.mesh);
  return {std::move(reply.mesh), std::move(reply.notices),
          std::move(reply.files), reply.is_repeatable};
}

Mesh read_mesh(const std::filesystem::path& file, const MeshOptions& options,
               const Mesher& mesher) {
  return read_traced_mesh(file, options, mesher).mesh;
}

TracedMesh read_traced_mesh(const std::filesystem::path& file,
                            const MeshOptions& options,
                            const Progress& progress) {
  // Problems of the user's file are reported before those of the installation.
  check_mesh_options(file, find_mesh_file_kind(file), options);
  return read_traced_mesh(file, options, find_mesher(), progress);
}

Mesh read_mesh(const std::filesystem::path& file, const MeshOptions& options) {
  return read_traced_mesh(file, options).mesh;
}

}  // namespace limber::fem
