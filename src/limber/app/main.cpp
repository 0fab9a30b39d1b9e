// SPDX-License-Identifier: BSD-3-Clause
#include "limber/app/commands/commands.hpp"
#include "limber/app/commands/verify_command.hpp"
#include "limber/app/console/command_line.hpp"
#include "limber/app/run/verifier.hpp"

int main(int argc, char** argv) {
  using namespace limber::app;
  return run_command_line(argc, argv, [argv](CLI::App& app, Action& action) {
    add_run(app, action);
    add_advise(app, action);
    add_check(app, action);
    add_explain(app, action);
    add_compare(app, action);
    add_study(app, action);
    add_verify(app, action,
               [argv](const VerifyOptions&) { become_verifier(argv); });
    add_modes(app, action);
    add_frequencies(app, action);
    add_linearize(app, action);
    add_static(app, action);
    add_operate(app, action);
    add_reduce(app, action);
    add_info(app, action);
    add_view(app, action);
    add_export(app, action);
    add_wobble(app, action);
    add_cache(app, action);
    add_schema(app, action);
    add_ship(app, action);
  });
}
