// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <numbers>

#include "app/commands.hpp"
#include "app/json.hpp"
#include "app/mesh_options.hpp"
#include "app/reducer.hpp"
#include "app/terminal.hpp"

namespace limber::app {
namespace {

struct Options {
  MeshOptions mesh;
  std::vector<std::string> clamps;
  int count = 10;
  bool json = false;
};

VectorX frequencies(const flexbody::ReducedBody& body) {
  return body.lambda.cwiseMax(0.0).cwiseSqrt() / (2.0 * std::numbers::pi);
}

void print_json(const flexbody::ReducedBody& body) {
  const Json json = Json{{"nodes", body.mesh_nodes},
                         {"elements", body.mesh_elements},
                         {"boundary_nodes", body.mesh_boundary_nodes},
                         {"clamped", body.clamped},
                         {"mass", body.mass},
                         {"center_of_mass", to_json(body.p_MoBcm_M)},
                         {"inertia", to_json(body.inertia())},
                         {"eigenvalues", to_json(body.lambda)},
                         {"frequencies_hz", to_json(frequencies(body))}};
  fmt::print("{}\n", to_text(json));
}

void print_text(const flexbody::ReducedBody& body) {
  const Vector3& c = body.p_MoBcm_M;
  fmt::print("{} nodes ({} on the boundary), {} elements\n", body.mesh_nodes,
             body.mesh_boundary_nodes, body.mesh_elements);
  fmt::print("mass {:.6g} kg, centre of mass ({:.6g}, {:.6g}, {:.6g}) m\n",
             body.mass, c.x(), c.y(), c.z());
  const VectorX hz = frequencies(body);
  fmt::print("{:>5} {:>16} {:>16}\n", "mode", "frequency [Hz]",
             "eigenvalue [1/s^2]");
  for (Eigen::Index i = 0; i < hz.size(); ++i) {
    fmt::print("{:>5} {:>16.8g} {:>16.10g}\n", i + 1, hz[i], body.lambda[i]);
  }
}

void find_modes(const Options& options) {
  flexbody::Recipe recipe = make_recipe(options.mesh);
  recipe.clamped_groups = options.clamps;
  recipe.basis.eigenmodes = options.count;
  recipe.rows = flexbody::parse_rows({"interfaces"});
  const flexbody::ReducedBody body = make_reducer(make_progress_bar())(recipe);
  clear_progress_bar();
  if (options.json) {
    print_json(body);
  } else {
    print_text(body);
  }
}

}  // namespace

void add_modes(CLI::App& app, Action& action) {
  const auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand(
      "modes", "Eigenfrequencies of a mesh (.msh) or geometry (.geo, .step)");
  add_mesh_options(*command, options->mesh);
  command->add_option("--clamp", options->clamps,
                      "Group that is fixed; may be given again");
  command->add_option("--count", options->count, "Number of elastic modes")
      ->check(CLI::PositiveNumber);
  command->add_flag("--json", options->json, "Print one JSON object");
  command->callback(
      [&action, options] { action = [options] { find_modes(*options); }; });
}

}  // namespace limber::app
