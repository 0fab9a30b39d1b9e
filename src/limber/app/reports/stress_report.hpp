// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "limber/app/console/json.hpp"
#include "limber/runs/stress_peaks.hpp"

namespace limber::app {

[[nodiscard]] Json to_json(const std::vector<runs::StressPeak>& peaks);
[[nodiscard]] std::string to_text(const std::vector<runs::StressPeak>& peaks);

}  // namespace limber::app
