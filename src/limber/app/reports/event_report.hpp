// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "limber/app/console/json.hpp"
#include "limber/dynamics/monitors/event.hpp"
#include "limber/results/pictures.hpp"

namespace limber::app {

/// Every event: time, source, what, rate.
[[nodiscard]] Json to_json(const std::vector<dynamics::Event>& events);

/// One line per event; if there are more than ten, one line per kind with the
/// number, the first and the last. Empty without events.
[[nodiscard]] std::string to_text(const std::vector<dynamics::Event>& events);

/// Marks for plots from `start` to `end` [s]. Events closer together than the
/// width of their labels share a mark. None if there are more than twelve,
/// which would hide the curves.
[[nodiscard]] std::vector<results::Mark> make_marks(
    const std::vector<dynamics::Event>& events, double start, double end);

}  // namespace limber::app
