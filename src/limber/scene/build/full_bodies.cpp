// SPDX-License-Identifier: BSD-3-Clause
#include "limber/scene/build/full_bodies.hpp"

#include <fmt/format.h>

#include <map>
#include <string>

#include "limber/common/errors.hpp"
#include "limber/flexbody/file/cache.hpp"
#include "limber/scene/build/recipes.hpp"

namespace limber::scene {
namespace {

void require_mesh(const Scene& scene, const Link& link,
                  const FullMaker& make_full) {
  const auto refuse = [&](const char* why) {
    throw InputError(fmt::format("{}: link '{}': level full needs its mesh; {}",
                                 scene.robot.file.string(), link.name, why));
  };
  if (!link.flexible->reduced_file.empty()) {
    refuse("it comes from a saved reduced body");
  }
  if (!make_full) refuse("this program was built without finite elements");
}

}  // namespace

void add_full_bodies(const Scene& scene, const FullMaker& make_full,
                     BodyPlans& plans) {
  std::map<std::string, FullPointer> known;
  for (BodyPlan& plan : plans.bodies) {
    if (!plan.reduced) continue;
    const int index = plan.links.front();
    const Link& link = scene.robot.links[static_cast<std::size_t>(index)];
    if (scene.scenario.level_of(link.name) != dynamics::Fidelity::full) {
      continue;
    }
    require_mesh(scene, link, make_full);
    const flexbody::Recipe recipe =
        make_recipe(scene.robot, index, scene.scenario);
    const std::string& key = plan.reduced->content_key;
    FullPointer& body = known[key];
    if (!body) body = make_full(recipe, scene.scenario.full, *plan.reduced);
    plan.full = body;
  }
}

}  // namespace limber::scene
