// SPDX-License-Identifier: BSD-3-Clause
#include "limber/app/reports/robot_masses.hpp"

#include <fmt/format.h>

#include <map>

#include "limber/app/options/reducer.hpp"
#include "limber/common/errors.hpp"
#include "limber/flexbody/file/body_file.hpp"
#include "limber/flexbody/file/cache.hpp"
#include "limber/flexbody/model/unlikely_values.hpp"
#include "limber/scene/build/link_motion.hpp"

namespace limber::app {
namespace {

void append(const std::vector<std::string>& more,
            std::vector<std::string>& texts) {
  texts.insert(texts.end(), more.begin(), more.end());
}

LinkMass read_saved(const scene::FlexibleLink& link) {
  const flexbody::ReducedBody body = flexbody::read_body(link.reduced_file);
  return {body.mass, link.X_LM * body.p_MoBcm_M, body.size,
          flexbody::question_body(body)};
}

/// By recipe, since links may share a mesh.
using Parts = std::map<std::string, flexbody::PartMass>;

LinkMass measure_mesh(const scene::FlexibleLink& link, Parts& parts,
                      const Progress& progress) {
  flexbody::Recipe recipe;
  recipe.mesh = link.mesh;
  recipe.materials = link.materials;
  const std::string key = flexbody::recipe_key(recipe);
  if (!parts.contains(key)) {
    parts[key] = app::find_part_mass(recipe, progress);
  }
  const flexbody::PartMass& part = parts[key];
  LinkMass mass{part.mass, link.X_LM * part.p_MoBcm_M, part.size, part.notices};
  for (const flexbody::MaterialRegion& region : link.materials) {
    append(flexbody::question_material(region), mass.warnings);
  }
  append(flexbody::question_size(part.size, part.mass), mass.warnings);
  return mass;
}

std::optional<LinkMass> find_mass(const scene::Link& link, Parts& parts,
                                  const Progress& progress) {
  if (!link.flexible) {
    if (!link.inertia) return std::nullopt;
    return LinkMass{link.inertia->mass, link.inertia->p_LBcm};
  }
  const auto find = [&] {
    return link.flexible->reduced_file.empty()
               ? measure_mesh(*link.flexible, parts, progress)
               : read_saved(*link.flexible);
  };
  LinkMass found;
  try {
    found = find();
  } catch (const InputError& error) {  // the rest is worth telling
    found.warnings = error.problems();
  }
  for (std::string& text : found.warnings) {
    text = fmt::format("link '{}': {}", link.name, text);
  }
  return found;
}

}  // namespace

RobotMasses find_masses(const scene::Robot& robot, const Progress& progress) {
  const auto motions = scene::find_motions_at_zero(robot, {});
  RobotMasses all;
  Parts parts;
  Vector3 moment = Vector3::Zero();
  for (std::size_t i = 0; i < robot.links.size(); ++i) {
    all.of_link.push_back(find_mass(robot.links[i], parts, progress));
    if (!all.of_link.back()) continue;
    const LinkMass& one = *all.of_link.back();
    all.total += one.mass;
    moment += one.mass * (motions[i].X_WL * one.p_LBcm);
  }
  if (all.total > 0.0) all.center = moment / all.total;
  return all;
}

}  // namespace limber::app
