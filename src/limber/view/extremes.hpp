// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/common/types.hpp"
#include "limber/view/home.hpp"
#include "limber/view/recording.hpp"

namespace limber::view {

/// Largest values over all points of all bodies: the nodes of surfaces, and the
/// corners of the shapes of rigid bodies.
struct Extremes {
  /// T x 4, an output a row: deformation [m], displacement from the first
  /// output [m], speed [m/s], von Mises stress (zero without stress) [Pa].
  MatrixX fields;
  /// Box of the points at all outputs, from the home, axes of the world [m].
  Vector3 lower, upper;
};

/// Modal rates that were not recorded are differences of outputs.
[[nodiscard]] Extremes calc_extremes(const Recording& recording,
                                     const results::Home& home);

}  // namespace limber::view
