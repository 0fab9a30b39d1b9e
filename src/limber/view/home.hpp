// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/results/offset.hpp"
#include "limber/view/recording.hpp"

namespace limber::view {

/// Where a page or a scene counts from, so that single precision holds the
/// motion wherever it is.
[[nodiscard]] results::Home find_home(const Recording& recording);

}  // namespace limber::view
