// SPDX-License-Identifier: BSD-3-Clause
#include "limber/app/commands/verify_command.hpp"

#include <CLI/CLI.hpp>
#include <memory>

#include "limber/app/options/list_option.hpp"
#include "limber/app/options/shared_options.hpp"
#include "limber/app/options/validators.hpp"

namespace limber::app {

void add_verify(CLI::App& app, Action& action, const Verify& verify) {
  const auto options = std::make_shared<VerifyOptions>();
  CLI::App* command = app.add_subcommand(
      "verify", "Compare the level `rigid` with Simbody, body by body");
  add_scenario(*command, options->scenario);
  command->add_option(
      "--joints", options->joints,
      "Model of joints in Simbody: bushings (default), linear-bushings, ideal");
  command->add_option("--step", options->step, "Longest step of Limber [s]")
      ->check(make_positive());
  command->add_option("--duration", options->duration, "End of both runs [s]")
      ->check(make_positive());
  command
      ->add_option("--integrator", options->integrator,
                   "Ours: generalized-alpha, runge-kutta-4, explicit-euler")
      ->type_name("INTEGRATOR");
  command->add_option("--accuracy", options->accuracy,
                      "Of Simbody's integrator (default 1e-12)");
  command
      ->add_option("--refine", options->refine,
                   "Number of times to halve Limber's step, which shows the "
                   "order of convergence")
      ->check(CLI::Range(0, 20));
  add_list(*command, "--stiffen", options->stiffen,
           "Factors of the stiffness of all joints, for example 1,10,100: "
           "convergence to Simbody's ideal joints",
           make_positive());
  command->add_option("--out", options->out,
                      "Folder for verification.json and, with --stiffen, "
                      "stiffness.png (default: none)");
  add_cache_option(*command, options->cache);
  add_robot_options(*command, options->robots);
  add_json(*command, options->json);
  command->callback([&action, options, verify] {
    action = [options, verify] { verify(*options); };
  });
}

}  // namespace limber::app
