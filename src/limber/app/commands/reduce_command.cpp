// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>

#include "limber/app/commands/commands.hpp"
#include "limber/app/console/terminal.hpp"
#include "limber/app/options/mesh_options.hpp"
#include "limber/app/options/mode_options.hpp"
#include "limber/app/options/reducer.hpp"
#include "limber/app/options/shared_options.hpp"
#include "limber/app/options/validators.hpp"
#include "limber/app/reports/describe.hpp"
#include "limber/common/errors.hpp"
#include "limber/flexbody/file/body_file.hpp"
#include "limber/flexbody/model/unlikely_values.hpp"
#include "limber/scene/build/nodal_forces.hpp"
#include "limber/scene/scenario/link_start.hpp"

namespace limber::app {
namespace {

struct ReduceOptions {
  MeshOptions mesh;
  std::string output;
  std::vector<std::string> clamps;
  std::vector<std::string> interfaces;
  ModeOptions modes;
  std::vector<std::string> forces;
  int terms = 1;
  std::string initial_displacement;
  std::string initial_velocity;
  std::vector<std::string> rows = {"boundary"};
  bool manifold = false;
  bool stress = false;
  bool json = false;
};

flexbody::Recipe make_recipe(const ReduceOptions& options) {
  flexbody::Recipe recipe = make_recipe(options.mesh);
  recipe.clamped_groups = options.clamps;
  apply(options.modes, recipe.basis);
  for (const std::string& file : options.forces) {
    recipe.nodal_forces.push_back(scene::read_load_cases(file));
  }
  recipe.basis.terms = options.terms;
  if (options.terms > 1 && options.forces.empty() &&
      options.interfaces.empty()) {
    throw InputError(
        "--terms counts those of static-deformation modes; name their source "
        "by --force or --interface");
  }
  if (options.interfaces.empty() &&
      std::count(options.rows.begin(), options.rows.end(), "interfaces") > 0) {
    throw InputError(
        "--rows interfaces keeps the nodes of --interface; name one, or keep "
        "other rows");
  }
  scene::LinkStart start;
  start.displacement = options.initial_displacement;
  start.velocity = options.initial_velocity;
  add_initial_fields(start, recipe);
  recipe.rows = flexbody::parse_rows(options.rows);
  recipe.manifold = options.manifold;
  recipe.stress = options.stress;
  for (const std::string& group : options.interfaces) {
    flexbody::InterfaceRequest request;
    request.name = group;
    request.nodes = flexbody::GroupNodes{group};
    recipe.interfaces.push_back(request);
  }
  return recipe;
}

void warn(const flexbody::ReducedBody& body) {
  if (const auto text = describe_locking(body.locking)) print_warnings({*text});
  if (body.selection) print_warnings(describe_shortfalls(*body.selection));
  for (const flexbody::LoadModesRecord& record : body.load_modes)
    if (const auto text = describe_left_out(record)) print_warnings({*text});
  if (const auto& field = body.initial.displacement)
    print_warnings(describe_losses(*field, "initial displacement"));
  if (const auto& field = body.initial.velocity)
    print_warnings(describe_losses(*field, "initial velocity"));
}

void print_body_json(const flexbody::ReducedBody& body,
                     const std::vector<std::string>& found,
                     const std::string& file) {
  Json json = Json{{"file", file},
                   {"nodes", body.mesh_nodes},
                   {"modes", body.mode_count()},
                   {"mass", body.mass}};
  if (!found.empty()) json["found"] = found;
  add_choices(body, json);
  fmt::print("{}\n", to_text(json));
}

void print_text(const flexbody::ReducedBody& body, const std::string& file) {
  fmt::print("{} nodes -> {} modes, in {}\n", body.mesh_nodes,
             body.mode_count(), file);
  if (body.selection) fmt::print("{}\n", summarize(*body.selection));
}

void reduce(const ReduceOptions& options) {
  const flexbody::Recipe recipe = make_recipe(options);
  const flexbody::MeshAtHand mesh =
      make_reducer(make_progress_bar()).make_mesh(recipe.mesh);
  const flexbody::ReducedBody body = mesh.reduce(recipe);
  clear_progress_bar();
  if (!options.json) print_found(mesh.record.found);
  print_warnings(mesh.record.notices);
  for (const flexbody::MaterialRegion& region : recipe.materials)
    print_warnings(flexbody::question_material(region));
  print_warnings(flexbody::question_body(body));
  warn(body);
  flexbody::write_body(body, options.output);
  if (options.json) {
    print_body_json(body, mesh.record.found, options.output);
  } else {
    print_text(body, options.output);
  }
}

}  // namespace

void add_reduce(CLI::App& app, Action& action) {
  const auto options = std::make_shared<ReduceOptions>();
  CLI::App* command =
      app.add_subcommand("reduce",
                         "Reduce a mesh, or stiffness and mass matrices, to a "
                         "reduced body that no longer needs them");
  add_model_options(*command, options->mesh);
  command->add_option("--output,-o", options->output, "Reduced body (HDF5)")
      ->required();
  command->add_option("--interface", options->interfaces,
                      "Group that becomes an interface; may be repeated");
  command->add_option("--clamp", options->clamps,
                      "Group that is fixed; may be repeated");
  add_mode_options(*command, "--modes,--eigenmodes", options->modes);
  command->add_option(
      "--force", options->forces,
      "Force file: the static responses to the span of its columns enter the "
      "basis, and with --modes auto they are the load cases; may be repeated");
  command
      ->add_option("--terms", options->terms,
                   "Terms x, K^+ M x, ... of each static-deformation mode (1)")
      ->check(make_positive());
  command->add_option("--initial-displacement", options->initial_displacement,
                      "Nodal field that the body starts with: a row for each "
                      "free degree of freedom [m]");
  command->add_option("--initial-velocity", options->initial_velocity,
                      "The same for its rate [m/s]");
  command->add_option("--rows", options->rows,
                      "Nodes to keep: all, boundary (default), interfaces, or "
                      "groups by name; may be repeated");
  command->add_flag("--second-order", options->manifold,
                    "With the tables that level nonlinear needs");
  command->add_flag("--stress", options->stress,
                    "With stress modes at the nodes kept, for probes of "
                    "stress");
  add_json(*command, options->json);
  command->callback(
      [&action, options] { action = [options] { reduce(*options); }; });
}

}  // namespace limber::app
