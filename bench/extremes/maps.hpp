// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "cell.hpp"

namespace limber::bench {

/// What is swept along one side of a map.
struct Axis {
  std::string label;  ///< with its unit
  std::vector<double> values;
  std::function<void(Cell&, double)> set;
};

/// A grid of cells, for each integrator one.
struct Map {
  std::string name;
  std::string title;
  Axis x;
  Axis y;
  std::vector<dynamics::IntegratorKind> integrators;
  Cell base;
};

/// @param full finer grids, and every integrator on every map
[[nodiscard]] std::vector<Map> make_maps(bool full);

[[nodiscard]] Cell make_cell(const Map& map,
                             dynamics::IntegratorKind integrator, double x,
                             double y);

}  // namespace limber::bench
