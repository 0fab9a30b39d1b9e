// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "limber/dynamics/integrators/simulation_settings.hpp"
#include "limber/dynamics/system/system_model.hpp"
#include "limber/dynamics/system/system_state.hpp"
#include "limber/scene/build/assembly.hpp"
#include "limber/scene/build/full_bodies.hpp"
#include "limber/scene/build/reductions.hpp"
#include "limber/scene/build/scene.hpp"
#include "limber/scene/probes/probe.hpp"

namespace limber::scene {

/// Bands of frequencies in which loss factors hold, and of what.
struct KnownBands {
  std::string system;  ///< as text, without `bodies`
  std::vector<std::shared_ptr<const flexbody::ReducedBody>> bodies;
  ElasticBands bands;
};

/// What one scene can take from others.
struct KnownParts {
  KnownBodies bodies;
  std::vector<KnownBands> bands;  ///< of the last few, the newest first
};

/// A scene, ready to be simulated.
struct BuiltScene {
  dynamics::SystemModel model;
  dynamics::SystemState initial;
  dynamics::SimulationSettings settings;
  std::vector<Probe> probes;
  std::vector<PlacedLink> links;  ///< one per link of the robot
  std::vector<std::string> warnings;
  /// Notices for the user: the scenario's, then those of building it.
  std::vector<std::string> notes;
  std::vector<flexbody::PieceCheck> piece_checks;  ///< of links in pieces
  KnownParts known;                                ///< given, and made for it
  int bodies_reduced = 0;        ///< number of reductions done now
  int bodies_cached = 0;         ///< number of reductions from the cache
  double seconds_offline = 0.0;  ///< total wall time [s]
};

/// Reduces the flexible links (equal ones once, known ones from `cache`),
/// builds the system and finds its initial state: body frames from the
/// joint coordinates of the undeformed links, velocities consistent with
/// the joints' rates, and flexible links deformed as the scenario
/// specifies; or, if requested, the static equilibrium near that. Bodies in
/// contact must not overlap deeply there. Couplers are unstressed in the
/// undeformed configuration. `make_full` is needed only for links at level
/// `full`.
/// @param known from other scenes; its bodies take precedence over the cache
/// for equal recipes
/// @throws InputError naming the link, joint, load or probe; both errors as
/// dynamics::find_equilibrium.
[[nodiscard]] BuiltScene build_system(const Scene& scene,
                                      const Reducer& reducer,
                                      const std::filesystem::path& cache,
                                      const FullMaker& make_full = {},
                                      const KnownParts& known = {});

}  // namespace limber::scene
