// SPDX-License-Identifier: BSD-3-Clause
#include "limber/scene/build/recipes.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "limber/common/names.hpp"
#include "limber/scene/build/nodal_forces.hpp"
#include "limber/scene/probes/stress_points.hpp"
#include "limber/scene/scenario/link_start.hpp"

namespace limber::scene {
namespace {

using flexbody::InterfaceRequest;
using flexbody::LoadPattern;
using flexbody::Recipe;

const InterfaceRequest* find_request(const Recipe& recipe,
                                     const std::string& name) {
  for (const InterfaceRequest& request : recipe.interfaces) {
    if (request.name == name) return &request;
  }
  return nullptr;
}

/// Adds an interface `name` on the group of that name, unless it exists.
void require_interface(Recipe& recipe, const std::string& name) {
  if (find_request(recipe, name) != nullptr) return;
  InterfaceRequest request;
  request.name = name;
  request.nodes = flexbody::GroupNodes{name};
  recipe.interfaces.push_back(request);
}

/// @throws InputError if an interface of the place's own name has other nodes.
void require_place(Recipe& recipe, const Place& place,
                   bool static_modes = false) {
  const std::string name = find_place_interface(place);
  if (name.empty()) return;
  if (!place.nodes) {
    require_interface(recipe, name);
    return;
  }
  const InterfaceRequest* known = find_request(recipe, name);
  if (known == nullptr) {
    recipe.interfaces.push_back(
        {name, *place.nodes, place.weighting, static_modes});
  } else if (known->nodes != *place.nodes ||
             known->weighting != place.weighting) {
    throw InputError(fmt::format(
        "interface '{}' has the same name as another selection, {}; rename it",
        name, flexbody::describe(*place.nodes)));
  }
}

/// A load covered by the interface's static-deformation modes needs no mode of
/// its own, but is still a load case. A body-frame load is one pattern. One
/// fixed in the world may have any direction in the body, so it gives one
/// pattern per axis.
void add_patterns(Recipe& recipe, const FlexibleLink& link,
                  const LoadSpec& load) {
  const std::string name = find_place_interface(load.where);
  const InterfaceRequest* request = find_request(recipe, name);
  const bool is_covered =
      request != nullptr && request->static_modes && link.basis.interface_modes;
  if (is_covered && !link.basis.automatic) return;
  const auto add = [&](const Vector3& force, const Vector3& moment) {
    if (force.isZero() && moment.isZero()) return;
    recipe.load_patterns.push_back({name, force, moment, !is_covered});
  };
  const Matrix3 R_ML = link.X_LM.R.transpose();
  if (load.frame == dynamics::LoadFrame::body) {
    add(R_ML * load.force, R_ML * load.moment);
    return;
  }
  for (int axis = 0; axis < 3; ++axis) {
    const Vector3 unit = Vector3::Unit(axis);
    const Vector3 none = Vector3::Zero();
    if (!load.force.isZero()) add(unit, none);
    if (!load.moment.isZero()) add(none, unit);
  }
}

/// Nodal forces need every row. Their span gives static-deformation modes,
/// their columns are load cases of automatic modes.
void add_nodal_forces(Recipe& recipe, const std::filesystem::path& file) {
  recipe.rows = flexbody::parse_rows({"all"});
  if (!recipe.basis.automatic && !recipe.basis.load_modes) return;
  recipe.nodal_forces.push_back(read_load_cases(file));
}

void add_connections(Recipe& recipe, const Robot& robot, int index) {
  const Link& link = robot.links[static_cast<std::size_t>(index)];
  for (const Joint& joint : robot.joints) {
    if (joint.parent != index && joint.child != index) continue;
    if (joint.kind == joints::JointKind::floating) continue;
    if (joint.child == index && !link.flexible->clamped_groups.empty()) {
      continue;
    }
    require_interface(recipe, find_joint_interface(*link.flexible, joint.name));
  }
  for (const ConnectorEnd& end : find_ends(robot)) {
    if (end.where.link == link.name) require_place(recipe, end.where, true);
  }
}

/// Null if it is not of a place on a link.
const Place* find_probed_place(const ProbeSpec& probe) {
  if (const auto* point = std::get_if<PointProbeSpec>(&probe.of)) {
    return &point->where;
  }
  const auto* stress = std::get_if<StressProbeSpec>(&probe.of);
  return stress == nullptr ? nullptr : &stress->where;
}

}  // namespace

bool takes_pieces(dynamics::Fidelity level) {
  return level == dynamics::Fidelity::coupled ||
         level == dynamics::Fidelity::nonlinear;
}

std::string find_joint_interface(const FlexibleLink& link,
                                 const std::string& joint) {
  const auto found = link.interface_of_joint.find(joint);
  return found == link.interface_of_joint.end() ? joint : found->second;
}

std::string name_held_joint(const Robot& robot, int index,
                            const std::string& problem) {
  const FlexibleLink& link =
      *robot.links[static_cast<std::size_t>(index)].flexible;
  std::vector<std::string> known;
  for (const InterfaceRequest& request : link.interfaces) {
    known.push_back(request.name);
  }
  for (const Joint& joint : robot.joints) {
    const std::string name = find_joint_interface(link, joint.name);
    const bool is_held = joint.parent == index || joint.child == index;
    if (!is_held || !problem.starts_with("interface '" + name + "': ") ||
        std::find(known.begin(), known.end(), name) != known.end()) {
      continue;
    }
    return fmt::format(
        "joint '{}' is attached to it at {}, which does not exist: {}; add "
        "<interface name=\"{}\"> with its nodes, or choose one by <attach "
        "joint=\"{}\" interface=\"NAME\"/> ({})",
        joint.name,
        name == joint.name ? "an interface of the joint's own name"
                           : "the interface that <attach> names",
        describe_unknown("interface", name, known), name, joint.name, problem);
  }
  return problem;
}

std::string find_place_interface(const Place& place) {
  if (!place.interface.empty()) return place.interface;
  if (!place.nodes) return "";
  const bool equal = place.weighting == flexbody::Weighting::equal;
  return (equal ? "equal:" : "") + flexbody::name_of(*place.nodes);
}

Recipe make_recipe(const Robot& robot, int index, const Scenario& scenario) {
  const Link& link = robot.links[static_cast<std::size_t>(index)];
  LIMBER_EXPECT(link.flexible.has_value());
  const FlexibleLink& flexible = *link.flexible;
  Recipe recipe;
  recipe.name = flexible.mesh.file.stem().string();
  recipe.mesh = flexible.mesh;
  recipe.materials = flexible.materials;
  recipe.clamped_groups = flexible.clamped_groups;
  recipe.interfaces = flexible.interfaces;
  recipe.basis = flexible.basis;
  recipe.rows = flexible.rows;
  recipe.contact_groups = flexible.contact_groups;
  if (scenario.level_of(link.name) == dynamics::Fidelity::full) {
    recipe.rows = flexbody::parse_rows({"all"});
  }
  recipe.manifold =
      scenario.level_of(link.name) == dynamics::Fidelity::nonlinear;
  if (recipe.manifold) recipe.law = scenario.full.law;
  recipe.stress = needs_stress_modes(scenario, link.name);
  add_connections(recipe, robot, index);
  for (const LoadSpec& load : scenario.loads) {
    if (load.where.link != link.name) continue;
    if (!load.nodal_forces.empty()) {
      add_nodal_forces(recipe, load.nodal_forces);
      continue;
    }
    require_place(recipe, load.where);
    add_patterns(recipe, flexible, load);
  }
  if (const LinkStart* start = find_start(scenario, link.name)) {
    add_initial_fields(*start, recipe);
  }
  for (const ProbeSpec& probe : scenario.probes) {
    const Place* where = find_probed_place(probe);
    if (where == nullptr || where->link != link.name) continue;
    if (where->nodes && flexbody::is_single_node(*where->nodes)) continue;
    require_place(recipe, *where);
  }
  for (const ProbeSpec& probe : scenario.probes) {
    const auto* point = std::get_if<PointProbeSpec>(&probe.of);
    if (point == nullptr || !point->relative_to) continue;
    if (point->relative_to->link != link.name) continue;
    require_place(recipe, *point->relative_to);
  }
  return recipe;
}

}  // namespace limber::scene
