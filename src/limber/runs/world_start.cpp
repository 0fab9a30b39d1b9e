// SPDX-License-Identifier: BSD-3-Clause
#include "limber/runs/world_start.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>
#include <vector>

#include "limber/common/errors.hpp"
#include "limber/common/index.hpp"
#include "limber/common/names.hpp"
#include "limber/dynamics/equations/joint_state.hpp"
#include "limber/dynamics/equations/pair_forces.hpp"
#include "limber/dynamics/monitors/rounding_limit.hpp"
#include "limber/joints/pairs/touching.hpp"
#include "limber/scene/build/body_plan.hpp"
#include "limber/scene/build/link_motion.hpp"
#include "limber/scene/contacts/start_overlap.hpp"

namespace limber::runs {
namespace {

void check_finite(const std::string& whose, std::span<const double> values) {
  const auto bad = std::find_if(values.begin(), values.end(),
                                [](double x) { return !std::isfinite(x); });
  if (bad == values.end()) return;
  throw InputError(fmt::format(
      "start of {}: {} is not a valid start value; expected a finite number",
      whose, *bad));
}

/// Replaces what is given, if anything.
void replace(const std::string& whose, const std::vector<double>& given,
             std::vector<double>& value) {
  check_finite(whose, given);
  if (!given.empty()) value = given;
}

void replace(const std::string& whose, const std::optional<Vector3>& given,
             Vector3& value) {
  if (!given) return;
  check_finite(whose, {given->data(), 3});
  value = *given;
}

scene::BodyStart& find_free(const std::string& name,
                            scene::Scenario& scenario) {
  if (name == "base") return scenario.base;
  std::vector<std::string> known = {"base"};
  for (scene::ProjectileSpec& projectile : scenario.projectiles) {
    if (projectile.name == name) return projectile.start;
    known.push_back(projectile.name);
  }
  throw InputError(describe_unknown("free body", name, known));
}

scene::Scenario change(const scene::Scenario& scenario,
                       const WorldStart& start) {
  scene::Scenario changed = scenario;
  for (const auto& [name, given] : start.joints) {
    const std::string whose = fmt::format("joint '{}'", name);
    scene::JointStart& own = changed.joints[name];
    replace(whose, given.position, own.position);
    replace(whose, given.velocity, own.velocity);
  }
  for (const auto& [name, given] : start.bodies) {
    const std::string whose = fmt::format("body '{}'", name);
    scene::BodyStart& own = find_free(name, changed);
    replace(whose, given.position, own.position);
    replace(whose, given.orientation_rpy, own.orientation_rpy);
    replace(whose, given.velocity, own.velocity);
    replace(whose, given.angular_velocity, own.angular_velocity);
  }
  return changed;
}

double find_size(const dynamics::SystemModel& model,
                 dynamics::BodyIndex index_of_it) {
  if (index_of_it == dynamics::kWorld) return kInfinity;
  const dynamics::BodyModel& body = model.bodies[index(index_of_it)];
  return body.reduced ? body.reduced->size.norm()
                      : std::sqrt(2.0 * body.J0.trace() / body.mass);
}

/// All pairs that may touch. They may overlap as far as at the scenario's
/// start, or by a fraction of the smaller body.
std::vector<scene::PlacedPair> list_contacts(const scene::BuiltScene& built) {
  constexpr double kMostFraction = 1e-4;  // of the smaller body's size [-]
  std::vector<scene::PlacedPair> contacts;
  for (std::size_t i = 0; i < built.model.pairs.size(); ++i) {
    const dynamics::Pair& pair = built.model.pairs[i];
    if (pair.law->touching() == nullptr) continue;
    joints::PairResponse scratch = dynamics::make_response(built.model, pair);
    const dynamics::PairMotion motion =
        dynamics::find_pair_motion(built.model, pair, built.initial);
    const double depth =
        pair.law->touching()->find_touch(motion.bodies(), scratch).depth;
    const double size = std::min(find_size(built.model, pair.body_A),
                                 find_size(built.model, pair.body_B));
    contacts.push_back({.name = pair.name,
                        .most_overlap = std::max(depth, kMostFraction * size),
                        .pair = dynamics::PairIndex(i)});
  }
  return contacts;
}

void check_movable(const scene::Scene& scene, const scene::BuiltScene& built) {
  if (scene.scenario.equilibrium) {
    throw InputError(
        "a scenario that starts in equilibrium does not support other starts: "
        "remove 'equilibrium' of [initial], or start all worlds there");
  }
  if (built.model.nodal_count > 0) {
    throw InputError(
        "a scenario with a body at level 'full' does not support other starts; "
        "choose another level, or start all worlds as it does");
  }
}

}  // namespace

dynamics::SystemState find_start(const scene::Scene& scene,
                                 const scene::BuiltScene& built,
                                 const WorldStart& start,
                                 std::vector<std::string>& notices) {
  if (start.is_empty()) return built.initial;
  check_movable(scene, built);
  const scene::Scenario changed = change(scene.scenario, start);
  dynamics::SystemState state = built.initial;
  const scene::BodyPlans plans = scene::plan_bodies(
      scene.robot, scene::find_reduced(scene.robot, built.model));
  scene::follow_links(scene::find_placed_bodies(plans),
                      scene::find_link_motions(scene.robot, changed), state);
  dynamics::store_turns(built.model,
                        scene::find_joint_starts(scene.robot, changed), state);
  dynamics::check_rounding(built.model, state);
  for (std::string& notice :
       scene::check_overlaps(list_contacts(built), built.model, state)) {
    notices.push_back(std::move(notice));
  }
  return state;
}

}  // namespace limber::runs
