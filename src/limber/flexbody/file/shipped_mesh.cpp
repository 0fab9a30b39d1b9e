// SPDX-License-Identifier: BSD-3-Clause
#include "limber/flexbody/file/shipped_mesh.hpp"

#include <algorithm>
#include <exception>
#include <string>

#include "limber/common/files/own_data.hpp"
#include "limber/common/files/sealed_file.hpp"
#include "limber/common/records/wire.hpp"
#include "limber/flexbody/file/cache_file.hpp"

namespace limber::flexbody {
namespace {

namespace fs = std::filesystem;

constexpr Seal kShippedSeal = {"limber shipped mesh", 1};

void pass_shipped(Wire& wire, MeshRecord& record) {
  wire(record.content, record.notices, record.found, record.files);
}

fs::path find_shipped_place(const MeshSource& mesh, const fs::path& folder) {
  Digest digest;
  digest.add(mesh.file.filename().string());
  digest.add(stamp_content(fs::absolute(mesh.file)).mark);
  add_source_options(mesh, digest);
  return folder / (digest.text() + ".shipped");
}

}  // namespace

fs::path find_shipped_bodies() { return find_own_data("bodies"); }

bool ship_mesh_record(const MeshRecord& record, const MeshSource& mesh,
                      const fs::path& folder) {
  if (!record.is_repeatable || mesh.is_matrices()) return false;
  const fs::path home =
      fs::absolute(mesh.file).lexically_normal().parent_path();
  MeshRecord shipped = record;
  std::erase_if(shipped.files, [](const FileStamp& stamp) {
    return stamp.mark.starts_with("version ");  // of programs
  });
  for (FileStamp& stamp : shipped.files) {
    stamp.path = stamp.path.lexically_relative(home);
    if (stamp.path.empty() || *stamp.path.begin() == "..") return false;
  }
  Wire wire;
  pass_shipped(wire, shipped);
  write_own_file(find_shipped_place(mesh, folder), [&](const fs::path& place) {
    write_sealed(place, kShippedSeal, wire.bytes());
  });
  return true;
}

std::optional<MeshRecord> find_shipped_mesh(const MeshSource& mesh,
                                            const fs::path& folder) {
  if (folder.empty() || mesh.is_matrices()) return std::nullopt;
  try {
    const fs::path file = find_shipped_place(mesh, folder);
    if (!is_own_file(file)) return std::nullopt;
    Wire wire(read_sealed(file, kShippedSeal));
    MeshRecord record;
    pass_shipped(wire, record);
    wire.finish();
    for (FileStamp& stamp : record.files) {
      stamp.path = fs::absolute(mesh.file).parent_path() / stamp.path;
      if (!is_unchanged(stamp)) return std::nullopt;
    }
    return record;
  } catch (const std::exception&) {  // damaged in any way: as if missing
    return std::nullopt;
  }
}

}  // namespace limber::flexbody
