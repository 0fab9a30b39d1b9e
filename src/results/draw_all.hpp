// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace limber::results {

/// Draws one picture; empty, or why there is none.
using Picture = std::function<std::string()>;

/// Draws pictures, as many at a time as there are cores. Once three have
/// failed the next would fail alike, and is not begun.
/// @returns why there are none, each reason once, in the order of pictures
[[nodiscard]] std::vector<std::string> draw_all(
    const std::vector<Picture>& pictures);

}  // namespace limber::results
