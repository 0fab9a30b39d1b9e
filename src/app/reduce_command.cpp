// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <memory>

#include "app/commands.hpp"
#include "app/json.hpp"
#include "app/mesh_options.hpp"
#include "app/reducer.hpp"
#include "app/terminal.hpp"
#include "flexbody/body_file.hpp"

namespace limber::app {
namespace {

struct Options {
  MeshOptions mesh;
  std::string output;
  std::vector<std::string> clamps;
  std::vector<std::string> interfaces;
  int eigenmodes = 10;
  std::vector<std::string> rows = {"boundary"};
  bool json = false;
};

void reduce(const Options& options) {
  flexbody::Recipe recipe = make_recipe(options.mesh);
  recipe.clamped_groups = options.clamps;
  recipe.basis.eigenmodes = options.eigenmodes;
  recipe.rows = flexbody::parse_rows(options.rows);
  for (const std::string& group : options.interfaces) {
    flexbody::InterfaceRequest request;
    request.name = group;
    request.nodes = flexbody::GroupNodes{group};
    recipe.interfaces.push_back(request);
  }
  const flexbody::ReducedBody body = make_reducer(make_progress_bar())(recipe);
  clear_progress_bar();
  flexbody::write_body(body, options.output);
  if (options.json) {
    const Json json = Json{{"file", options.output},
                           {"nodes", body.mesh_nodes},
                           {"modes", body.mode_count()},
                           {"mass", body.mass}};
    fmt::print("{}\n", to_text(json));
  } else {
    fmt::print("{} nodes -> {} modes, in {}\n", body.mesh_nodes,
               body.mode_count(), options.output);
  }
}

}  // namespace

void add_reduce(CLI::App& app, Action& action) {
  const auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand(
      "reduce", "Reduce a mesh to a body that needs no mesh any more");
  add_mesh_options(*command, options->mesh);
  command->add_option("--output,-o", options->output, "Reduced body (HDF5)")
      ->required();
  command->add_option("--interface", options->interfaces,
                      "Group that becomes an interface; may be given again");
  command->add_option("--clamp", options->clamps,
                      "Group that is fixed; may be given again");
  command->add_option("--eigenmodes", options->eigenmodes, "Eigenmodes kept")
      ->check(CLI::NonNegativeNumber);
  command->add_option("--rows", options->rows,
                      "Nodes to keep: all, boundary (default), interfaces, or "
                      "groups by name; may be given again");
  command->add_flag("--json", options->json, "Print one JSON object");
  command->callback(
      [&action, options] { action = [options] { reduce(*options); }; });
}

}  // namespace limber::app
