// SPDX-License-Identifier: BSD-3-Clause
#include "limber/scene/build/contact_assembly.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <utility>
#include <variant>

#include "limber/common/errors.hpp"
#include "limber/common/index.hpp"
#include "limber/common/names.hpp"
#include "limber/contact/make_contact.hpp"
#include "limber/contact/patches/patch_sides.hpp"
#include "limber/contact/patches/surface_parts.hpp"
#include "limber/contact/potential/mesh_parts.hpp"
#include "limber/contact/shapes/mesh_surface.hpp"
#include "limber/scene/contacts/collision_mesh.hpp"
#include "limber/scene/contacts/contact_shapes.hpp"
#include "limber/scene/text/error_context.hpp"

namespace limber::scene {
namespace {

contact::ContactSide make_side(
    contact::Shape shape,
    const std::optional<contact::SurfaceMaterial>& material,
    const BodyPlan& plan) {
  if (plan.is_world) return {std::move(shape), material, kInfinity};
  return {std::move(shape), material, plan.mass, plan.inertia};
}

const flexbody::ContactSurface& bare_surface(
    const flexbody::ContactSurface& surface) {
  return surface;
}
const flexbody::ContactSurface& bare_surface(
    const flexbody::FullContactSurface& surface) {
  return surface.surface;
}

/// @tparam Surface of a reduced body, or of a whole one
/// @throws InputError if there is no such surface, or it is empty.
template <typename Surface>
const Surface& find_surface(const std::vector<Surface>& surfaces,
                            const std::string& name) {
  std::vector<std::string> known;
  for (const Surface& surface : surfaces) {
    known.push_back(bare_surface(surface).name);
    if (known.back() != name) continue;
    if (!bare_surface(surface).faces.empty()) return surface;
    throw InputError(fmt::format("surface '{}' has no faces", name));
  }
  throw InputError(describe_unknown("surface", name, known) +
                   "; a saved body has those that it was reduced with");
}

bool has_surface(const flexbody::ReducedBody& body, const std::string& name) {
  return std::any_of(body.contact_surfaces.begin(), body.contact_surfaces.end(),
                     [&](const flexbody::ContactSurface& surface) {
                       return surface.name == name;
                     });
}

void make_rigid_parts(std::vector<flexbody::ContactPart>& parts) {
  for (flexbody::ContactPart& part : parts) {
    part.motion_B.resize(6, 0);
    part.residual = part.flexibility = 0.0;
  }
}

void make_rigid_slices(std::vector<flexbody::ContactSlice>& slices) {
  for (flexbody::ContactSlice& slice : slices) {
    slice.motion_B.resize(6, 0);
    slice.flexibility_B.setZero();
  }
}

// Products of modes move the surface at level nonlinear alone.
void take_columns(const flexbody::ReducedBody& body, bool has_products,
                  flexbody::ContactSurface& surface) {
  const Eigen::Index m = body.mode_count();
  const Eigen::Index columns =
      has_products
          ? m + flexbody::count_pairs(std::ssize(body.manifold->paired))
          : m;
  if (surface.Phi_B.cols() < columns) {
    throw InputError(fmt::format(
        "surface '{}' of its saved body has no second order, which level "
        "nonlinear needs; reduce it again by 'limber reduce --second-order'",
        surface.name));
  }
  surface.Phi_B.conservativeResize(Eigen::NoChange, columns);
  for (flexbody::ContactPart& part : surface.parts) {
    part.motion_B.conservativeResize(Eigen::NoChange, columns);
  }
  for (flexbody::ContactSlice& slice : surface.slices) {
    slice.motion_B.conservativeResize(Eigen::NoChange, columns);
  }
}

// A mesh is a surface in the frame of its body, without modes.
contact::Shape make_rigid_shape(const Geometry& geometry, const Pose& X_BS) {
  const auto* mesh = std::get_if<MeshGeometry>(&geometry);
  if (mesh == nullptr) return {make_shape(geometry), X_BS};
  return {std::make_shared<const contact::MeshSurface>(
              read_collision_mesh(*mesh, X_BS)),
          Pose{}};
}

const flexbody::ContactSurface* find_surface(const contact::Shape& shape) {
  const auto* mesh_surface =
      std::get_if<std::shared_ptr<const contact::MeshSurface>>(&shape.kind);
  return mesh_surface == nullptr ? nullptr : &(*mesh_surface)->surface();
}

// None of a shape that is no mesh, or a mesh that has too many parts.
std::vector<contact::PlacedBody> find_bodies(const contact::Shape& shape) {
  const flexbody::ContactSurface* found = find_surface(shape);
  if (found == nullptr) return {};
  const flexbody::ContactSurface& surface = *found;
  std::vector<contact::PlacedBody> bodies;
  for (auto& solid : contact::split_mesh(surface.x_B, surface.faces)) {
    bodies.push_back({std::move(solid), Pose{}});
  }
  return bodies;
}

// A surface that is farther from what stands for it than this, of its size, is
// told of.
constexpr double kClose = 1e-3;

std::optional<std::string> describe_error(
    const std::string& name, const flexbody::ContactSurface& surface,
    double error) {
  const Vector3 extent =
      surface.x_B.rowwise().maxCoeff() - surface.x_B.rowwise().minCoeff();
  if (error <= kClose * extent.norm()) return {};
  return fmt::format(
      "contact of '{}', surface '{}': the convex shapes that represent it "
      "deviate from it by up to {:.2g} m; contact begins at these shapes",
      name, surface.name, error);
}

std::string describe_pair(const Scene& scene, const TouchingPair& pair) {
  return fmt::format("{}: [[contact]] {} between '{}' and '{}'",
                     scene.scenario.file.string(), pair.contact + 1,
                     name_of(pair.A, scene.robot, scene.scenario),
                     name_of(pair.B, scene.robot, scene.scenario));
}

}  // namespace

std::vector<PlacedPair> ContactAssembly::add_all() {
  std::vector<PlacedPair> placed;
  for (std::size_t i = 0; i < scene_.touching.size(); ++i) {
    const TouchingPair& pair = scene_.touching[i];
    with_context(describe_pair(scene_, pair), [&] {
      const Sides& all_A = get_sides(pair.A);
      const Sides& all_B = get_sides(pair.B);
      for (const Side& A : all_A) {
        for (const Side& B : all_B) add_pair(i, A, B, placed);
      }
    });
  }
  return placed;
}

const ContactAssembly::Sides& ContactAssembly::get_sides(const Toucher& body) {
  const auto found = sides_.find(body);
  if (found != sides_.end()) return found->second;
  const auto make = [&] {
    if (body.is_obstacle) {
      return make_obstacle(scene_.scenario.obstacles[body.index]);
    }
    const int link = static_cast<int>(body.index);
    return scene_.robot.links[body.index].flexible ? make_flexible(link)
                                                   : make_rigid(link);
  };
  return sides_.emplace(body, make()).first->second;
}

ContactAssembly::Sides ContactAssembly::make_obstacle(
    const ObstacleSpec& obstacle) const {
  return {{obstacle.name,
           dynamics::kWorld,
           {{make_shape(obstacle.geometry), obstacle.X_WS},
            obstacle.material,
            kInfinity}}};
}

ContactAssembly::Sides ContactAssembly::make_rigid(int link) const {
  const Link& source = scene_.robot.links[index(link)];
  Sides sides;
  for (const Collision& collision : source.collisions) {
    const AttachmentSite site = sites_.find_site(link, collision.X_LS, {});
    const std::string number = source.collisions.size() > 1
                                   ? fmt::format(".{}", sides.size() + 1)
                                   : "";
    const contact::Shape shape = with_context(
        fmt::format("link '{}'", source.name),
        [&] { return make_rigid_shape(collision.geometry, site.X_BF); });
    sides.push_back(
        {source.name + number, site.body,
         make_side(shape, source.contact.material, sites_.plan_of(link))});
    sides.back().side.bodies = find_bodies(shape);
    sides.back().is_mesh = find_surface(shape) != nullptr;
  }
  return sides;
}

ContactAssembly::Sides ContactAssembly::make_flexible(int link) {
  const Link& source = scene_.robot.links[index(link)];
  const std::vector<std::string> surfaces = find_surfaces(source);
  Sides sides;
  for (const BodyPlan& plan : sites_.pieces_of(link)) {
    for (const std::string& name : surfaces) {
      // A surface need not reach over all pieces.
      if (plan.piece_count > 1 && !has_surface(*plan.reduced, name)) continue;
      with_context(fmt::format("link '{}'", source.name), [&] {
        const auto mesh_surface = get_mesh_surface(plan, name);
        const flexbody::ContactSurface& surface = mesh_surface->surface();
        sides.push_back(
            {surfaces.size() > 1 ? plan.name + "." + name : plan.name,
             sites_.body_of(link, plan.piece),
             make_side({mesh_surface, Pose{}},
                       contact::SurfaceMaterial{surface.youngs_modulus,
                                                surface.poisson_ratio},
                       plan)});
        contact::SurfaceParts parts = contact::split_surface(surface);
        sides.back().side.bodies = std::move(parts.bodies);
        sides.back().side.slices = std::move(parts.slices);
        sides.back().warning = describe_error(plan.name, surface, parts.error);
      });
    }
  }
  return sides;
}

// At level `rigid` there are neither modes nor residual flexibility; at
// `nonlinear` their products are additional modes.
std::shared_ptr<const contact::MeshSurface> ContactAssembly::get_mesh_surface(
    const BodyPlan& plan, const std::string& surface) {
  const dynamics::Fidelity level = scene_.scenario.level_of(
      scene_.robot.links[index(plan.links.front())].name);
  const bool is_rigid = level == dynamics::Fidelity::rigid;
  const void* body = plan.full ? static_cast<const void*>(plan.full.get())
                               : static_cast<const void*>(plan.reduced.get());
  auto& mesh_surface = mesh_surfaces_[{body, surface, level}];
  if (mesh_surface) return mesh_surface;
  if (plan.full) {
    mesh_surface = std::make_shared<const contact::MeshSurface>(
        find_surface(flexbody::find_contact_surfaces(*plan.full), surface),
        plan.full->node_count());
    return mesh_surface;
  }
  flexbody::ContactSurface copy =
      find_surface(plan.reduced->contact_surfaces, surface);
  take_columns(*plan.reduced, level == dynamics::Fidelity::nonlinear, copy);
  if (is_rigid) {
    copy.Phi_B.resize(copy.Phi_B.rows(), 0);
    copy.residual.setZero();
    make_rigid_parts(copy.parts);
    make_rigid_slices(copy.slices);
  }
  mesh_surface = std::make_shared<const contact::MeshSurface>(std::move(copy));
  return mesh_surface;
}

// Once for all pairs of a surface.
void ContactAssembly::warn(const Side& side) {
  const bool is_known =
      !side.warning ||
      std::count(warnings_.begin(), warnings_.end(), *side.warning) > 0;
  if (!is_known) warnings_.push_back(*side.warning);
}

// A rigid mesh as hulls; any other side as it is.
ContactAssembly::Side ContactAssembly::cover(const Side& side) {
  if (!side.is_mesh) return side;
  const flexbody::ContactSurface* mesh = find_surface(side.side.shape);
  const auto [found, is_new] = covers_.try_emplace(mesh);
  contact::SurfaceParts& hulls = found->second;
  if (is_new) hulls = contact::cover_mesh(*mesh);
  Side covered = side;
  covered.side.bodies = hulls.bodies;
  covered.warning = describe_error(side.name, *mesh, hulls.error);
  return covered;
}

void ContactAssembly::add_pair(std::size_t touching, const Side& A,
                               const Side& B, std::vector<PlacedPair>& placed) {
  const ContactOptions& options =
      scene_.scenario.contacts[scene_.touching[touching].contact].options;
  const contact::ContactParameters parameters = make_parameters(options);
  PlacedPair pair{
      .name = A.name + "/" + B.name,
      .most_overlap = find_most_overlap(A.side, B.side, options.radius),
      .touching = touching};
  const bool suits = contact::suits(A.side, B.side);
  const Side of_A = suits ? A : cover(A);
  const Side of_B = suits ? B : cover(B);
  // A ball touches the surface itself.
  if (!contact::has_ball_on_surface(of_A.side, of_B.side)) {
    warn(of_A);
    warn(of_B);
  }
  pair.pair = builder_.add_pair(
      pair.name, A.body, B.body,
      contact::make_contact(of_A.side, of_B.side, parameters));
  placed.push_back(std::move(pair));
}

}  // namespace limber::scene
