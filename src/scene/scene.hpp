// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "dynamics/simulation.hpp"
#include "dynamics/system_model.hpp"
#include "dynamics/system_state.hpp"
#include "flexbody/cache.hpp"
#include "flexbody/full_body.hpp"
#include "flexbody/recipe.hpp"
#include "flexbody/reduced_body.hpp"
#include "scene/probe.hpp"
#include "scene/robot.hpp"
#include "scene/scenario.hpp"

namespace limber::scene {

/// A scenario and the robot that it names. The scenario's choice of bases is
/// in the robot's links.
struct Scene {
  Scenario scenario;
  Robot robot;
};

/// What the command line puts in place of the file's word.
struct Overrides {
  std::optional<dynamics::Fidelity> fidelity = {};  ///< for every flexible link
  /// Over the file's [basis] for every flexible link, key by key.
  BasisChoice basis = {};
  /// Fixed step from the start to the end, in place of the file's steps or
  /// tolerance [s]. Output times stay those that the file asks for.
  std::optional<double> step = {};
  std::optional<dynamics::IntegratorKind> integrator = {};
  std::optional<flexbody::KeptRows> rows = {};  ///< of every link with a mesh
};

/// Reads the scenario and its robot, and checks one against the other.
/// @throws InputError with every problem found.
[[nodiscard]] Scene load_scene(const std::filesystem::path& file,
                               const Overrides& overrides = {});

/// Makes meshes and reduced bodies; usually flexbody::make_reducer.
using Reducer = flexbody::Reducer;

/// Makes a body without reduction; usually flexbody::make_full_body.
/// @param key content key of the reduced body that it goes with
using FullMaker = std::function<std::shared_ptr<const flexbody::FullBody>(
    const flexbody::Recipe&, const flexbody::FullOptions&,
    const std::string& key)>;

/// Reduced bodies that are at hand, by flexbody::recipe_key.
using KnownBodies =
    std::map<std::string, std::shared_ptr<const flexbody::ReducedBody>>;

/// A scene, ready to be simulated.
struct BuiltScene {
  dynamics::SystemModel model;
  dynamics::SystemState initial;
  dynamics::SimulationSettings settings;
  std::vector<Probe> probes;
  std::vector<std::string> warnings;
  KnownBodies known;             ///< all that were reduced or cached
  int bodies_reduced = 0;        ///< reductions done now
  int bodies_cached = 0;         ///< reductions taken from the cache
  double seconds_offline = 0.0;  ///< wall time of all of it [s]
};

/// Reduces the flexible links (equal ones once, known ones from `cache`), puts
/// the system together and finds its initial state: body frames where the
/// joints put the undeformed links, with velocities that agree with the joints'
/// rates, and flexible links deformed as the scenario says; or, if it asks, the
/// static equilibrium near there. Couplers rest in the undeformed
/// configuration. `make_full` is needed for links at level
/// `full` alone.
/// @param known is taken for an equal recipe, whatever the cache holds
/// @throws InputError naming the link, joint, load or probe; both errors as
/// dynamics::find_equilibrium.
[[nodiscard]] BuiltScene build_system(const Scene& scene,
                                      const Reducer& reducer,
                                      const std::filesystem::path& cache,
                                      const FullMaker& make_full = {},
                                      const KnownBodies& known = {});

}  // namespace limber::scene
