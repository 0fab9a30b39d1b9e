// SPDX-License-Identifier: BSD-3-Clause
#include "limber/app/run/scene_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "limber/app/options/reducer.hpp"
#include "limber/app/reports/silent_parts.hpp"
#include "limber/app/run/cost_check.hpp"
#include "limber/app/run/unstable_loop.hpp"
#include "limber/common/index.hpp"
#include "limber/dynamics/analysis/coupler_frequencies.hpp"
#include "limber/dynamics/analysis/natural_frequencies.hpp"
#include "limber/dynamics/integrators/stable_step.hpp"
#include "limber/scene/scenario/time_settings_reader.hpp"

namespace limber::app {
namespace {

BodyCheck check_body(const dynamics::BodyModel& body) {
  BodyCheck check{body.name, body.fidelity, body.mass, body.modes, {}};
  if (body.modes == 0) return check;
  const auto to_hertz = [](double lambda) {
    return std::sqrt(std::max(lambda, 0.0)) / (2.0 * std::numbers::pi);
  };
  const VectorX lambda = flexbody::rest_stiffness(body.elasticity);
  check.frequencies = {to_hertz(lambda.minCoeff()),
                       to_hertz(lambda.maxCoeff())};
  return check;
}

void check_frequencies(const scene::BuiltScene& built, SceneCheck& check) {
  const dynamics::SystemModel& model = built.model;
  const Eigen::Index unknowns =
      6 * std::ssize(model.bodies) + model.modal_count;
  if (!model.full_bodies.empty() || unknowns > SceneCheck::kMostUnknowns) {
    return;
  }
  const auto count =
      std::ssize(model.couplers) + std::ssize(model.transmissions);
  const dynamics::SmallMotion motion =
      dynamics::find_small_motion(model, built.initial);
  if (motion.size() == 0) return;
  const VectorX fastest = dynamics::find_coupler_frequencies(motion, count);
  Eigen::Index i = 0;
  for (const dynamics::Coupler& coupler : model.couplers) {
    const double frequency = fastest[i++];
    if (joints::is_ideal(coupler.law)) continue;
    check.joints.push_back({coupler.name, frequency});
  }
  for (const dynamics::Transmission& line : model.transmissions) {
    check.joints.push_back({line.name, fastest[i++]});
  }
  check.frequencies = dynamics::find_natural_frequencies(model, built.initial);
}

bool has_stiffness(const dynamics::CouplerOptions& options) {
  return options.translational_stiffness && options.rotational_stiffness;
}

void add_choices(const scene::Scene& scene, const scene::BuiltScene& built,
                 SceneCheck& check) {
  std::vector<std::string>& choices = check.choices;
  if (check.is_tolerance_chosen) {
    choices.push_back(fmt::format(
        "tolerance {:.3g} m: 1e-4 of the smallest group's largest body, as the "
        "scenario gives neither step nor tolerance",
        check.settings.tolerance));
  }
  std::size_t joints = 0;
  std::size_t unset = 0;
  std::size_t ideal = 0;
  for (const scene::Joint& joint : scene.robot.joints) {
    if (scene::merges(scene.robot, joint) ||
        joint.kind == joints::JointKind::floating) {
      continue;
    }
    ++joints;
    if (joint.coupler.is_ideal.value_or(false)) {
      ++ideal;
    } else if (!has_stiffness(joint.coupler)) {
      ++unset;
    }
  }
  if (ideal > 0) {
    choices.push_back(fmt::format(
        "{} of {} joints are ideal: they do not deflect in a run; in statics, "
        "frequencies and linear models they have {:g} times the stiffness of "
        "a flexible side, or {:g} Hz of two rigid ones",
        ideal, joints, dynamics::kIdealStiffnessRatio,
        dynamics::kRigidFrequency));
  }
  if (unset > 0) {
    choices.push_back(fmt::format(
        "stiffness of {} of {} joints by their bodies, as none is given: {:g} "
        "times that of a flexible side, or {:g} Hz of two rigid ones",
        unset, joints, dynamics::kStiffnessRatio, dynamics::kRigidFrequency));
  }
  for (const dynamics::BodyModel& body : built.model.bodies) {
    if (!body.reduced || !body.reduced->selection) continue;
    choices.push_back(fmt::format("modes of '{}': {}", body.name,
                                  summarize(*body.reduced->selection)));
  }
  choices.insert(choices.end(), built.notes.begin(), built.notes.end());
}

std::optional<double> find_stable_limit(const scene::BuiltScene& built) {
  const dynamics::IntegratorKind scheme = built.settings.integrator;
  if (traits_of(scheme).limit == dynamics::StepLimit::none) return std::nullopt;
  const double step =
      dynamics::find_stable_step(built.model, built.initial, scheme);
  if (!std::isfinite(step)) return std::nullopt;
  return step;
}

}  // namespace

SceneCheck check_scene(const scene::Scene& scene,
                       const std::filesystem::path& cache,
                       const Progress& progress) {
  const runs::PicturedScene pictured =
      runs::build_pictured(scene, make_reductions(cache, progress));
  const scene::BuiltScene& built = pictured.built;
  SceneCheck check;
  check.scenario = scene.scenario.file.string();
  check.settings = built.settings;
  check.start = built.initial.t;
  check.is_tolerance_chosen =
      scene.scenario.settings.tolerance == scene::kToleranceToChoose;
  for (const dynamics::BodyModel& body : built.model.bodies) {
    check.bodies.push_back(check_body(body));
    check.mass += body.mass;
  }
  check_frequencies(built, check);
  const std::vector<StartTouch> touches = find_start_touches(built);
  for (const StartTouch& start : touches) {
    check.contacts.push_back({start.pair->name, start.gap});
  }
  check.stable_step = find_stable_limit(built);
  check.silent = find_silent_parts(scene, built, touches);
  for (const dynamics::ControllerModel& controller : built.model.controllers) {
    check.controllers.push_back({controller.name, controller.period});
  }
  check.warnings = built.warnings;
  if (auto unstable = find_unstable_loop(scene, built, progress)) {
    check.warnings.push_back(std::move(*unstable));
  }
  add_choices(scene, built, check);
  check.cost = check_cost(pictured);
  const std::string& failure = check.cost.pace.failure;
  if (!failure.empty()) {
    check.problems.push_back("the first steps fail: " + failure);
  }
  return check;
}

}  // namespace limber::app
