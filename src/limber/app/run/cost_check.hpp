// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/app/reports/check_report.hpp"
#include "limber/runs/pictured_scene.hpp"

namespace limber::app {

/// Makes the first steps of a run, and the start of its results file in a
/// temporary folder.
[[nodiscard]] CostCheck check_cost(const runs::PicturedScene& scene);

}  // namespace limber::app
