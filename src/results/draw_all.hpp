// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace limber::results {

/// Draws one picture; returns an empty string, or why there is no picture.
using Picture = std::function<std::string()>;

/// Draws pictures, as many at a time as there are cores. Stops after three
/// failures, since further ones would fail alike.
/// @returns the reasons of failures, each once, in the order of pictures
[[nodiscard]] std::vector<std::string> draw_all(
    const std::vector<Picture>& pictures);

}  // namespace limber::results
