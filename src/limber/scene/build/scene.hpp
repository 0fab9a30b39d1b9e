// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "limber/common/pose.hpp"
#include "limber/dynamics/integrators/integrator_kind.hpp"
#include "limber/dynamics/system/fidelity.hpp"
#include "limber/dynamics/system/indices.hpp"
#include "limber/flexbody/model/recipe.hpp"
#include "limber/scene/contacts/touching_pairs.hpp"
#include "limber/scene/robot/robot.hpp"
#include "limber/scene/scenario/scenario.hpp"
#include "limber/scene/text/setting.hpp"

namespace limber::scene {

/// Values of the command line that override the file's.
struct Overrides {
  /// Keys of the scenario and the robot; the values below override them.
  std::vector<Setting> settings = {};
  std::optional<dynamics::Fidelity> fidelity = {};  ///< for every flexible link
  /// Overrides the file's [basis] for every flexible link, key by key.
  BasisChoice basis = {};
  /// Fixed step from the start to the end, in place of the file's steps or
  /// tolerance [s]. Output times remain those of the file.
  std::optional<double> step = {};
  std::optional<dynamics::IntegratorKind> integrator = {};
  std::optional<flexbody::KeptRows> rows = {};  ///< of every link with a mesh
};

/// A scenario and its robot. The scenario's choice of bases, its projectiles
/// and the surfaces that its contacts need are already the robot's.
struct Scene {
  Scenario scenario;
  Robot robot;
  std::vector<TouchingPair> touching = {};
  Overrides overrides = {};  ///< of the files; recorded in results
};

/// Body and frame of a robot's link in the system, for pictures.
struct PlacedLink {
  dynamics::BodyIndex body = dynamics::kWorld;
  Pose X_BL;  ///< link frame in the body's; of the world: in the world's
};

}  // namespace limber::scene
