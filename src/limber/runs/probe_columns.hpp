// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "limber/results/history.hpp"
#include "limber/scene/probes/probe.hpp"

namespace limber::runs {

/// Columns of a history, in the order of scene::evaluate_all.
[[nodiscard]] std::vector<results::ProbeColumn> list_columns(
    const std::vector<scene::Probe>& probes);

}  // namespace limber::runs
