// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "limber/app/console/json.hpp"
#include "limber/runs/analyses/static_report.hpp"

/// Report of `limber static` on an equilibrium.
namespace limber::app {

[[nodiscard]] Json to_json(const runs::StaticReport& report);
[[nodiscard]] std::string to_text(const runs::StaticReport& report);

}  // namespace limber::app
