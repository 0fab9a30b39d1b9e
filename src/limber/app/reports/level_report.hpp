// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "limber/app/console/json.hpp"
#include "limber/runs/level_judgement.hpp"

namespace limber::app {

[[nodiscard]] Json to_json(const runs::BodyLevel& level);
[[nodiscard]] Json to_json(const runs::SceneAdvice& advice);
/// A readable paragraph.
[[nodiscard]] std::string to_text(const runs::BodyLevel& level);
/// The [fidelity] table of a scenario that follows the advice.
[[nodiscard]] std::string to_fidelity_table(
    const std::vector<runs::BodyLevel>& levels);

}  // namespace limber::app
