// SPDX-License-Identifier: BSD-3-Clause
#include <CLI/CLI.hpp>
#include <memory>
#include <string>
#include <vector>

#include "limber/app/commands/commands.hpp"
#include "limber/app/options/reducer.hpp"
#include "limber/app/options/shared_options.hpp"
#include "limber/flexbody/file/shipped_mesh.hpp"
#include "limber/scene/build/load_scene.hpp"
#include "limber/scene/build/reductions.hpp"

namespace limber::app {
namespace {

struct ShipOptions {
  std::string cache;
  std::string folder;
  std::vector<std::string> scenarios;
};

void ship(const ShipOptions& options) {
  const scene::Reducer reducer = make_reducer({});
  const auto make_mesh = [&](const flexbody::MeshSource& source) {
    flexbody::MeshAtHand mesh = reducer.make_mesh(source);
    (void)flexbody::ship_mesh_record(mesh.record, source, options.folder);
    return mesh;
  };
  for (const std::string& scenario : options.scenarios) {
    (void)scene::find_reductions(scene::load_scene(scenario, {}),
                                 {reducer.mesher, make_mesh}, options.cache);
  }
}

}  // namespace

void add_ship(CLI::App& app, Action& action) {
  const auto options = std::make_shared<ShipOptions>();
  CLI::App* command = app.add_subcommand(
      "__ship", "Reduce the bodies of the scenarios that ship with Limber");
  command->group("");  // for scripts/package, in no help
  add_cache_option(*command, options->cache)->required();
  command->add_option("folder", options->folder)->required();
  command->add_option("scenarios", options->scenarios)->required();
  command->callback(
      [&action, options] { action = [options] { ship(*options); }; });
}

}  // namespace limber::app
