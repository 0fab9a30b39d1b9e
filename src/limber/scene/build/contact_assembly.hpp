// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "limber/contact/patches/surface_parts.hpp"
#include "limber/contact/shapes/mesh_surface.hpp"
#include "limber/dynamics/system/system_builder.hpp"
#include "limber/scene/build/attachment_sites.hpp"
#include "limber/scene/build/body_plan.hpp"
#include "limber/scene/build/scene.hpp"
#include "limber/scene/contacts/start_overlap.hpp"

namespace limber::scene {

/// Adds the pairs of bodies that may touch to a system.
class ContactAssembly {
 public:
  ContactAssembly(const Scene& scene, const AttachmentSites& sites,
                  dynamics::SystemBuilder& builder,
                  std::vector<std::string>& warnings)
      : scene_(scene), sites_(sites), builder_(builder), warnings_(warnings) {}

  /// A pair for every two shapes, called "A/B" after their bodies, with the
  /// shape's number ("A.2/B") or surface ("A.tip/B") if a body has several.
  /// @throws InputError naming file and contact.
  [[nodiscard]] std::vector<PlacedPair> add_all();

 private:
  struct Side {
    std::string name;
    dynamics::BodyIndex body = dynamics::kWorld;
    contact::ContactSide side;
    std::optional<std::string> warning = {};  ///< where its bodies touch
    bool is_mesh = false;                     ///< rigid
  };
  using Sides = std::vector<Side>;

  const Sides& get_sides(const Toucher& body);
  [[nodiscard]] Sides make_obstacle(const ObstacleSpec& obstacle) const;
  [[nodiscard]] Sides make_rigid(int link) const;
  [[nodiscard]] Sides make_flexible(int link);
  std::shared_ptr<const contact::MeshSurface> get_mesh_surface(
      const BodyPlan& plan, const std::string& surface);
  [[nodiscard]] Side cover(const Side& side);
  void warn(const Side& side);
  void add_pair(std::size_t touching, const Side& A, const Side& B,
                std::vector<PlacedPair>& placed);

  const Scene& scene_;
  const AttachmentSites& sites_;
  dynamics::SystemBuilder& builder_;
  std::vector<std::string>& warnings_;
  std::map<Toucher, Sides> sides_;
  /// By the body's reduction, the surface, and its level.
  std::map<std::tuple<const void*, std::string, dynamics::Fidelity>,
           std::shared_ptr<const contact::MeshSurface>>
      mesh_surfaces_;
  std::map<const flexbody::ContactSurface*, contact::SurfaceParts> covers_;
};

}  // namespace limber::scene
