// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <vector>

#include "limber/dynamics/monitors/contact_record.hpp"

namespace limber::dynamics {

/// Expected duration of the shortest impact of each pair, by its name [s];
/// omits pairs whose impacts have none.
[[nodiscard]] std::map<std::string, double> find_shortest_impacts(
    const std::vector<ContactRecord>& records);

}  // namespace limber::dynamics
