// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "app/json.hpp"
#include "dynamics/event.hpp"
#include "results/pictures.hpp"

namespace limber::app {

/// Every event: time, source, what, rate.
[[nodiscard]] Json to_json(const std::vector<dynamics::Event>& events);

/// A line an event; of more than ten a line a kind, with how many there were,
/// the first and the last. Empty without events.
[[nodiscard]] std::string to_text(const std::vector<dynamics::Event>& events);

/// Marks for pictures of the times from `start` to `end` [s]. Events closer
/// together than their labels are wide share a mark. None if there are more
/// than twelve, which would hide what they mark.
[[nodiscard]] std::vector<results::Mark> make_marks(
    const std::vector<dynamics::Event>& events, double start, double end);

}  // namespace limber::app
