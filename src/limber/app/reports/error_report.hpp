// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "limber/app/console/json.hpp"
#include "limber/runs/error_table.hpp"

namespace limber::app {

[[nodiscard]] Json to_json(const runs::ErrorTable& table);
/// Lines for a terminal, without those of noise; empty without probes.
[[nodiscard]] std::string to_text(const runs::ErrorTable& table);

}  // namespace limber::app
