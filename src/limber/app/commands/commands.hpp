// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/app/console/command_line.hpp"

namespace limber::app {

/// Each adds its subcommand to `app`; choosing it sets `action`.
void add_run(CLI::App& app, Action& action);
void add_advise(CLI::App& app, Action& action);
void add_check(CLI::App& app, Action& action);
void add_explain(CLI::App& app, Action& action);
void add_compare(CLI::App& app, Action& action);
void add_linearize(CLI::App& app, Action& action);
void add_modes(CLI::App& app, Action& action);
void add_frequencies(CLI::App& app, Action& action);
void add_static(CLI::App& app, Action& action);
void add_operate(CLI::App& app, Action& action);
void add_info(CLI::App& app, Action& action);
void add_reduce(CLI::App& app, Action& action);
void add_study(CLI::App& app, Action& action);
void add_wobble(CLI::App& app, Action& action);
void add_view(CLI::App& app, Action& action);
void add_export(CLI::App& app, Action& action);
void add_cache(CLI::App& app, Action& action);
void add_schema(CLI::App& app, Action& action);
void add_ship(CLI::App& app, Action& action);

}  // namespace limber::app
