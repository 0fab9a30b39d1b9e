// SPDX-License-Identifier: BSD-3-Clause
#include "flexbody/cache.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <exception>
#include <optional>
#include <system_error>
#include <utility>

#include "common/digest.hpp"
#include "common/errors.hpp"
#include "common/input_file.hpp"
#include "common/overloaded.hpp"
#include "flexbody/body_file.hpp"
#include "flexbody/cache_file.hpp"
#include "flexbody/geometry_files.hpp"

namespace limber::flexbody {
namespace {

// Raise when the reduction itself changes: it makes old entries unknown.
constexpr int kReductionVersion = 3;

// Of this run of the program alone: nothing before or after has it.
std::string find_run_mark() {
  static const std::string mark =
      fmt::format("{} {}", getpid(),
                  std::chrono::system_clock::now().time_since_epoch().count());
  return mark;
}

void add_mesh(const MeshSource& mesh, Digest& digest) {
  digest.add(mesh.file.extension().string());
  digest.add(read_input(mesh.file, kMeshInput));
  const GeometryFiles geometry = find_geometry_files(mesh.file);
  for (const std::filesystem::path& file : geometry.files) {
    std::error_code unknown;
    const bool is_there = std::filesystem::is_regular_file(file, unknown);
    digest.add(is_there);
    if (is_there) digest.add(read_input(file, kMeshInput));
  }
  if (!geometry.is_complete) digest.add(find_run_mark());
  digest.add(mesh.size);
  digest.add(mesh.order);
  digest.add(mesh.unit);
}

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

// The entry if it is there, sound and the asked one. Whatever else is in its
// place, of whatever kind its damage is, is no reason to fail: the body can
// be made anew.
std::optional<ReducedBody> find_entry(const std::filesystem::path& file,
                                      const std::string& key) {
  try {
    if (!is_own_file(file)) return std::nullopt;
    ReducedBody body = read_body(file);
    if (body.content_key == key) return body;
  } catch (const std::exception&) {
  }
  return std::nullopt;
}

// An entry that cannot be kept only makes the next run take longer.
void keep_entry(const ReducedBody& body, const std::filesystem::path& file) {
  try {
    write_own_file(file, [&](const std::filesystem::path& place) {
      write_body(body, place);
    });
  } catch (const std::exception&) {
  }
}

}  // namespace

std::string content_key(const Recipe& recipe) {
  Digest digest;
  digest.add(kBodyFileVersion);
  digest.add(kReductionVersion);
  add_mesh(recipe.mesh, digest);
  digest.add(recipe.materials.size());
  for (const MaterialRegion& region : recipe.materials) {
    digest.add(region.group);
    digest.add(region.material.youngs_modulus);
    digest.add(region.material.poisson_ratio);
    digest.add(region.material.density);
  }
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
  }
  digest.add(recipe.basis.interface_modes);
  digest.add(recipe.basis.load_modes);
  digest.add(recipe.basis.terms);
  digest.add(recipe.basis.drop_tolerance);
  digest.add(recipe.rows.extent);
  digest.add(recipe.rows.groups.size());
  for (const std::string& group : recipe.rows.groups) digest.add(group);
  return digest.text();
}

std::filesystem::path default_cache_folder() {
  const auto find = [](const char* name) {
    const char* value = std::getenv(name);
    return std::filesystem::path(value ? value : "");
  };
  if (const auto own = find("LIMBER_CACHE"); !own.empty()) return own;
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

CachedBody load_or_reduce(
    const Recipe& recipe, const std::filesystem::path& folder,
    const std::function<ReducedBody(const Recipe&)>& reduce) {
  const std::string key = content_key(recipe);
  const std::filesystem::path file = folder / (key + ".h5");
  if (std::optional<ReducedBody> body = find_entry(file, key)) {
    // Two links of one shape share an entry; the name is the asker's.
    body->name = recipe.name;
    return {std::move(*body), true};
  }
  CachedBody made{reduce(recipe), false};
  made.body.content_key = key;
  // No other run could use it.
  if (find_geometry_files(recipe.mesh.file).is_complete) {
    keep_entry(made.body, file);
  }
  return made;
}

}  // namespace limber::flexbody
