// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/common/progress.hpp"

namespace limber::runs {

/// Reports one of the stages of a command with its number: "2 of 3,
/// simulating".
/// @param stage from 1 to `count`
[[nodiscard]] Progress number_stage(const Progress& progress, int stage,
                                    int count);

}  // namespace limber::runs
