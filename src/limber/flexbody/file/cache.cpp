// SPDX-License-Identifier: BSD-3-Clause
#include "limber/flexbody/file/cache.hpp"

#include <fmt/format.h>

#include <cstdlib>
#include <exception>
#include <optional>
#include <utility>

#include "limber/common/errors.hpp"
#include "limber/common/overloaded.hpp"
#include "limber/common/records/digest.hpp"
#include "limber/flexbody/file/body_file.hpp"
#include "limber/flexbody/file/cache_contents.hpp"
#include "limber/flexbody/file/cache_file.hpp"

namespace limber::flexbody {
namespace {

// Increment when the reduction or its stress modes change, to invalidate old
// entries.
constexpr int kReductionVersion = 14;
// The same for contact surfaces, for bodies that have any.
constexpr int kContactVersion = 5;
// The same for second-order kinematics.
constexpr int kManifoldVersion = 3;
// The same for the cuts of meshes.
constexpr int kPieceVersion = 2;

void add_selection(const NodeSelection& nodes, Digest& digest) {
  digest.add(nodes.index());
  std::visit(
      Overloaded{[&](const GroupNodes& group) { digest.add(group.group); },
                 [&](const TaggedNode& node) { digest.add(node.tag); },
                 [&](const NearestNode& node) { digest.add(node.point); },
                 [&](const BoxNodes& box) {
                   digest.add(box.lower);
                   digest.add(box.upper);
                 },
                 [&](const PlaneNodes& plane) {
                   digest.add(plane.point);
                   digest.add(plane.normal);
                   digest.add(plane.tolerance);
                 },
                 [&](const CylinderNodes& cylinder) {
                   digest.add(cylinder.from);
                   digest.add(cylinder.to);
                   digest.add(cylinder.radius);
                   digest.add(cylinder.inner_radius);
                 }},
      nodes);
}

void add_request(const Recipe& recipe, Digest& digest) {
  add_materials(recipe.materials, digest);
  digest.add(recipe.clamped_groups.size());
  for (const std::string& group : recipe.clamped_groups) digest.add(group);
  digest.add(recipe.interfaces.size());
  for (const InterfaceRequest& request : recipe.interfaces) {
    digest.add(request.name);
    add_selection(request.nodes, digest);
    digest.add(request.weighting);
    digest.add(request.static_modes);
  }
  digest.add(recipe.load_patterns.size());
  for (const LoadPattern& pattern : recipe.load_patterns) {
    digest.add(pattern.interface);
    digest.add(pattern.force);
    digest.add(pattern.moment);
    digest.add(pattern.static_mode);
  }
  digest.add(recipe.nodal_forces.size());
  for (const NodalForces& nodal : recipe.nodal_forces) {
    digest.add(std::filesystem::path(nodal.name).filename().string());
    digest.add(nodal.times);
    digest.add(nodal.forces);
  }
  digest.add(MatrixX(recipe.initial_displacement.values));
  digest.add(MatrixX(recipe.initial_velocity.values));
  digest.add(recipe.basis.eigenmodes);
  digest.add(recipe.basis.automatic.has_value());
  if (recipe.basis.automatic) {
    digest.add(recipe.basis.automatic->threshold);
    digest.add(recipe.basis.automatic->measure);
    digest.add(recipe.basis.automatic->candidates);
    for (const ExpectedImpact& impact : recipe.basis.automatic->impacts) {
      digest.add(impact.mass);
      digest.add(impact.stiffness);
      digest.add(impact.speed);
    }
  }
  digest.add(recipe.basis.interface_modes);
  digest.add(recipe.basis.load_modes);
  digest.add(recipe.basis.terms);
  digest.add(recipe.basis.drop_tolerance);
  digest.add(recipe.rows.extent);
  digest.add(recipe.rows.groups.size());
  for (const std::string& group : recipe.rows.groups) digest.add(group);
  // Bodies without manifold and contact keep the keys that they had before
  // there was any.
  if (recipe.manifold) {
    digest.add(std::string("manifold"));
    digest.add(kManifoldVersion);
    if (recipe.law != MaterialLaw::st_venant_kirchhoff) {
      digest.add(std::string(to_string(recipe.law)));
    }
  }
  if (recipe.is_estimate) digest.add(std::string("estimate"));
  if (recipe.contact_groups.empty()) return;
  digest.add(kContactVersion);
  digest.add(recipe.contact_groups.size());
  for (const std::string& group : recipe.contact_groups) digest.add(group);
}

std::filesystem::path find_entry_place(const std::filesystem::path& folder,
                                       const std::string& key) {
  return folder / (key + ".h5");
}

// The entry if it exists, is undamaged, has the right key and the stress modes
// that are needed. Any other content is ignored, since the body can be made
// again.
std::optional<ReducedBody> find_entry(const std::filesystem::path& folder,
                                      const std::string& key,
                                      StressTables stress) {
  try {
    const std::filesystem::path file = find_entry_place(folder, key);
    if (!is_own_file(file)) return std::nullopt;
    ReducedBody body = read_body(file, stress);
    const bool is_enough = body.stress || stress == StressTables::skipped;
    if (body.content_key == key && is_enough) return body;
  } catch (const std::exception&) {
  }
  return std::nullopt;
}

// Failing to store an entry only makes the next run take longer.
void keep_entry(const ReducedBody& body, const std::filesystem::path& mesh,
                const std::filesystem::path& folder) {
  const std::filesystem::path file = find_entry_place(folder, body.content_key);
  try {
    write_own_file(file, [&](const std::filesystem::path& place) {
      write_body(body, place);
    });
    write_origin(file, mesh);
  } catch (const std::exception&) {
  }
}

// With stress modes, so that a later run that requests stress need not reduce
// it again; those of a manifold are many times larger, and computed on demand.
// Matrices, and beams and shells, have none.
ReducedBody reduce_for_all(const MeshAtHand& mesh, Recipe recipe) {
  recipe.stress |= !recipe.manifold && !recipe.is_estimate &&
                   !recipe.mesh.is_matrices() && recipe.mesh.sections.empty() &&
                   !recipe.materials.empty();
  return mesh.reduce(recipe);
}

}  // namespace

std::string content_key(const Recipe& recipe, const std::string& mesh) {
  Digest digest;
  digest.add(kBodyFileVersion);
  digest.add(kReductionVersion);
  digest.add(mesh);
  add_request(recipe, digest);
  return digest.text();
}

std::string find_piece_content(const std::string& mesh, const Piece& piece) {
  if (piece.count == 1) return mesh;
  return fmt::format("{}, piece {} of {}, cut {}", mesh, piece.index + 1,
                     piece.count, kPieceVersion);
}

std::string recipe_key(const Recipe& recipe, const Piece& piece) {
  Digest digest;
  digest.add(find_piece_content("", piece));
  digest.add(std::filesystem::absolute(recipe.mesh.file).string());
  add_source_options(recipe.mesh, digest);
  digest.add(recipe.stress);
  add_request(recipe, digest);
  return digest.text();
}

std::filesystem::path default_cache_folder() {
  const auto find = [](const char* name) {
    const char* value = std::getenv(name);
    return std::filesystem::path(value ? value : "");
  };
  if (auto own = find("LIMBER_CACHE"); !own.empty()) return own;
  // Relative ones are to be ignored (XDG Base Directory Specification).
  if (const auto xdg = find("XDG_CACHE_HOME"); xdg.is_absolute()) {
    return xdg / "limber";
  }
  if (const auto home = find("HOME"); home.is_absolute()) {
    return home / ".cache" / "limber";
  }
  throw InputError(
      "there is no place to keep reduced bodies: none of LIMBER_CACHE, "
      "XDG_CACHE_HOME and HOME names a folder. Set one of them, or give "
      "--cache FOLDER.");
}

CachedBody load_or_reduce(const Recipe& recipe,
                          const std::filesystem::path& cache,
                          const Reducer& reducer, const Piece& piece,
                          const std::filesystem::path& shipped) {
  const std::filesystem::path folder =
      cache.empty() ? default_cache_folder() : cache;
  const auto find_in =
      [&](const std::filesystem::path& place,
          const MeshRecord& mesh) -> std::optional<CachedBody> {
    const std::string key =
        content_key(recipe, find_piece_content(mesh.content, piece));
    std::optional<ReducedBody> body = find_entry(
        place, key,
        recipe.stress ? StressTables::needed : StressTables::skipped);
    if (!body) return std::nullopt;
    if (place == folder) note_use(find_entry_place(place, key));
    // Links of equal shape share an entry; the name is the caller's.
    body->name = recipe.name;
    return CachedBody{std::move(*body), true, mesh.notices, mesh.found};
  };
  const auto known = find_mesh_record(recipe.mesh, reducer.mesher, folder);
  if (known) {
    if (std::optional<CachedBody> body = find_in(folder, *known)) {
      return std::move(*body);
    }
  }
  if (const auto came = find_shipped_mesh(recipe.mesh, shipped)) {
    if (std::optional<CachedBody> body = find_in(shipped, *came)) {
      return std::move(*body);
    }
  }
  MeshAtHand mesh = reducer.make_mesh(recipe.mesh);
  keep_mesh_record(mesh.record, recipe.mesh, reducer.mesher, folder);
  if (std::optional<CachedBody> body = find_in(folder, mesh.record)) {
    return std::move(*body);
  }
  if (piece.count > 1) mesh = mesh.take_piece(piece);
  CachedBody made{reduce_for_all(mesh, recipe), false, mesh.record.notices,
                  mesh.record.found};
  made.body.content_key = content_key(recipe, mesh.record.content);
  keep_entry(made.body, recipe.mesh.file, folder);
  if (!recipe.stress) made.body.stress.reset();
  return made;
}

}  // namespace limber::flexbody
