// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <optional>

#include "limber/app/commands/commands.hpp"
#include "limber/app/console/terminal.hpp"
#include "limber/app/options/mesh_options.hpp"
#include "limber/app/options/reducer.hpp"
#include "limber/app/options/shared_options.hpp"
#include "limber/app/options/validators.hpp"
#include "limber/app/reports/mode_table.hpp"
#include "limber/common/errors.hpp"
#include "limber/flexbody/model/unlikely_values.hpp"
#include "limber/scene/build/nodal_forces.hpp"

namespace limber::app {
namespace {

struct ModesOptions {
  MeshOptions mesh;
  std::vector<std::string> clamps;
  std::vector<std::string> forces;
  int count = 10;
  std::optional<int> static_terms;
  std::vector<std::string> interfaces;
  bool json = false;
};

void add_static_modes(const ModesOptions& options, flexbody::Recipe& recipe) {
  const bool has_source =
      !options.forces.empty() || !options.interfaces.empty();
  if (options.static_terms && !has_source) {
    throw InputError(
        "--static lists static-deformation modes; name their source by --force "
        "or --interface");
  }
  if (!options.static_terms && !options.interfaces.empty()) {
    throw InputError("--interface requires --static");
  }
  if (!options.static_terms && options.count == 0) {
    throw InputError("--count is 0; expected 1 or more without --static");
  }
  recipe.basis.terms = options.static_terms.value_or(1);
  for (const std::string& group : options.interfaces) {
    flexbody::InterfaceRequest request;
    request.name = group;
    request.nodes = flexbody::GroupNodes{group};
    recipe.interfaces.push_back(request);
  }
}

void find_modes(const ModesOptions& options) {
  flexbody::Recipe recipe = make_recipe(options.mesh);
  recipe.clamped_groups = options.clamps;
  recipe.basis.eigenmodes = options.count;
  for (const std::string& file : options.forces) {
    recipe.nodal_forces.push_back(scene::read_load_cases(file));
  }
  add_static_modes(options, recipe);
  const flexbody::ModeStudy study = run_mode_study(
      recipe, options.static_terms.has_value(), make_progress_bar());
  clear_progress_bar();
  if (!options.json) print_found(study.found);
  print_warnings(study.notices);
  for (const flexbody::MaterialRegion& region : recipe.materials)
    print_warnings(flexbody::question_material(region));
  print_warnings(flexbody::question_size(study.size, study.mass));
  if (const auto text = describe_locking(study.locking))
    print_warnings({*text});
  if (options.json) {
    fmt::print("{}\n", to_text(to_json(study)));
  } else {
    print_text(study);
  }
}

}  // namespace

void add_modes(CLI::App& app, Action& action) {
  const auto options = std::make_shared<ModesOptions>();
  CLI::App* command = app.add_subcommand(
      "modes",
      "Eigenmodes of a mesh (.msh), geometry (.geo, .step) or of stiffness and "
      "mass matrices, and what each carries of a load or of a clamped body's "
      "base motion");
  add_model_options(*command, options->mesh);
  command->add_option("--clamp", options->clamps,
                      "Group that is fixed; may be repeated");
  command->add_option(
      "--force", options->forces,
      "Force file whose columns are load cases; may be repeated");
  command->add_option("--count", options->count, "Number of elastic modes")
      ->check(make_not_negative());
  command
      ->add_option("--static", options->static_terms,
                   "The whole basis instead: these eigenmodes and the "
                   "static-deformation modes of --force and --interface, with "
                   "so many Krylov terms x, K^+ M x, ... of each")
      ->check(make_positive());
  command->add_option(
      "--interface", options->interfaces,
      "Group whose static-deformation modes --static lists; may be repeated");
  add_json(*command, options->json);
  command->callback(
      [&action, options] { action = [options] { find_modes(*options); }; });
}

}  // namespace limber::app
