// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "limber/app/console/json.hpp"
#include "limber/dynamics/monitors/contact_record.hpp"

namespace limber::app {

/// The two bodies of a pair called "A/B".
[[nodiscard]] Json split_pair(const std::string& pair);

/// Every impact: between, time, touches, impulse, peak_force, peak_time,
/// peak_depth, duration, touch_speed, restitution (null while they touch at
/// the end, or if no impact brought them together) and energy (ImpactEnergy),
/// all in SI units.
[[nodiscard]] Json to_json(const std::vector<dynamics::ContactRecord>& records);

/// A table with one line per impact; if there are more than twenty, those with
/// the largest impulse, in the order of time, and the number of the others.
/// Empty without impacts.
[[nodiscard]] std::string to_text(
    const std::vector<dynamics::ContactRecord>& records);

}  // namespace limber::app
