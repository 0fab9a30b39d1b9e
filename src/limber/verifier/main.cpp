// SPDX-License-Identifier: BSD-3-Clause
// limber-verify: runs in place of `limber verify` with the same command
// line. It alone links Simbody, so that `limber` starts without.
#include "limber/app/commands/verify_command.hpp"
#include "limber/app/console/command_line.hpp"
#include "limber/verifier/verify.hpp"

int main(int argc, char** argv) {
  using namespace limber::app;
  return run_command_line(argc, argv, [](CLI::App& app, Action& action) {
    add_verify(app, action, verify);
  });
}
