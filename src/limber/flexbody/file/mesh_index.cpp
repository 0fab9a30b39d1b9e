// SPDX-License-Identifier: BSD-3-Clause
#include "limber/flexbody/file/mesh_index.hpp"

#include <algorithm>
#include <exception>
#include <optional>
#include <system_error>

#include "limber/common/files/sealed_file.hpp"
#include "limber/common/records/digest.hpp"
#include "limber/common/records/wire.hpp"
#include "limber/flexbody/file/cache_file.hpp"

namespace limber::flexbody {
namespace {

constexpr Seal kSeal = {kMeshRecord, 2};

/// One request and its result.
struct Entry {
  std::string request;
  std::string mesher;
  MeshRecord record;
};

void exchange(Wire& wire, Entry& entry) {
  MeshRecord& record = entry.record;
  wire(entry.request, entry.mesher, record.content, record.notices,
       record.found, record.files);
}

// A geometry refers to files relative to its folder, so symbolic links are
// resolved.
std::string find_request(const MeshSource& mesh) {
  std::error_code unknown;
  Digest digest;
  digest.add(std::filesystem::absolute(mesh.file).string());
  digest.add(std::filesystem::weakly_canonical(mesh.file, unknown).string());
  add_source_options(mesh, digest);
  return digest.text();
}

void add_vector(const std::optional<Vector3>& vector, Digest& digest) {
  digest.add(vector.has_value());
  if (vector) digest.add(*vector);
}

void add_sections(const SectionSource& sections, Digest& digest) {
  digest.add(sections.shells.size());
  for (const ShellRegion& region : sections.shells) {
    digest.add(region.group);
    digest.add(region.thicknesses);
    digest.add(region.angles);
    digest.add(region.materials.size());
    for (const std::string& name : region.materials) digest.add(name);
    add_vector(region.axis_1, digest);
    digest.add(region.offset);
  }
  digest.add(sections.beams.size());
  for (const BeamRegion& region : sections.beams) {
    digest.add(region.group);
    digest.add(region.section);
    for (const auto& [name, value] : region.sizes) {
      digest.add(name);
      digest.add(value);
    }
    add_vector(region.y_axis, digest);
    digest.add(region.offset);
  }
  add_materials(sections.materials, digest);
}

std::filesystem::path find_index_place(const std::string& request,
                                       const std::filesystem::path& folder) {
  return folder / (request + ".mesh");
}

}  // namespace

void add_materials(const std::vector<MaterialRegion>& materials,
                   Digest& digest) {
  digest.add(materials.size());
  for (const MaterialRegion& region : materials) {
    digest.add(region.group);
    digest.add(region.material.youngs_modulus);
    digest.add(region.material.poisson_ratio);
    digest.add(region.material.density);
    if (!region.material.anisotropy) continue;
    const Anisotropy& anisotropy = *region.material.anisotropy;
    digest.add(std::string("anisotropy"));
    digest.add(MatrixX(anisotropy.C));
    digest.add(anisotropy.axes.is_cylindrical);
    digest.add(MatrixX(anisotropy.axes.directions));
    digest.add(anisotropy.axes.point);
  }
}

void add_source_options(const MeshSource& source, Digest& digest) {
  digest.add(source.size);
  digest.add(source.order);
  digest.add(source.unit);
  digest.add(source.matrices.mass);
  if (source.force != 0.0) digest.add(source.force);
  for (const std::string& card : source.ignored) digest.add(card);
  for (const auto* paths : {&source.matrices.paths, &source.matrices.recovery})
    for (const std::filesystem::path& path : *paths)
      digest.add(std::filesystem::absolute(path).string());
  if (!source.sections.empty()) add_sections(source.sections, digest);
}

std::filesystem::path read_mesh_file(const std::filesystem::path& record) {
  try {
    Wire wire(read_sealed(record, kSeal));
    Entry entry;
    wire(entry);
    wire.finish();
    const std::vector<FileStamp>& files = entry.record.files;
    return files.empty() ? std::filesystem::path() : files.front().path;
  } catch (const std::exception&) {
    return {};
  }
}

std::optional<MeshRecord> find_mesh_record(
    const MeshSource& mesh, const std::string& mesher,
    const std::filesystem::path& folder) {
  try {
    const std::string request = find_request(mesh);
    const std::filesystem::path file = find_index_place(request, folder);
    if (!is_own_file(file)) return std::nullopt;
    Wire wire(read_sealed(file, kSeal));
    Entry entry;
    wire(entry);
    wire.finish();
    const bool is_requested =
        entry.request == request && (mesher.empty() || entry.mesher == mesher);
    const std::vector<FileStamp>& files = entry.record.files;
    if (!is_requested ||
        !std::all_of(files.begin(), files.end(), is_unchanged)) {
      return std::nullopt;
    }
    entry.record.is_repeatable = true;
    note_use(file);
    return entry.record;
  } catch (const std::exception&) {  // damaged in any way: as if missing
    return std::nullopt;
  }
}

void keep_mesh_record(const MeshRecord& record, const MeshSource& mesh,
                      const std::string& mesher,
                      const std::filesystem::path& folder) {
  if (!record.is_repeatable) return;
  try {
    Entry entry{find_request(mesh), mesher, record};
    Wire wire;
    wire(entry);
    write_own_file(find_index_place(entry.request, folder),
                   [&](const std::filesystem::path& place) {
                     write_sealed(place, kSeal, wire.bytes());
                   });
  } catch (const std::exception&) {
  }
}

}  // namespace limber::flexbody
