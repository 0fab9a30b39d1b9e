// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "limber/results/gnuplot.hpp"

namespace limber::results {

/// Draws one picture; returns an empty string, or why there is no picture.
using Picture = std::function<std::string()>;

/// Adds pictures that draw the charts, several by each.
void add_charts(std::vector<GnuplotScript> charts,
                std::vector<Picture>& pictures);

/// Draws pictures, as many at a time as there are cores. Stops after three
/// failures, since further ones would fail in the same way.
/// @returns the reasons of failures, each once, in the order of pictures
[[nodiscard]] std::vector<std::string> draw_all(
    const std::vector<Picture>& pictures);

}  // namespace limber::results
