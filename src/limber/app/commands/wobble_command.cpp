// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <memory>

#include "limber/app/commands/commands.hpp"
#include "limber/app/console/interruption.hpp"
#include "limber/app/options/mode_options.hpp"
#include "limber/app/options/shared_options.hpp"
#include "limber/app/options/validators.hpp"
#include "limber/app/run/output_folder.hpp"
#include "limber/app/run/run_scene.hpp"
#include "limber/common/errors.hpp"
#include "limber/scene/robot/akantu_material.hpp"

namespace limber::app {
namespace {

struct WobbleOptions {
  std::string mesh;
  std::string material;
  std::string force;
  double size = 0.0;
  int order = 0;
  double unit = 0.0;
  ModeOptions modes;
  double step = 0.0;
  double duration = 0.0;
  std::string solver = "CoupledRB";
  std::string integrator;
  std::vector<std::string> clamps;
  std::string initial_displacement;
  std::string initial_velocity;
  std::vector<int> nodes;
  std::string out;
  std::string cache;
  bool json = false;
  bool xdmf = false;
};

scene::Robot make_robot(const WobbleOptions& options) {
  scene::FlexibleLink flexible;
  flexible.mesh = {options.mesh, options.size, options.order, options.unit};
  flexible.materials = scene::read_akantu_materials(options.material);
  apply(options.modes, flexible.basis);
  flexible.basis.interface_modes = false;
  flexible.basis.load_modes = false;
  flexible.clamped_groups = options.clamps;
  scene::Robot robot;
  robot.name = flexible.mesh.file.stem().string();
  robot.file = options.mesh;
  robot.links = {{robot.name, {}, flexible}};
  return robot;
}

/// PureMA: a body that must be clamped; SimpleRB and CoupledRB: one that is
/// free.
dynamics::Fidelity find_level(const WobbleOptions& options) {
  const bool is_pure = options.solver == "PureMA";
  if (is_pure == options.clamps.empty()) {
    throw InputError(fmt::format(
        "--solver {} {}", options.solver,
        is_pure ? "has no rigid motion: name the held groups with --clamp"
                : "moves freely: drop --clamp, or use --solver PureMA"));
  }
  return options.solver == "CoupledRB" ? dynamics::Fidelity::coupled
                                       : dynamics::Fidelity::uncoupled;
}

std::vector<double> find_output_times(double step, double duration) {
  constexpr double kMostOutputs = 1e7;  // they are kept in memory
  if (!(duration / step <= kMostOutputs)) {
    throw InputError(
        fmt::format("--step {:g} s needs {:.3g} steps until {:g} s, each an "
                    "output; at most {:g} can be stored",
                    step, duration / step, duration, kMostOutputs));
  }
  std::vector<double> times;
  const auto count = static_cast<long>(std::ceil(duration / step - 1e-9));
  for (long i = 0; i < count; ++i) {
    times.push_back(static_cast<double>(i) * step);
  }
  times.push_back(duration);
  return times;
}

scene::Scenario make_scenario(const WobbleOptions& options,
                              const std::string& link) {
  scene::Scenario scenario;
  scenario.name = link;
  scenario.file = options.force;
  scenario.settings.end_time = options.duration;
  scenario.settings.step = options.step;
  if (!options.integrator.empty()) {
    scenario.settings.integrator =
        dynamics::parse_integrator(options.integrator);
  }
  scenario.settings.output_times =
      find_output_times(options.step, options.duration);
  scenario.fidelity = find_level(options);
  scene::LoadSpec load;
  load.name = "force";
  load.where.link = link;
  load.nodal_forces = options.force;
  scenario.loads = {load};
  if (!options.initial_displacement.empty() ||
      !options.initial_velocity.empty()) {
    scenario.link_starts[link] = {
        {}, {}, options.initial_displacement, options.initial_velocity};
  }
  for (const int tag : options.nodes) {
    scene::PointProbeSpec probe;
    probe.where.link = link;
    probe.where.nodes = flexbody::TaggedNode{static_cast<std::size_t>(tag)};
    scenario.probes.push_back({fmt::format("node_{}", tag), probe});
  }
  return scenario;
}

void wobble(const WobbleOptions& options) {
  scene::Scene scene;
  scene.robot = make_robot(options);
  scene.scenario = make_scenario(options, scene.robot.name);
  const OutputFolder folder(
      find_results_folder(options.out, scene.scenario.name));
  DeferredSignals signals;
  const runs::Run result = run_scene(scene, options.cache, {}, &signals);
  folder.write([&](const std::filesystem::path& place) {
    write_run(result, place, options.xdmf);
  });
  finish_run(result, folder, options.json);
}

}  // namespace

void add_wobble(CLI::App& app, Action& action) {
  const auto options = std::make_shared<WobbleOptions>();
  CLI::App* command = app.add_subcommand(
      "wobble", "Simulate one body from the WOBBLE package's input files");
  command->add_option("--mesh", options->mesh, "Mesh (.msh) or geometry (.geo)")
      ->required();
  command->add_option("--material", options->material, "Akantu material file")
      ->required();
  command
      ->add_option("--force", options->force,
                   "Force file: times, then a row for each free degree of "
                   "freedom")
      ->required();
  command->add_option("--step", options->step, "Time step [s]")
      ->required()
      ->check(make_positive());
  command->add_option("--duration", options->duration, "Duration [s]")
      ->required()
      ->check(make_positive());
  add_mode_options(*command, "--modes", options->modes);
  command
      ->add_option("--solver", options->solver, "PureMA, SimpleRB, CoupledRB")
      ->check(CLI::IsMember({"PureMA", "SimpleRB", "CoupledRB"}));
  command
      ->add_option("--integrator", options->integrator,
                   "generalized-alpha (default), runge-kutta-4, or "
                   "explicit-euler, the package's own")
      ->type_name("INTEGRATOR");
  command->add_option("--clamp", options->clamps,
                      "Group that is fixed; may be repeated");
  command->add_option("--initial-displacement", options->initial_displacement,
                      "Nodal field at the start: a row for each free degree "
                      "of freedom [m]");
  command->add_option("--initial-velocity", options->initial_velocity,
                      "The same for its rate [m/s]");
  command->add_option("--node", options->nodes,
                      "Node to follow, by its tag; may be repeated");
  command->add_option("--size", options->size,
                      "Element size when meshing geometry [mesh units]");
  command->add_option("--order", options->order,
                      "Element order when meshing geometry: 1, 2 or 3");
  add_unit(*command, options->unit);
  add_out(*command, options->out, "<mesh name>");
  add_cache_option(*command, options->cache);
  add_json(*command, options->json);
  command->add_flag("--xdmf", options->xdmf, "Write files for ParaView");
  command->callback(
      [&action, options] { action = [options] { wobble(*options); }; });
}

}  // namespace limber::app
